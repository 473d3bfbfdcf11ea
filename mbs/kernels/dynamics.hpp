/// @file
/// O(n) recursions: inverse dynamics (Newton-Euler) and forward dynamics (articulated body). They never form g or
/// Gamma.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/metric.hpp"

#include <Eigen/LU>

namespace cardan {

/// Inverse dynamics tau_a = g_ab qdd^b + Gamma_abc qd^b qd^c, armatures and added mass included.
///                                                                                        [Zhao et al. 2007, eq. 4]
/// @param qd, qdd  joint rates and accelerations, size n
/// @param tau      out, size n, N m or N; overwritten; must not alias the inputs
///
/// Cost O(n), no allocation. Never singular.
/// @throws InputError for vectors of the wrong size, as do all functions here
template <class S>
void inverse_dynamics(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd, VectorOutT<S> tau);

/// Generalised inertial forces h_a = Gamma_abc qd^b qd^c.             [Zhao et al. 2007, eq. 4 and 9 (corrected)]
/// @param h  out, size n, N m or N; overwritten; must not alias qd
///
/// Cost O(n), no allocation. Never singular.
template <class S>
void inertial_forces(const KinematicsT<S>& kin, VectorInT<S> qd, VectorOutT<S> h);

/// Forward dynamics in hybrid form: accelerations of the free coordinates from generalised forces, forces of the driven
/// coordinates from their prescribed accelerations. Holds the memory for armatures and the set of driven coordinates.
class ForwardDynamics {
public:
    /// Driven are the coordinates that have this role in the coordinate table.
    explicit ForwardDynamics(const Model& model);
    explicit ForwardDynamics(Model&&) = delete;  // the model must live longer
    /// @param driven  size n; true where the acceleration is prescribed
    /// @throws InputError if `driven` has another size.
    ForwardDynamics(const Model& model, std::vector<bool> driven);
    ForwardDynamics(const ForwardDynamics& other);
    ForwardDynamics(ForwardDynamics&& other) noexcept;
    ForwardDynamics& operator=(const ForwardDynamics& other);
    ForwardDynamics& operator=(ForwardDynamics&& other) noexcept;
    ~ForwardDynamics();

    /// @param Q    generalised forces, size n; on driven coordinates, those in addition to the actuator's; must not
    ///             alias the outputs
    /// @param qdd  in: accelerations of driven coordinates; out: of all coordinates
    /// @param actuator  out, size n: force that the drive adds to Q on each driven coordinate, zero on free ones
    ///
    /// Cost O(n) plus O(n) per armature that spans several coordinates; no allocation.
    /// @throws InputError for kinematics of another model and vectors of the wrong size
    void solve(const Kinematics& kin, VectorIn qd, VectorIn Q, VectorOut qdd, VectorOut actuator);

    /// Finds a free coordinate without inertia of its own: the recursion divides by the pivots of the metric of the
    /// free coordinates, eliminated from the tips to the base. Reports the most distal of the coordinates that take
    /// part in the motion without inertia.
    /// @return nullopt if every pivot exceeds 1e-12 of its scale, which is the sum of the magnitudes added up in it: a
    /// slender body that turns about its own axis, or two joints that do the same thing, leave nothing but rounding
    /// error, which looks small only relative to that sum. If a pivot is returned, solve() must not be called at this
    /// q. Cost O(n) and, with armatures over several coordinates, the cube of their number; allocates.
    std::optional<SingularPivot> singular_pivot(const Kinematics& kin);

    bool is_driven(int a) const {
        require_index("forward dynamics", "coordinate", a, std::ssize(driven_));
        return entry(driven_, a) != 0;
    }

private:
    struct Articulated;
    struct OnPath;
    struct Path {
        int body;
        int parent;  ///< on the path, -1: base
    };
    struct AddedMass;
    struct Arrays;
    static void factorise(const Arrays& arrays);
    static void backward(const Arrays& arrays, const double* Q, double* qdd, double* reaction);
    static void forward(const Arrays& arrays, double* qdd, double* reaction);
    static void backward_on_path(const Arrays& arrays, std::ptrdiff_t loads);
    static void forward_on_path(const Arrays& arrays, std::ptrdiff_t loads);
    void find_support(bool coupled);
    void find_path();
    int most_distal(const Kinematics& kin, int at, double scale) const;
    std::optional<SingularPivot> singular_pivot_of_support() const;
    void couple(const Arrays& arrays);

    const Model* model_;
    std::vector<char> driven_;  ///< no vector<bool>: the loops read it through a pointer
    std::vector<Articulated> articulated_;
    std::vector<AddedMass> water_;
    Vector armature_diagonal_, residual_, correction_, reaction_;
    std::vector<int> support_;  ///< free coordinates in armatures of several coordinates
    Matrix coupling_;           ///< off-diagonal part of these armatures on the support
    std::vector<Path> path_;    ///< all bodies that lead to the support, parents first
    std::vector<int> at_;       ///< where the support lies on the path
    std::vector<OnPath> on_path_;
    Matrix support_inverse_, capacity_;
    Eigen::PartialPivLU<Matrix> capacity_lu_;
    Vector support_qdd_, support_load_, support_correction_;
};

}  // namespace cardan
