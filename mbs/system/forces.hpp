/// @file
/// Force elements in batches per kind; every one reports its energy and power.
#pragma once

#include "mbs/kernels/metric.hpp"
#include "mbs/system/state.hpp"
#include "mbs/system/state_forces.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cardan {

/// Force and moment at a frame's origin, N and N m.
struct Wrench {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};
/// Adds a wrench about `from` as one about `to`.
inline void add_moved(Wrench& sum, const Wrench& wrench, const Vec3& from, const Vec3& to, double factor = 1) {
    sum.force += factor * wrench.force;
    sum.moment += factor * (wrench.moment + cross<double>(from - to, wrench.force));
}
/// Axes in which a wrench is constant: those of the base (dead load) or those of the frame (follower load).
enum class WrenchAxes : std::uint8_t { base, frame };

/// Of a system without states or inputs.
inline const Vector no_states;

/// A user-defined force. Without `jacobian` its derivatives are central differences (step 1e-6, double precision),
/// which allocate; with it the library allocates nothing.
struct UserForce {
    std::string name = {};
    /// Adds its generalised forces to Q (size n), which already holds those of other elements: add, do not assign or
    /// read.
    std::function<void(const StateView&, VectorOut Q)> force = {};
    /// Adds dQ/dq and dQ/dqd (n x n), in the same way.
    std::function<void(const StateView&, MatrixOut dQ_dq, MatrixOut dQ_dqd)> jacobian = {};
    /// Potential energy, J, if there is one.
    std::function<double(const StateView&)> energy = {};
    /// A spring rather than a load: -dQ/dq counts as elastic stiffness.
    bool elastic = false;
};

/// A place on a body where a field acts.
struct FieldPoint {
    FrameId frame = {};
    Vec3 place = Vec3::Zero();  ///< in the axes of the frame, m
};

/// A motion as a field sees it, with the field's own states and inputs.
struct FieldInput : StateView {
    Eigen::Ref<const Vector> own;          ///< in the field's order; empty without
    std::span<const int> own_inputs = {};  ///< WrenchField::inputs, as indices into `u`

    FieldInput(const StateView& at) : StateView(at), own(no_states) {}  // NOLINT(google-explicit-constructor)
    FieldInput(const StateView& at, const Eigen::Ref<const Vector>& states, std::span<const int> inputs = {})
        : StateView(at), own(states), own_inputs(inputs) {}
};

/// Derivatives of a field with states, to be added to: of the generalised forces Q and of the states' rates f.
struct FieldJacobian {
    MatrixOut Q_q, Q_qd, Q_s;  ///< n x n, n x n, n x number of the field's states m
    MatrixOut f_q, f_qd, f_s;  ///< m x n, m x n, m x m
};

/// States of a field that depend on one another, and the coordinates that they see or act upon; what other groups do
/// reaches them through coordinates only.
struct FieldGroup {
    std::vector<int> states = {};  ///< indices in the field
    std::vector<BodyId> coordinates = {};
};

/// Forces and moments at many places that depend on the motion, as those of air and water. Unlike those of a user force
/// the library knows where they act, so that loads of channels and joints take them into account.
struct WrenchField {
    std::string name = {};
    std::vector<FieldPoint> points = {};
    /// Writes force and moment about its place, base axes, for every point.
    std::function<void(const FieldInput&, std::span<Wrench>)> wrenches = {};
    /// Adds dQ/dq and dQ/dqd (n x n). Empty: central differences, as those of UserForce.
    std::function<void(const FieldInput&, MatrixOut dQ_dq, MatrixOut dQ_dqd)> jacobian = {};
    std::vector<double> breaks = {};  ///< times, s, ascending, across which it is not smooth

    /// @name States of first order beside the coordinates, as of elements with states (StateElement)
    /// The following functions then take the place of `wrenches` and `jacobian`.
    ///@{
    std::vector<StateInfo> states = {};
    /// Writes wrenches and ds/dt.
    std::function<void(const FieldInput&, std::span<Wrench>, VectorOut rates)> evaluate = {};
    /// Empty: central differences with 1e-6 rad, m, rad/s, m/s, and 1e-6 of the scale of a state.
    std::function<void(const FieldInput&, FieldJacobian&)> state_jacobian = {};
    /// Every state in one of them. Empty: all depend on one another and on all coordinates.
    std::vector<FieldGroup> groups = {};
    ///@}
    /// Names of inputs of the system (ForceSet::add_input()) that it depends on: FieldInput::own_inputs. Derivatives by
    /// them are central differences with 1e-4 of their scale.
    std::vector<std::string> inputs = {};

    /// @name Springs between places; only without states
    ///@{
    std::function<double(const FieldInput&)> energy = {};  ///< potential energy, J, if there is one
    /// A spring rather than a load: -dQ/dq counts as elastic stiffness, and load factors leave it as it is.
    bool elastic = false;
    ///@}
};

/// Linear law Q = -K (q - q0) - D qd over a few coordinates (the six of a beam element, or one joint's spring).
struct LinearLaw {
    std::string name = {};
    std::vector<BodyId> coordinates = {};
    Matrix stiffness = {};  ///< symmetric; N m/rad, N/m or N per coordinate pair
    Matrix damping = {};    ///< empty: none
    Vector rest = {};       ///< q0; empty: zero
};

/// A force and a moment at the origin of a frame, constant or changing with time in its axes.
struct FrameLoad {
    std::string name = {};
    FrameId frame = {};
    Wrench wrench = {};
    WrenchAxes axes = WrenchAxes::base;
    /// Added to `wrench`, in the same axes; empty: the load is constant. To be continuous. Tables:
    /// elements/machine/load_over_time.hpp. What has no time of its own (a steady state) takes it at its operating
    /// point's.
    std::function<Wrench(double time)> over_time = {};
    /// Times, s, ascending, across which `over_time` is not smooth: integration restarts there.
    std::vector<double> breaks = {};

    /// At a time, in its own axes.
    Wrench at(double time) const {
        if (!over_time) return wrench;
        const Wrench more = over_time(time);
        return {wrench.force + more.force, wrench.moment + more.moment};
    }
};

/// Editable list of force elements on the bodies of a Tree. Bad values throw InputError.
class ForceSet {
public:
    void add_spring(std::string name, BodyId coordinate, double stiffness, double damping = 0, double rest = 0);
    void add_law(LinearLaw law);
    /// Also one that changes with time: loads of channels and joints take either into account.
    void add_wrench(FrameLoad load);
    void add_user(UserForce force);
    void add_field(WrenchField field);
    /// Equations of first order, and the forces that depend on their states.
    void add_states(StateElement element);
    /// A value that elements with states may name.
    void add_input(InputInfo input);
    /// Gravity vector in base axes, m/s^2, e.g. (0, 0, -9.80665).
    void set_gravity(const Vec3& g);

    const std::vector<LinearLaw>& laws() const { return laws_; }
    const std::vector<FrameLoad>& loads() const { return loads_; }
    const std::vector<UserForce>& users() const { return users_; }
    const std::vector<WrenchField>& fields() const { return fields_; }
    const std::vector<StateElement>& state_elements() const { return state_elements_; }
    const std::vector<InputInfo>& inputs() const { return inputs_; }
    const Vec3& gravity() const { return gravity_; }

private:
    std::vector<LinearLaw> laws_;
    std::vector<FrameLoad> loads_;
    std::vector<UserForce> users_;
    std::vector<WrenchField> fields_;
    std::vector<StateElement> state_elements_;
    std::vector<InputInfo> inputs_;
    Vec3 gravity_ = Vec3::Zero();
};

/// Energy stored in, and power delivered by, one force element at a state.
struct ForceReport {
    std::string name;
    std::optional<double> energy;  ///< potential energy, J; none for loads that have no potential
    double power;                  ///< Q . qd, W
};

/// Stiffness and damping of the force elements at a state, -dQ/dq and -dQ/dqd, n x n, by origin, and the derivatives by
/// and of the states.
struct ForceDerivatives {
    Matrix elastic;  ///< -dQ/dq of linear laws, elastic user forces and elastic fields
    Matrix gravity;  ///< -dQ/dq of gravity
    Matrix loads;    ///< -dQ/dq of wrenches, other fields, other user forces and elements with states
    Matrix damping;  ///< -dQ/dqd of all
    StateDerivatives states;
};

/// A force set bound to a model: indices resolved, ready to evaluate. All functions throw InputError for kinematics of
/// another model and for vectors of the wrong size.
class Forces {
public:
    /// @throws InputError for bodies and frames that the model does not have
    Forces(const ForceSet& set, const Model& model);

    /// Q_a, the sum over all elements, and the rates of the states.
    /// @param Q      out, size n, N m or N; overwritten; must not alias q or qd. Cost O(n d); allocates nothing unless
    /// a
    ///               user force does.
    /// @param rates  out, ds/dt of states(); overwritten
    void generalised_forces(const StateView& at, VectorOut Q, VectorOut rates) const;
    /// Of a system without states.  @throws InputError if there are some
    void generalised_forces(const StateView& at, VectorOut Q) const;
    /// Likewise without user forces and fields, for any scalar (tests).
    template <class S>
    void generalised_forces_of_elements(const KinematicsT<S>& kin, VectorInT<S> q, VectorInT<S> qd, VectorOutT<S> Q,
                                        double time = 0) const;
    /// Derivatives of forces and rates.
    /// @param out  overwritten; matrices of the right size are reused. Cost O(n^2), then without allocation unless a
    ///             user force has no Jacobian.
    void derivatives(const StateView& at, ForceDerivatives& out) const;

    /// Potential energy of all elements that have one, J; that in elements with states apart, state_energy().
    double potential_energy(const StateView& at) const;
    /// Of all elements but those with states.
    std::vector<ForceReport> report(const StateView& at) const;
    /// Energy of the elements with states that tell it, without load factors.
    StateEnergy state_energy(const StateView& at) const;

    /// @throws InputError if there are elements with states: for analyses that do not know them
    void require_no_states(const char* where) const;
    /// There are states, or inputs.
    bool has_states() const { return !states_.empty(); }
    const StateTable& states() const { return states_.states(); }
    const InputTable& inputs() const { return states_.inputs(); }
    /// Groups of states that depend on one another.
    const std::vector<StateGroup>& state_groups() const { return states_.groups(); }
    const std::vector<FrameLoad>& loads() const { return loads_; }
    /// A load as it acts at a time: force and moment at the frame's origin, base axes.
    Wrench at_frame(const FrameLoad& load, const Kinematics& kin, double time = 0) const;
    /// Where fields act, and the wrenches there: force and moment about the place, base axes.
    int fields() const { return static_cast<int>(fields_.size()); }
    const WrenchField& field(int i) const;
    /// A motion as the field of this name sees it; valid as long as these forces.
    /// @throws InputError without such a field
    FieldInput field_input(std::string_view name, const StateView& at) const;
    std::vector<Wrench> field_wrenches(int i, const StateView& at) const;
    /// Times, s, ascending, across which a load, a field or an element with states is not smooth.
    std::vector<double> breaks() const;
    const Vec3& gravity() const { return gravity_; }
    /// Model::serial() of the model that it is bound to.
    std::uint64_t model_serial() const { return model_; }
    bool has_gravity() const { return !gravity_.isZero(0); }
    /// Name of the linear law that is stiffest on a coordinate; empty: there is none.
    std::string stiffest_law(int coordinate) const;
    /// Power dissipated by the dampers of the linear laws, qd^T D qd, W.  Cost O(n), no allocation.
    double dissipation(const Vector& qd) const;
    /// A copy with another gravity.  @throws InputError if it is not finite
    Forces with_gravity(const Vec3& g) const;
    /// A copy with the loads multiplied by `factor`: wrenches, fields and user forces but elastic ones (force,
    /// jacobian and energy), forces of elements with states (not the rates of these) and, if `gravity_too`, gravity.
    /// Springs and dampers stay. Factors of repeated calls multiply.
    /// @throws InputError if the factor is not finite.
    Forces with_load_factor(double factor, bool gravity_too) const;
    /// With a load more.
    /// @throws InputError for a frame that the model does not have
    Forces with_load(FrameLoad load, const Model& model) const;

private:
    struct Law {
        std::string name;
        std::vector<int> at;
        Matrix K, D;
        Vector rest;
    };
    struct User {
        UserForce own;
        double factor = 1;
    };
    struct Field {
        WrenchField own;
        std::vector<int> bodies;   // of the points; -1: base
        std::vector<Vec3> places;  // in body axes
        int first = 0;             // index of its first state
        double factor = 1;
        std::vector<int> inputs = {};  // their indices

        Eigen::Index states() const { return std::ssize(own.states); }
        FieldInput input(const StateView& at) const { return {at, at.s.segment(first, states()), inputs}; }
    };
    // Coefficients of one row of a law's matrix, of consecutive coordinates.
    struct Run {
        int row, column, size;
    };
    // Those of all laws, zeros at the ends of a run left out, one run after the other.
    struct Runs {
        std::vector<Run> runs;
        std::vector<double> values, rest;  ///< rest: that of the coordinate of each value
    };
    Runs runs_of(Matrix Law::*matrix) const;
    template <class S>
    void add_laws(VectorInT<S> q, VectorInT<S> qd, VectorOutT<S> Q) const;
    static void add_springs(std::ptrdiff_t n, const Run* runs, const double* K, const double* rest, const double* q,
                            double* Q);
    static void add_springs(std::ptrdiff_t n, const Run* runs, const double* K, const double* rest, const Complex* q,
                            Complex* Q);
    static void add_dampers(std::ptrdiff_t n, const Run* runs, const double* D, const double* qd, double* Q);
    static void add_dampers(std::ptrdiff_t n, const Run* runs, const double* D, const Complex* qd, Complex* Q);
    // The plain twin of add_laws() for one of them.
    static void add_law(const Law& law, const Vector& q, const Vector& qd, Vector& Q);
    template <class S>
    void add_gravity(const KinematicsT<S>& kin, VectorOutT<S> Q) const;
    template <class S>
    void add_wrench(const FrameLoad& load, const KinematicsT<S>& kin, double time, VectorOutT<S> Q) const;
    void gravity_stiffness(const Kinematics& kin, Matrix& K) const;
    void wrench_stiffness(const FrameLoad& load, const Kinematics& kin, double time, Matrix& K) const;
    void add_users(const StateView& at, VectorOut& Q) const;
    void add_user(const User& user, const StateView& at, VectorOut& Q) const;
    void user_derivatives(const User& user, const StateView& at, ForceDerivatives& out) const;
    Field bound(const WrenchField& field, const Model& model, int first) const;
    static void evaluate_field(const FieldInput& at, const Field& field, std::span<Wrench> wrenches,
                               const VectorOut& rates);
    void add_field(const Field& field, double factor, const FieldInput& at, VectorOut& Q, const VectorOut& rates) const;
    void field_derivatives(const Field& field, const StateView& at, ForceDerivatives& out) const;
    void state_field_derivatives(const Field& field, const StateView& at, ForceDerivatives& out) const;
    void input_derivatives(const Field& field, const StateView& at, StateDerivatives& out) const;
    double gravity_energy(const Kinematics& kin) const;
    template <class S>
    void require_state(const KinematicsT<S>& kin, VectorInT<S> q, VectorInT<S> qd) const;

    std::vector<Law> laws_;
    Runs springs_, dampers_;
    std::vector<FrameLoad> loads_;
    std::vector<User> users_;
    std::vector<Field> fields_;
    StateForces states_;
    Vec3 gravity_;
    std::uint64_t model_;  ///< Model::serial()
    int size_;             ///< number of coordinates
};

/// Of a field's point, base axes, m.
Vec3 place_of(const Kinematics& kin, const FieldPoint& point);

}  // namespace cardan
