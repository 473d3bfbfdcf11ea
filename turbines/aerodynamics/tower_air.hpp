/// @file
/// Drag of the air on the tower and the nacelle of a machine.
///
///     const turbines::TowerAir air(machine, {.tower = {.height = {0, 87.6}, .diameter = {6, 3.87}, .drag = {0.5,
///     0.5}}},
///                                  SteadyWind{.speed = 8});
///     ForceSet forces = machine.forces();
///     forces.add_element(air.element());
///
/// Per length of the tower, which bends and moves,
///
///     1/2 rho C_d D |V| V,    V the air's velocity against it, the part across its axis,
///
/// at the heights of the table, linear between them, nothing beyond. Ground axes of the wind and base axes are the
/// same.
#pragma once

#include "elements/aerodynamics/tower.hpp"
#include "elements/wind/wind.hpp"
#include "turbines/model/assembly.hpp"

#include <memory>
#include <vector>

namespace cardan::turbines {

/// Immutable, cheap to copy, may be used by several threads.
class TowerAir {
public:
    /// The wind is that of the open field. What the tower does to it is no matter of its own forces, but of the
    /// rotor's: MachineAir.
    /// @throws InputError for drag of a tower or a nacelle that the machine does not have, rows beyond the ends of the
    /// tower, and as AeroTower::check() and AeroNacelle::check()
    TowerAir(const Turbine& turbine, const TowerNacelleAero& support, const Wind& wind);

    /// A copy in another wind.
    TowerAir in(const Wind& wind) const;

    /// "air on the tower": its forces, for ForceSet::add_element(); valid for every machine with the tree of `turbine`.
    /// Exact derivatives; no allocation. Loads do the same work on the beam's rigid segments as spread along them.
    ForceElement element() const;

    /// Forces at a state, base axes: forces per length at the rows of the table, N/m, from the foot upwards.
    std::vector<Vec3> tower(const StateView& at) const;
    Vec3 nacelle(const StateView& at) const;      ///< force on it, N
    double work_rate(const StateView& at) const;  ///< of the drag on all motions, W
    bool is_empty() const;                        ///< neither tower nor nacelle has drag

private:
    struct Parts;
    std::shared_ptr<const Parts> parts_;
};

}  // namespace cardan::turbines
