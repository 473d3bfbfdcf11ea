#include "tests/support/simulation.hpp"

namespace cardan::testing {

Vector runge_kutta(Vector y, const Rate& rate, double t0, double t1, int steps) {
    const double h = (t1 - t0) / steps;
    for (int i = 0; i < steps; ++i) {
        const double t = t0 + i * h;
        const Vector k1 = rate(t, y);
        const Vector k2 = rate(t + h / 2, Vector(y + h / 2 * k1));
        const Vector k3 = rate(t + h / 2, Vector(y + h / 2 * k2));
        const Vector k4 = rate(t + h, Vector(y + h * k3));
        y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
}

Simulation::Simulation(const System& system, Vector q, Vector qd, Drive drive)
    : system_(&system),
      workspace_(system.model),
      forward_(system.model),
      drive_(std::move(drive)),
      q_(std::move(q)),
      qd_(std::move(qd)) {}

Simulation::Response Simulation::response(double time, const Vector& q, const Vector& qd) {
    const Model& model = system_->model;
    const Eigen::Index n = model.size();
    Vector Q(n);
    Response out{Vector::Zero(n), Vector::Zero(n)};
    for (int k = 0; k < model.size(); ++k)
        if (drive_ && forward_.is_driven(static_cast<int>(k))) out.qdd(k) = drive_(time, k);
    const Kinematics kin = kinematics(model, q, workspace_);
    system_->forces.generalised_forces({{.time = time, .q = q, .qd = qd}, kin}, Q);
    forward_.solve(kin, qd, Q, out.qdd, out.actuator);
    return out;
}

Simulation::Response Simulation::response() {
    return response(time_, q_, qd_);
}

void Simulation::advance(double duration, int steps) {
    const Eigen::Index n = q_.size();
    const auto rate = [&](double t, const Vector& y) {
        const Vector q = y.head(n), qd = y.segment(n, n);
        const Response now = response(t, q, qd);
        double power = 0;
        for (const ForceReport& element :
             system_->forces.report({{.time = t, .q = q, .qd = qd}, kinematics(system_->model, q, workspace_)}))
            power += element.power;
        Vector rates(2 * n + 2);
        rates << qd, now.qdd, power, now.actuator.dot(qd);
        return rates;
    };
    Vector y(2 * n + 2);
    y << q_, qd_, work_of_forces_, work_of_drives_;
    y = runge_kutta(y, rate, time_, time_ + duration, steps);
    time_ += duration;
    q_ = y.head(n);
    qd_ = y.segment(n, n);
    work_of_forces_ = y(2 * n);
    work_of_drives_ = y(2 * n + 1);
}

double Simulation::kinetic_energy() {
    return cardan::kinetic_energy(kin(), qd_);
}

double Simulation::potential_energy() {
    return system_->forces.potential_energy({{.time = time_, .q = q_, .qd = qd_}, kin()});
}

}  // namespace cardan::testing
