/// @file
/// Steps of state_space(). Internal: not for users of the library.
#pragma once

#include "solvers/linear/channel_values.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/linear_models/state_space.hpp"

#include <optional>

namespace cardan::solvers::detail {

/// Effect of a unit change of each state (first) and input on the whole machine: one column each, one row per
/// coordinate.
struct Directions {
    Matrix q, qd;         ///< change of positions and rates
    Matrix qdd;           ///< of accelerations, by the linear model
    Matrix actuator;      ///< of what drives add to Q on their coordinates
    Matrix Q;             ///< generalised forces of inputs
    Matrix s, s_rate, u;  ///< of the states of first order, their rates, the system's inputs
    Matrix lambda;        ///< of the multipliers of loops
};

/// States, driven coordinates and columns of a model, from the inputs.
class Layout {
public:
    /// @throws InputError, see state_space()
    Layout(const System& system, const RotorMap& rotor, const std::vector<LinearInput>& inputs,
           const StateSpaceOptions& options);
    /// Leaves, with loops, those as states on which the other unknowns depend.
    void keep_independent(const std::vector<int>& kept);

    Eigen::Index states() const { return 2 * std::ssize(coordinates) + first_order(); }
    Eigen::Index first_order() const { return system_.forces.states().size(); }
    Eigen::Index columns() const { return states() + std::ssize(input_signals); }

    std::vector<int> coordinates;             ///< whose positions and rates are states
    std::vector<int> unknowns, driven;        ///< coordinates with an equation of motion, and the others
    std::vector<int> independent, followers;  ///< of the unknowns, with loops
    std::vector<Signal> state_signals, input_signals;

    /// Directions as far as they follow from kinematics alone, at the poses of `kin`.
    void begin(const Kinematics& kin, Directions& out) const;
    /// Values of the inputs at an operating point.
    Vector input_values(const DynamicState& at) const;
    /// The wrench per unit input for a column; none for other columns.
    std::optional<FrameLoad> wrench_of(Eigen::Index column) const;

private:
    struct Column {
        std::size_t input;
        int derivative;  ///< 0, 1, 2 of a motion: position, rate, acceleration
    };
    void check(const LinearInput& input) const;
    std::string units(const LinearInput& input) const;
    void add_columns(const std::vector<LinearInput>& inputs);
    void name_states();

    const System& system_;
    const std::vector<LinearInput>& inputs_;
    std::vector<Column> columns_;
};

/// Channels at a state and their derivatives along Directions.
class OutputDifferences {
public:
    OutputDifferences(const System& system, const std::vector<ChannelGroup>& groups,
                      const std::vector<std::string>& wanted);

    const std::vector<Signal>& signals() const { return signals_; }
    /// Values at a state.
    Vector at(const DynamicState& state, const Forces& forces);
    /// @param error, size  in and out: largest estimated error of a difference, and largest difference, per output;
    /// empty at first
    Matrix along(const DynamicState& state, const Directions& directions, const Layout& layout, Vector& error,
                 Vector& size);

private:
    const System& system_;
    ChannelValues values_;
    std::vector<Signal> signals_;
    std::vector<std::size_t> at_;  ///< of the wanted channels among all
    std::vector<bool> angle_;      ///< may jump by 2 pi
};

}  // namespace cardan::solvers::detail
