// The work that is done within the steps of a method.
#include "mbs/base/entry.hpp"
#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/integrate.hpp"

#include <array>

namespace cardan::solvers {

namespace {

// Lobatto's formula, of order 6: its places in a step.
constexpr std::array places{0.0, 0.27639320225002103, 0.72360679774997897, 1.0};

// Integral from 0 to s of the polynomial that is 1 at places[i] and 0 at the others.
double integral_to(double s, std::size_t i) {
    std::array<double, places.size()> c = {1};  // its coefficients, lowest first
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

void Integrator::add_work(const Powers& power, double duration) {
    work_.forces += duration * power.forces;
    work_.dissipation += duration * power.dissipation;
    work_.drives += duration * power.drives;
    work_.state_supply += duration * power.states.supplied;
    work_.state_dissipation += duration * power.states.dissipated;
    work_.state_work += duration * power.states.work;
}

// At the places of the last step, where it is asked for the first time.
bool Integrator::find_powers() {
    if (powers_.known) return true;
    const Stepper::Ends ends = stepper_->ends();
    powers_.begin = ends.begin;
    powers_.end = ends.end;
    powers_.at.front() = ends.at_begin;
    powers_.at.back() = ends.at_end;
    for (std::size_t i = 1; i + 1 < places.size(); ++i) {
        const double time = ends.begin + places[i] * (ends.end - ends.begin);
        state_at(time, x_between_);
        if (!equations_.powers(time, x_between_.data(), powers_.at[i])) return false;
    }
    powers_.known = true;
    return true;
}

// From the present time on. Beside the long steps of Runge-Kutta methods, which know the powers at their ends,
// Lobatto's formula over the step, and in parts of it the polynomial through the same powers; beside the short ones of
// the others Gauss' formula of order 4 over every part.
bool Integrator::accumulate(double to) {
    const double from = state_.time;
    if (!options_.integrate_work || to <= from) return true;
    if (options_.method == Method::dirk || options_.method == Method::erk) {
        if (!find_powers()) return false;
        const double h = powers_.end - powers_.begin, s0 = (from - powers_.begin) / h, s1 = (to - powers_.begin) / h;
        for (std::size_t i = 0; i < places.size(); ++i)
            add_work(powers_.at[i], h * (integral_to(s1, i) - integral_to(s0, i)));
        return true;
    }
    constexpr double place = 0.57735026918962576;  // on -1 ... 1
    const double half = (to - from) / 2;
    std::array<Powers, 2> powers;  // all before any is added: a user force may throw
    for (std::size_t i = 0; i < 2; ++i) {
        const double time = from + half * (i == 0 ? 1 - place : 1 + place);
        state_at(time, x_between_);
        if (!equations_.powers(time, x_between_.data(), powers[i])) return false;
    }
    for (const Powers& power : powers) add_work(power, half);
    return true;
}

}  // namespace cardan::solvers
