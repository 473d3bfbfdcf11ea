/// @file
/// Air on a machine at one state: inflow, induction, loads, and their derivatives. Internal to the air on machines: not
/// installed.
#pragma once

#include "elements/aerodynamics/lagging_air.hpp"
#include "turbines/aerodynamics/detail/air_blade.hpp"
#include "turbines/aerodynamics/detail/air_tower.hpp"
#include "turbines/aerodynamics/detail/body_motion.hpp"

#include <memory>
#include <optional>
#include <span>

namespace cardan::turbines {

/// Unsteady parts of the air: of all sections, one blade after the other.
struct AirLags {
    std::shared_ptr<const std::vector<UnsteadyAirfoil>> airfoils;  ///< sections point to these
    std::vector<UnsteadySection> sections;
    std::vector<int> first;  ///< index of a section's first state
    int states = 0;
    /// tau_1 of a dynamic wake, s; 0: by the mean induction and wind of the instant, with inflow_weights() of the
    /// sections.
    double inflow_time = 0;
    std::vector<double> inflow_weights;
};

/// Parts of an evaluation that do not change with the state.
struct AirParts {
    std::shared_ptr<const AeroBlade> airfoil;  ///< of every blade; sections point to its polars
    Wind wind = SteadyWind{};
    RotorAirOptions options;
    std::vector<AirBlade> blades;
    int hub_body = -1, shaft_body = -1;       ///< what turns, and what carries it; -1: the ground
    Vec3 hub_place, hub_axis;                 ///< centre and shaft, downwind; axes of the hub's body
    std::vector<int> trunk;                   ///< bodies from the base to the hub, ascending
    double radius = 0;                        ///< of the rotor that is not bent, m
    std::vector<int> bodies;                  ///< all that move a section, ascending
    std::optional<InfluenceParts> influence;  ///< the tower changes the wind at the sections
    std::optional<AirLags> lags;
    std::string wind_input;  ///< that changes the wind's speed; empty: none
};

/// A section at a state, base axes.
struct SectionState {
    Vec3 place, span, x, y;   ///< axes of the section: x downwind, y against the motion
    Vec3 velocity, relative;  ///< of the section; of the air against it, m/s
    Mat3 wind_gradient;       ///< dW_i/dx_j, 1/s, of the wind without the tower; for derivatives only
    Vec3 radial;              ///< unit, from the shaft
    RotorWake wake;
    Annulus annulus;
    SectionAir air;
    Vec3 force, moment;  ///< per length, N/m and N
};

/// Memory of AirDerivatives.
struct AirDerivativeScratch {
    std::vector<Mover> movers;               ///< by coordinate
    std::vector<InfluenceSlopes> influence;  ///< of all sections, if the tower changes the wind there
    std::vector<LaggingSlopes> lagging;      ///< of all sections, if something lags
    std::vector<Columns6> by_q, by_qd;       ///< of the sections of a blade: force, moment per length
    /// Derivatives of all sections by what they see of the wake: its angle, its blade's sine, the share of the
    /// induction.
    std::vector<Eigen::Matrix<double, 6, 3>> by_wake;
    Columns6 blade_q, blade_qd, trunk_q, trunk_qd;             ///< moment about the base's origin, force; by coordinate
    Eigen::Matrix<double, 3, Eigen::Dynamic> mean_q, mean_qd;  ///< of the mean wind
    Matrix wake_q, wake_qd;  ///< n x (2 + blades): the wake's angle and share, the blades' sines, by coordinate
    Matrix of_wake;          ///< n x (2 + blades): generalised forces by these
};

/// Memory that evaluations reuse.
struct AirScratch {
    std::vector<BodyRate> rates;
    std::vector<SectionState> sections;     ///< of all blades, one after the other
    std::vector<InfluenceState> influence;  ///< at them, if the tower changes the wind there
    std::vector<LaggingAir> lagging;        ///< of all sections, if something lags
    std::vector<SectionInflow> inflows;     ///< of all sections
    std::vector<Induction> inductions;  ///< in equilibrium with the loads; without lags as the rotor's wake leaves them
    std::vector<Vec3> places, winds;    ///< of all sections, the wind without the tower
    std::vector<double> along_x, along_y, angles,
        levers;  ///< of all sections: the chord's components and angle, the wake's lever
    AirDerivativeScratch derivatives;
};

/// The mean wind against the rotor.
struct MeanWind {
    Vec3 velocity;  ///< less that of the hub, m/s
    double normal;  ///< along the shaft
    double speed, angle;
    InductionShare share;
};

class AirEvaluation {
public:
    AirEvaluation(const AirParts& parts, const ElementView& at, AirScratch& scratch);

    std::span<const SectionState> sections(std::size_t blade) const {
        const std::size_t count = parts_.airfoil->sections();
        return std::span(scratch_.sections).subspan(blade * count, count);
    }
    /// Wrench of a point: force and moment about it.
    Wrench wrench(std::size_t blade, const AirPoint& point) const {
        const SectionState& s = sections(blade)[point.section];
        return {point.length * s.force, point.length * s.moment};
    }
    const Vec3& shaft() const { return shaft_; }
    const Vec3& hub() const { return hub_; }
    double speed() const;  ///< of the rotor about the shaft, rad/s
    /// Power of a wrench about a place that is fixed to a body, W.
    double power(const Wrench& wrench, int body, const Vec3& place) const;
    double density() const { return wind_.density(); }
    double inflow_time() const { return inflow_time_; }  ///< tau_1 of a dynamic wake, s; 0 without
    void rates(VectorOut out) const;                     ///< of the states
    void steady_states(VectorOut out) const;
    /// Adds those by motion and states.
    void add_derivatives(ElementJacobian& out);

private:
    void place_sections();
    void disturb_wind();
    void find_mean_wind();
    void find_inductions();
    void find_inflow_time();
    void find_loads();
    void find_lagging_air();
    void find_steady_air();
    SectionMotion motion_of(std::size_t section) const;
    SectionStates states_of(std::size_t section) const;
    Vec3 blade_direction(std::size_t blade) const;  // unit, in the plane of the rotor
    double sine(std::size_t blade) const;  // of the blade's azimuth in the skewed wake, times that of the wake's angle

    friend class AirDerivatives;

    const AirParts& parts_;
    Kinematics kin_;
    Eigen::Ref<const Vector> states_;
    AirScratch& scratch_;
    BodyMotion motion_;
    WindAtTime wind_;
    Vec3 shaft_, hub_;
    MeanWind mean_ = {};
    double inflow_time_ = 0;
};

}  // namespace cardan::turbines
