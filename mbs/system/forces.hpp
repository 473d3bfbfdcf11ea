/// @file
/// Forces on a system: springs, loads and gravity in batches per kind, and force elements.
#pragma once

#include "mbs/kernels/metric.hpp"
#include "mbs/system/bound_elements.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cardan {

/// Axes in which a wrench is constant: those of the base (dead load) or those of the frame (follower load).
enum class WrenchAxes : std::uint8_t { base, frame };

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
    /// elements/machine_elements/load_over_time.hpp. What has no time of its own (a steady state) takes it at its
    /// operating point's.
    std::function<Wrench(double time)> over_time = {};
    /// Times, s, ascending, across which `over_time` is not smooth: integration restarts there.
    std::vector<double> breaks = {};

    /// Wrench at a time, in its own axes.
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
    void add_element(ForceElement element);
    /// A value from outside that elements may name.
    void add_input(InputInfo input);
    /// Gravity vector in base axes, m/s^2, e.g. (0, 0, -9.80665).
    void set_gravity(const Vec3& g);

    const std::vector<LinearLaw>& laws() const { return laws_; }
    const std::vector<FrameLoad>& loads() const { return loads_; }
    const std::vector<ForceElement>& elements() const { return elements_; }
    const std::vector<InputInfo>& inputs() const { return inputs_; }
    const Vec3& gravity() const { return gravity_; }

private:
    std::vector<LinearLaw> laws_;
    std::vector<FrameLoad> loads_;
    std::vector<ForceElement> elements_;
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
    Matrix elastic;  ///< -dQ/dq of linear laws and elastic elements
    Matrix gravity;  ///< -dQ/dq of gravity
    Matrix loads;    ///< -dQ/dq of wrenches and the other elements
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
    ///               force element does.
    /// @param rates  out, ds/dt of states(); overwritten
    void generalised_forces(const StateView& at, VectorOut Q, VectorOut rates) const;
    /// Generalised forces of a system without states.  @throws InputError if there are some
    void generalised_forces(const StateView& at, VectorOut Q) const;
    /// Generalised forces without force elements, for any scalar (tests).
    template <class S>
    void generalised_forces_of_laws(const KinematicsT<S>& kin, VectorInT<S> q, VectorInT<S> qd, VectorOutT<S> Q,
                                    double time = 0) const;
    /// Derivatives of forces and rates.
    /// @param out  overwritten; matrices of the right size are reused. Cost O(n^2), then without allocation unless an
    ///             element with points has no Jacobian.
    void derivatives(const StateView& at, ForceDerivatives& out) const;

    /// Potential energy of all that have one, J; that of elements which tell their whole balance apart, state_energy().
    double potential_energy(const StateView& at) const;
    /// Reports of all elements but those that report their whole balance of energy.
    std::vector<ForceReport> report(const StateView& at) const;
    /// Energy of the elements that tell their whole balance, without load factors.
    StateEnergy state_energy(const StateView& at) const;

    /// @throws InputError if there are elements with states: for analyses that do not know them
    void require_no_states(const char* where) const;
    /// Whether there are states, inputs, or elements that tell their whole balance of energy.
    bool has_states() const { return !states().empty() || !inputs().empty() || elements_.tells_power(); }
    const StateTable& states() const { return elements_.states(); }
    const InputTable& inputs() const { return elements_.inputs(); }
    /// Groups of states that depend on one another.
    const std::vector<StateGroup>& state_groups() const { return elements_.groups(); }
    const BoundElements& elements() const { return elements_; }
    const std::vector<FrameLoad>& loads() const { return loads_; }
    /// A load as it acts at a time: force and moment at the frame's origin, base axes.
    Wrench at_frame(const FrameLoad& load, const Kinematics& kin, double time = 0) const;
    /// Times, s, ascending, across which a load or an element is not smooth.
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
    /// A copy with the loads multiplied by `factor`: wrenches, forces of elements that are not elastic (not the rates
    /// of their states) and, if `gravity_too`, gravity. Springs and dampers stay. Factors of repeated calls multiply.
    /// @throws InputError if the factor is not finite.
    Forces with_load_factor(double factor, bool gravity_too) const;
    /// A copy with one more load.
    /// @throws InputError for a frame that the model does not have
    Forces with_load(FrameLoad load, const Model& model) const;

private:
    struct Law {
        std::string name;
        std::vector<int> at;
        Matrix K, D;
        Vector rest;
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
    double gravity_energy(const Kinematics& kin) const;
    template <class S>
    void require_state(const KinematicsT<S>& kin, VectorInT<S> q, VectorInT<S> qd) const;

    std::vector<Law> laws_;
    Runs springs_, dampers_;
    std::vector<FrameLoad> loads_;
    BoundElements elements_;
    Vec3 gravity_;
    std::uint64_t model_;  ///< Model::serial()
    int size_;             ///< number of coordinates
};

}  // namespace cardan
