// Free vibrations in time against the eigenvalues of the linearised system, and what methods with fixed steps make of
// an oscillator against their amplification matrices.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

IntegrationOptions without_works(Method method, double tolerance) {
    IntegrationOptions options = equal_tolerances(method, tolerance);
    options.integrate_work = false;
    return options;
}

// The exponent of a signal of one complex exponential sampled at equal times, one signal per row, by least squares:
// y(k + 1) - s y(k) + p y(k - 1) = 0 with the sum s and the product p of exp(lambda dt) and its conjugate. With several
// samples per period this is the logarithmic decrement taken over all of them.
Complex exponent(const Matrix& y, double dt) {
    const Eigen::Index n = y.cols() - 2, rows = y.rows();
    Matrix A(n * rows, 2);
    Vector b(n * rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        A.block(i * n, 0, n, 1) = y.row(i).segment(1, n).transpose();
        A.block(i * n, 1, n, 1) = -y.row(i).head(n).transpose();
        b.segment(i * n, n) = y.row(i).tail(n).transpose();
    }
    const Vector c = A.completeOrthogonalDecomposition().solve(b);
    return std::log(Complex(c(0) / 2, std::sqrt(c(1) - c(0) * c(0) / 4))) / dt;
}

double relative(Complex a, Complex b) {
    return std::abs(a - b) / std::abs(b);
}

struct Case {
    Method method;
    double tolerance, error;
};

// A clamped beam of two elements with unequal bending stiffnesses and damping by direction.
struct Cantilever {
    System system = make();
    std::vector<Mode> found = modes(restrict_to(linearise(system, rest()), system.model.coordinates().free()));

    static System make() {
        Tree tree;
        ForceSet forces;
        EngineeringSection s;
        s.mass = 5, s.GJ = 900, s.EI_flap = 2000, s.EI_edge = 3500, s.j_flap = 0.05, s.j_edge = 0.1;
        CardanBeamOptions options{.elements = 2};
        options.damping.time_constants = {0, 0, 0, 2e-3, 4e-3, 6e-3};
        add_cardan_beam(tree, forces, Tree::base(), uniform_beam(5, s), "beam", {"beam"}, options);
        return {tree, forces};
    }
    DynamicState rest() const { return at_rest(system.model.size()); }
    // The exponent seen over three periods of a mode that begins with a largest angle of `amplitude` rad.
    Complex decay(const Mode& mode, double amplitude, const IntegrationOptions& options) const {
        const ComplexVector shape = mode.shape * (amplitude / mode.shape.cwiseAbs().maxCoeff());
        Integrator integrator(system, {}, 0, shape.real(), (mode.eigenvalue * shape).real(), options);
        const double dt = 1 / (12 * mode.damped_hz());
        Matrix y(shape.size(), 37);
        y.col(0) = integrator.state().q;
        for (Eigen::Index k = 1; k < y.cols(); ++k) {
            REQUIRE(integrator.advance(static_cast<double>(k) * dt).reached());
            y.col(k) = integrator.state().q;
        }
        return exponent(y, dt);
    }
};

}  // namespace

TEST_CASE("time: a damped beam let go in a mode decays with its eigenvalue, with every method",
          "[solvers][time][crosscheck]") {
    const Cantilever beam;
    // With dirk the error follows the tolerance only roughly: its iteration ends early while matrices are used again.
    for (const Case& c :
         {Case{Method::bdf, 1e-10, 5e-6}, Case{Method::adams, 1e-10, 2e-6}, Case{Method::dirk, 1e-10, 5e-4},
          Case{Method::erk, 1e-10, 2e-6}, Case{Method::generalised_alpha, 1e-9, 2e-4}})
        for (std::size_t i : {0U, 1U, 2U, 3U}) {
            const Mode& mode = beam.found[i];
            REQUIRE(mode.damping_ratio() > 0.005);
            const Complex seen = beam.decay(mode, 1e-3, without_works(c.method, c.tolerance));
            CAPTURE(static_cast<int>(c.method), i, seen, mode.eigenvalue, relative(seen, mode.eigenvalue));
            CHECK(relative(seen, mode.eigenvalue) < c.error);
        }
}

TEST_CASE("time: the eigenvalue is what remains as the amplitude vanishes, the difference is of its square",
          "[solvers][time][property]") {
    const Cantilever beam;
    for (std::size_t i : {0U, 1U}) {
        const auto difference = [&](double amplitude) {
            return relative(beam.decay(beam.found[i], amplitude, without_works(Method::erk, 1e-12)),
                            beam.found[i].eigenvalue);
        };
        const double large = difference(0.2), small = difference(0.1), smaller = difference(0.05);
        CAPTURE(i, large, small, smaller);
        CHECK(small > 1e-5);
        CHECK(std::log2(large / small) == Approx(2).margin(0.1));
        CHECK(std::log2(small / smaller) == Approx(2).margin(0.05));
    }
}

TEST_CASE("time: the modes of a spinning rotor on an elastic support, whirling ones too, are motions of the machine",
          "[solvers][time][crosscheck]") {
    // Multi-blade coordinates z of the blades, x = T(psi) z: a mode is z = Re(shape exp(lambda t)).
    const double Omega = 9;
    const SmallRotor rotor =
        small_rotor({.damping = 20, .hinges = BladeHinges::flap_and_lag, .lag_damping = 30, .elastic_support = true});
    const std::vector<int> unknowns = rotor.unknowns();
    const ColemanTransform transform(rotor.map, unknowns);
    const std::vector<Mode> found = modes(transform.transform(rotor.rotating(Omega), 0, Omega));
    REQUIRE(found.size() == 8);
    const Drive spin{rotor.map.spin, Motion::constant_rate(0, Omega)};
    for (const Case& c :
         {Case{Method::bdf, 1e-10, 3e-5}, Case{Method::adams, 1e-11, 1e-5}, Case{Method::dirk, 1e-10, 5e-4},
          Case{Method::erk, 1e-11, 1e-5}, Case{Method::generalised_alpha, 1e-9, 2e-3}})
        for (const Mode& mode : found) {
            const ComplexVector shape = mode.shape * (1e-4 / mode.shape.cwiseAbs().maxCoeff());
            const Vector z = shape.real(), z_dot = (mode.eigenvalue * shape).real();
            Vector q = Vector::Zero(rotor.system.model.size()), qd = q;
            q(unknowns) = transform.matrix(0) * z;
            qd(unknowns) = transform.matrix(0) * z_dot + Omega * (transform.matrix(0, 1) * z);
            qd(rotor.map.spin) = Omega;
            Integrator integrator(rotor.system, {spin}, 0, q, qd, without_works(c.method, c.tolerance));
            const double dt = 1 / (12 * mode.damped_hz());
            Matrix y(z.size(), 25);
            y.col(0) = z;
            for (Eigen::Index k = 1; k < y.cols(); ++k) {
                REQUIRE(integrator.advance(static_cast<double>(k) * dt).reached());
                y.col(k) = transform.matrix(Omega * integrator.time()).transpose() * integrator.state().q(unknowns);
            }
            const Complex seen = exponent(y, dt);
            const Complex growth = std::exp(mode.eigenvalue * (24 * dt));
            const double motion = (y.col(24) - (growth * shape).real()).norm() / shape.norm();
            CAPTURE(static_cast<int>(c.method), seen, mode.eigenvalue, motion);
            CHECK(relative(seen, mode.eigenvalue) < c.error);
            CHECK(motion < 10 * c.error);  // 1e-4 of it for terms of second order in the amplitude
        }
}

namespace {

// A mass on a spring, omega = 1 rad/s.
System oscillator() {
    Tree tree;
    ForceSet forces;
    const Link mass = testing::add_joint(
        tree, {.name = "mass", .kind = JointKind::prismatic, .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
    forces.add_spring("spring", mass.body, 1);
    return {tree, forces};
}

// x and h x' of the oscillator, let go at x = 1, after every step.
Matrix steps_of(const System& system, Method method, double h, int steps, double spectral_radius = 0.8) {
    IntegrationOptions options = without_works(method, 1e-9);
    options.fixed_step = h;
    options.spectral_radius = spectral_radius;
    Vector q(1), qd(1);
    q << 1;
    qd << 0;
    Integrator integrator(system, {}, 0, q, qd, options);
    Matrix y(2, steps + 1);
    y.col(0) << 1, 0;
    for (int k = 1; k <= steps; ++k) {
        REQUIRE(integrator.step().reached());
        y.col(k) << integrator.state().q(0), h * integrator.state().qd(0);
    }
    return y;
}

// One step of the generalised-alpha method on x'' = -x as a matrix over (x, h x', h^2 a) [Chung and Hulbert, J. Appl.
// Mech. 60 (1993) 371-375]: (1 - m) a1 + m a0 = -(1 - f) x1 - f x0, Newmark's formulas with a.
Mat3 amplification(double h, double rho) {
    const double m = (2 * rho - 1) / (rho + 1), f = rho / (rho + 1), gamma = 0.5 - m + f,
                 beta = std::pow(1 - m + f, 2) / 4;
    Mat3 left, right;
    left << 1, 0, -beta, 0, 1, -gamma, (1 - f) * h * h, 0, 1 - m;
    right << 1, 1, 0.5 - beta, 0, 1, 1 - gamma, -f * h * h, 0, -m;
    return left.inverse() * right;
}

}  // namespace

TEST_CASE("time: generalised alpha amplifies an oscillator by its matrix, at any step and dissipation",
          "[solvers][time][analytic]") {
    const System system = oscillator();
    for (const double rho : {0.0, 0.5, 0.8, 1.0})
        for (const double h : {0.05, 0.6, 4.0, 100.0}) {
            const Mat3 A = amplification(h, rho);
            const Matrix y = steps_of(system, Method::generalised_alpha, h, 40, rho);
            Vec3 state(1, 0, -h * h);
            for (int k = 1; k <= 40; ++k) {
                state = A * state;
                CAPTURE(rho, h, k, state, y.col(k));
                REQUIRE((y.col(k) - state.head<2>()).norm() < 1e-11 * (1 + h * h));
            }
        }
}

TEST_CASE("time: the numerical damping of generalised alpha rises with the cube of the step up to the chosen radius",
          "[solvers][time][analytic]") {
    const System system = oscillator();
    for (const double rho : {0.0, 0.5, 0.8}) {
        CHECK(Matrix(amplification(1e5, rho)).eigenvalues().cwiseAbs().maxCoeff() == Approx(rho).margin(1e-2));
        // Damping ratio of the decay, of critical; the start excites the third root too, which has died away after a
        // few steps.
        const auto damping = [&](double h) {
            const int skipped = 60, steps = skipped + static_cast<int>(40 / h);
            const Complex seen = exponent(
                steps_of(system, Method::generalised_alpha, h, steps, rho).topRows(1).rightCols(steps - skipped), h);
            const ComplexVector roots = Matrix(amplification(h, rho)).eigenvalues();
            Complex principal = roots(0);
            for (const Complex& root : roots)
                if (std::abs(root - std::exp(Complex(0, h))) < std::abs(principal - std::exp(Complex(0, h))))
                    principal = root;
            CHECK(relative(seen, std::log(principal) / h) < 1e-7);
            return -seen.real() / std::abs(seen);
        };
        const double coarse = damping(0.1), fine = damping(0.05);
        CAPTURE(rho, coarse, fine);
        CHECK(std::log2(coarse / fine) == Approx(3).margin(0.1));
    }
    const Matrix kept = steps_of(system, Method::generalised_alpha, 0.5, 1000, 1.0);
    CHECK(kept.row(0).tail(20).cwiseAbs().maxCoeff() > 0.99);  // without dissipation nothing is lost
}

// Explicit, order 5 with six stages that count: R is the series of exp and z^6 / 600 [Dormand and Prince 1980].
TEST_CASE("time: the explicit Runge-Kutta method amplifies an oscillator by its stability function",
          "[solvers][time][analytic]") {
    const System system = oscillator();
    for (const double h : {0.1, 0.7}) {
        const Complex z(0, h);
        const Complex R =
            1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 5.0)))));
        const Matrix y = steps_of(system, Method::erk, h, 30);
        for (int k = 1; k <= 30; ++k) {
            const Complex exact = std::pow(R, k);  // x = Re, x' = i x
            CAPTURE(h, k, exact);
            REQUIRE(std::abs(y(0, k) - exact.real()) < 1e-11);
            REQUIRE(std::abs(y(1, k) + h * exact.imag()) < 1e-11 * (1 + h));
        }
    }
}

// What its authors claim of the method [Kennedy and Carpenter 2019]: order 5, stable on the whole imaginary axis, and
// R = 0 at infinity.
TEST_CASE("time: the implicit Runge-Kutta method is of order five, never amplifies and forgets what is fast",
          "[solvers][time][analytic]") {
    const System system = oscillator();
    const auto R = [&](double h) {
        const Matrix y = steps_of(system, Method::dirk, h, 1);
        return Complex(y(0, 1), -y(1, 1) / h);
    };
    const auto error = [&](double h) { return std::abs(R(h) - std::exp(Complex(0, h))); };
    CHECK(std::log2(error(1.0) / error(0.5)) == Approx(6).margin(0.3));
    for (const double h : {0.3, 0.7, 1.5, 3.0, 6.0, 12.0, 30.0, 100.0}) {
        CAPTURE(h);
        CHECK(std::abs(R(h)) < 1);
    }
    CHECK(std::abs(R(1e3)) / std::abs(R(1e5)) == Approx(100).epsilon(0.01));  // as 1 / h
    CHECK(std::abs(R(1e5)) < 1e-3);
    // Step after step the same.
    const Matrix y = steps_of(system, Method::dirk, 0.7, 30);
    for (int k = 1; k <= 30; ++k) CHECK(std::abs(y(0, k) - std::pow(R(0.7), k).real()) < 1e-8);
}
