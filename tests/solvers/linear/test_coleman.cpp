// Multi-blade transformation against its definition, finite differences, Floquet theory and closed forms.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/mode_names/energy_shares.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <numeric>

namespace cardan::testing::multi_blade_coordinates {

using namespace solvers;

namespace {

constexpr double flap_offset = 0.5, arm = 4, mass = 3, stiffness = 2000;

SmallRotor rotor_of(int blades, bool elastic_support, bool lag = false) {
    return small_rotor({.stiffness = std::vector<double>(static_cast<std::size_t>(blades), stiffness),
                        .damping = 2,
                        .hinges = lag ? BladeHinges::flap_and_lag : BladeHinges::flap,
                        .mass = mass,
                        .arm = arm,
                        .offset = flap_offset,
                        .elastic_support = elastic_support});
}

// An imagined rotor: two fixed coordinates, then `per_blade` coordinates of each blade, blade after blade.
RotorMap imagined(int blades, int per_blade) {
    RotorMap map;
    map.machine = "imagined rotor";
    int next = 2;
    for (int k = 0; k < blades; ++k) {
        map.blades.emplace_back();
        for (int i = 0; i < per_blade; ++i) map.blades.back().push_back(next++);
    }
    return map;
}

std::vector<int> first(int n) {
    std::vector<int> list(static_cast<std::size_t>(n));
    std::iota(list.begin(), list.end(), 0);
    return list;
}

double scaled(const Matrix& difference, const Matrix& reference) {
    return difference.cwiseAbs().maxCoeff() / reference.cwiseAbs().maxCoeff();
}

// A mass on springs in the rotating frame of a shaft about sense * x; the pair y, z is seen from the shaft.
SecondOrderSystem shaft_in_fixed_frame(double sense, double k, double d, double m, double Omega, double psi) {
    Tree tree;
    ForceSet forces;
    const Link spin = add_joint(
        tree, {.name = "spin", .axis = sense * Vec3::UnitX(), .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    const Link y =
        add_joint(tree, {.name = "y", .inboard = spin.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitY()});
    const Link z = add_joint(tree, {.name = "z",
                                    .inboard = y.axes,
                                    .kind = JointKind::prismatic,
                                    .axis = Vec3::UnitZ(),
                                    .inertia = {m, Vec3::Zero()}});
    forces.add_spring("y", y.body, k, d);
    forces.add_spring("z", z.body, k, d);
    const System system(tree, forces);
    DynamicState at{{.q = psi * Vector::Unit(3, 0), .qd = Omega * Vector::Unit(3, 0)}, Vector::Zero(3)};
    RotorMap map;
    map.blades = {{}, {}, {}};  // three blades without coordinates of their own
    map.rotating_pairs = {{1, 2, sense}};
    return ColemanTransform(map, {1, 2}).transform(restrict_to(linearise(system, at), {1, 2}), psi, Omega);
}

}  // namespace

TEST_CASE("coleman: T is orthogonal, and its derivatives are those of finite differences", "[property]") {
    for (const int blades : {3, 4, 5, 6}) {
        const int per_blade = 2, n = 2 + blades * per_blade;
        RotorMap map = imagined(blades, per_blade);
        map.rotating_pairs = {{0, 1, blades % 2 == 0 ? 1.0 : -1.0}};
        const ColemanTransform T(map, first(n));
        for (const double psi : {0.0, 0.4, 2.0, -5.0}) {
            CAPTURE(blades, psi);
            const Matrix M = T.matrix(psi);
            REQUIRE((M.transpose() * M - Matrix::Identity(n, n)).cwiseAbs().maxCoeff() < 1e-14);
            const double step = 1e-5;
            for (const int d : {0, 1}) {
                const Matrix difference = (T.matrix(psi + step, d) - T.matrix(psi - step, d)) / (2 * step);
                REQUIRE((difference - T.matrix(psi, d + 1)).cwiseAbs().maxCoeff() < 1e-9);
            }
            REQUIRE(T.matrix(psi, 1).norm() > 0.1);
        }
    }
}

TEST_CASE("coleman: one unit of each multi-blade coordinate moves the blades as its name says", "[analytic]") {
    const double psi = 0.3;
    for (const int blades : {3, 4, 5}) {
        const int n = 2 + blades;
        const ColemanTransform T(imagined(blades, 1), first(n));
        const Matrix M = T.matrix(psi);
        CHECK(M.topLeftCorner(2, 2).isIdentity(0));
        CHECK(M.topRightCorner(2, blades).isZero(0));
        CHECK(T.rows()[0].kind == MultiBlade::none);
        CHECK(multi_blade_name(T.rows()[0]).empty());
        std::vector<std::string> names;
        for (int j = 0; j < blades; ++j) {
            const MultiBladeRow& row = entry(T.rows(), 2 + j);
            names.push_back(multi_blade_name(row));
            CHECK(row.blade_coordinate == 0);
            for (int k = 0; k < blades; ++k) {
                const double psi_k = psi + 2 * pi * k / blades;
                const double expected =
                    row.kind == MultiBlade::collective     ? std::sqrt(1.0 / blades)
                    : row.kind == MultiBlade::differential ? std::sqrt(1.0 / blades) * (k % 2 ? -1 : 1)
                    : row.kind == MultiBlade::cosine       ? std::sqrt(2.0 / blades) * std::cos(row.harmonic * psi_k)
                                                           : std::sqrt(2.0 / blades) * std::sin(row.harmonic * psi_k);
                CHECK(M(2 + k, 2 + j) == Approx(expected).margin(1e-15));
            }
        }
        const std::vector<std::string> all[] = {{"collective", "cosine 1", "sine 1"},
                                                {"collective", "cosine 1", "sine 1", "differential"},
                                                {"collective", "cosine 1", "sine 1", "cosine 2", "sine 2"}};
        CHECK(names == all[blades - 3]);
    }
}

TEST_CASE("coleman: an isotropic rotor on an elastic support has constant matrices in the fixed frame", "[property]") {
    for (const int blades : {3, 4, 5})
        for (const bool lag : {false, true}) {
            const SmallRotor rotor = rotor_of(blades, true, lag);
            const double Omega = 4;
            const ColemanTransform T(rotor.map, rotor.unknowns());
            const SecondOrderSystem z = T.transform(rotor.rotating(Omega), 0, Omega);
            CAPTURE(blades, lag);
            for (const double psi : {0.3, 1.0, 2.2, 4.9}) {
                const SecondOrderSystem own = rotor.rotating(Omega, psi), other = T.transform(own, psi, Omega);
                REQUIRE(scaled(other.M - z.M, z.M) < 1e-13);
                REQUIRE(scaled(other.C - z.C, z.C) < 1e-13);
                REQUIRE(scaled(other.K - z.K, z.K) < 1e-13);
                REQUIRE(scaled(other.K_elastic - z.K_elastic, z.K_elastic) < 1e-13);
                // In the rotating frame they are not.
                REQUIRE(scaled(own.M - rotor.rotating(Omega).M, own.M) > 1e-3);
            }
            // Multi-blade matrices are skew or symmetric as they must be: G without the dampers has no symmetric part.
            const SecondOrderSystem still = T.transform(rotor.rotating(0), 0, 0);
            const Matrix gyroscopic = z.C - still.C;
            REQUIRE((z.M - z.M.transpose()).cwiseAbs().maxCoeff() < 1e-12 * z.M.norm());
            REQUIRE((gyroscopic + gyroscopic.transpose()).cwiseAbs().maxCoeff() < 1e-11 * gyroscopic.norm());
        }
}

TEST_CASE("coleman: the fixed-frame eigenvalues give the Floquet multipliers of the rotating-frame equations",
          "[property]") {
    // Floquet: exp(lambda T) are the eigenvalues of the monodromy matrix of the periodic system, integrated here.
    const SmallRotor rotor = rotor_of(3, true);
    const double Omega = 5, period = 2 * pi / Omega;
    const Eigen::Index n = std::ssize(rotor.unknowns());
    const int steps = 1500;
    std::vector<Matrix> A;  // at every half step
    for (int i = 0; i <= 2 * steps; ++i) {
        const SecondOrderSystem s = rotor.rotating(Omega, pi * i / steps);
        Matrix a = Matrix::Zero(2 * n, 2 * n);
        a.topRightCorner(n, n).setIdentity();
        a.bottomLeftCorner(n, n) = -s.M.partialPivLu().solve(s.K);
        a.bottomRightCorner(n, n) = -s.M.partialPivLu().solve(s.C);
        A.push_back(a);
    }
    Matrix monodromy(2 * n, 2 * n);
    for (Eigen::Index c = 0; c < 2 * n; ++c)
        monodromy.col(c) = runge_kutta(
            Vector::Unit(2 * n, c),
            [&](double t, const Vector& x) -> Vector { return entry(A, std::lround(2 * steps * t / period)) * x; }, 0,
            period, steps);
    Eigen::VectorXcd multipliers = monodromy.eigenvalues();

    const ColemanTransform T(rotor.map, rotor.unknowns());
    const std::vector<Mode> found = modes(T.transform(rotor.rotating(Omega), 0, Omega));
    REQUIRE(found.size() == static_cast<std::size_t>(n));
    for (const Mode& mode : found)
        for (const Complex lambda : {mode.eigenvalue, std::conj(mode.eigenvalue)}) {
            REQUIRE(mode.oscillates());
            const Complex expected = std::exp(lambda * period);
            CHECK((multipliers.array() - expected).abs().minCoeff() < 1e-7);
        }
    CHECK(multipliers.cwiseAbs().maxCoeff() < 0.999);  // all damped: the comparison is not one of unit circles
}

TEST_CASE("coleman: on a rigid hub a rotating-frame frequency splits into backward w - Omega and forward w + Omega",
          "[analytic]") {
    // Hinged point mass: w^2 = k / (m l^2) + Omega^2 (1 + e / l), damped by d / (2 m l^2).
    const double Omega = 2;
    const SmallRotor rotor = rotor_of(3, false);
    const ColemanTransform T(rotor.map, rotor.unknowns());
    const SecondOrderSystem z = T.transform(rotor.rotating(Omega), 0, Omega);
    const double inertia = mass * arm * arm, decay = 2 / (2 * inertia);
    const double w = std::sqrt(stiffness / inertia + Omega * Omega * (1 + flap_offset / arm) - decay * decay);
    const std::vector<Mode> found = modes(z);
    REQUIRE(found.size() == 3);
    const double expected[] = {w - Omega, w, w + Omega};
    for (std::size_t i = 0; i < 3; ++i) {
        CAPTURE(i);
        CHECK(found[i].eigenvalue.imag() == Approx(expected[i]).epsilon(1e-12));
        CHECK(found[i].eigenvalue.real() == Approx(-decay).epsilon(1e-10));
    }
    // The deformation travels against or with the rotor: blades reach their largest flap in the order of rising or
    // falling azimuth. Rows are collective, cosine, sine: x = cos(w t -+ psi).
    CHECK(std::abs(found[0].shape(2) / found[0].shape(1) - Complex(0, 1)) < 1e-10);
    CHECK(std::abs(found[1].shape(1)) + std::abs(found[1].shape(2)) < 1e-10 * std::abs(found[1].shape(0)));
    CHECK(std::abs(found[2].shape(2) / found[2].shape(1) - Complex(0, -1)) < 1e-10);

    // So say the names.
    const EnergyFractions energy_shares(linearise(rotor.system, rotor.spinning(Omega)), rotor.system.model, rotor.map,
                                        rotor.unknowns(), T.rows());
    REQUIRE(energy_shares.components().size() == 1);
    CHECK(energy_shares.shares(found[0])[0].of(RotorPattern::backward) == Approx(1).epsilon(1e-12));
    CHECK(energy_shares.shares(found[1])[0].of(RotorPattern::collective) == Approx(1).epsilon(1e-12));
    CHECK(energy_shares.shares(found[2])[0].of(RotorPattern::forward) == Approx(1).epsilon(1e-12));
    CHECK(energy_shares.shares(found[0])[0].whirl == Approx(-1).epsilon(1e-12));
    CHECK(energy_shares.shares(found[2])[0].whirl == Approx(1).epsilon(1e-12));
}

TEST_CASE("coleman: isotropic shaft bending becomes a mass on fixed springs with rotating damping", "[analytic]") {
    // Fixed frame: m r'' + d (r' - Omega e_x x r) + k r = 0, whichever way the part's x axis points.
    const double m = 2, k = 50, d = 0.7, Omega = 3;
    for (const double sense : {1.0, -1.0})
        for (const double psi : {0.0, 0.8, 3.0}) {
            CAPTURE(sense, psi);
            const SecondOrderSystem fixed = shaft_in_fixed_frame(sense, k, d, m, Omega, psi);
            const double turn = d * sense * Omega;
            CHECK((fixed.M - m * Matrix::Identity(2, 2)).cwiseAbs().maxCoeff() < 1e-13);
            CHECK((fixed.C - d * Matrix::Identity(2, 2)).cwiseAbs().maxCoeff() < 1e-12);
            CHECK((fixed.K - (Matrix(2, 2) << k, turn, -turn, k).finished()).cwiseAbs().maxCoeff() < 1e-12);
            CHECK((fixed.K_elastic - k * Matrix::Identity(2, 2)).cwiseAbs().maxCoeff() < 1e-12);
        }
}

TEST_CASE("coleman: of two blades the sum and the difference, whatever the azimuth", "[analytic]") {
    const ColemanTransform T(imagined(2, 1), first(4));
    CHECK(T.rows()[2].kind == MultiBlade::collective);
    CHECK(T.rows()[3].kind == MultiBlade::differential);
    Matrix expected = Matrix::Identity(4, 4);
    expected.bottomRightCorner(2, 2) << std::sqrt(0.5), std::sqrt(0.5), std::sqrt(0.5), -std::sqrt(0.5);
    for (const double psi : {0.0, 1.3}) CHECK((T.matrix(psi) - expected).cwiseAbs().maxCoeff() < 1e-15);
    CHECK(T.matrix(0.4, 1).isZero(0));
}

TEST_CASE("coleman: less than two blades and unequal blades are refused", "[property]") {
    for (const int blades : {0, 1})
        check_refused([&] { ColemanTransform(imagined(blades, 1), first(2 + blades)); },
                      {"imagined rotor", text("number of blades = ", blades), "at least 2"});
    RotorMap unequal = imagined(3, 2);
    unequal.blades[1].pop_back();
    check_refused([&] { ColemanTransform(unequal, first(8)); },
                  {"multi-blade coordinates = none", "has other coordinates than blade 1"});
    RotorMap uneven = imagined(3, 2);
    uneven.evenly_spaced = false;
    check_refused([&] { ColemanTransform(uneven, first(8)); }, {"the blades are not evenly spaced", "Floquet"});
    uneven.missing_blades = {2};
    check_refused([&] { ColemanTransform(uneven, first(8)); }, {"imagined rotor", "blade 2 of 4 is missing"});
    // A blade coordinate that is an unknown on two of three blades.
    check_refused(
        [&] {
            ColemanTransform(imagined(3, 1), {0, 1, 2, 4});
        },
        {"multi-blade coordinates = none", "other coordinates than blade 1", "the same free coordinates"});
    // On none of them it just does not appear.
    const ColemanTransform T(imagined(3, 2), {0, 1, 2, 4, 6});
    CHECK(T.rows()[4].kind == MultiBlade::sine);
    CHECK(T.rows()[4].blade_coordinate == 0);
}

}  // namespace cardan::testing::multi_blade_coordinates
