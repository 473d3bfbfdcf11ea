#include "mbs/loops/closure.hpp"

#include "mbs/base/error.hpp"
#include "mbs/loops/constraint_factor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan {

namespace {

constexpr const char* in_closure = "closing of loops";
// Gradients less independent than this are taken for dependent.
constexpr double dependent_below = 1e-9;
// Rates over their terms that mean that a loop opens.
constexpr double open_from = 1e-9;

std::vector<bool> kept(const Model& model, const std::vector<int>& fixed) {
    std::vector<bool> flags = model.coordinates().driven();
    for (const int coordinate : fixed) {
        require_index(in_closure, "fixed coordinate", coordinate, model.size());
        flags[static_cast<std::size_t>(coordinate)] = true;
    }
    return flags;
}

void require_finite_entries(const Model& model, const char* what, const Vector& values) {
    require_size(in_closure, what, values, model.size());
    for (int i = 0; i < model.size(); ++i)
        if (!std::isfinite(values(i)))
            throw InputError(text(in_closure, ": '", model.coordinates()[i].name, "'"), what, values(i), "finite");
}

// Everything at one position.
class Place {
public:
    Place(const Model& model, const Loops& loops, const std::vector<int>& fixed, double time)
        : phi(Vector::Zero(loops.size())),
          G(loops.size(), model.size()),
          magnitudes(loops.size(), model.size()),
          model_(model),
          loops_(loops),
          time_(time),
          allowed_(loops.size()),
          workspace_(model),
          metric_(model, kept(model, fixed)),
          factor_(model, loops.size()) {}

    // How far the loops are open, over what is allowed at the position factorised last.
    double gap_at(const Vector& q) {
        const Kinematics kin = kinematics(model_, q, workspace_);
        loops_.residual<double>(kin, time_, q, phi);
        return phi.allFinite() ? phi.cwiseQuotient(allowed_).lpNorm<Eigen::Infinity>()
                               : std::numeric_limits<double>::infinity();
    }
    void factorise(const Vector& q, double tolerance) {
        const Kinematics kin = kinematics(model_, q, workspace_);
        loops_.tolerances(kin, time_, q, tolerance, allowed_);
        loops_.gradient(kin, time_, q, G, magnitudes);
        if (const PivotStatus status = metric_.factorise(kin); !status)
            throw NumericalError(text(in_closure, ": ", status.message()));
        factor_.factorise(metric_, G, magnitudes, dependent_below);
    }
    // The equation that is open the furthest.
    int widest() const {
        Eigen::Index worst = 0;
        phi.cwiseQuotient(allowed_).cwiseAbs().maxCoeff(&worst);
        return static_cast<int>(worst);
    }
    int turned_over(const Vector& q) { return loops_.turned_over(kinematics(model_, q, workspace_)); }
    Vector shortest(const Vector& y) {
        Vector x(model_.size());
        factor_.shortest(y, x);
        return x;
    }
    // Of displacements of the free coordinates.
    double product(Vector x, Vector y) {
        for (Vector* v : {&x, &y}) {
            for (int i = 0; i < model_.size(); ++i)
                if (metric_.is_driven(i)) (*v)(i) = 0;
            metric_.multiply_L(*v);
        }
        return x.dot(y);
    }
    double length(const Vector& x) { return std::sqrt(product(x, x)); }
    const ConstraintFactor& factor() const { return factor_; }

    Vector phi;
    Matrix G, magnitudes;

private:
    const Model& model_;
    const Loops& loops_;
    double time_;
    Vector allowed_;
    Workspace workspace_;
    MetricFactor metric_;
    ConstraintFactor factor_;
};

// Newton's method; steps that open the loops further are halved. True: closed.
bool close(Place& place, Closure& state, const ClosureOptions& options) {
    bool polished = false;
    double gap = 0;  // over what is allowed
    for (;; ++state.iterations) {
        place.factorise(state.q, options.tolerance);
        gap = place.gap_at(state.q);
        const bool closed = gap <= 1;
        if (closed && (polished || gap == 0)) return true;
        if (state.iterations >= options.iterations) return closed;
        const Vector step = place.shortest(place.phi);
        double fraction = 1, gap_there = 0;
        Vector trial;
        for (int halving = 0; halving < 12; ++halving, fraction /= 2) {
            trial = state.q - fraction * step;
            gap_there = place.gap_at(trial);
            if (gap_there < gap) break;
        }
        polished = closed;  // one step more than needed, for quadratic convergence makes it the last
        if (!(gap_there < gap)) return closed;
        state.q = trial;
    }
}

// From one closed position to another that is nearer to the start, along the part of the way back that lies in the
// tangent space. How far: as the change of that part over the last step tells.                 [Barzilai and Borwein
// 1988]
void approach(Place& place, const Vector& start, Closure& state, const ClosureOptions& options) {
    const auto way_back = [&](const Vector& q) {
        place.factorise(q, options.tolerance);
        const Vector back = start - q;
        return Vector(back - place.shortest(place.G * back));
    };
    Vector back = way_back(state.q);
    state.distance = place.length(state.q - start);
    double fraction = 1;
    for (int i = 0; i < 60 && fraction > 1e-3 && place.length(back) > 1e-9 * state.distance; ++i) {
        Closure next;
        next.q = state.q + fraction * back;
        next.converged = close(place, next, options);
        const Vector next_back = way_back(next.q);
        next.distance = place.length(next.q - start);
        if (!next.converged || next.distance > state.distance * (1 + 1e-14)) {
            fraction /= 2;
            continue;
        }
        const double left = place.product(next_back, back) / place.product(back, back);
        fraction = std::clamp(left < 0.9 ? fraction / (1 - left) : 2 * fraction, 0.01, 10.0);
        next.iterations += state.iterations;
        state = next;
        back = next_back;
    }
}

}  // namespace

Closure close_loops(const Model& model, const Loops& loops, const Vector& q, const ClosureOptions& options) {
    require_finite_entries(model, "position", q);
    Closure result;
    result.q = q;
    result.converged = true;
    if (loops.empty()) return result;
    Place place(model, loops, options.fixed, options.time);
    result.converged = close(place, result, options);
    if (result.converged && options.nearest) approach(place, q, result, options);
    place.factorise(result.q, options.tolerance);
    result.rank = place.factor().rank();
    place.gap_at(result.q);
    result.gap = place.phi.lpNorm<Eigen::Infinity>();
    if (!result.converged) {
        const int widest = place.widest();
        const Loops::Equation& worst = entry(loops.equations(), widest);
        result.message =
            text("the loops cannot be closed from here: ", loops.describe(worst.loop), " leaves ", place.phi(widest),
                 " ", worst.unit, " (", worst.name, ") after ", result.iterations,
                 " iterations; start from a position that is nearer, hold fewer coordinates, or look for a "
                 "length that does not fit");
    } else if (const int turned = place.turned_over(result.q); turned >= 0) {
        result.converged = false;
        result.message = text("the loops close from here only with the axes of ", loops.describe(turned),
                              " against each other; turn one of its frames by 180 degrees, or start nearer");
    }
    return result;
}

Vector close_rates(const Model& model, const Loops& loops, const Vector& q, const Vector& qd,
                   const ClosureOptions& options) {
    require_finite_entries(model, "position", q);
    require_finite_entries(model, "rate", qd);
    if (loops.empty()) return qd;
    Place place(model, loops, options.fixed, options.time);
    place.factorise(q, options.tolerance);
    Vector opening(loops.size()), own(loops.size());
    loops.time_rates(options.time, q, own);
    Vector closed = qd;
    for (int pass = 0; pass < 2; ++pass) {
        opening = own + place.G * closed;
        closed -= place.shortest(opening);
    }
    opening = own + place.G * closed;
    // Beside the terms of which the rates of the equations are sums.
    const Vector terms = own.cwiseAbs() + place.magnitudes * closed.cwiseAbs();
    for (int i = 0; i < loops.size(); ++i)
        if (std::abs(opening(i)) > open_from * terms(i))
            throw InputError(text(in_closure, ": ", loops.describe(entry(loops.equations(), i).loop)),
                             "rate at which it opens", opening(i),
                             "0: prescribed rates contradict each other, or the position is a dead point");
    return closed;
}

}  // namespace cardan
