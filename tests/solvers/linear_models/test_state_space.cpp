// Linear models with inputs and outputs: systems of one or two coordinates by hand, what follows from the matrices of
// the linearised equations, Fourier series, bad input.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/periodic_system.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::state_spaces {

using namespace solvers;

namespace {

constexpr double m = 3, J = 7, k = 40, c = 1.5, R = 2, g = units::standard_gravity;

// An arm that turns about the level axis z, angle a, with a mass that slides along it at R + r on spring and damper.
struct SlidingMass {
    Tree tree;
    ForceSet forces;
    FrameId mass_frame;
    int arm = -1, slider = -1;

    explicit SlidingMass(CoordinateRole role = CoordinateRole::free) {
        const Link turning =
            add_joint(tree, {.name = "arm", .inertia = {1e-3, Vec3::Zero(), Vec3(5, 5, J).asDiagonal()}, .role = role});
        const FrameId at = tree.add_frame(turning.axes, Placement::translation({R, 0, 0}), "rail");
        const Link mass = add_joint(tree, {.name = "slider",
                                           .inboard = at,
                                           .kind = JointKind::prismatic,
                                           .axis = Vec3::UnitX(),
                                           .inertia = {m, Vec3::Zero()}});
        mass_frame = mass.axes;
        forces.add_spring("spring", mass.body, k, c);
        forces.set_gravity({0, -g, 0});
        const Model model(tree);
        arm = model.index(turning.body);
        slider = model.index(mass.body);
    }

    // Torque of the arm's drive; force of the rail and its drive on the mass along the arm; acceleration of the mass.
    std::vector<ChannelGroup> channels() const {
        ChannelGroup group;
        group.channels = {{"arm torque", "N m", "torque of the drive"},
                          {"rail force", "N", "along the arm on the mass"},
                          {"mass acceleration", "m s-2", "along the arm"},
                          {"arm angle", "rad", "wrapped", {}, {}, "ArmAng"}};
        group.sample = [arm = arm, body = slider](const DynamicView& in, double* values) {
            const Vec3 along = in.kinematics.rotation(arm) * Vec3::UnitX();
            values[0] = in.actuator(arm);
            values[1] = along.dot(entry(in.loads().joint, body).force);
            values[2] = along.dot(entry(in.loads().motion, body).acceleration);
            values[3] = in.q(arm) - 2 * pi * std::floor(in.q(arm) / (2 * pi));
        };
        return {group};
    }
};

RotorMap no_rotor() {
    RotorMap map;
    map.machine = "arm";
    return map;
}

struct Instant {
    double a, w, e, r, v, s;  // angle, rate, acceleration; slide, rate, acceleration
    DynamicState of(const SlidingMass& x) const {
        DynamicState at = at_rest(2);
        at.q(x.arm) = a, at.qd(x.arm) = w, at.qdd(x.arm) = e;
        at.q(x.slider) = r, at.qd(x.slider) = v, at.qdd(x.slider) = s;
        return at;
    }
};
// Slide in balance: r'' = (R + r) w^2 - (k r + c v) / m - g sin a.
Instant moving(double a, double w, double e, double r, double v) {
    return {a, w, e, r, v, (R + r) * w * w - (k * r + c * v) / m - g * std::sin(a)};
}

void check_equal(const Matrix& found, const Matrix& expected, double tolerance) {
    REQUIRE(found.rows() == expected.rows());
    REQUIRE(found.cols() == expected.cols());
    INFO("found\n" << found << "\nexpected\n" << expected);
    CHECK((found - expected).cwiseAbs().maxCoeff() <= tolerance * (1 + expected.cwiseAbs().maxCoeff()));
}

SmallRotor heavy_rotor() {
    return small_rotor({.stiffness = {900, 900, 900},
                        .damping = 20,
                        .hinges = BladeHinges::flap_and_lag,
                        .lag_damping = 30,
                        .elastic_support = true,
                        .gravity = units::standard_gravity * Vec3(0, -1, -0.1)});
}

ChannelGroup positions(const Model& model) {
    ChannelGroup group;
    for (const CoordinateInfo& info : model.coordinates()) group.channels.push_back({info.name, info.unit, "position"});
    group.sample = [](const DynamicView& in, double* values) {
        for (double q : in.q) *values++ = q;
    };
    return group;
}

}  // namespace

TEST_CASE("state space: a mass that slides on a driven arm has the matrices that differentiation by hand gives",
          "[analytic]") {
    const SlidingMass x(CoordinateRole::prescribed);
    const System system(x.tree, x.forces);
    const Instant at = moving(0.7, 1.9, 0.4, 0.3, -0.2);
    const auto [a, w, e, r, v, s] = at;
    const double rho = R + r;
    const LinearModel model = state_space(system, no_rotor(), at.of(x),
                                          {LinearInput::motion("arm", {{x.arm, 1.0}}),
                                           LinearInput::force("push", x.mass_frame, Vec3::UnitX(), WrenchAxes::frame),
                                           LinearInput::generalised_force("pull", {{x.slider, -2.0}})},
                                          x.channels());
    REQUIRE(model.samples.size() == 1);
    CHECK(model.inputs.back().units == "N");
    const LinearSample& found = model.samples[0];
    CHECK(model.states[1].name == "slider rate");
    CHECK(model.states[1].units == "m s-1");
    CHECK(model.inputs[2].name == "arm acceleration");
    CHECK(model.inputs[2].units == "rad s-2");
    check_equal(found.A, (Matrix(2, 2) << 0, 1, w * w - k / m, -c / m).finished(), 1e-14);
    check_equal(found.B, (Matrix(2, 5) << 0, 0, 0, 0, 0, -g * std::cos(a), 2 * rho * w, 0, 1 / m, -2 / m).finished(),
                1e-14);
    // torque = (J + m rho^2) e + 2 m rho v w + m g rho cos a; rail force m (r'' - rho w^2 + g sin a) - push, where
    // m r'' follows: -k r - c v - 2 pull; acceleration of the mass r'' - rho w^2.
    Matrix C(4, 2), D(4, 5);
    C << m * (2 * rho * e + 2 * v * w + g * std::cos(a)), 2 * m * rho * w, -k, -c, -k / m, -c / m, 0, 0;
    D << -m * g * rho * std::sin(a), 2 * m * rho * v, m * rho * rho + J, 0, 0,  //
        0, 0, 0, 0, -2,                                                         //
        -g * std::cos(a), 0, 0, 1 / m, -2 / m,                                  //
        1, 0, 0, 0, 0;
    check_equal(found.C, C, 1e-9);
    check_equal(found.D, D, 1e-9);
    CHECK(model.output_error.maxCoeff() < 1e-5);
    CHECK(model.imbalance < 1e-13);
    CHECK(found.y(0) == Approx((J + m * rho * rho) * e + 2 * m * rho * v * w + m * g * rho * std::cos(a)));
    CHECK((found.u - Vector((Vector(5) << a, w, e, 0, 0).finished())).norm() < 1e-15);
}

TEST_CASE("state space: an accelerated coordinate with states of its own gives the same transfer function",
          "[property]") {
    const SlidingMass x(CoordinateRole::prescribed);
    const System system(x.tree, x.forces);
    const DynamicState at = moving(0.7, 1.9, 0.4, 0.3, -0.2).of(x);
    const auto model_of = [&](const LinearInput& input) {
        return at_sample(state_space(system, no_rotor(), at, {input}, x.channels()), 0);
    };
    const ConstantModel split = model_of(LinearInput::motion("arm", {{x.arm, 0.5}})),
                        whole = model_of(LinearInput::acceleration("arm", {{x.arm, 0.5}}));
    REQUIRE(whole.states.size() == 4);
    REQUIRE(whole.inputs.size() == 1);
    const Complex s(0.2, 3.1);
    const ComplexMatrix three = split.transfer(s), one = whole.transfer(s);
    const ComplexVector together = three.col(0) / (s * s) + three.col(1) / s + three.col(2);
    CHECK((together - one.col(0)).norm() < 1e-9 * one.norm());
}

TEST_CASE("state space: D of a motion is in proportion to its factor, however large or small that is", "[property]") {
    const SlidingMass x(CoordinateRole::prescribed);
    const System system(x.tree, x.forces);
    const DynamicState at = moving(0.7, 1.9, 0.4, 0.3, -0.2).of(x);
    const auto D = [&](double factor) {
        return state_space(system, no_rotor(), at, {LinearInput::motion("arm", {{x.arm, factor}})}, x.channels())
            .samples[0]
            .D;
    };
    const Matrix one = D(1);
    for (double factor : {300.0, 1e-4}) check_equal(D(factor) / factor, one, 1e-9);
}

TEST_CASE("state space: a channel in rad may jump by a turn", "[property]") {
    const SlidingMass x;
    const System system(x.tree, x.forces);
    StateSpaceOptions options;
    options.outputs = {"ArmAng"};
    const LinearModel model = state_space(system, no_rotor(), moving(0, 0, 0, 0, 0).of(x), {}, x.channels(), options);
    check_equal(model.samples[0].C, (Matrix(1, 4) << 1, 0, 0, 0).finished(), 1e-9);
    CHECK(model.outputs[0].alias == "ArmAng");
}

TEST_CASE("state space: A is that of the linearised equations, its Fourier series holds between the samples",
          "[crosscheck]") {
    const SmallRotor rotor = heavy_rotor();
    PeriodicOptions periodic;
    periodic.rotor_speed = 8;
    periodic.harmonics = 24;
    const PeriodicSteadyState about = harmonic_balance(rotor.system, rotor.map.spin, periodic);
    REQUIRE(about.converged);
    StateSpaceOptions options;
    options.spin = RotorSpin::prescribed;
    options.azimuths = 40;
    const std::vector<LinearInput> inputs{
        LinearInput::moment("hub moment", rotor.map.hub, Vec3::UnitX(), WrenchAxes::base)};
    const auto groups = std::vector<ChannelGroup>{positions(rotor.system.model)};
    const LinearModel model = state_space(rotor.system, rotor.map, about, inputs, groups, options);
    CHECK(model.imbalance < 1e-6);
    const PeriodicSystem system = linearised(rotor.system, about);
    REQUIRE(2 * system.rows() == model.samples[0].A.rows());
    for (double psi : {0.0, 0.4321, 5.1}) {
        const StateMatrices found = evaluate(fourier_coefficients(model), psi);
        SecondOrderSystem own;
        system.at(psi / periodic.rotor_speed, own);
        const Eigen::Index n = system.rows();
        Matrix expected = Matrix::Zero(2 * n, 2 * n);
        expected.topRightCorner(n, n).setIdentity();
        expected.bottomLeftCorner(n, n) = -own.M.llt().solve(own.K);
        expected.bottomRightCorner(n, n) = -own.M.llt().solve(own.C);
        // What harmonics beyond 19 hold, sampled.
        CHECK((found.A - expected).norm() < 1e-7 * expected.norm());
    }
}

TEST_CASE(
    "state space: the multi-blade model of an isotropic rotor is constant and has the modes of Coleman's matrices",
    "[crosscheck]") {
    const SmallRotor rotor = small_rotor({.damping = 4, .hinges = BladeHinges::flap_and_lag, .elastic_support = true});
    const double Omega = 7;
    StateSpaceOptions options;
    options.spin = RotorSpin::prescribed;
    std::vector<LinearInput> inputs;
    for (std::size_t b = 0; b < 3; ++b)
        inputs.push_back(
            LinearInput::generalised_force(text("blade ", b + 1, " flap moment"), {{rotor.map.blades[b][0], 1.0}}));
    inputs.push_back(LinearInput::moment("nacelle moment", rotor.map.hub, Vec3::UnitX(), WrenchAxes::base));
    ChannelGroup blades;
    for (int b = 1; b <= 3; ++b) blades.channels.push_back({text("blade ", b, " flap angle"), "rad", "flap angle"});
    blades.sample = [map = rotor.map](const DynamicView& in, double* values) {
        for (const std::vector<int>& blade : map.blades) *values++ = in.q(blade[0]);
    };
    const LinearModel model = state_space(rotor.system, rotor.map, rotor.spinning(Omega), inputs, {blades}, options);
    const MultiBladeModel fixed = multi_blade(model, rotor.map);
    CHECK(fixed.A_remainder < 1e-12);
    CHECK(fixed.B_remainder < 1e-12);
    CHECK(fixed.C_remainder < 1e-9);
    REQUIRE(fixed.input_sets == std::vector<std::string>{"blade flap moment"});
    REQUIRE(fixed.output_sets == std::vector<std::string>{"blade flap angle"});
    CHECK(fixed.inputs[0].name == "blade flap moment (collective)");
    CHECK(fixed.inputs[2].name == "blade flap moment (sine 1)");
    CHECK(fixed.inputs[3].name == "nacelle moment");

    const ColemanTransform coleman(rotor.map, model.coordinates);
    const auto expected = modes(coleman.transform(rotor.rotating(Omega, 0.3), 0.3, Omega));
    std::vector<Complex> poles;
    for (const Complex& pole : fixed.poles())
        if (pole.imag() > 0) poles.push_back(pole);
    REQUIRE(poles.size() == expected.size());
    for (std::size_t i = 0; i < poles.size(); ++i)
        CHECK(std::abs(poles[i] - expected[i].eigenvalue) < 1e-9 * std::abs(poles[i]));

    // The output set is read off the states: collective, cosine, sine of the flap angles are states themselves.
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string pattern = fixed.outputs[i].name.substr(fixed.outputs[i].name.find('('));
        const std::size_t state = index_of(fixed.states, "flap 1 " + pattern);
        const auto row = static_cast<Eigen::Index>(i);
        CHECK(fixed.C(row, static_cast<Eigen::Index>(state)) == Approx(1));
        CHECK(fixed.C.row(row).norm() == Approx(1));
    }
    // A collective moment acts on the collective angle alone and on all blades alike.
    const Complex s(0.1, 2.3);
    const ComplexMatrix G = fixed.transfer(s);
    CHECK(std::abs(G(1, 0)) + std::abs(G(2, 0)) < 1e-12 * std::abs(G(0, 0)));
}

TEST_CASE("state space: bad input is refused with what is allowed", "[property]") {
    const SlidingMass x;
    const System system(x.tree, x.forces);
    const RotorMap map = no_rotor();
    const DynamicState at = moving(0, 0, 0, 0, 0).of(x);
    const auto refused = [&](const std::vector<LinearInput>& inputs, std::initializer_list<std::string> parts,
                             StateSpaceOptions options = {}) {
        check_refused([&] { (void)state_space(system, map, at, inputs, x.channels(), options); }, parts);
    };
    refused({LinearInput::generalised_force("a", {{9, 1.0}})}, {"'a'", "coordinate = 9", "0 ... 1"});
    refused({LinearInput::generalised_force("a", {})}, {"number of coordinates = 0"});
    refused({LinearInput::generalised_force("a", {{0, 0.0}})}, {"factor = 0"});
    refused({LinearInput::generalised_force("a", {{x.arm, 1.0}, {x.slider, 1.0}})},
            {"'a'", "unit of", "= m; allowed: rad"});
    refused({LinearInput::generalised_force("a", {{0, 1.0}, {0, -1.0}})}, {"'a'", "coordinate = arm", "each once"});
    refused({LinearInput::motion("a", {{-1, 1.0}})}, {"'a'", "= -1"});
    refused({LinearInput::force("a", FrameId{0}, Vec3::UnitX(), WrenchAxes::base)}, {"frame = 0", "of a body"});
    refused({LinearInput::force("a", x.mass_frame, Vec3::Zero(), WrenchAxes::base)}, {"direction", "not zero"});
    refused({LinearInput::generalised_force("a", {{0, 1.0}}), LinearInput::generalised_force("a", {{1, 1.0}})},
            {"'a'", "once"});
    refused({LinearInput::motion("a", {{x.arm, 1.0}}), LinearInput::acceleration("b", {{x.arm, 1.0}})},
            {"with and without states"});
    refused({LinearInput::motion("a", {{x.arm, 1.0}}), LinearInput::generalised_force("b", {{x.arm, 1.0}})},
            {"'b'", "= arm", "not driven"});
    refused({LinearInput::motion("a", {{x.arm, 1.0}, {x.slider, 1.0}})}, {"free coordinates = 0"});
    StateSpaceOptions wrong;
    wrong.outputs = {"nothing"};
    refused({}, {"'nothing'", "'rail force'"}, wrong);
    check_refused([&] { (void)state_space(system, map, DynamicState{}, {}, {}); }, {"operating point = 0"});
    check_refused([&] { (void)state_space(system, map, PeriodicSteadyState{}, {}, {}); }, {"not converged"});
    const LinearModel model = state_space(system, map, at, {}, x.channels());
    check_refused([&] { (void)fourier_coefficients(model, 1); }, {"harmonics = 1", "at most 0"});
    check_refused([&] { (void)at_sample(model, 1); }, {"= 1", "below 1"});
    check_refused([&] { (void)index_of(model.outputs, "x"); }, {"'x'", "'arm torque'"});
    check_refused([&] { (void)multi_blade(model, heavy_rotor().map); }, {"number of blades = 0"});
    // Gravity makes the multi-blade matrices periodic three times per revolution, which three or six azimuths hide.
    const SmallRotor rotor = heavy_rotor();
    StateSpaceOptions few;
    for (const int azimuths : {3, 6}) {
        few.azimuths = azimuths;
        const LinearModel hidden = state_space(rotor.system, rotor.map, rotor.spinning(8), {}, {}, few);
        check_refused([&] { (void)multi_blade(hidden, rotor.map); }, {text("azimuths = ", azimuths), "4, 9"});
    }
    few.azimuths = 9;
    const LinearModel seen = state_space(rotor.system, rotor.map, rotor.spinning(8), {}, {}, few);
    CHECK(multi_blade(seen, rotor.map).A_remainder > 1e-6);
}

}  // namespace cardan::testing::state_spaces
