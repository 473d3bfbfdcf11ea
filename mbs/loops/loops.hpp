/// @file
/// The equations of a system's loops, phi_i(q, t) = 0, and their derivatives.
#pragma once

#include "mbs/kernels/kinematics.hpp"
#include "mbs/loops/loop_set.hpp"
#include "mbs/loops/path.hpp"
#include "mbs/loops/relative_measure.hpp"

#include <string>
#include <vector>

namespace cardan {

/// Load that a loop exerts: a force at a point of a body and a moment, base axes, N and N m.
struct LoopLoad {
    int body;  ///< -1: base
    Vec3 point, force, moment;
};

/// A loop set bound to a model.
///
/// The gradient of every equation of a joint is the covector of a pair of opposite wrenches at the origin of b, force f
/// and moment m on b and the opposite on a; for the coordinate c of a joint on the way from a to b,
///
///     phi_c = s_c (m . w_c + f . v_c),   s_c = 1 on the branch of b, -1 on that of a,
///
/// with the twist w_c, v_c of the coordinate at that point. What lies on both branches moves the loop as a whole and
/// does not occur. Multipliers are the sizes of these wrenches: phi_c lambda stands beside Q_c on the right of
/// Lagrange's equations.                                                             (docs/theory.md, "Closed loops")
///
/// Functions throw InputError for arguments of the wrong size or model. They allocate nothing unless there are user
/// constraints. Cost: the number of equations times the length of their loops.
class Loops {
public:
    /// An equation.
    struct Equation {
        std::string name;  ///< "crank pin: x together"
        std::string unit;  ///< of phi; "1" for the cosine of an angle that is to be a right one
        int loop;          ///< index in the order joints, distances, surfaces, couplings, users, locks
    };

    Loops() = default;
    /// @throws InputError for frames and bodies that the model does not have, and for a joint that no coordinate moves
    Loops(const LoopSet& set, const Model& model);

    int size() const { return static_cast<int>(equations_.size()); }
    bool empty() const { return equations_.empty(); }
    const std::vector<Equation>& equations() const { return equations_; }
    /// Number of loops, and their names.
    int loops() const { return static_cast<int>(names_.size()); }
    const std::string& name(int loop) const;
    /// "'pin' (between 'rod' and 'base')"
    std::string describe(int loop) const;
    /// Index of a loop's first equation; of loops(): the number of equations.
    int first_of(int loop) const { return entry(first_, loop); }
    /// Locks come last.
    bool is_lock(int loop) const { return loop >= loops() - static_cast<int>(locks_.size()); }
    /// @name Joints, rods and surfaces, which come first among the loops
    /// Loads that they exert have a place; those of couplings and constraints of one's own do not.
    ///@{
    int pairs() const { return static_cast<int>(loops_.size()); }
    bool is_rod(int pair) const { return entry(loops_, pair).length > 0; }
    /// Whether there may be a moment.
    bool holds_directions(int pair) const;
    /// Axes of frame a, base axes.
    Mat3 axes(const Kinematics& kin, int pair) const;
    /// N, positive where it pulls.
    /// @param on_b  its load on b
    double rod_tension(const Kinematics& kin, int pair, const LoopLoad& on_b) const;
    ///@}
    /// Whether there are surfaces or constraints of one's own, which are known for real numbers only.
    bool has_own_functions() const { return !surfaces_.empty() || !users_.empty(); }
    /// Whether gradients may change with a coordinate. Those of couplings and locks never do.
    bool involves(int coordinate) const { return !empty() && entry(involved_, coordinate); }

    /// phi.  @param phi  out, size(), in units of the equations
    template <class S>
    void residual(const KinematicsT<S>& kin, double time, VectorInT<S> q, VectorOutT<S> phi) const;
    /// phi_a.  @param G  out, size() x n
    template <class S>
    void gradient(const KinematicsT<S>& kin, double time, VectorInT<S> q, MatrixOutT<S> G) const;
    /// Gradients with the magnitudes that their entries may have: what a gradient that vanishes at a singular position
    /// is measured by. Those of joints, rods and surfaces have the longest lever of their loop, about whatever hinge;
    /// others, which do not change with the position, or nobody knows how, have their own.
    /// @param magnitudes  out, size() x n, >= |G|
    void gradient(const Kinematics& kin, double time, VectorIn q, MatrixOut G, MatrixOut magnitudes) const;
    /// phi_t, of those that change with time by themselves.  @param out  size()
    void time_rates(double time, VectorIn q, VectorOut out) const;
    /// phi_ab qd^a qd^b + 2 phi_at qd^a + phi_tt: what the accelerations have to balance, phi_a qdd^a = -bias.
    template <class S>
    void bias(const KinematicsT<S>& kin, double time, VectorInT<S> q, VectorInT<S> qd, VectorOutT<S> out) const;
    /// H += sum of factor_i phi_i,ab.
    void add_second_gradient(const Kinematics& kin, double time, VectorIn q, VectorIn factors, MatrixOut H) const;

    /// Whether directions that have to agree point against each other, a second way to fulfil the same equations.
    /// @return the loop, -1: none
    int turned_over(const Kinematics& kin) const;
    /// Tolerance below which phi counts as closed: a fraction of the size of what each equation compares, or as much as
    /// rounding may leave. Of lengths, the size is the longest lever or stroke on the way from a to b, or the length of
    /// the rod; of directions 1; of couplings, locks and constraints of one's own the sum of the entries of their
    /// gradients, each times 1 rad, or the larger of stroke and extent of the tree.
    /// @param fraction  > 0
    /// @param out       size(), > 0, in units of the equations
    void tolerances(const Kinematics& kin, double time, VectorIn q, double fraction, VectorOut out) const;

    /// Adds the loads that a joint, rod or surface exerts on the bodies of b and a, from the multipliers of its
    /// equations; couplings and user constraints have no place where they act and add nothing.
    /// @param out  added to
    void add_loads(const Kinematics& kin, VectorIn lambda, std::vector<LoopLoad>& out) const;
    /// Force and moment of a joint on the body of b, at the origin of b.
    /// @throws InputError for couplings and user constraints
    LoopLoad reaction(const Kinematics& kin, int loop, VectorIn lambda) const;

private:
    struct Loop {
        FrameId a, b;
        int body_a, body_b;
        double length;
        int surface;                 // index in surfaces_, -1: none
        bool aligned, same_x;        // z of a and b agree; x as well
        std::vector<PathStep> path;  // from a to b
        std::vector<RelativeMeasure> equations;
        int first;  // index of its first equation
    };
    struct Linear {
        std::vector<std::pair<int, double>> factors;
        double offset = 0;
        int equation = 0;
    };
    struct User {
        UserConstraint own;
        int equation = 0;
    };
    struct Held {
        std::shared_ptr<const LockState> state;
        int coordinate = 0, equation = 0;
    };
    void add_loop(const std::string& name, const Model& model, Loop loop);
    void add_single(const std::string& name, const std::string& unit, std::string place);
    void add_equation(const std::string& name, std::string unit);
    template <class S, class Visit>
    void for_each_entry(const KinematicsT<S>& kin, const Visit& visit) const;
    template <class S>
    void add_linear_rows(double time, VectorInT<S> q, MatrixOutT<S> G) const;
    template <class S>
    UnitWrench<S> wrench(const Loop& loop, const RelativeMeasure& equation, const FrameEnds<S>& ends) const;
    template <class S>
    S value(const Loop& loop, const RelativeMeasure& equation, const FrameEnds<S>& ends) const;
    Mat3 surface_bend(const Loop& loop, const FrameEnds<double>& ends) const;
    double size_of(const Loop& loop, const Kinematics& kin, VectorIn q, const FrameEnds<double>& ends) const;
    template <class Visit>
    void for_each_user(double time, VectorIn q, const Visit& visit) const;
    template <class S>
    void check(const KinematicsT<S>& kin, VectorInT<S> q) const;

    std::vector<Loop> loops_;
    std::vector<PointOnSurface> surfaces_;
    std::vector<Linear> couplings_;
    std::vector<User> users_;
    std::vector<Held> locks_;
    std::vector<Equation> equations_;
    std::vector<std::string> names_, places_;
    std::vector<int> first_ = {0};
    std::vector<bool> involved_;
    std::uint64_t model_ = 0;
    Eigen::Index coordinates_ = 0;
};

}  // namespace cardan
