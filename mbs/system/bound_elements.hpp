/// @file
/// The force elements of a set, bound to a model.
#pragma once

#include "mbs/model/model.hpp"
#include "mbs/system/force_element.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cardan {

/// States that depend on one another, and the coordinates that they see or act upon. What other groups do reaches them
/// through these coordinates only: the pattern of the derivatives.
struct StateGroup {
    std::vector<int> states, coordinates;  ///< indices in the system, ascending
};

/// ElementPower of several elements, with the power of their forces.
struct StateEnergy : ElementPower {
    double work = 0;  ///< Q . qd, W
};

/// Evaluates one element after the other. Allocates nothing after the first call in a thread, unless an element's own
/// functions or the differences of one with points do. All functions throw InputError for a state of the wrong size.
class BoundElements {
public:
    BoundElements() = default;
    /// @throws InputError for coordinates, points, states and inputs that the system does not have, and for names that
    /// occur twice
    BoundElements(std::vector<ForceElement> elements, std::vector<InputInfo> inputs, const Model& model);

    int size() const { return static_cast<int>(elements_.size()); }
    /// @throws InputError for an index out of range
    const ForceElement& operator[](int i) const;
    /// @throws InputError without such an element
    int index(std::string_view name) const;
    const StateTable& states() const { return states_; }
    const InputTable& inputs() const { return inputs_; }
    const std::vector<StateGroup>& groups() const { return groups_; }
    /// One of them tells its whole balance of energy.
    bool tells_power() const;

    /// Adds the forces to Q and writes the rates of the states.
    void add_forces(const StateView& at, VectorOut& Q, VectorOut& rates) const;
    /// The wrenches of one of them, about its points, base axes.
    std::vector<Wrench> wrenches(int i, const StateView& at) const;
    /// Subtracts dQ/dq from `elastic` or `loads` and dQ/dqd from `damping`, n x n, and writes the rest.
    void derivatives(const StateView& at, Matrix& elastic, Matrix& loads, Matrix& damping, StateDerivatives& out) const;
    /// Generalised forces of one element on all coordinates.
    Vector forces(int i, const StateView& at) const;
    std::optional<double> potential(int i, const StateView& at) const;
    /// Sum over the elements that tell their balance, without load factors.
    StateEnergy energy(const StateView& at) const;
    void append_breaks(std::vector<double>& times) const;
    /// Multiplies the forces of those that are not elastic; not the rates of their states.
    void scale(double factor);

private:
    struct Bound {
        ForceElement own;
        std::vector<int> at, reads, inputs;  // indices in the system
        std::vector<int> bodies;             // of the points; -1: base
        std::vector<Vec3> places;            // of the points, in body axes
        int first = 0;                       // index of its first state
        double factor = 1;

        bool sees_all() const { return !own.points.empty(); }
        Eigen::Index states() const { return std::ssize(own.states); }
    };
    // Values and results of one element, in memory of the thread.
    class Local;

    void bind(Bound& element, const Model& model);
    void find_groups(const Model& model);
    void add_declared_groups(const Bound& element, const Model& model);
    void require_sizes(const StateView& at) const;
    void add_derivatives(const Bound& element, const StateView& at, Matrix& stiffness, Matrix& damping,
                         StateDerivatives& out) const;
    const Bound& bound(int i) const;

    std::vector<Bound> elements_;
    StateTable states_;
    InputTable inputs_;
    std::vector<StateGroup> groups_;
    int size_ = 0;  // coordinates

    friend class ElementValues;
};

/// Values that one of the elements sees at a state: for channels and other functions outside of the evaluation.
class ElementValues {
public:
    /// @throws InputError without an element of this name
    ElementValues(const BoundElements& elements, std::string_view name, const StateView& at);
    ElementValues(const ElementValues&) = delete;
    ElementValues& operator=(const ElementValues&) = delete;
    ~ElementValues() = default;
    const ElementView& view() const { return *view_; }

private:
    StateView system_;
    Vector q_, qd_, others_, u_;
    std::optional<ElementView> view_;
};

}  // namespace cardan
