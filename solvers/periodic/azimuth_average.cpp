#include "solvers/periodic/azimuth_average.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

PeriodicSteadyState periodic_state(const System& system, const RotorMap& rotor, const AzimuthAverageOptions& options) {
    PeriodicOptions periodic;
    periodic.rotor_speed = options.rotor_speed;
    periodic.harmonics = options.harmonics;
    periodic.rotor = &rotor;
    PeriodicSteadyState state = harmonic_balance(system, rotor.spin, periodic);
    require_result(state);
    return state;
}

DynamicState standstill(const System& system, int spin, double azimuth) {
    SteadyOptions options;
    options.azimuth = azimuth;
    const SteadyState state = steady_state(system, spin, options);
    require_result(state);
    return state.at;
}

}  // namespace

AzimuthAverage azimuth_average(const System& system, const RotorMap& rotor, const AzimuthAverageOptions& options) {
    const double speed = options.rotor_speed;
    if (speed != 0 && options.azimuths < 3)
        throw InputError("mean over the azimuth", "number of azimuths", options.azimuths, ">= 3");
    if (!rotor.evenly_spaced)
        throw InputError(rotor.machine, "spacing of the blades", uneven_spacing(rotor),
                         "equal angles, for a mean over the azimuth");
    system.require_no_loops("azimuth average");
    const std::vector<int> unknowns = system.model.coordinates().free_without(rotor.spin);
    const ColemanTransform coleman(rotor, unknowns, system.forces.states());
    AzimuthAverage mean;
    mean.rows = coleman.rows();
    if (speed == 0) {
        const Linearisation lin = linearise(system, standstill(system, rotor.spin, options.standstill));
        mean.system = coleman.transform(restrict_to(lin, unknowns, rotor.spin), options.standstill, 0);
        return mean;
    }
    const PeriodicSteadyState state = periodic_state(system, rotor, options);
    const PeriodicSystem periodic = in_multi_blade_rows(linearised(system, state, unknowns), coleman, speed);
    mean.steady_remainder = state.remainder;
    mean.system = mean_over_period(periodic, options.azimuths);
    const SecondOrderSystem& m = mean.system;
    SecondOrderSystem at;
    for (int i = 0; i < options.azimuths; ++i) {
        periodic.at(periodic.period() * i / options.azimuths, at);
        mean.remainder = std::max({mean.remainder, (at.K - m.K).norm() / m.K.norm(), (at.M - m.M).norm() / m.M.norm(),
                                   relative_change(at.states, m.states, std::max(std::abs(speed), 1.0))});
    }
    return mean;
}

NearestMode nearest_mode(const SecondOrderSystem& system, const std::vector<Mode>& modes, const Mode& mode) {
    if (modes.empty()) throw InputError("nearest mode", "number of modes", 0, ">= 1");
    NearestMode nearest;
    const EnergyProduct product(system, mode);
    const double own = std::real(product.with(mode));
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const double other = std::real(energy_product(system, modes[i], modes[i]));
        const double mac = std::norm(product.with(modes[i])) / (own * other);
        if (mac > nearest.mac) nearest = {i, mac};
    }
    return nearest;
}

}  // namespace cardan::solvers
