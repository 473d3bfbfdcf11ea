/// @file
/// The elements with states of a force set, bound to a model.
#pragma once

#include "mbs/model/model.hpp"
#include "mbs/system/state.hpp"
#include "mbs/system/state_element.hpp"

#include <string>
#include <vector>

namespace cardan {

/// States that depend on one another, and the coordinates that they see or act upon. What other groups do reaches them
/// through these coordinates only: the pattern of the derivatives.
struct StateGroup {
    std::vector<int> states, coordinates;  ///< indices in the system, ascending
};

/// States that somebody else evaluates, behind those of the elements: their names and pattern.
struct OtherStates {
    std::string owner;
    std::vector<StateInfo> states;
    std::vector<StateGroup> groups;  ///< states by their index here, coordinates by that in the system
};

/// Allocates nothing after the first call in a thread, unless an element's own functions do.
class StateForces {
public:
    StateForces() = default;
    /// @throws InputError for coordinates, states and inputs that the system does not have, and for names that occur
    /// twice
    StateForces(std::vector<StateElement> elements, std::vector<InputInfo> inputs, const Model& model,
                const std::vector<OtherStates>& others = {});

    bool empty() const { return states_.empty() && elements_.empty() && inputs_.empty(); }
    const StateTable& states() const { return states_; }
    const InputTable& inputs() const { return inputs_; }
    const std::vector<StateGroup>& groups() const { return groups_; }

    /// Adds the forces to Q and writes the rates of the elements' states.  @param f  out, number of states
    void rates(const StateView& at, VectorOut& Q, VectorOut& f) const;
    /// Subtracts dQ/dq from K and dQ/dqd from D (n x n), and writes the rest, zero for the states of others.
    void derivatives(const StateView& at, Matrix& K, Matrix& D, StateDerivatives& out) const;
    /// Sum over the elements that tell their energy.
    StateEnergy energy(const StateView& at) const;
    /// Appends the times across which the elements are not smooth.
    void append_breaks(std::vector<double>& times) const;
    /// Multiplies the forces Q, not the rates.
    void scale(double factor);

private:
    struct Bound {
        StateElement own;
        std::vector<int> at, reads, inputs;  ///< indices in the system
        int first = 0;                       ///< index of its first state
    };
    // Values, results and derivatives of one element, in memory of the thread.
    class Local;

    void bind(Bound& element, const Model& model);
    void find_groups();
    void add_groups(const OtherStates& others, int first, const std::string& where);
    void difference(const Bound& element, double time, Local& local) const;
    double step(const Bound& element, int column) const;
    void require_sizes(const StateView& at) const;

    std::vector<Bound> elements_;
    StateTable states_;
    InputTable inputs_;
    std::vector<StateGroup> groups_;
    int size_ = 0, own_ = 0;  // coordinates; states of the elements
    double factor_ = 1;
};

}  // namespace cardan
