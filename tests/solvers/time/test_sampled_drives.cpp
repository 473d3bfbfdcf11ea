// Driven coordinates that follow a sampled controller: where they are at any time, what their drives do, checkpoints.
#include "solvers/hdf5/history.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <functional>

namespace cardan::testing::sampled_drives {

namespace {

// A carriage without mass that follows its demand, 2 (place - 0.1), and on it a mass on a spring.
struct Carriage {
    double m = 3, k = 40, period = 0.05;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link carriage =
            add_joint(tree, {.name = "carriage", .kind = JointKind::prismatic, .role = CoordinateRole::prescribed});
        const Link mass = add_joint(tree, {.name = "mass",
                                           .inboard = carriage.axes,
                                           .kind = JointKind::prismatic,
                                           .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("spring", mass.body, k, 0);
        forces.add_input({.name = "place", .unit = "m", .scale = 1, .initial = 0.1});
        return {tree, forces};
    }
    SampledController controller(std::function<double(double time)> demand) const {
        SampledController all{.name = "places", .inputs = {"place"}, .period = period};
        all.drives = {{0, "place", 2, 0.1}};
        all.update = [demand = std::move(demand)](long /*sample*/, const DynamicView& in, VectorOut u) {
            u(0) = 0.1 + demand(in.time) / 2;
        };
        return all;
    }
    IntegrationOptions options(std::function<double(double time)> demand, Method method = Method::dirk) const {
        IntegrationOptions all = equal_tolerances(method, method == Method::generalised_alpha ? 1e-8 : 1e-10);
        all.controllers = {controller(std::move(demand))};
        return all;
    }
};

}  // namespace

TEST_CASE("sampled drives: a step of the demand is reached after two periods, by two parabolas without overshoot",
          "[solvers][integrate][analytic]") {
    const Carriage carriage;
    const System system = carriage.system();
    const double T = carriage.period, from = 4 * T;
    const auto step = [&](double time) { return time > from - T / 2 ? 0.3 : 0.0; };
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator run(system, {}, 0, vector({0, 0}), vector({0, 0}), carriage.options(step, method));
        for (int i = 0; i <= 64; ++i) {
            const double time = T * i / 8, x = std::clamp((time - from) / T, 0.0, 2.0);
            REQUIRE(run.advance(time).reached());
            const double exact = x < 1 ? x * x / 2 : 1 - (2 - x) * (2 - x) / 2;
            CAPTURE(time);
            CHECK(run.state().q(0) == Approx(0.3 * exact).margin(1e-14));
            CHECK(run.state().qd(0) == Approx(0.3 / T * (x < 1 ? x : 2 - x)).margin(1e-12));
        }
    }
}

TEST_CASE("sampled drives: of a harmonic demand the amplitude is sinc^3 and the delay three halves of a period",
          "[solvers][integrate][analytic]") {
    // Twelve samples a turn, and forty: fundamental by Simpson's rule over whole turns; the averages of a held demand
    // over one period, twice, have the frequency response sinc^2, and to hold it is one more.
    const Carriage carriage;
    const System system = carriage.system();
    for (const int samples : {12, 40}) {
        const double turn = samples * carriage.period, w = 2 * pi / turn;
        Integrator run(system, {}, 0, vector({0, 0}), vector({0, 0}),
                       carriage.options([w](double time) { return 0.2 * std::sin(w * time); }));
        const int n = 16 * samples;
        Complex sum = 0;
        for (int i = 0; i <= 2 * n; ++i) {
            const double time = turn * i / n;
            REQUIRE(run.advance(time).reached());
            if (i < n) continue;
            const double weight = (i == n || i == 2 * n ? 1 : i % 2 == 1 ? 4 : 2) / 3.0;
            sum += weight * run.state().q(0) * std::exp(Complex(0, -w * time));
        }
        const Complex found = sum * Complex(0, 2.0) / double(n) / 0.2;  // relative to sin
        const double x = w * carriage.period / 2;
        CHECK(std::abs(found) == Approx(std::pow(std::sin(x) / x, 3)).epsilon(1e-5));
        CHECK(std::arg(found) == Approx(-1.5 * w * carriage.period).epsilon(1e-5));
    }
}

TEST_CASE("sampled drives: what is carried feels the acceleration, and what the drive does is in the balance",
          "[solvers][integrate][analytic]") {
    const Carriage carriage;
    const System system = carriage.system();
    const double T = carriage.period, w = std::sqrt(carriage.k / carriage.m);
    const auto demand = [](double time) { return 0.1 * std::sin(7 * time) + (time > 0.4 ? 0.05 : 0); };
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator run(system, {}, 0, vector({0, 0}), vector({0, 0}), carriage.options(demand, method));
        REQUIRE(run.advance(1.02).reached());
        // m x'' = -k x - m a with a constant within a period.
        double x = 0, v = 0, earlier = 0, last = 0, a = 0;
        for (int k = 0; k <= 20; ++k) {
            const double now = demand(k * T), span = k == 20 ? 0.02 : T;
            a = (now - 2 * last + earlier) / (T * T);
            earlier = last, last = now;
            const double rest = -a / (w * w), c = std::cos(w * span), s = std::sin(w * span), dx = x - rest;
            x = rest + dx * c + v / w * s;
            v = v * c - dx * w * s;
        }
        const DynamicState& at = run.state();
        const double good = method == Method::generalised_alpha ? 2e-5 : 1e-7;
        CHECK(at.q(1) == Approx(x).margin(good));
        CHECK(at.qd(1) == Approx(v).margin(10 * good));
        CHECK(at.actuator(0) == Approx(-carriage.k * at.q(1)).margin(1e-9));
        const EnergyBalance energy = run.energy();
        const double rate = at.qd(0) + v;
        CHECK(energy.drives == Approx(carriage.m * rate * rate / 2 + carriage.k * x * x / 2).epsilon(1e3 * good));
        CHECK(std::abs(energy.error) < 1e3 * good * energy.drives);
    }
}

TEST_CASE("sampled drives: a run goes on from a checkpoint between and at samples, from a file as well",
          "[solvers][integrate][property]") {
    const Carriage carriage;
    const System system = carriage.system();
    const auto options = carriage.options([](double time) { return 0.1 * std::sin(7 * time); });
    for (const double pause : {0.0, 0.5, 0.51}) {
        CAPTURE(pause);
        Integrator whole(system, {}, 0, vector({0, 0}), vector({0, 0}), options);
        const test::Folder folder;
        Recorder recorder(whole);
        {
            HistoryWriter writer = HistoryWriter::create(folder / "run.h5", recorder.channels(), {}, {});
            writer.take_checkpoints([&] { return whole.checkpoint(); });
            REQUIRE(record(whole, recorder, sample_times(0, pause, pause == 0 ? 1 : pause / 2), writer).reached());
            writer.finish();
        }
        const Checkpoint here = whole.checkpoint();
        const std::optional<Checkpoint> read = read_checkpoint(folder / "run.h5");
        REQUIRE(read);
        REQUIRE(whole.advance(1).reached());
        for (const Checkpoint& from : {here, *read}) {
            Integrator part(system, {}, from, options);
            REQUIRE(part.advance(1).reached());
            CHECK(part.state().q == whole.state().q);
            CHECK(part.state().qd == whole.state().qd);
            CHECK(part.energy().drives == whole.energy().drives);
        }
    }
}

TEST_CASE("sampled drives: a delayed controller, a start elsewhere, and what cannot be",
          "[solvers][integrate][property]") {
    const Carriage carriage;
    const System system = carriage.system();
    IntegrationOptions late = carriage.options([](double) { return 0.3; });
    late.controllers[0].delayed = true;
    Integrator delayed(system, {}, 0, vector({0, 0}), vector({0, 0}), late);
    REQUIRE(delayed.advance(carriage.period).reached());
    CHECK(delayed.state().q(0) == 0);
    REQUIRE(delayed.advance(2 * carriage.period).reached());
    CHECK(delayed.state().q(0) == Approx(0.15).epsilon(1e-12));

    Integrator elsewhere(system, {}, 0, vector({0.2, 0}), vector({0, 0}), carriage.options([](double) { return 0.3; }));
    REQUIRE(elsewhere.advance(carriage.period).reached());
    CHECK(elsewhere.state().q(0) == Approx(0.25).epsilon(1e-12));

    const auto refused = [&](std::vector<InputDrive> drives, std::initializer_list<std::string> parts) {
        check_refused(
            [&] {
                IntegrationOptions options = carriage.options([](double) { return 0; });
                options.controllers[0].drives = std::move(drives);
                Integrator(system, {}, 0, vector({0, 0}), vector({0, 0}), options);
            },
            parts);
    };
    refused({{2, "place"}}, {"controller 'places': coordinate that follows", "index = 2", "0 ... 1"});
    refused({{0, "place"}, {0, "place"}}, {"index = 0", "one that no other drive has"});
    refused({{0, "plaice"}}, {"'plaice'", "one that the controller sets"});
    refused({{0, "place", NAN}}, {"factor and zero = nan", "finite"});
}

}  // namespace cardan::testing::sampled_drives
