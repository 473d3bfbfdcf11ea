// Neighbouring geodesics. Oracle: the force-free motion itself by the articulated-body recursion and small steps of the
// Runge-Kutta method, which knows neither symbols nor curvature.
#include "mbs/geometry/curvature.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/simulation.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr double duration = 0.4;

// (q, qd) after `duration` without forces.
Vector free_motion(SampledTree& s, const Vector& q, const Vector& qd, int steps) {
    ForwardDynamics forward(s.model, std::vector<bool>(static_cast<std::size_t>(s.n), false));
    Workspace workspace(s.model);
    const Vector zero = Vector::Zero(s.n);
    Vector qdd(s.n), actuator(s.n), start(2 * s.n);
    start << q, qd;
    return runge_kutta(
        start,
        [&](double, const Vector& y) {
            forward.solve(kinematics(s.model, Vector(y.head(s.n)), workspace), y.tail(s.n), zero, qdd, actuator);
            Vector rate(2 * s.n);
            rate << y.tail(s.n), qdd;
            return rate;
        },
        0, duration, steps);
}

// q, qd, xi and eta = D xi/dt by the geodesic equation and D eta/dt = -R(xi, qd, qd).
class Deviation {
public:
    explicit Deviation(const Model& model) : n_(model.size()), model_(model), workspace_(model), curvature_(model) {}

    Vector operator()(double, const Vector& y) {
        const Vector q = y.head(n_), qd = y.segment(n_, n_), xi = y.segment(2 * n_, n_), eta = y.tail(n_);
        REQUIRE(curvature_.update(kinematics(model_, q, workspace_)).ok());
        const Vector zero = Vector::Zero(n_);
        Vector qdd(n_), turned_xi(n_), turned_eta(n_), bent(n_), rate(4 * n_);
        curvature_.geodesic(qd, qdd);
        curvature_.covariant_derivative(qd, xi, zero, turned_xi);
        curvature_.covariant_derivative(qd, eta, zero, turned_eta);
        curvature_.deviation(qd, xi, bent);
        rate << qd, qdd, eta - turned_xi, bent - turned_eta;
        return rate;
    }
    /// eta that belongs to the rate of xi.
    Vector eta(const Vector& q, const Vector& qd, const Vector& xi, const Vector& xi_rate) {
        REQUIRE(curvature_.update(kinematics(model_, q, workspace_)).ok());
        Vector out(n_);
        curvature_.covariant_derivative(qd, xi, xi_rate, out);
        return out;
    }

private:
    int n_;
    const Model& model_;
    Workspace workspace_;
    Curvature curvature_;
};

}  // namespace

TEST_CASE("geodesic deviation: predicts the distance of neighbouring force-free motions, with error of second order",
          "[property]") {
    for (unsigned seed = 0; seed < 6; ++seed) {
        SampledTree s(seed, {.bodies = 5, .massless = 0, .armatures = seed % 2 == 0});
        const Vector qd = s.qd / 4, xi = s.vector(), xi_rate = s.vector();
        Deviation deviation(s.model);
        Vector start(4 * s.n);
        start << s.q, qd, xi, deviation.eta(s.q, qd, xi, xi_rate);
        const Vector end = runge_kutta(start, std::ref(deviation), 0, duration, 400);
        const Vector alone = free_motion(s, s.q, qd, 400);
        CAPTURE(seed);
        CHECK(largest(end.head(2 * s.n) - alone) < 1e-10);

        const auto error = [&](double h) {
            const Vector above = free_motion(s, s.q + h * xi, qd + h * xi_rate, 400),
                         below = free_motion(s, s.q - h * xi, qd - h * xi_rate, 400);
            return largest((above - below).head(s.n) / (2 * h) - end.segment(2 * s.n, s.n));
        };
        const double coarse = error(4e-3), fine = error(2e-3);
        CAPTURE(coarse, fine);
        CHECK(fine < 1e-3 * largest(end.segment(2 * s.n, s.n)));
        CHECK(coarse / fine == Approx(4).epsilon(0.03));
        // The effect of the curvature itself is far larger than the errors.
        const Vector flat = runge_kutta(
            start,
            [&](double t, const Vector& y) {
                Vector rate = deviation(t, y);
                const Vector bent = rate.tail(s.n);
                Vector without = y;
                without.segment(2 * s.n, s.n).setZero();
                rate.tail(s.n) = deviation(t, without).tail(s.n);
                return rate;
            },
            0, duration, 100);
        CHECK(largest((flat - end).segment(2 * s.n, s.n)) > 100 * fine);
    }
}
