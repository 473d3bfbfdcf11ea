#include "elements/machine_elements/bushing.hpp"

#include "elements/machine_elements/pair_law.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

void require_finite_coefficients(const std::string& where, const BearingCoefficients& coefficients) {
    if (!coefficients.stiffness.allFinite() || !coefficients.damping.allFinite())
        throw InputError(where, "coefficients", "not finite", "finite");
}

}  // namespace

void add_bushing(ForceSet& forces, const Bushing& bushing) {
    const std::string where = text("bushing '", bushing.name, "'");
    const Mat6 &K = bushing.stiffness, &D = bushing.damping;
    if (!K.allFinite() || !D.allFinite()) throw InputError(where, "stiffness, damping", "not finite", "finite");
    if (K.isZero(0) && D.isZero(0)) throw InputError(where, "stiffness and damping", 0, "one that is not zero");
    if ((K - K.transpose()).norm() > 1e-9 * K.norm())
        throw InputError(where, "stiffness", "not symmetric", "symmetric");
    PairLaw pair{bushing.name, bushing.a, bushing.b, {}, {}};
    for (int i = 0; i < 3; ++i) pair.measures.push_back(PairMeasure::turn(i));
    for (int i = 0; i < 3; ++i) pair.measures.push_back(PairMeasure::along(i));
    pair.law = [K, D](double /*time*/, const Vector& x, const Vector& v, PairForces& out) {
        out.f.noalias() = -(K * x.head<6>()) - D * v.head<6>();
        out.by_x = -K;
        out.by_v = -D;
        out.energy = x.head<6>().dot(K * x.head<6>()) / 2;
    };
    forces.add_element(pair_force(pair));
}

JournalBearingTable::JournalBearingTable(std::vector<double> speeds, std::vector<BearingCoefficients> coefficients)
    : speeds_(std::move(speeds)), coefficients_(std::move(coefficients)) {
    if (speeds_.empty() || speeds_.size() != coefficients_.size())
        throw InputError("bearing table", "number of coefficients", coefficients_.size(),
                         text("as many as speeds, ", speeds_.size(), ", and at least one"));
    for (std::size_t i = 0; i < speeds_.size(); ++i) {
        if (!std::isfinite(speeds_[i]) || (i > 0 && speeds_[i] <= speeds_[i - 1]))
            throw InputError("bearing table", text("speed ", i, " [rad/s]"), speeds_[i], "finite and ascending");
        require_finite_coefficients(text("bearing table, speed ", speeds_[i]), coefficients_[i]);
    }
}

BearingCoefficients JournalBearingTable::at(double speed) const {
    if (!(speed >= speeds_.front() && speed <= speeds_.back()))
        throw InputError("bearing table", "speed [rad/s]", speed, text(speeds_.front(), " ... ", speeds_.back()));
    const auto next = std::upper_bound(speeds_.begin(), speeds_.end(), speed);
    if (next == speeds_.end()) return coefficients_.back();
    const auto i = next - speeds_.begin();
    const double part = (speed - entry(speeds_, i - 1)) / (entry(speeds_, i) - entry(speeds_, i - 1));
    const BearingCoefficients &below = entry(coefficients_, i - 1), &above = entry(coefficients_, i);
    return {(1 - part) * below.stiffness + part * above.stiffness, (1 - part) * below.damping + part * above.damping};
}

void add_bearing(ForceSet& forces, const JournalBearing& bearing) {
    require_finite_coefficients(text("bearing '", bearing.name, "'"), bearing.coefficients);
    PairLaw pair{bearing.name, bearing.a, bearing.b, {PairMeasure::along(0), PairMeasure::along(1)}, {}};
    pair.has_energy = false;
    pair.law = [own = bearing.coefficients](double /*time*/, const Vector& x, const Vector& v, PairForces& out) {
        out.f = -(own.stiffness * x.head<2>()) - own.damping * v.head<2>();
        out.by_x = -own.stiffness;
        out.by_v = -own.damping;
    };
    forces.add_element(pair_force(pair));
}

}  // namespace cardan
