/// @file
/// Critical speeds: where, over a parameter, flutter and divergence begin or cease.
///
///     std::optional<turbines::Turbine> windy;
///     const auto at_wind = [&](double speed) {
///         windy = air.in(SteadyWind{.speed = speed}).on(machine);
///         return CampbellCase{&windy->system(), &windy->rotor()};
///     };
///     const StabilityLimits found = stability_limits(at_wind, "wind speed, m/s", 10, 60);
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "solvers/equilibrium/load_stability.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan::solvers {

/// The machine at a value of the parameter: wind speed, rotor speed, a stiffness. What it points to must last until the
/// next call; CampbellCase::parameter is not used. All machines have the same coordinates and component modes.
using MachineFamily = std::function<CampbellCase(double parameter)>;

struct StabilityOptions {
    /// Method, spin and so on; modes up to `max_frequency_hz` are followed. A frozen azimuth and a neighbour are
    /// refused, shapes are not kept. Progress counts `steps`; cancelling keeps the modes as far as they were followed.
    CampbellOptions modes = {};
    int steps = 20;  ///< equal ones, over the range. A motion that grows within less than a step only is missed
    /// Number of times that a step is halved where it is doubtful which mode is which (a MAC below `min_reliable_mac`,
    /// or another mode as like and nearer in its eigenvalue; of modes with a damping ratio up to 0.5), or where no
    /// steady state is found. What is doubtful then is marked.
    int halvings = 6;
    double tolerance = 1e-9;  ///< of the parameter, over the width of the range
    /// A mode grows if Re(lambda) > growth |lambda|; less is rounding, as of a structure without damping and air.
    double growth = 1e-8;
};

/// A motion begins to grow, or ceases to.
struct StabilityLimit {
    Instability kind = Instability::none;
    bool begins = true;     ///< it grows above the limit; false: below
    std::string name = {};  ///< of the mode, as its branch in a Campbell diagram; of a divergence, what takes part most
    double parameter = 0;   ///< within the tolerance
    double rotor_speed = 0;  ///< rad/s
    Complex eigenvalue = 0;  ///< +i omega of flutter, its real part zero but for tolerance and `growth`; 0: divergence
    bool doubtful = false;   ///< the name: its branch is doubtful on one side

    double frequency_hz() const { return eigenvalue.imag() / (2 * pi); }
};

struct StabilityLimits {
    std::vector<StabilityLimit> limits;  ///< by the parameter
    /// The modes that were followed, and where: frequencies and damping over the parameter. `complete` is false if the
    /// end of the range was not reached. Its branches are single curves, also through veerings.
    Campbell diagram;
    /// Remarks: what grows at the first value already, or where it is first found or lost; what grows, or is all there
    /// is, beyond the largest frequency that is followed; why the end of the range was not reached, or divergence not
    /// looked for. Usually empty.
    std::string note;

    /// The lowest at which a motion of this kind begins to grow; null: there is none.
    const StabilityLimit* first(Instability kind) const;
};

/// Follows all modes over a range of the parameter by their complex energy MAC, in steps that are halved where the
/// identity of a mode is doubtful, and finds by roots [TOMS 748; Alefeld, Potra and Shi 1995] where
///
/// - flutter: the growth rate of an oscillating mode passes through zero. Oscillations of states of first order
///   (Mode::is_state_motion()), as those of air that lags, are followed as all others;
/// - divergence: a real eigenvalue of the complete state matrix passes through zero, that is, one of the stiffness with
///   all states where they come to rest, K + Q_s f_s^-1 f_q. Whether it begins or ceases is the sign of the real
///   eigenvalue beyond: under loads without a potential the number of negative roots of the stiffness does not tell.
///
/// In multi-blade coordinates a divergence is one of the whole rotor; of blades that diverge by themselves the
/// collective one is found as such, while their whirling relatives oscillate at the rotor speed there and count as
/// flutter. By Floquet's theory the growth of the exponents is followed; where the rotor turns, neither divergence nor
/// oscillations of states are then looked for. An oscillation that is born of two motions that grow already has no
/// limit of its own: the note says where it is first found.
///
/// Each step, and each evaluation of a root, is a linearisation with its modes.
/// @param parameter  what it is, with its unit; empty: the rotor speed, rad/s, which the cases then have
/// @throws InputError for a range that is not finite and rising, options out of range, cases without a machine,
/// machines that differ in coordinates or component modes, and as campbell()
/// @throws NumericalError if there is no steady state at the first value
StabilityLimits stability_limits(const MachineFamily& family, const std::string& parameter, double from, double to,
                                 const StabilityOptions& options = {});

}  // namespace cardan::solvers
