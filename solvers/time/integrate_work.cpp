// The work that is done within the steps of a method.
#include "mbs/base/entry.hpp"
#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/integrate.hpp"

#include <array>

namespace cardan::solvers {

namespace {

// Parts of a step. Lobatto's formula is of order 6, with what the long steps of Runge-Kutta methods know at their ends
// already; Gauss' is of order 4, beside the short steps of the others.
constexpr std::array lobatto{0.0, 0.27639320225002103, 0.72360679774997897, 1.0};
constexpr std::array gauss{0.21132486540518712, 0.78867513459481288};

// Integral from 0 to s of the polynomial that is 1 at places[i] and 0 at the others.
double integral_to(double s, std::span<const double> places, std::size_t i) {
    std::array<double, lobatto.size()> c = {1};  // its coefficients, lowest first
    for (std::size_t j = 0, degree = 0; j < places.size(); ++j) {
        if (j == i) continue;
        ++degree;
        const double scale = 1 / (places[i] - places[j]);
        for (std::size_t k = degree; k > 0; --k) c[k] = scale * (c[k - 1] - places[j] * c[k]);
        c[0] *= -scale * places[j];
    }
    double sum = 0;
    for (std::size_t k = places.size(); k-- > 0;) sum = s * (sum + c[k] / static_cast<double>(k + 1));
    return sum;
}

}  // namespace

// Where it is asked for the first time.
bool Integrator::find_powers() {
    if (powers_.known) return true;
    const bool long_steps = stepper_->knows_ends();
    powers_.places = long_steps ? std::span<const double>(lobatto) : std::span<const double>(gauss);
    powers_.from = stepper_->begin_of_step();
    powers_.to = stepper_->time();
    for (std::size_t i = 0; i < powers_.places.size(); ++i) {
        const double place = powers_.places[i];
        if (long_steps && (place == 0 || place == 1)) {
            powers_.at[i] = stepper_->powers_at_end(place == 1);
            continue;
        }
        const double time = powers_.from + place * (powers_.to - powers_.from);
        state_at(time, x_between_);
        if (!equations_.powers(time, x_between_.data(), powers_.at[i])) return false;
    }
    powers_.known = true;
    return true;
}

// From the present time on.
bool Integrator::accumulate(double to) {
    if (!options_.integrate_work || to <= state_.time) return true;
    if (!find_powers()) return false;
    const double h = powers_.to - powers_.from, s0 = (state_.time - powers_.from) / h, s1 = (to - powers_.from) / h;
    for (std::size_t i = 0; i < powers_.places.size(); ++i) {
        const double weight = h * (integral_to(s1, powers_.places, i) - integral_to(s0, powers_.places, i));
        const Powers& power = powers_.at[i];
        work_.forces += weight * power.forces;
        work_.dissipation += weight * power.dissipation;
        work_.drives += weight * power.drives;
        work_.state_supply += weight * power.states.supplied;
        work_.state_dissipation += weight * power.states.dissipated;
        work_.state_work += weight * power.states.work;
    }
    return true;
}

}  // namespace cardan::solvers
