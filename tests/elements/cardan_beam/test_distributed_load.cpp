// Loads per length with every partition: statics of nodes, the load of gravity, section loads.
#include "elements/cardan_beam/distributed_load.hpp"
#include "elements/sections/quadrature.hpp"
#include "tests/elements/cardan_beam/loaded_beam.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr std::array<Partition, 2> shaped{Partition::static_moment, Partition::mean_difference};

CardanBeamOptions options_of(int elements, Partition partition) {
    CardanBeamOptions options;
    options.elements = elements;
    options.partition = partition;
    options.extension = true;
    options.torsion = false;
    return options;
}

// L = 1; EI and mass fall to the tip.
BeamLine tapered(double taper, double GA = std::numeric_limits<double>::infinity()) {
    BeamLine line{1, {}, {}, "tapered"};
    line.section = [=](double x) {
        const double k = 1 - taper * x;
        EngineeringSection s = slender(k * k * k, k);
        s.EA = 1e3 * k, s.GA_y = s.GA_z = GA * k, s.GJ = 0.5 * k * k * k, s.j_flap = s.j_edge = 0.01 * k;
        return s.section();
    };
    return line;
}

// Deflection and turn about -y of the tip under a load f along z and a moment m about y per length.
std::pair<double, double> tip(const BeamLine& line, const CardanBeamOptions& options, const Wrench& w,
                              WrenchAxes axes = WrenchAxes::base) {
    Loaded b = clamped(line, options);
    add_distributed_load(b.tree, b.forces, b.beam, {"p", [&](double) { return w; }, axes});
    b.settle();
    Workspace workspace(b.system->model);
    const Pose<double> end = pose(kinematics(b.system->model, b.at.q, workspace), b.beam.tip());
    return {end.p.z(), std::atan2(end.R(2, 0), end.R(0, 0))};
}

// Tip of a sheared beam in linear statics, f across and m along it, by quadrature.
std::pair<double, double> exact_tip(double taper, double GA, double f, double m) {
    const auto at = [&](double x) {
        const double k = 1 - taper * x, l = 1 - x, curvature = (f * l * l / 2 - m * l) / (k * k * k);
        return Eigen::Vector2d(curvature * l + f * l / (GA * k), curvature);
    };
    const Eigen::Vector2d sum = integrate(0, 1, {}, Eigen::Vector2d(Eigen::Vector2d::Zero()), at);
    return {sum(0), sum(1)};
}

}  // namespace

TEST_CASE(
    "distributed load: with the static shapes the tip of a cantilever is exact in linear statics, whatever the "
    "number of elements",
    "[analytic]") {
    const double rigid = std::numeric_limits<double>::infinity(), f = 1e-7, m = 3e-7;
    CHECK(exact_tip(0, rigid, f, 0).first == Approx(f / 8).epsilon(1e-12));
    for (const Partition partition : shaped)
        for (const int elements : {1, 2, 5})
            for (const double taper : {0.0, 0.5})
                for (const double GA : {rigid, 10.0}) {
                    const CardanBeamOptions options = options_of(elements, partition);
                    const BeamLine line = tapered(taper, GA);
                    CAPTURE(partition_name(partition), elements, taper, GA);
                    const auto force = exact_tip(taper, GA, f, 0), moment = exact_tip(taper, GA, 0, m);
                    for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame}) {
                        const auto bent = tip(line, options, {{0, 0, f}, Vec3::Zero()}, axes);
                        CHECK(bent.first == Approx(force.first).epsilon(1e-9));
                        CHECK(bent.second == Approx(force.second).epsilon(1e-9));
                        const auto turned = tip(line, options, {Vec3::Zero(), {0, m, 0}}, axes);
                        CHECK(turned.first == Approx(moment.first).epsilon(1e-9));
                        CHECK(turned.second == Approx(moment.second).epsilon(1e-9));
                    }
                }
    // Segment masses carry the load where it is: of order 2 but with hinges at the Gauss points.
    const auto segments = [&](int elements, double delta) {
        CardanBeamOptions options = options_of(elements, Partition::segment_masses);
        options.delta = delta;
        return tip(tapered(0), options, {{0, 0, f}, Vec3::Zero()}).first / (f / 8) - 1;
    };
    for (const int elements : {1, 4, 8}) {
        CHECK(segments(elements, sixth) == Approx(1. / 18 / (elements * elements)).epsilon(1e-6));
        CHECK(std::abs(segments(elements, delta_gauss)) < 1e-9);
    }
}

TEST_CASE("distributed load: mass per length times g acts as gravity at any deflection, with every partition",
          "[property]") {
    Random random(5);
    const Vec3 g(1, -2, -9);
    const auto compare = [&](const BeamLine& line, Partition partition, int elements) {
        CardanBeamOptions options = options_of(elements, partition);
        options.torsion = true;
        Loaded heavy = clamped(line, options), loaded = clamped(line, options);
        heavy.forces.set_gravity(g);
        add_distributed_load(loaded.tree, loaded.forces, loaded.beam,
                             {"weight", [&](double s) {
                                  return Wrench{line.section(s).mass * g, Vec3::Zero()};
                              }});
        const System by_gravity(heavy.tree, heavy.forces), by_load(loaded.tree, loaded.forces);
        const auto n = by_load.model.size();
        const Vector zero = Vector::Zero(n);
        Workspace one(by_gravity.model), two(by_load.model);
        double share = 1;
        for (const CardanBeam::Element& element : loaded.beam.elements) share = std::min(share, element.shape_share);
        for (const double size : {0.0, 0.05, 0.5}) {
            const Vector q = Vector::NullaryExpr(n, [&] { return size * uniform(random, -1, 1); });
            Vector Q(n), P(n);
            by_gravity.forces.generalised_forces({{.q = q, .qd = zero}, kinematics(by_gravity.model, q, one)}, Q);
            by_load.forces.generalised_forces({{.q = q, .qd = zero}, kinematics(by_load.model, q, two)}, P);
            CAPTURE(partition_name(partition), elements, size);
            CHECK((Q - P).norm() < 1e-11 * Q.norm());
        }
        return share;
    };
    for (const Partition partition :
         {Partition::segment_masses, Partition::compliance_gauss, Partition::static_moment, Partition::mean_difference})
        for (const double taper : {0.0, 0.5}) {
            const double share = compare(tapered(taper), partition, 2);
            const bool shapes = partition == Partition::static_moment || partition == Partition::mean_difference;
            CHECK(share == (shapes ? 1 : 0));
        }
    // So steep that the limiter of the mean differences is at work.
    const double share = compare(tapered(0.97), Partition::mean_difference, 1);
    CHECK(share > 0.01);
    CHECK(share < 0.99);
}

TEST_CASE("distributed load: bent far, dead and follower loads converge with order 4 where the masses do",
          "[property]") {
    for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame})
        for (const Partition partition : shaped) {
            const auto deflection = [&](int elements) {
                CardanBeamOptions options = options_of(elements, partition);
                options.extension = false;
                return tip(uniform_beam(1, slender(1, 1)), options, {{0, 0, 4}, Vec3::Zero()}, axes).first;
            };
            const double n8 = deflection(8), n16 = deflection(16), n32 = deflection(32);
            CAPTURE(axes == WrenchAxes::frame, partition_name(partition), n8, n16, n32);
            CHECK(n16 > 0.35);
            CHECK(std::log2((n16 - n8) / (n32 - n16)) == Approx(4).margin(0.15));
        }
}

TEST_CASE("distributed load: section loads by equilibrium do not see how it was shared", "[analytic]") {
    const Vec3 f(1e-4, 2e-4, -3e-4), m(5e-5, -2e-5, 1e-5);
    for (const Partition partition : shaped) {
        CardanBeamOptions options = options_of(2, partition);
        options.torsion = true;
        Loaded b = clamped(tapered(0.3, 50), options);
        add_distributed_load(b.tree, b.forces, b.beam, {"wind", [&](double) { return Wrench{f, m}; }});
        b.settle();
        std::vector<double> places{0, 0.5, 1};
        for (const CardanBeam::Element& e : b.beam.elements)
            for (double fraction : {e.hinges.first, e.hinges.middle, e.hinges.second})
                for (double side : {-1e-7, 1e-7}) places.push_back(e.start + (fraction + side) * e.length);
        for (const double s : places) {
            const double l = 1 - s;
            const Vec6 exact = (Vec6() << l * f, l * m + cross<double>(Vec3(l * l / 2, 0, 0), f)).finished();
            CAPTURE(partition_name(partition), s, exact.transpose(), b.equilibrium(s).transpose());
            CHECK((b.equilibrium(s) - exact).cwiseAbs().maxCoeff() < 1e-7);
        }
    }
}
