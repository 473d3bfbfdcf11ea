// The rotor speed at which the centrifugal force softens a beam of mean differences, against its eigenvalues.
#include "elements/cardan_beam/centrifugal_limit.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/units.hpp"
#include "tests/elements/cardan_beam/rotating_cantilever.hpp"
#include "tests/oracles/wt600_stations.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr double rated = 27 * units::rpm;  // of the 600 kW machine, rad/s

CardanBeamOptions bending_at_gauss(int elements, Partition partition = Partition::mean_difference) {
    return bending_only(elements, delta_gauss, partition);
}

// The 600 kW blade without twist, offsets and sectional inertia: y bends flapwise.
BeamLine straight_blade() {
    const oracles::BladeStations blade = oracles::wt600_stations();
    const Eigen::VectorXd stations = blade.positions();
    return {20,
            {stations.begin() + 1, stations.end() - 1},
            [blade](double x) {
                const oracles::BladeStation s = blade.at(x);
                EngineeringSection section = slender(s.flap_stiffness, s.mass_per_length);
                section.EI_edge = s.edge_stiffness;
                return section.section();
            },
            "blade"};
}

double min_stiffness(const RotatingBeam& rotor, double rotor_speed) {
    const Matrix K = rotor.at(rotor_speed).K;
    return Eigen::SelfAdjointEigenSolver<Matrix>(Matrix((K + K.transpose()) / 2), Eigen::EigenvaluesOnly)
        .eigenvalues()(0);
}

// The speed at which the least eigenvalue of the stiffness passes through zero.
double divergence(const RotatingBeam& rotor, double from, double to) {
    REQUIRE(min_stiffness(rotor, from) > 0);
    REQUIRE(min_stiffness(rotor, to) < 0);
    while (to - from > 1e-9 * to) {
        const double middle = (from + to) / 2;
        (min_stiffness(rotor, middle) > 0 ? from : to) = middle;
    }
    return from;
}

}  // namespace

TEST_CASE("centrifugal limit: true segments and a uniform beam have none", "[property]") {
    for (int elements : {1, 2, 3}) {
        for (const Partition p : {Partition::segment_masses, Partition::compliance_gauss})
            CHECK(std::isinf(
                centrifugal_limit(RotatingBeam(straight_blade(), bending_at_gauss(elements, p), 1.5).beam, 1.5)));
        CHECK(std::isinf(
            centrifugal_limit(RotatingBeam(uniform_beam(1, slender(1, 1)), bending_at_gauss(elements), 0).beam, 0)));
    }
}

TEST_CASE("centrifugal limit: 600 kW blade, within 2.5 % of the speed at which the stiffness passes through zero",
          "[crosscheck]") {
    // In units of the rated speed, from the eigenvalues; out of the plane of rotation, the soft one, it gives way
    // first.
    for (const auto& [elements, expected] :
         std::vector<std::pair<int, double>>{{1, 2.440}, {2, 4.294}, {3, 7.205}, {4, 10.668}, {8, 30.384}}) {
        const RotatingBeam rotor(straight_blade(), bending_at_gauss(elements), 1.5);
        const double limit = centrifugal_limit(rotor.beam, 1.5), exact = divergence(rotor, 0, 1.1 * limit);
        CAPTURE(elements, limit / rated);
        CHECK(exact / rated == Approx(expected).margin(6e-4));
        CHECK(limit == Approx(exact).epsilon(0.025));
    }
}

TEST_CASE("centrifugal limit: beams alike in both planes give way in the plane of rotation, 1.5 to 5 % below it",
          "[crosscheck]") {
    const auto in_first_frequencies = [](std::function<EngineeringSection(double)> section) {
        const BeamLine line{1, {}, [section](double x) { return section(x).section(); }};
        const RotatingBeam rotor(line, bending_at_gauss(2), 0);
        const double limit = centrifugal_limit(rotor.beam, 0), exact = divergence(rotor, 0, 1.1 * limit);
        CHECK(limit > 1.015 * exact);
        CHECK(limit < 1.05 * exact);
        return exact / clamped_frequencies(line, bending_at_gauss(2))[0];
    };
    const auto exponential = [](double k) {
        return [k](double x) { return slender(std::pow(10, -k * x), std::pow(10, -k * x / 2)); };
    };
    CHECK(in_first_frequencies([](double x) { return slender(std::pow(1 - x / 2, 3), 1 - x / 2); }) ==
          Approx(6.616).margin(6e-4));
    CHECK(in_first_frequencies(exponential(3)) == Approx(1.458).margin(6e-4));
    CHECK(in_first_frequencies(exponential(5)) == Approx(0.613).margin(6e-4));
}

TEST_CASE("centrifugal limit: does not depend on where the axes of the section point", "[property]") {
    const auto limit = [](double beta) {
        const BeamLine line{1, {}, [beta](double x) {
                                EngineeringSection s = slender(std::pow(1 - x / 2, 3), 1 - x / 2);
                                s.EI_edge *= 4;
                                s.beta = beta;
                                return s.section();
                            }};
        return centrifugal_limit(RotatingBeam(line, bending_at_gauss(3), 0.2).beam, 0.2);
    };
    CHECK(limit(0.6) == Approx(limit(0)).epsilon(1e-10));
}
