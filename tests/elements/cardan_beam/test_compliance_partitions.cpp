// Bodies of the partitions whose hinges follow the compliance, in space: twist, offsets, sectional inertia, curves.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/sections/beam_line.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/refusal.hpp"

#include <random>

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr std::array both_partitions{Partition::compliance_gauss, Partition::mean_difference};

// A blade-like beam: taper, 40 degrees of twist, mass off the axis, sectional inertia.
EngineeringSection blade_section(double x) {
    const double t = 1 - 0.09 * x;
    EngineeringSection s;
    s.mass = 40 * t * t;
    s.EI_flap = 1e7 * std::pow(t, 4), s.EI_edge = 5e7 * std::pow(t, 3), s.GJ = 2e6 * std::pow(t, 4);
    s.beta = 0.7 * t * t;
    s.mass_centre = {-0.3 * t + 0.02 * x, 0.1 * t};
    s.j_flap = 2 * t * t, s.j_edge = 9 * t * t;
    return s;
}

BeamLine blade() {
    return {10, {4}, [](double x) { return blade_section(x).section(); }, "blade"};
}

struct Sums {
    double mass = 0;
    Vec3 first = Vec3::Zero();
    Mat3 J = Mat3::Zero();  // about the inboard end of the element
};

Sums sums(const ElementInertia& e) {
    Sums s;
    for (const RigidInertia& b : e.body) {
        s.mass += b.mass;
        s.first += b.mass * b.com;
        s.J += b.J + b.mass * (b.com.squaredNorm() * Mat3::Identity() - b.com * b.com.transpose());
    }
    return s;
}

}  // namespace

TEST_CASE("partitions by compliance: a uniform element in closed form, whatever delta is given", "[analytic]") {
    const double M = 2, L = 0.9;
    const BeamLine line = uniform_beam(L, slender(1, M / L));
    const ElementInertia k = partition_element(line, 0, L, 0.3, Partition::mean_difference);
    const std::array<double, 4> mass{1. / 6, 1. / 3, 1. / 3, 1. / 6}, centre{1. / 6, 1. / 2, 1. / 2, 5. / 6},
        J{11. / 2520, 71. / 3780, 71. / 3780, 11. / 2520};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(k.body[i].mass == Approx(mass[i] * M).epsilon(1e-12));
        CHECK(k.body[i].com(0) == Approx(centre[i] * L).epsilon(1e-12));
        CHECK(k.body[i].J(1, 1) == Approx(J[i] * M * L * L).epsilon(1e-11));
        CHECK(k.body[i].J(2, 2) == Approx(J[i] * M * L * L).epsilon(1e-11));
        CHECK(std::abs(k.body[i].J(0, 0)) < 1e-14);
    }
    CHECK(k.hinges.first == Approx(1. / 6).epsilon(1e-12));
    const ElementInertia g = partition_element(line, 0, L, 0.3, Partition::compliance_gauss),
                         n = partition_element(line, 0, L, delta_gauss, Partition::segment_masses);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(g.body[i].mass == Approx(n.body[i].mass).epsilon(1e-12));
        CHECK((g.body[i].com - n.body[i].com).norm() < 1e-12);
        CHECK((g.body[i].J - n.body[i].J).norm() < 1e-12);
    }
}

TEST_CASE("compliance Gauss points: mass, first moment and inertia tensor of the continuum are kept", "[analytic]") {
    const Sums n = sums(partition_element(blade(), 2, 7, delta_gauss, Partition::segment_masses)),
               g = sums(partition_element(blade(), 2, 7, delta_gauss, Partition::compliance_gauss));
    CHECK(g.mass == Approx(n.mass).epsilon(1e-13));
    CHECK((g.first - n.first).norm() < 1e-12 * n.first.norm());
    CHECK((g.J - n.J).norm() < 1e-12 * n.J.norm());
}

TEST_CASE("mean differences: mass, first moment in all directions and second moment along the axis are kept",
          "[analytic]") {
    for (const auto& [x0, L] : {std::pair(0.0, 10.0), {2.0, 7.0}, {9.0, 1.0}}) {
        const Sums n = sums(partition_element(blade(), x0, L, delta_gauss, Partition::segment_masses)),
                   k = sums(partition_element(blade(), x0, L, delta_gauss, Partition::mean_difference));
        CHECK(k.mass == Approx(n.mass).epsilon(1e-12));
        CHECK((k.first - n.first).norm() < 1e-12 * n.first.norm());
        const double along = binet_tensor<double>(n.J)(0, 0);
        // Sectional inertia is no part of int mu x^2.
        CHECK(binet_tensor<double>(k.J)(0, 0) == Approx(along).epsilon(1e-9));
        // Across, and the products, to the order of the discretisation.
        CHECK(k.J(0, 0) == Approx(n.J(0, 0)).epsilon(0.05));
        CHECK((k.J - n.J).norm() < 0.01 * n.J.norm());
    }
}

TEST_CASE("mean differences: across the axis a body is where the material of its segment is", "[property]") {
    const ElementInertia k = partition_element(blade(), 2, 7, delta_gauss, Partition::mean_difference);
    const std::array<double, 5> ends{0, k.hinges.first, k.hinges.middle, k.hinges.second, 1};
    for (std::size_t i : {0u, 3u}) {
        using Sum = Eigen::Vector3d;
        const Sum m =
            integrate(2 + 7 * ends[i], 2 + 7 * ends[i + 1], std::vector<double>{4}, Sum(Sum::Zero()), [](double x) {
                const BeamSection s = blade_section(x).section();
                return Sum(s.mass * Sum(1, s.centre(1), s.centre(2)));
            });
        CHECK(k.body[i].com(1) == Approx(m(1) / m(0)).epsilon(1e-11));
        CHECK(k.body[i].com(2) == Approx(m(2) / m(0)).epsilon(1e-11));
    }
}

TEST_CASE("partitions by compliance: the polar inertia is cut at the centroid of the torsion compliance",
          "[analytic]") {
    EngineeringSection s = slender(1, 2);
    const BeamLine line{1, {}, [s](double x) {
                            EngineeringSection own = s;
                            own.j_flap = 0.3;
                            own.GJ = 1 / (1 + x);
                            return own.section();
                        }};
    const double cut = (1. / 2 + 1. / 3) / (1 + 1. / 2);
    for (const Partition partition : both_partitions) {
        const ElementInertia e = partition_element(line, 0, 1, 0.2, partition);
        CHECK(e.rotary_split == Approx(cut).epsilon(1e-12));
        CHECK(e.body[0].J(0, 0) == Approx(0.3 * cut).epsilon(1e-11));
        CHECK(e.body[3].J(0, 0) == Approx(0.3 * (1 - cut)).epsilon(1e-11));
        CHECK(e.polar_inertia == Approx(0.3).epsilon(1e-12));
        // Rigid in torsion: in the middle. The other partitions always.
        CHECK(partition_element(uniform_beam(1, s), 0, 1, 0.2, partition).rotary_split == 0.5);
    }
    CHECK(partition_element(line, 0, 1, 0.2, Partition::segment_masses).rotary_split == 0.5);
}

TEST_CASE("partitions by compliance: bodies of random twisted beams with offsets are physically possible",
          "[property]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(0, 1);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<double> x;
        std::vector<EngineeringSection> sections;
        for (int i = 0; i < 5; ++i) {
            x.push_back(2.5 * i);
            EngineeringSection s;
            s.mass = std::pow(10, 2 * u(random));
            s.EI_flap = std::pow(10, 4 + 5 * u(random)), s.EI_edge = std::pow(10, 4 + 5 * u(random));
            s.GJ = std::pow(10, 4 + 3 * u(random));
            s.beta = 2 * u(random) - 1;
            s.mass_centre = {2 * u(random) - 1, u(random) - 0.5};
            if (trial % 2 == 0) s.j_flap = u(random), s.j_edge = u(random);
            sections.push_back(s);
        }
        const BeamLine line = beam_line({"random", x, sections, Interpolation::log_linear_stiffness});
        for (const auto& [x0, L] : {std::pair(0.0, 10.0), {0.0, 3.3}, {6.0, 4.0}})
            for (const Partition partition : both_partitions) {
                const ElementInertia e = partition_element(line, x0, L, delta_gauss, partition);
                CAPTURE(trial, x0, L, partition_name(partition));
                double mass = 0;
                for (const RigidInertia& body : e.body) {
                    REQUIRE_NOTHROW(body.check("body"));
                    REQUIRE(body.com.tail<2>().norm() < 2);  // sections: below 1.12
                    mass += body.mass;
                }
                REQUIRE(mass == Approx(e.mass).epsilon(1e-12));
            }
    }
}

TEST_CASE("partitions by compliance: elements without mass, partly without mass or rigid are accepted", "[property]") {
    for (const Partition partition : both_partitions) {
        CAPTURE(partition_name(partition));
        const ElementInertia none = partition_element(uniform_beam(1, slender(1, 0)), 0, 1, 0.2, partition);
        CHECK(none.mass == 0);
        for (const RigidInertia& body : none.body) CHECK(body.is_massless());
        for (const auto& [from, to] : {std::pair(0.0, 0.6), {0.6, 1.0}, {0.45, 0.5}}) {
            const BeamLine part{1, {from, to}, [from = from, to = to](double x) {
                                    return slender(1 - 0.5 * x, x > from && x < to ? 2 : 0).section();
                                }};
            const ElementInertia e = partition_element(part, 0, 1, 0.2, partition);
            for (const RigidInertia& body : e.body) CHECK_NOTHROW(body.check("body"));
            CHECK(sums(e).mass == Approx(2 * (to - from)).epsilon(1e-9));
            CHECK(sums(e).first(0) == Approx(to * to - from * from).epsilon(1e-9));
        }
        BeamLine rigid = uniform_beam(1, slender(1, 1));
        rigid.section = [](double) {
            BeamSection s;
            s.mass = 1;
            return s;
        };
        const ElementInertia e = partition_element(rigid, 0, 1, 0.2, partition);
        CHECK(e.hinges.first == delta_gauss);
        CHECK(e.body[0].mass == Approx(delta_gauss).epsilon(1e-12));
        for (const RigidInertia& body : e.body) CHECK_NOTHROW(body.check("body"));
    }
}

TEST_CASE("partitions by compliance: on a curve mass and first moment are kept, bodies are physically possible",
          "[property]") {
    // A quarter circle of radius 4 in the plane x-z.
    BeamLine line = blade();
    line.length = 2 * pi;
    line.axis = ReferenceLine::curve([](double s) { return Vec3(4 * std::sin(s / 4), 0, 4 * (1 - std::cos(s / 4))); },
                                     [](double s) { return Vec3(std::cos(s / 4), 0, std::sin(s / 4)); }, 0, 2 * pi);
    for (const Partition partition : both_partitions) {
        const ElementLine on(line, 1, 5);
        const ElementInertia e = partition_element(on, delta_gauss, partition),
                             n = partition_element(on, delta_gauss, Partition::segment_masses);
        CHECK(sums(e).mass == Approx(sums(n).mass).epsilon(1e-12));
        CHECK((sums(e).first - sums(n).first).norm() < 1e-11 * sums(n).first.norm());
        CHECK((sums(e).J - sums(n).J).norm() < 0.05 * sums(n).J.norm());
        for (const RigidInertia& body : e.body) CHECK_NOTHROW(body.check("body"));
    }
}

TEST_CASE("partitions have names of their own", "[property]") {
    CHECK(partition_name(Partition::segment_masses) == "segment masses");
    CHECK(partition_name(Partition::static_moment) == "static moments");
    CHECK(partition_name(Partition::compliance_gauss) == "compliance Gauss points");
    CHECK(partition_name(Partition::mean_difference) == "mean differences");
    CardanBeamOptions options = bending_only(2, 0.6, Partition::mean_difference);
    Tree tree;
    ForceSet forces;
    check_refused(
        [&] {
            (void)add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "beam", {"beam"},
                                  options);
        },
        {"delta", "0.6"});
}
