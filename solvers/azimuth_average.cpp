#include "solvers/azimuth_average.hpp"

#include "mbs/error.hpp"
#include "solvers/periodic.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

std::vector<int> free_without_spin(const System& system, int spin) {
    std::vector<int> unknowns;
    for (int i : system.model.coordinates().free())
        if (i != spin) unknowns.push_back(i);
    return unknowns;
}

PeriodicSteadyState periodic_state(const System& system, int spin, const AzimuthAverageOptions& options) {
    PeriodicOptions periodic;
    periodic.rotor_speed = options.rotor_speed;
    periodic.harmonics = options.harmonics;
    PeriodicSteadyState state = harmonic_balance(system, spin, periodic);
    if (!state.converged) throw NumericalError(state.message);
    return state;
}

OperatingPoint standstill(const System& system, int spin, double azimuth) {
    SteadyOptions options;
    options.azimuth = azimuth;
    const SteadyState state = steady_state(system, spin, options);
    if (!state.converged) throw NumericalError(state.message);
    return state.at;
}

}  // namespace

AzimuthAverage azimuth_average(const System& system, const RotorMap& rotor, const AzimuthAverageOptions& options) {
    const bool turns = options.rotor_speed != 0;
    if (turns && options.azimuths < 3)
        throw InputError("mean over the azimuth", "number of azimuths", options.azimuths, ">= 3");
    const std::vector<int> unknowns = free_without_spin(system, rotor.spin);
    const ColemanTransform coleman(rotor, unknowns);
    Lineariser lineariser(system);
    Linearisation lin;
    const auto at = [&](const OperatingPoint& point, double psi) {
        lineariser.linearise(point, lin);
        SecondOrderSystem own = restrict_to(lin, unknowns, rotor.spin);
        coleman.transform_in_place(own, psi, options.rotor_speed);
        return own;
    };
    AzimuthAverage mean;
    mean.rows = coleman.rows();
    if (!turns) {
        mean.system = at(standstill(system, rotor.spin, options.standstill), options.standstill);
        return mean;
    }
    const PeriodicSteadyState state = periodic_state(system, rotor.spin, options);
    mean.steady_remainder = state.remainder;
    std::vector<SecondOrderSystem> all;
    for (int i = 0; i < options.azimuths; ++i) {
        const double psi = 2 * pi * i / options.azimuths;
        all.push_back(at(state.at(psi), psi));
    }
    SecondOrderSystem& sum = mean.system = all.front();
    for (std::size_t i = 1; i < all.size(); ++i)
        sum.M += all[i].M, sum.C += all[i].C, sum.K += all[i].K, sum.K_elastic += all[i].K_elastic;
    const double share = 1.0 / options.azimuths;
    sum.M *= share, sum.C *= share, sum.K *= share, sum.K_elastic *= share;
    for (const SecondOrderSystem& own : all)
        mean.remainder =
            std::max({mean.remainder, (own.K - sum.K).norm() / sum.K.norm(), (own.M - sum.M).norm() / sum.M.norm()});
    return mean;
}

NearestMode nearest_mode(const SecondOrderSystem& system, const std::vector<Mode>& modes, const Mode& mode) {
    if (modes.empty()) throw InputError("nearest mode", "number of modes", 0, ">= 1");
    NearestMode nearest;
    const double own = std::real(energy_product(system, mode, mode));
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const double other = std::real(energy_product(system, modes[i], modes[i]));
        const double mac = std::norm(energy_product(system, modes[i], mode)) / (own * other);
        if (mac > nearest.mac) nearest = {i, mac};
    }
    return nearest;
}

}  // namespace cardan::solvers
