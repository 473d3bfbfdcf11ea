// A rotor without blades: a disc that tilts on a shaft, in closed form.
#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>

namespace cardan::testing::disc_rotor {

using namespace solvers;

namespace {

constexpr double Jp = 3.2, Jt = 1.9, k = 5200;  // kg m^2 about and across the shaft, N m/rad

enum class Shaft : std::uint8_t { turns, turns_reversed, stands };

struct Disc {
    System system;
    RotorMap map;
};

// The shaft lies along x. Its two hinges turn with it, or carry the bearing of a disc that turns.
Disc disc_on_shaft(Shaft shaft, double damping = 0) {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    const auto joint = [&](const char* name, const char* part, const Vec3& axis, const RigidInertia& inertia) {
        BodySpec body = joint_spec(name, at, JointKind::revolute, axis);
        const Placement back = body.placement.inverse();
        body.inertia = inertia.in(back);
        body.coordinate.part = part;
        const BodyId id = tree.add_body(body);
        at = tree.add_frame(tree.frame_of(id), back, text(name, " axes"));
        return id;
    };
    const RigidInertia disc{40, Vec3::Zero(), Vec3(Jp, Jt, Jt).asDiagonal()}, none{};
    const auto hinges = [&](const RigidInertia& carried) {
        const BodyId y = joint("bending y", "shaft", Vec3::UnitY(), none);
        const BodyId z = joint("bending z", "shaft", Vec3::UnitZ(), carried);
        for (const BodyId body : {y, z}) forces.add_spring(text("spring ", body.index), body, k, damping);
        return std::pair(y, z);
    };
    std::pair<BodyId, BodyId> pair;
    BodyId spin;
    if (shaft == Shaft::stands) {
        pair = hinges(none);
        spin = joint("spin", "drive train", Vec3::UnitX(), disc);
    } else {
        spin = joint("spin", "drive train", Vec3::UnitX(), none);
        // The axes of a shaft that is described from its other end.
        if (shaft == Shaft::turns_reversed) at = tree.add_frame(at, Placement::rotation(rot_z(pi)), "from behind");
        pair = hinges(disc);
    }
    Disc rotor{System(tree, forces), {}};
    const Model& model = rotor.system.model;
    rotor.map.machine = "disc on a shaft";
    rotor.map.spin = model.index(spin);
    rotor.map.hub = tree.frame("spin axes");
    rotor.map.rotating_pairs = {{model.index(pair.first), model.index(pair.second),
                                 shaft == Shaft::turns_reversed ? -1.0 : 1.0, shaft != Shaft::stands}};
    rotor.map.parts = {{"shaft", tree.frame("spin axes"), {}, {"", "shaft bending", "shaft bending"}}};
    return rotor;
}

// Jt a'' - i Jp Omega a' + k a = 0 for the tilt a = a_y + i a_z.
double whirl(double Omega, double direction) {
    return (direction * Jp * Omega + std::sqrt(Jp * Jp * Omega * Omega + 4 * Jt * k)) / (2 * Jt);
}

}  // namespace

TEST_CASE("campbell: a disc on a shaft whirls backward and forward in the fixed frame, whatever carries it",
          "[analytic]") {
    const std::array speeds{0.0, 12.0, 47.0, 130.0};
    for (const Shaft shaft : {Shaft::turns, Shaft::turns_reversed, Shaft::stands})
        for (const RotorSpin spin : {RotorSpin::free, RotorSpin::prescribed}) {
            CampbellOptions options;
            options.spin = spin;
            options.max_frequency_hz = 1000;
            const Disc rotor = disc_on_shaft(shaft);
            const Campbell d = campbell(rotor.system, rotor.map, speeds, options);
            CAPTURE(static_cast<int>(shaft), static_cast<int>(spin), table(d));
            CHECK(d.method == "fixed frame");
            REQUIRE(d.branches.size() == 2);
            for (std::size_t i = 0; i < speeds.size(); ++i) {
                CHECK(d.natural_hz(d.branch("shaft bending (backward)"), i) ==
                      Approx(whirl(speeds.at(i), -1) / (2 * pi)).epsilon(1e-10));
                CHECK(d.natural_hz(d.branch("shaft bending (forward)"), i) ==
                      Approx(whirl(speeds.at(i), 1) / (2 * pi)).epsilon(1e-10));
                // From rest, where the pair is one of cosine and sine, the link is loose.
                for (const Branch& branch : d.branches) CHECK((i < 2 || !branch.doubtful[i]));
            }
        }
}

TEST_CASE("campbell: damping that turns with a disc makes forward whirl grow, as the closed form says", "[analytic]") {
    const double c = 31;
    const std::array speeds{10.0, 60.0, 200.0};
    CampbellOptions options;
    options.max_frequency_hz = 1000;
    options.spin = RotorSpin::prescribed;
    const Disc rotor = disc_on_shaft(Shaft::turns, c);
    const Campbell d = campbell(rotor.system, rotor.map, speeds, options);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const double Omega = speeds.at(i);
        // Jt s^2 + (c - i Jp Omega) s + k - i c Omega = 0
        const Complex b(c, -Jp * Omega), root = std::sqrt(b * b - 4 * Jt * Complex(k, -c * Omega));
        double growth = -1e9;
        for (const double sign : {1.0, -1.0}) {
            const Complex s = (-b + sign * root) / (2 * Jt);
            growth = std::max(growth, s.real());
            const char* name = s.imag() > 0 ? "shaft bending (forward)" : "shaft bending (backward)";
            const Complex found = d.mode(d.branch(name), i)->mode.eigenvalue;
            CHECK(std::abs(found - Complex(s.real(), std::abs(s.imag()))) < 1e-9 * std::abs(s));
        }
        CHECK(d.points[i].stability_margin == Approx(-growth).epsilon(1e-7));
    }
}

TEST_CASE("campbell: an undamped rotor is neither stable nor unstable, whatever rounding leaves", "[property]") {
    std::vector<double> speeds;
    for (int i = 0; i < 60; ++i) speeds.push_back(3.7 * i);
    for (const Shaft shaft : {Shaft::turns, Shaft::turns_reversed, Shaft::stands}) {
        const Disc rotor = disc_on_shaft(shaft);
        const Campbell d = campbell(rotor.system, rotor.map, speeds, {.max_frequency_hz = 1000});
        CHECK(d.warning.empty());
        for (const CampbellPoint& point : d.points) CHECK(point.stability_margin == 0);
    }
}

TEST_CASE("modes: a shaft almost without inertia adds its own frequency or none, never one of rounding", "[analytic]") {
    // Two hinges in series: at the first the shaft, at the second the disc.
    const double J = 2, k1 = 5000, k2 = 8000;
    for (const double shaft : {1e-6, 1e-9, 1e-11, 1e-14, 1e-15, 1e-16, 1e-18, 1e-20}) {
        SecondOrderSystem s;
        s.M = (Matrix(2, 2) << shaft + J, J, J, J).finished();
        s.K = s.K_elastic = Vector(Eigen::Vector2d(k1, k2)).asDiagonal();
        s.C = Matrix::Zero(2, 2);
        const double a = shaft * J, b = k1 * J + k2 * (shaft + J), root = std::sqrt(b * b - 4 * a * k1 * k2);
        const std::vector<Mode> found = modes(s);
        CAPTURE(shaft, found.size());
        REQUIRE(!found.empty());
        CHECK(std::abs(found[0].eigenvalue) == Approx(std::sqrt(2 * k1 * k2 / (b + root))).epsilon(1e-12));
        const double own = std::sqrt((b + root) / (2 * a));
        if (shaft > 1e-12) REQUIRE(found.size() == 2);
        if (found.size() == 2) CHECK(std::abs(found[1].eigenvalue) == Approx(own).epsilon(0.02));
    }
}

TEST_CASE("campbell: a machine in which nothing can move is refused by name", "[property]") {
    Tree tree;
    BodySpec shaft = joint_spec("spin", Tree::base(), JointKind::revolute, Vec3::UnitX());
    shaft.inertia = {40, Vec3::Zero(), Vec3(Jp, Jt, Jt).asDiagonal()};
    const BodyId spin = tree.add_body(shaft);
    const System system(tree, ForceSet{});
    RotorMap map;
    map.machine = "rigid machine";
    map.spin = system.model.index(spin);
    map.hub = tree.frame_of(spin);
    CHECK_THROWS_WITH(campbell(system, map, {0.0, 1.0}, {.spin = RotorSpin::prescribed}),
                      Catch::Contains("rigid machine: coordinates that can move = 0"));
}

}  // namespace cardan::testing::disc_rotor
