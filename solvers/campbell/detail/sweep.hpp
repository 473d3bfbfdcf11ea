/// @file
/// A Campbell diagram that grows point by point. Internal: not for users of the library.
#pragma once

#include "solvers/campbell/point.hpp"
#include "solvers/mode_names/detail/floquet_mac.hpp"
#include "solvers/mode_names/detail/tracking.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cardan::solvers {

/// @throws InputError for a rotor speed that is negative or not finite, and without a machine
void check_case(const CampbellCase& one, const std::string& parameter);

/// The diagram of one machine or of several like it, point by point. Points may be computed and compared that are not
/// added.
class Sweep {
public:
    using Solvers = std::vector<std::unique_ptr<PointSolver>>;

    /// @param options  kept as a reference; their method is the one chosen
    /// @param why      it was
    /// @param points   number of them, for CampbellOptions::progress
    Sweep(const CampbellOptions& options, std::string why, std::size_t points, const std::string& parameter = {});

    void set_machine(const System& system, const RotorMap& rotor, const PointSolver& solver);
    /// Computes the point of a rotor speed and adds it. False if it was cancelled.
    bool add(const System& system, PointSolver& solver, double rotor_speed, double parameter = 0);

    /// Shares are by the components of the first machine.
    /// @throws InputError for a machine that has others
    CampbellPoint solve(PointSolver& solver, double rotor_speed);
    /// MAC of the last known mode of every track with the modes of a point that is to be the next.
    PeriodicMac likeness(const PointSolver& solver, const CampbellPoint& point) const;
    /// Tracker::continues() up to the largest frequency of the options.
    bool continues(const PeriodicMac& likeness, const CampbellPoint& point) const;
    /// Adds a point without shapes (CampbellOptions::keep_shapes), which need the machine at the end.
    /// @param parameter  its place on the axis, where that is not of rotor speeds
    void add(CampbellPoint point, const PeriodicMac& likeness, double parameter);

    /// @param solvers  by point, or one for all
    Campbell finish(const RotorMap& rotor, const Solvers& solvers, BranchesOf of = BranchesOf::names);

private:
    bool is_cancelled();
    void align(const EnergyFractions& own, CampbellPoint& point);
    PeriodicMac likeness_of_periodic(const PointSolver& solver, const CampbellPoint& point) const;
    void set_branches(const Solvers& solvers, BranchesOf of);
    void set_warning(const RotorMap& rotor, const Solvers& solvers);

    const CampbellOptions& options_;
    std::string why_;  // this method was chosen
    std::size_t points_;
    Campbell diagram_;
    std::vector<NamedState> states_;
    std::vector<FrameId> frames_;
    std::vector<const System*> systems_;      // by point, for shapes
    const EnergyFractions* first_ = nullptr;  // of the first machine
    Tracker tracker_;
    std::optional<NeighbourNames> neighbour_;
    std::string instability_;
};

}  // namespace cardan::solvers
