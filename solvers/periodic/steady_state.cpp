#include "solvers/periodic/steady_state.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/algebra/azimuth_series.hpp"

#include <algorithm>
#include <utility>

namespace cardan::solvers {

DynamicState PeriodicSteadyState::at(double psi) const {
    DynamicState point;
    point.time = psi / rotor_speed;
    point.q = coefficients * fourier_basis(psi, harmonics());
    point.qd = rotor_speed * (coefficients * fourier_basis(psi, harmonics(), 1));
    point.qdd = rotor_speed * rotor_speed * (coefficients * fourier_basis(psi, harmonics(), 2));
    if (turns.size() > 0) {
        point.q += psi * turns;
        point.qd += rotor_speed * turns;
    }
    point.q(spin) = psi;
    point.qd(spin) = rotor_speed;
    if (state_coefficients.rows() > 0) {
        point.s = state_coefficients * fourier_basis(psi, harmonics());
        point.s_rate = rotor_speed * (state_coefficients * fourier_basis(psi, harmonics(), 1));
    }
    if (multipliers.rows() > 0) point.lambda = multipliers * fourier_basis(psi, harmonics());
    point.u = inputs;
    return point;
}

double PeriodicSteadyState::amplitude(int harmonic) const {
    if (harmonic < 0 || harmonic > harmonics())
        throw InputError("periodic steady state", "harmonic", harmonic, text("0 ... ", harmonics()));
    if (harmonic == 0) return coefficients.col(0).cwiseAbs().maxCoeff();
    return coefficients.middleCols(2 * harmonic - 1, 2).rowwise().norm().maxCoeff();
}

double PeriodicSteadyState::last_harmonics() const {
    double largest = 0;
    for (int j = 1; j <= harmonics(); ++j) largest = std::max(largest, amplitude(j));
    if (largest == 0) return 0;
    double last = 0;
    for (int j = std::max(1, harmonics() - 1); j <= harmonics(); ++j) last = std::max(last, amplitude(j));
    return last / largest;
}

std::string PeriodicSteadyState::neglected_in_words() const {
    if (!needs_more_harmonics) return {};
    return text("at ", rotor_speed * units::to_rpm, " rpm ", harmonics(),
                " harmonics leave a residual over stiffness of ", remainder, " and of states over their scales of ",
                state_remainder, " in the periodic steady state: take more");
}

std::vector<PeriodicSteadyState> periodic_sweep(const System& system, int spin, std::span<const double> rotor_speed,
                                                PeriodicOptions options) {
    constexpr double smallest_part = 1.0 / 64;
    std::vector<PeriodicSteadyState> states;
    double reached = 0;
    bool any = false;
    for (double wanted : rotor_speed) {
        options.rotor_speed = wanted;
        PeriodicSteadyState state = harmonic_balance(system, spin, options);
        const Matrix begin = options.start, states_begin = options.state_start;
        // Part of the way from the last speed that converged; doubled after a success, halved after a failure.
        for (double done = 0, part = 0.5; any && !state.converged && part >= smallest_part;) {
            options.rotor_speed = reached + std::min(1.0, done + part) * (wanted - reached);
            PeriodicSteadyState between = harmonic_balance(system, spin, options);
            if (!between.converged) {
                part /= 2;
                continue;
            }
            options.start = between.coefficients;
            options.state_start = between.state_coefficients;
            done += part;
            part *= 2;
            if (done >= 1) state = std::move(between);
        }
        if (state.converged) {
            options.start = state.coefficients;
            options.state_start = state.state_coefficients;
            reached = wanted;
            any = true;
        } else {
            options.start = begin;
            options.state_start = states_begin;
        }
        states.push_back(std::move(state));
    }
    return states;
}

}  // namespace cardan::solvers
