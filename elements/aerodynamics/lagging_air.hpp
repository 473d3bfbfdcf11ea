/// @file
/// Air on one section of a blade that lags behind its motion: induction, airfoil, or both, with derivatives.
#pragma once

#include "elements/aerodynamics/air_model.hpp"
#include "elements/aerodynamics/dynamic_inflow.hpp"
#include "elements/aerodynamics/section_air.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace cardan {

/// Unsteady parts of a section. Its states are those of the inflow, then those of the airfoil.
struct UnsteadySection {
    const UnsteadyAirfoil* airfoil = nullptr;  ///< none: that of the annulus, steady
    Wake wake = Wake::equilibrium;
    /// The airfoil has no states here: they are those that would stay, if the motion of the instant went on for ever.
    bool at_rest = false;
    double share = 0;                                    ///< r/R, for Wake::oye: inflow_times()
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< induced, of a frozen one, m/s

    static constexpr int max_states = int{DynamicInflow::states} + int{UnsteadyAirfoil::states};
    bool has_airfoil() const { return airfoil != nullptr && airfoil->is_unsteady(); }
    int inflow_states() const { return wake == Wake::oye ? DynamicInflow::states : 0; }
    int airfoil_states() const { return has_airfoil() && !at_rest ? airfoil->own_states() : 0; }
    int states() const { return inflow_states() + airfoil_states(); }
};
/// States of a section; only the first UnsteadySection::states() count.
using SectionStates = Eigen::Matrix<double, UnsteadySection::max_states, 1>;

/// Motion of a section as its flow sees it.
struct SectionMotion {
    double V_x = 0, V_y = 0;  ///< air against the section without induction, m/s
    double rate = 0;          ///< of the section about its span, nose up, rad/s
    RotorWake wake;           ///< of no meaning to a frozen wake, which holds what it was
};

struct LaggingAir {
    SectionAir air;
    SectionStates rates = SectionStates::Zero();
    Eigen::Vector2d velocity;  ///< induced, in equilibrium with the loads, before the wake's skew, m/s
    double root = 0;           ///< of the balance, as Induction::root; for lagging_slopes()
    bool solved = false;       ///< for lagging_slopes(): whether `root` is one
};
LaggingAir lagging_air(const Annulus& annulus, const SectionMotion& motion, const SectionStates& s,
                       const RotorAirOptions& options, double density, const UnsteadySection& lags);
/// @param balance  the induction in equilibrium with the loads, solve_induction(), or none; of no meaning to a frozen
/// wake
LaggingAir lagging_air(const Induction& balance, const Annulus& annulus, const SectionMotion& motion,
                       const SectionStates& s, double density, const UnsteadySection& lags);
/// States that stay as they are.
SectionStates steady_states(const Annulus& annulus, const SectionMotion& motion, const RotorAirOptions& options,
                            const UnsteadySection& lags);

/// Derivatives of normal, driving, moment and the states' rates (rows). RotorWake::time counts as constant.
struct LaggingSlopes {
    enum Column : std::uint8_t { V_x, V_y, angle, radius, wake_angle, wake_lever, wake_share, rate, first_state };
    static constexpr int columns = first_state + UnsteadySection::max_states, rows = 3 + UnsteadySection::max_states;
    Eigen::Matrix<double, rows, columns> by = Eigen::Matrix<double, rows, columns>::Zero();
};
/// @param at  lagging_air() with the same arguments
LaggingSlopes lagging_slopes(const Annulus& annulus, const LaggingAir& at, const SectionMotion& motion,
                             const SectionStates& s, const RotorAirOptions& options, double density,
                             const UnsteadySection& lags);

}  // namespace cardan
