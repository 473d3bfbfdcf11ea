// Arguments of the solvers that do not fit, are not finite or belong to another system.
#include "solvers/algebra/dense.hpp"
#include "solvers/algebra/fft.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "solvers/equilibrium/load_stability.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/periodic/forced_response.hpp"
#include "solvers/periodic/periodic_system.hpp"
#include "solvers/time/integrate.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/doors.hpp"
#include "tests/support/numbers.hpp"

#include <functional>
#include <limits>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

TEST_CASE("sizes: vectors and matrices that do not fit are refused by the solvers", "[property][solvers]") {
    const SmallRotor rotor = small_rotor();
    const System& system = rotor.system;
    const int n = system.model.size();
    const Linearisation lin = linearise(system, rotor.spinning(2));
    SecondOrderSystem good = restrict_to(lin, rotor.unknowns());
    const std::vector<Mode> found = modes(good);
    ModeSolver solver(good.M.rows());
    REQUIRE(solver.solve(good) == found.size());
    const ColemanTransform coleman(rotor.map, rotor.unknowns());
    for (const int size : {0, 1, n - 2, n + 1, 50 * n}) {
        DynamicState q = rotor.spinning(2), qd = q, qdd = q;
        q.q.setZero(size);
        qd.qd.setZero(size);
        qdd.qdd.setZero(size);
        const Vector vector = Vector::Zero(size);
        Linearisation cut = lin;
        cut.gravity.setZero(size, n);
        SecondOrderSystem other = good;
        other.K.setZero(size, size);
        Mode mode = found[0];
        mode.shape.setZero(size);
        Vector b = vector;
        LuFactors factors(n);
        RealFourier fourier(16);
        std::vector<double> samples(static_cast<std::size_t>(size));
        std::vector<Complex> lines(9);
        Matrix A = Matrix::Identity(n, n), B(size, 2);
        check_all_refused({{"position", [&] { linearise(system, q); }},
                           {"rate", [&] { linearise(system, qd); }},
                           {"acceleration", [&] { linearise(system, qdd); }},
                           {"restriction", [&] { restrict_to(cut, {0}); }},
                           {"modes", [&] { modes(other); }},
                           {"transformation", [&] { coleman.transform(other, 0.1, 2); }},
                           {"energy of a mode", [&] { energy_by_row(good, mode); }},
                           {"energies of modes", [&] { energy_product(good, found[0], mode); }},
                           {"solution", [&] { factors.solve(b); }},
                           {"solution in place", [&] { solve_in_place(A, B); }},
                           {"Fourier transform", [&] { fourier.transform(samples, lines); }}},
                          text(" = ", size));
        if (size > 0)
            check_all_refused(
                {{"start", [&] { static_cast<void>(steady_state(system, rotor.map.spin, {.initial = vector})); }},
                 {"buckling", [&] { static_cast<void>(linear_buckling(system, {.at = vector})); }},
                 {"integrator", [&] { Integrator(system, {}, 0, vector, Vector::Zero(n)); }},
                 {"rates", [&] { Integrator(system, {}, 0, Vector::Zero(n), vector); }}},
                text(" = ", size));
    }
    for (const int bad : {-1, n, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
        check_all_refused({{"restriction",
                            [&] {
                                restrict_to(lin, {0, bad});
                            }},
                           {"drive",
                            [&] {
                                Integrator(system, {{bad, Motion::constant(0)}}, 0, Vector::Zero(n), Vector::Zero(n));
                            }}},
                          text(" = ", bad));
    Mode out;
    Vector shares;
    check_refused([&] { solver.copy(found.size(), out); }, {"modes", "mode ="});
    check_refused([&] { solver.energy_by_row(found.size(), shares); }, {"modes", "mode ="});
}

TEST_CASE("sizes: a rotor map of another machine is refused", "[property][solvers]") {
    const SmallRotor rotor = small_rotor();
    const int n = rotor.system.model.size();
    const std::vector<double> speeds{0, 1};
    const auto refused = [&](const char* what, const std::function<void(RotorMap&)>& change) {
        RotorMap map = rotor.map;
        change(map);
        CAPTURE(what);
        check_refused([&] { static_cast<void>(campbell(rotor.system, map, speeds)); }, {text(" = ", n + 40), what});
    };
    refused("coordinate of a blade", [&](RotorMap& map) { map.blades[1].back() = n + 40; });
    refused("spin", [&](RotorMap& map) { map.spin = n + 40; });
    refused("rotating pair", [&](RotorMap& map) { map.rotating_pairs = {{0, n + 40, 1}}; });
    refused("frame", [&](RotorMap& map) { map.hub = FrameId{n + 40}; });
    refused("frame", [&](RotorMap& map) { map.parts[0].axes = FrameId{n + 40}; });
    refused("frame", [&](RotorMap& map) { map.lines[0].points.push_back(FrameId{n + 40}); });
}

TEST_CASE("recorder: an integrator of another system or with other drives is refused", "[property][solvers]") {
    const SmallRotor rotor = small_rotor(), other = small_rotor();
    const Vector zero = Vector::Zero(rotor.system.model.size());
    Integrator driven(rotor.system, {{rotor.map.spin, Motion::constant(0)}}, 0, zero, zero),
        free(rotor.system, {}, 0, zero, zero), elsewhere(other.system, {}, 0, zero, zero);
    Recorder recorder(driven), of_free(free);
    std::vector<double> values(recorder.channels().size());
    check_refused([&] { recorder.sample(elsewhere, values.data()); }, {"recorder", "another model"});
    check_refused([&] { recorder.sample(free, values.data()); }, {"recorder", "= spin", "driven"});
    History history;
    check_refused([&] { static_cast<void>(record(elsewhere, of_free, {0.1}, history)); }, {"another model"});
    CHECK(history.time.empty());
}

TEST_CASE("bad input: values that are not finite, invalid tolerances, empty functions", "[property][solvers]") {
    const SmallRotor rotor = small_rotor();
    const System& system = rotor.system;
    for (const double bad : {not_a_number, infinite, -infinite}) {
        for (Vector DynamicState::*part :
             std::initializer_list<Vector DynamicState::*>{&DynamicState::q, &DynamicState::qd, &DynamicState::qdd}) {
            DynamicState at = rotor.spinning(2);
            (at.*part)(2) = bad;
            check_refused([&] { linearise(system, at); },
                          {"linearisation", system.model.coordinates()[2].name, text("= ", bad), "finite"});
        }
        DynamicState late = rotor.spinning(2);
        late.time = bad;
        check_refused([&] { linearise(system, late); }, {"time [s]", text(bad)});
        Vector start = Vector::Zero(system.model.size());
        start(1) = bad;
        check_all_refused(
            {{"tolerance", [&] { static_cast<void>(steady_state(system, rotor.map.spin, {.tolerance = bad})); }},
             {"start", [&] { static_cast<void>(steady_state(system, rotor.map.spin, {.initial = start})); }},
             {"speed", [&] { static_cast<void>(steady_state(system, rotor.map.spin, {.rotor_speed = bad})); }},
             {"load stability from", [&] { static_cast<void>(load_stability(system, {.from = bad})); }},
             {"load stability tolerance", [&] { static_cast<void>(load_stability(system, {.tolerance = bad})); }},
             {"load stability growth", [&] { static_cast<void>(load_stability(system, {.growth = bad})); }},
             {"load path",
              [&] {
                  static_cast<void>(equilibrium_path(system, {.factors = {0, bad}}));
              }},
             {"harmonic motion", [&] { Motion::harmonic(0, 1, bad); }},
             {"samples", [&] { sample_times(bad, 1, 0.1); }}},
            text(bad));
    }
    check_refused([&] { static_cast<void>(steady_state(system, rotor.map.spin, {.iterations = 0})); },
                  {"iterations = 0"});
    check_refused([] { PeriodicSystem::second_order(1, 2, {}); }, {"M, C and K", "empty"});
    check_refused([] { PeriodicSystem::first_order(1, 2, {}); }, {"E and A", "empty"});
    const PeriodicSystem constant = PeriodicSystem::second_order(1, 1, [](double, SecondOrderSystem& out) {
        out.M = out.K = Matrix::Identity(1, 1);
        out.C = Matrix::Zero(1, 1);
    });
    check_refused([&] { forced_response(constant, {}, 2); }, {"forced response", "empty"});
}

TEST_CASE("bad input: a harmonic motion whose accelerations are not finite names its period", "[property][solvers]") {
    check_refused([] { Motion::harmonic(0, 0.1, 1e-320); }, {"harmonic motion", "period [s] = 9.99", "e-321"});
    check_refused([] { Motion::harmonic(0, 1e200, 1e-100); }, {"period [s] = 1e-100"});
    CHECK(refusal([] { Motion::harmonic(0, 0.1, 1e-6); }) == "(accepted)");
}

TEST_CASE("bad input: a checkpoint with a number that is not finite", "[property][solvers]") {
    const SmallRotor rotor = small_rotor();
    const Vector zero = Vector::Zero(rotor.system.model.size());
    Integrator integrator(rotor.system, {}, 0, zero, zero);
    const Checkpoint good = integrator.checkpoint();
    const auto refused = [&](const char* what, const std::function<void(Checkpoint&)>& change) {
        Checkpoint bad = good;
        change(bad);
        check_refused([&] { Integrator(rotor.system, {}, bad); }, {what, "nan", "finite"});
    };
    refused("time", [](Checkpoint& c) { c.time = not_a_number; });
    refused("flap 2", [](Checkpoint& c) { c.q(2) = not_a_number; });
    refused("flap 3", [](Checkpoint& c) { c.qd(3) = not_a_number; });
    refused("kinetic energy", [](Checkpoint& c) { c.kinetic_at_start = not_a_number; });
    refused("dissipated energy", [](Checkpoint& c) { c.work.dissipation = not_a_number; });
    refused("'brake'", [](Checkpoint& c) { c.notes["brake"] = not_a_number; });
    CHECK(refusal([&] { Integrator(rotor.system, {}, good); }) == "(accepted)");
}

TEST_CASE("Campbell diagram: a spring meant to be rigid is named, and its rounding is no growth",
          "[property][solvers]") {
    SmallRotorSpec spec;
    spec.stiffness = {2000, 2000, 2000};
    spec.elastic_support = true;
    SmallRotor rotor = small_rotor(spec);
    const std::vector<double> speeds{0, 3};
    const Campbell soft = campbell(rotor.system, rotor.map, speeds);
    CHECK(soft.warning.empty());
    // This machine with a rigid yaw spring added.
    spec.rigid_yaw = 1e30;
    rotor = small_rotor(spec);
    const Campbell rigid = campbell(rotor.system, rotor.map, speeds);
    CAPTURE(rigid.warning);
    CHECK(rigid.warning.find("'rigid yaw' (1e+30 on the coordinate 'yaw')") != std::string::npos);
    CHECK(rigid.warning.find("rounding") != std::string::npos);
    CHECK(rigid.warning.find("unstable") == std::string::npos);
    // Undamped modes of the hinges do not grow by more than rounding of their own frequency.
    for (const CampbellPoint& point : rigid.points) CHECK(point.stability_margin > -1e-6);
}

TEST_CASE("Campbell diagram: more unknowns than can be handled are refused with the reason", "[property][solvers]") {
    Tree tree;
    FrameId at = Tree::base();
    ForceSet forces;
    for (int k = 0; k < 1600; ++k) {
        const BodyId body =
            tree.add_body({.name = text("link ", k), .inboard = at, .inertia = {1, Vec3(1, 0, 0), Mat3::Identity()}});
        forces.add_spring(text("spring ", k), body, 1e3);
        at = tree.frame_of(body);
    }
    const System chain(tree, forces);
    RotorMap map;
    map.machine = "long chain";
    check_refused([&] { static_cast<void>(campbell(chain, map, std::vector<double>{0})); },
                  {"long chain", "number of unknowns = 1600", "<= 1500", "fewer elements per part"});
}
