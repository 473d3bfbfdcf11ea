/// @file
/// Air on a machine that turns, moves and bends: on its blades and, where that is asked for, on tower and nacelle.
///
///     const turbines::MachineAir air(machine, turbines::nrel5mw_aero_blade(), SteadyWind{.speed = 8});
///     const turbines::Turbine in_the_wind = air.on(machine);
///
/// Blade-element momentum in every section of every blade, at its displaced place, with its own velocity, in axes that
/// follow the bent blade: z along the section's span, y across it in the plane of the rotor, against the motion, x
/// downwind across both. Their angle to the section's chord holds twist, pitch and torsion. Ground axes of the wind and
/// base axes are the same.
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "mbs/system/channel.hpp"
#include "turbines/aerodynamics/tower_air.hpp"
#include "turbines/model/assembly.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace cardan::turbines {

struct AirLags;

/// Options of unsteady aerodynamics: states of first order that lag behind the motion.
struct UnsteadyAeroOptions {
    /// Unsteady airfoils in the place of the blade's polars, one for each; those of cylinders and of the like lag in
    /// nothing. Empty: airfoils are steady.
    std::vector<UnsteadyAirfoil> airfoils = {};
    bool airfoils_at_rest = false;  ///< they have no states, UnsteadySection::at_rest
    /// DynamicInflow in every section but those without balance of momentum, root and tip
    bool dynamic_inflow = false;
    /// tau_1 of a dynamic wake, s: MachineAir::inflow_time_constant(); 0: that of every instant. Derivatives leave out
    /// how it changes with the motion, which counts for induced velocities that are not in equilibrium alone.
    double inflow_time_constant = 0;
};

/// Immutable, cheap to copy, may be used by several threads.
class MachineAir {
public:
    /// @param blade  of all blades; its first section lies at the blade's root, its last one at the tip
    /// @param support  drag of tower and nacelle, and the influence of the tower on the wind at the sections: of the
    ///                 part of the wind across the tower's axis where it is next to the section, less the velocity of
    ///                 the tower. The mean wind of a skewed wake counts it. Beyond the tower's top it fades to nothing
    ///                 over a radius [AeroDyn]. Exact derivatives.
    /// @throws InputError for a machine without blades, sections beyond the ends of the blade, and as
    /// AeroBlade::check() and TowerAir
    MachineAir(const Turbine& turbine, AeroBlade blade, const Wind& wind, const RotorAirOptions& options = {},
               const TowerNacelleAero& support = {});
    MachineAir(const Turbine& turbine, AeroBlade blade, const SteadyWind& wind, const RotorAirOptions& options = {},
               const TowerNacelleAero& support = {})
        : MachineAir(turbine, std::move(blade), Wind(wind), options, support) {}

    /// A copy in another wind.
    MachineAir in(const Wind& wind) const;

    /// A copy with air that lags. Functions of a state then take the states of the air as well: values().
    /// @throws InputError for another number of airfoils than of polars, a time that is negative
    MachineAir lagging(UnsteadyAeroOptions options) const;
    /// A copy whose induced velocities are those of a state for ever; airfoils lag as before.
    MachineAir with_frozen_wake(const ElementView& at) const;
    /// The mean of several states, such as those of a revolution: sections().
    /// @throws InputError for none, and those of another machine
    MachineAir with_frozen_wake(std::span<const std::vector<std::vector<SectionAir>>> states) const;
    /// A copy in a wind that an input of the system changes: m/s, added to the speed at the reference height, of which
    /// the wind elsewhere is a share. on() adds the input, zero at the start. Blades see it; tower and nacelle do not.
    MachineAir with_wind_input(const std::string& name = "wind speed") const;
    int states() const;
    /// Values that the air sees of a motion: of its own states and of its input.
    /// @param forces  of on()
    ElementValues values(const StateView& at, const Forces& forces) const;
    /// States that stay as they are while the machine moves as it does.
    Vector steady_states(const ElementView& at) const;
    /// All states of a machine with this air: these of the air, others as its table says.
    /// @param own     steady_states()
    /// @param forces  of on()
    Vector with_states(const Vector& own, const Forces& forces) const;
    /// tau_1 of a dynamic wake by the mean induction and wind of a state, s: inflow_time().
    double inflow_time_constant(const ElementView& at) const;

    /// "air": forces on the blades, for ForceSet::add_element(); those on tower and nacelle: support().element(). Valid
    /// for every machine with the tree of `turbine`. Exact derivatives; no allocation. Loads per length are linear
    /// between the sections and do the same work on the beam's rigid segments as spread along them. With a skewed wake
    /// (Skew::pitt_peters) every blade feels all others through the mean wind, so derivatives are full matrices.
    ForceElement element() const;
    /// The machine with all forces of the air added to its own: element() and, where there is drag,
    /// support().element().
    Turbine on(const Turbine& turbine) const;

    /// Flow and forces of the sections at a state; forces per length, as in a rotor that does not bend (RotorAir): by
    /// blade, from root to tip.
    std::vector<std::vector<SectionAir>> sections(const ElementView& at) const;
    /// Force and moment of the air on the rotor about the rotor's centre, in axes of the shaft that do not turn: x
    /// downwind along the shaft, z up.
    struct Rotor {
        Vec3 force, moment;  ///< N, N m; moment.x(): torque, driving
        double speed;        ///< rate of the rotor centre about the shaft, rad/s
        double work_rate;    ///< of the air on all that moves the blades, bending included, W
        Vec3 centre;         ///< of the rotor, base axes, m
        double power() const { return moment.x() * speed; }
    };
    Rotor rotor(const ElementView& at) const;
    /// Wind at the rotor's centre, thrust, torque and power of the air on the rotor, rate of its work on all motions,
    /// those of tower and nacelle included.
    ChannelGroup channels() const;

    double radius() const;  ///< of the rotor that is not bent, m
    const AeroBlade& blade() const;
    const Wind& wind() const;
    const TowerAir& support() const;   ///< drag of tower and nacelle
    bool has_induction() const;        ///< the rotor induces velocities
    bool has_tower_influence() const;  ///< the tower changes the wind at the sections
    /// Azimuths of a revolution that means and harmonics need: with the tower's influence 144, for it is over within a
    /// few degrees (blades that are 120 deg apart see the tower from the same azimuths), else 1.
    int min_azimuths() const;

private:
    struct Parts;
    explicit MachineAir(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
    MachineAir with(AirLags lags) const;

    std::shared_ptr<const Parts> parts_;
};

/// Origin of a frame at rest, not bent, base axes, m.
Vec3 place_at_rest(const Turbine& turbine, FrameId frame);
/// Centre of the rotor at rest, not bent, base axes, m: the height that winds are given at.
/// @throws InputError for a machine without a rotor
Vec3 hub_at_rest(const Turbine& turbine);

}  // namespace cardan::turbines
