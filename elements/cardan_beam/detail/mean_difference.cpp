#include "elements/cardan_beam/detail/mean_difference.hpp"

#include "elements/cardan_beam/detail/static_shapes.hpp"

namespace cardan {

namespace {

using Samples = PlanarElement::Samples;

// What the chain requires of the end bodies: first moments of B4 and B1 about their hinges and second ones, (P2, Q1,
// I4, I1). A point mass on a hinge belongs to either neighbour, so that masses come last.
using Targets = Eigen::Vector4d;

// EnergyFraction of the linear term of each shape in the inertia about its hinge. Any share is of fourth order; 1/3 is
// best on blades with few elements.
constexpr double linear_share = 1. / 3;

// The middle body: mass, first and second moment about the middle of the hinges.
struct Rest {
    double mass, first, second;
    double own() const { return second - first * first / mass; }
};

class Partitioner {
public:
    Partitioner(const PlanarElement& element, const HingePlaces& hinges)
        : L_(element.length()), hinges_(hinges), middle_((hinges.first + hinges.second) / 2) {
        const double x1 = hinges.first, x2 = hinges.second;
        const std::array<double, 4> cuts{0, x1, x2, L_};
        for (std::size_t k = 0; k < 3; ++k) segment_[k] = element.mass_moments(cuts[k], cuts[k + 1]);
        all_ = segment_[0] + segment_[1] + segment_[2];
        const Vec3 &first = segment_[0], &last = segment_[2];
        true_ << last(1) - x2 * last(0), x1 * first(0) - first(1), last(2) - 2 * x2 * last(1) + x2 * x2 * last(0),
            first(2) - 2 * x1 * first(1) + x1 * x1 * first(0);
        const HingeShapes s = hinge_shapes(element, hinges);
        shapes_ << s.P2, s.Q1, (1 - linear_share) * s.M22 + linear_share * s.L2,
            (1 - linear_share) * s.M11 + linear_share * s.L1;
    }

    MeanDifference result() const {
        const double limiter = feasible(shapes_) ? 1 : largest([&](double t) { return feasible(blend(t)); });
        if (limiter < 1e-6) return {hinges_, true_segments(), 0, 1};
        const Targets q = limiter < 1 ? blend(limiter) : shapes_;
        const Minima min = min_masses(q);
        const double g1 = std::max(segment_[0](0), min.first / 0.75), g4 = std::max(segment_[2](0), min.last / 0.75);
        const auto masses = [&](double tau) {
            return Minima{min.first + tau * (g1 - min.first), min.last + tau * (g4 - min.last)};
        };
        const Rest at_least = rest(q, min);
        const auto sound = [&](double tau) {
            const Rest r = rest(q, masses(tau));
            return r.mass > at_least.mass / 4 && inside(r) && r.own() >= at_least.own() / 4;
        };
        const double gauge = sound(1) ? 1 : largest(sound);
        return {hinges_, bodies(q, masses(gauge)), limiter, gauge};
    }

private:
    struct Minima {
        double first, last;
    };

    Targets blend(double t) const { return true_ + t * (shapes_ - true_); }

    // Masses of B1 and B4 below which their own inertia is negative or their centre outside the element.
    Minima min_masses(const Targets& q) const {
        const double P2 = q(0), Q1 = q(1), x1 = hinges_.first, x2 = hinges_.second, tiny = 1e-9 * L_;
        return {std::max({Q1 * Q1 / q(3), Q1 / std::max(x1, tiny), -Q1 / (L_ - x1)}),
                std::max({P2 * P2 / q(2), P2 / std::max(L_ - x2, tiny), -P2 / x2})};
    }

    Rest rest(const Targets& q, const Minima& m) const {
        const double P2 = q(0), Q1 = q(1), c = middle_, a = hinges_.first - c, e = hinges_.second - c;
        const double M = all_(0), S = all_(1) - c * M, I = all_(2) - 2 * c * all_(1) + c * c * M;
        return {M - m.first - m.last, S - (m.first * a - Q1) - (m.last * e + P2),
                I - (m.first * a * a - 2 * a * Q1 + q(3)) - (m.last * e * e + 2 * e * P2 + q(2))};
    }

    bool inside(const Rest& r) const { return -middle_ * r.mass <= r.first && r.first <= (L_ - middle_) * r.mass; }

    bool feasible(const Targets& q) const {
        if (!(q(2) > 0 && q(3) > 0)) return false;
        const Rest r = rest(q, min_masses(q));
        const double spread = all_(0) * all_(2) - all_(1) * all_(1);
        return r.mass > 0.02 * all_(0) && inside(r) && r.mass * r.second - r.first * r.first >= 1e-3 * spread;
    }

    // The largest argument in (0, 1) up to which a condition holds; the sets are convex.
    template <class Condition>
    static double largest(const Condition& holds) {
        double good = 0, bad = 1;
        for (int i = 0; i < 40; ++i) {
            const double t = (good + bad) / 2;
            (holds(t) ? good : bad) = t;
        }
        return good;
    }

    std::array<PlanarBody, 3> bodies(const Targets& q, const Minima& m) const {
        const Rest r = rest(q, m);
        return {{{m.first, hinges_.first - q(1) / m.first, q(3) - q(1) * q(1) / m.first},
                 {r.mass, middle_ + r.first / r.mass, r.own()},
                 {m.last, hinges_.second + q(0) / m.last, q(2) - q(0) * q(0) / m.last}}};
    }

    std::array<PlanarBody, 3> true_segments() const {
        std::array<PlanarBody, 3> bodies{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& s = segment_[k];
            if (s(0) > 0) bodies[k] = {s(0), s(1) / s(0), std::max(0.0, s(2) - s(1) * s(1) / s(0))};
        }
        return bodies;
    }

    double L_;
    HingePlaces hinges_;
    double middle_;
    std::array<Vec3, 3> segment_;  // int mu (1, x, x^2) dx of the true segments
    Vec3 all_;
    Targets true_, shapes_;
};

}  // namespace

HingeShapes hinge_shapes(const PlanarElement& element, const HingePlaces& hinges) {
    const StaticShapes p = static_shapes(element, hinges);
    const Samples &x = element.x(), &mu = element.mass();
    return {element.integral(mu * p.last),
            element.integral(mu * p.first),
            element.integral(mu * p.last.square()),
            element.integral(mu * p.first.square()),
            element.integral(mu * p.last * (x - hinges.second)),
            element.integral(mu * p.first * (hinges.first - x))};
}

MeanDifference mean_difference(const PlanarElement& element) {
    return Partitioner(element, mean_difference_points(element)).result();
}

}  // namespace cardan
