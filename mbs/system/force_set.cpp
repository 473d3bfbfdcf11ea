#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/system/forces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cardan {

namespace {

constexpr double largest_magnitude = 1e100;  // squares and products stay numbers

void require_semidefinite(const Matrix& A, std::size_t n, const std::string& where, std::string_view quantity) {
    if (A.rows() != static_cast<Eigen::Index>(n) || A.cols() != A.rows())
        throw InputError(where, text(quantity, " size"), text(A.rows(), " x ", A.cols()), text(n, " x ", n));
    if (!A.allFinite()) throw InputError(where, quantity, A, "finite");
    if (!(A.cwiseAbs().maxCoeff() <= largest_magnitude)) throw InputError(where, quantity, A, "magnitudes up to 1e100");
    if ((A - A.transpose()).norm() > 1e-9 * A.norm()) throw InputError(where, quantity, A, "symmetric");
    // Scaled to unit diagonal first: entries of rotations and translations differ by many decades.
    Matrix unit = A;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
        if (A(i, i) < 0) throw InputError(where, quantity, A(i, i), ">= 0 on the diagonal");
        const double scale = A(i, i) > 0 ? 1 / std::sqrt(A(i, i)) : 1.0;
        unit.row(i) *= scale;
        unit.col(i) *= scale;
    }
    const double lowest = Eigen::SelfAdjointEigenSolver<Matrix>(unit, Eigen::EigenvaluesOnly).eigenvalues()(0);
    if (lowest < -1e-9) throw InputError(where, text(quantity, ", lowest scaled eigenvalue"), lowest, ">= 0");
}

void check_breaks(const FrameLoad& load) {
    const std::string where = text("load '", load.name, "'");
    if (!load.over_time && !load.breaks.empty())
        throw InputError(where, "number of breaks", load.breaks.size(), "0 without a function of time");
    for (std::size_t i = 0; i < load.breaks.size(); ++i)
        if (!std::isfinite(load.breaks[i]) || (i > 0 && !(load.breaks[i] > load.breaks[i - 1])))
            throw InputError(where, "time of a break [s]", load.breaks[i], "finite and ascending");
}

// The load times a factor, whenever.
void scale(FrameLoad& load, double factor) {
    load.wrench.force *= factor;
    load.wrench.moment *= factor;
    if (!load.over_time) return;
    load.over_time = [own = std::move(load.over_time), factor](double time) {
        const Wrench now = own(time);
        return Wrench{factor * now.force, factor * now.moment};
    };
}

}  // namespace

void ForceSet::add_spring(std::string name, BodyId coordinate, double stiffness, double damping, double rest) {
    LinearLaw law{std::move(name), {coordinate}, Matrix::Constant(1, 1, stiffness), {}, Vector::Constant(1, rest)};
    if (damping != 0) law.damping = Matrix::Constant(1, 1, damping);
    add_law(std::move(law));
}

void ForceSet::add_law(LinearLaw law) {
    const std::string where = text("force element '", law.name, "'");
    const std::size_t n = law.coordinates.size();
    if (n == 0) throw InputError(where, "number of coordinates", 0, "at least one");
    if (law.damping.size() == 0) law.damping = Matrix::Zero(law.stiffness.rows(), law.stiffness.cols());
    if (law.rest.size() == 0) law.rest = Vector::Zero(static_cast<Eigen::Index>(n));
    require_semidefinite(law.stiffness, n, where, "stiffness");
    require_semidefinite(law.damping, n, where, "damping");
    if (law.rest.size() != static_cast<Eigen::Index>(n) || !law.rest.allFinite())
        throw InputError(where, "rest position", law.rest.transpose(), text(n, " finite values"));
    laws_.push_back(std::move(law));
}

void ForceSet::add_wrench(FrameLoad load) {
    if (!load.wrench.force.allFinite() || !load.wrench.moment.allFinite())
        throw InputError(text("load '", load.name, "'"), "force [N], moment [N m]",
                         text(load.wrench.force.transpose(), ", ", load.wrench.moment.transpose()), "finite");
    if (!(load.wrench.force.cwiseAbs().maxCoeff() <= largest_magnitude &&
          load.wrench.moment.cwiseAbs().maxCoeff() <= largest_magnitude))
        throw InputError(text("load '", load.name, "'"), "force [N], moment [N m]",
                         text(load.wrench.force.transpose(), ", ", load.wrench.moment.transpose()),
                         "magnitudes up to 1e100");
    check_breaks(load);
    loads_.push_back(std::move(load));
}

void ForceSet::add_element(ForceElement element) {
    const std::string where = text("element '", element.name, "'");
    if (!element.evaluate) throw InputError(text(where, ": the function `evaluate` is missing"));
    if (element.points.empty() && element.coordinates.empty() && element.states.empty())
        throw InputError(where, "coordinates, points and states", "none", "what it acts upon");
    if (!element.points.empty() && !element.coordinates.empty())
        throw InputError(where, "coordinates", element.coordinates.size(), "0 beside points: it sees all of them");
    if (element.points.empty() && !element.groups.empty())
        throw InputError(where, "groups", element.groups.size(), "0 without points");
    if (element.potential && element.power)
        throw InputError(where, "potential, power", "both given", "one: power is the whole balance of energy");
    if (element.differences_by_inputs && !element.jacobian)
        throw InputError(where, "differences_by_inputs", "true", "false without a jacobian");
    if (element.elastic && !element.states.empty()) throw InputError(where, "elastic", "true", "false beside states");
    for (const FramePoint& point : element.points)
        if (!point.place.allFinite()) throw InputError(where, "place [m]", point.place.transpose(), "finite");
    elements_.push_back(std::move(element));
}

void ForceSet::add_input(InputInfo input) {
    inputs_.push_back(std::move(input));
}

void ForceSet::set_gravity(const Vec3& g) {
    if (!g.allFinite()) throw InputError("gravity", "vector [m/s^2]", g.transpose(), "finite");
    gravity_ = g;
}

namespace {

void require_frame(const FrameLoad& load, const Model& model) {
    if (load.frame.index < 0 || load.frame.index >= static_cast<int>(model.frames().size()))
        throw InputError(text("load '", load.name, "'"), "frame", load.frame.index, "a frame of the tree");
}

}  // namespace

Forces::Forces(const ForceSet& set, const Model& model)
    : loads_(set.loads()),
      elements_(set.elements(), set.inputs(), model),
      gravity_(set.gravity()),
      model_(model.serial()),
      size_(model.size()) {
    for (const LinearLaw& law : set.laws()) {
        Law bound{law.name, {}, law.stiffness, law.damping, law.rest};
        for (BodyId body : law.coordinates) {
            if (body.index < 0 || body.index >= model.size())
                throw InputError(text("force element '", law.name, "'"), "body", body.index, "a body of the tree");
            bound.at.push_back(model.index(body));
        }
        laws_.push_back(std::move(bound));
    }
    springs_ = runs_of(&Law::K);
    dampers_ = runs_of(&Law::D);
    for (const FrameLoad& load : loads_) require_frame(load, model);
}

// A law's coordinates in ascending order, cut where an index is left out.
Forces::Runs Forces::runs_of(Matrix Law::*matrix) const {
    Runs out;
    Run run{};
    const auto close = [&] {
        for (; run.size > 0 && out.values.back() == 0; --run.size) {
            out.values.pop_back();
            out.rest.pop_back();
        }
        if (run.size > 0) out.runs.push_back(run);
        run.size = 0;
    };
    for (const Law& law : laws_) {
        std::vector<Eigen::Index> order(law.at.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(), [&](auto i, auto j) { return entry(law.at, i) < entry(law.at, j); });
        for (Eigen::Index i = 0; i < std::ssize(law.at); ++i) {
            run.row = entry(law.at, i);
            for (const Eigen::Index j : order) {
                const double value = (law.*matrix)(i, j);
                if (entry(law.at, j) != run.column + run.size) close();
                if (run.size == 0 && value == 0) continue;
                if (run.size == 0) run.column = entry(law.at, j);
                ++run.size;
                out.values.push_back(value);
                out.rest.push_back(law.rest(j));
            }
            close();
        }
    }
    return out;
}

std::string Forces::stiffest_law(int coordinate) const {
    require_index("forces", "coordinate", coordinate, size_);
    std::string name;
    double stiffest = 0;
    for (const Law& law : laws_)
        for (Eigen::Index i = 0; i < law.K.rows(); ++i) {
            if (entry(law.at, i) != coordinate || !(law.K(i, i) > stiffest)) continue;
            stiffest = law.K(i, i);
            name = law.name;
        }
    return name;
}

std::vector<double> Forces::breaks() const {
    std::vector<double> all;
    for (const FrameLoad& load : loads_) all.insert(all.end(), load.breaks.begin(), load.breaks.end());
    elements_.append_breaks(all);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

Forces Forces::with_gravity(const Vec3& g) const {
    if (!g.allFinite()) throw InputError("gravity", "vector [m/s^2]", g.transpose(), "finite");
    Forces other = *this;
    other.gravity_ = g;
    return other;
}

Forces Forces::with_load(FrameLoad load, const Model& model) const {
    require_model("forces", "model", model.serial(), model_);
    require_frame(load, model);
    Forces other = *this;
    other.loads_.push_back(std::move(load));
    return other;
}

Forces Forces::with_load_factor(double factor, bool gravity_too) const {
    if (!std::isfinite(factor)) throw InputError("forces", "load factor", factor, "finite");
    Forces other = *this;
    for (FrameLoad& load : other.loads_) scale(load, factor);
    other.elements_.scale(factor);
    if (gravity_too) other.gravity_ *= factor;
    return other;
}

}  // namespace cardan
