/// @file
/// Motion of a system by the classical Runge-Kutta method, with the work done on it.
#pragma once

#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/system.hpp"

#include <functional>

namespace cardan::testing {

/// dy/dt at time t.
using Rate = std::function<Vector(double t, const Vector& y)>;

/// y(t1) of dy/dt = rate(t, y) by `steps` equal steps of the classical method of fourth order.
Vector runge_kutta(Vector y, const Rate& rate, double t0, double t1, int steps);

/// Coordinates with role driven follow `drive`; the others follow from forward dynamics.
class Simulation {
public:
    /// Acceleration of one driven coordinate, rad/s^2 or m/s^2.
    using Drive = std::function<double(double time, int coordinate)>;

    Simulation(const System& system, Vector q, Vector qd, Drive drive = {});

    void advance(double time, int steps);

    double time() const { return time_; }
    const Vector& q() const { return q_; }
    const Vector& qd() const { return qd_; }
    Kinematics kin() { return kinematics(system_->model, q_, workspace_); }

    double kinetic_energy();
    double potential_energy();
    double energy() { return kinetic_energy() + potential_energy(); }
    /// Time integral of the power that the force elements report, J.
    double work_of_forces() const { return work_of_forces_; }
    /// Time integral of the power of the drives of driven coordinates, J.
    double work_of_drives() const { return work_of_drives_; }

    /// Accelerations and forces of drives at the present state.
    struct Response {
        Vector qdd, actuator;
    };
    Response response();

private:
    Response response(double time, const Vector& q, const Vector& qd);

    const System* system_;
    Workspace workspace_;
    ForwardDynamics forward_;
    Drive drive_;
    double time_ = 0, work_of_forces_ = 0, work_of_drives_ = 0;
    Vector q_, qd_;
};

}  // namespace cardan::testing
