// Integrations that are recorded into files, broken off and resumed.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/solvers/hdf5/write_hook.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::test;
using namespace cardan::testing;
using Catch::Matchers::Contains;

namespace {

// Three pendulums, one on the other, with a little damping.
System chain() {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    for (int i = 0; i < 3; ++i) {
        const Link link = add_joint(tree, {.name = text("hinge ", i + 1),
                                           .inboard = at,
                                           .axis = i == 1 ? Vec3::UnitX() : Vec3::UnitY(),
                                           .inertia = {2.0, Vec3(0, 0, -0.5), Mat3(Vec3(0.1, 0.2, 0.1).asDiagonal())}});
        at = tree.add_frame(link.axes, Placement::translation({0, 0, -1}), text("end ", i + 1));
        forces.add_spring(text("spring ", i + 1), link.body, 5, 0.3);
    }
    forces.set_gravity({0, 0, -units::standard_gravity});
    return {tree, forces};
}

IntegrationOptions accurate() {
    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-11, 1e-11};
    return options;
}

constexpr RecorderOptions recorded{.accelerations = true, .statistics = false};

struct Run {
    System system = chain();
    std::vector<double> times = sample_times(0, 3, 0.01);
    Integrator fresh() { return {system, {}, 0, Vector(Vec3(0.8, 0.4, -0.6)), Vector::Zero(3), accurate()}; }

    History uninterrupted() {
        Integrator integrator = fresh();
        Recorder recorder(integrator, {}, recorded);
        History history;
        CHECK(record(integrator, recorder, times, history).reached());
        return history;
    }
    void begin(const std::string& path, const std::function<bool()>& cancelled) {
        IntegrationOptions options = accurate();
        options.cancelled = cancelled;
        Integrator integrator(system, {}, 0, Vector(Vec3(0.8, 0.4, -0.6)), Vector::Zero(3), options);
        Recorder recorder(integrator, {}, recorded);
        HistoryWriter file = HistoryWriter::create(path, recorder.channels(), {.title = "chain"}, {.chunk = 32});
        (void)record(integrator, recorder, times, file);
    }
    void resume(const std::string& path) {
        const std::optional<Checkpoint> from = read_checkpoint(path);
        REQUIRE(from);
        Integrator integrator(system, {}, *from, accurate());
        Recorder recorder(integrator, {}, recorded);
        HistoryWriter file = HistoryWriter::append_to(path, recorder.channels());
        CHECK(file.last_time() <= from->time);
        CHECK(record(integrator, recorder, times, file).reached());
        file.finish();
    }
};

/// Largest difference of all channels, each over its largest magnitude; that of energies over the largest of all.
double difference(const History& a, const History& b) {
    REQUIRE(a.time == b.time);
    REQUIRE(a.values.size() == b.values.size());
    double worst = 0, energy = 0;
    const auto largest = [](const std::vector<double>& v) {
        return Eigen::Map<const Vector>(v.data(), std::ssize(v)).lpNorm<Eigen::Infinity>();
    };
    for (std::size_t c = 0; c < a.values.size(); ++c)
        if (a.channels[c].units == "J") energy = std::max(energy, largest(a.values[c]));
    for (std::size_t c = 0; c < a.values.size(); ++c) {
        const double scale = a.channels[c].units == "J" ? energy : std::max(1e-3, largest(a.values[c]));
        for (std::size_t row = 0; row < a.time.size(); ++row)
            worst = std::max(worst, std::abs(a.values[c][row] - b.values[c][row]) / scale);
    }
    return worst;
}

}  // namespace

TEST_CASE("history: a run that was broken off and resumed equals the uninterrupted one", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    Run run;
    int steps = 0;
    run.begin(path, [&] { return ++steps > 250; });
    const HistoryInfo broken = read_history_info(path);
    CHECK_FALSE(broken.finished);
    CHECK(broken.rows > 32);
    CHECK(broken.rows < 250);
    CHECK(broken.checkpoint_rows == broken.rows);
    run.resume(path);
    const HistoryInfo info = read_history_info(path);
    CHECK(info.finished);
    CHECK(info.statistics->steps > broken.statistics->steps);
    CHECK(info.checkpoint->time == 3);
    const History resumed = read_history(path);
    CHECK(resumed.time.size() == run.times.size());
    CHECK(difference(run.uninterrupted(), resumed) == 0);
}

TEST_CASE("history: resumed with a one-step method it is the uninterrupted run bit for bit, counters included",
          "[property]") {
    const Folder folder;
    const System system = chain();
    const std::vector<double> times = sample_times(0, 6, 0.02);
    const Vector q = Vec3(0.8, 0.4, -0.6), zero = Vector::Zero(3);
    for (Method method : {Method::dirk, Method::erk, Method::generalised_alpha, Method::bdf}) {
        IntegrationOptions options;
        options.method = method;
        options.tolerances = {1e-7, 1e-9, 1e-9, 1e-8, 1e-8};
        // The swing that comes back is pushed: the method starts anew there, before or after the interruption.
        options.events = {{.name = "back",
                           .function = [](const StateView& at) { return at.qd(0) - 0.2; },
                           .action = [](Integrator&) { return AfterEvent::restart; }}};
        History whole;
        Integrator uninterrupted(system, {}, 0, q, zero, options);
        Recorder recorder(uninterrupted);
        REQUIRE(record(uninterrupted, recorder, times, whole).reached());
        const std::string path = folder / text("run", static_cast<int>(method), ".h5");
        const long half = uninterrupted.statistics().steps / 2;
        for (int part = 0; part < 3; ++part) {
            IntegrationOptions broken = options;
            long asked = 0;
            if (part < 2) broken.cancelled = [&] { return ++asked > half * 4 / 5; };
            std::optional<Checkpoint> from;
            if (part > 0) from = read_checkpoint(path);
            Integrator integrator =
                from ? Integrator(system, {}, *from, broken) : Integrator(system, {}, 0, q, zero, broken);
            Recorder rows(integrator);
            HistoryWriter file = from ? HistoryWriter::append_to(path, rows.channels())
                                      : HistoryWriter::create(path, rows.channels(), {}, {.chunk = 16});
            CHECK(record(integrator, rows, times, file).reached() == (part == 2));
        }
        const History resumed = read_history(path);
        CAPTURE(static_cast<int>(method), uninterrupted.statistics().steps, uninterrupted.statistics().restarts);
        CHECK(uninterrupted.statistics().restarts > 2);
        REQUIRE(resumed.time == whole.time);
        if (method == Method::bdf)
            CHECK(resumed.values != whole.values);  // it started anew
        else
            CHECK(resumed.values == whole.values);
    }
}

TEST_CASE("history: a run whose process is killed is resumed by another one", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    Run run;
    const pid_t child = ::fork();
    if (child == 0) {
        int steps = 0;
        run.begin(path, [&] {
            if (++steps > 400) ::kill(::getpid(), SIGKILL);
            return false;
        });
        ::_exit(0);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    CHECK(WIFSIGNALED(status));
    const HistoryInfo broken = read_history_info(path);
    CHECK(broken.rows % 32 == 0);
    CHECK(broken.rows > 0);
    run.resume(path);
    CHECK(difference(run.uninterrupted(), read_history(path)) == 0);
}

TEST_CASE("history: a finished run is extended", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    Run run;
    const std::vector<double> all = run.times;
    run.times.resize(101);
    {
        Integrator integrator = run.fresh();
        Recorder recorder(integrator, {}, recorded);
        HistoryWriter file = HistoryWriter::create(path, recorder.channels());
        CHECK(record(integrator, recorder, run.times, file).reached());
        file.finish();
    }
    CHECK(read_history_info(path).finished);
    run.times = all;
    run.resume(path);
    CHECK(difference(run.uninterrupted(), read_history(path)) == 0);
}

TEST_CASE("history: an exception out of a user's function costs no rows", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    Run run;
    int steps = 0;
    const auto broken = [&] {
        if (++steps > 250) throw std::runtime_error("of the user");
        return false;
    };
    CHECK_THROWS_WITH(run.begin(path, broken), "of the user");
    CHECK(read_history_info(path).rows > 32);
    CHECK(read_history_info(path).rows > read_history_info(path).checkpoint_rows);
    run.resume(path);
    CHECK(difference(run.uninterrupted(), read_history(path)) == 0);
}

TEST_CASE("history: a recorder with other channels than the file is refused", "[property]") {
    const Folder folder;
    Run run;
    Integrator integrator = run.fresh();
    Recorder recorder(integrator, {}, recorded), other(integrator);
    HistoryWriter file = HistoryWriter::create(folder / "a.h5", other.channels());
    CHECK_THROWS_WITH(record(integrator, recorder, run.times, file), Contains("channels to record = channel 7 is "));
}

// Run by name only, lest two programs write the files at the same time.
TEST_CASE("history: files for the program history", "[.files][slow]") {
    const std::string folder = CARDAN_TEST_OUTPUT_DIR "/";
    Run run;
    {
        Integrator integrator = run.fresh();
        Recorder recorder(integrator, {}, recorded);
        HistoryWriter file = HistoryWriter::create(folder + "history_finished.h5", recorder.channels(),
                                                   {"chain", "BDF", "three pendulums"}, {.replace = true});
        CHECK(record(integrator, recorder, run.times, file).reached());
        file.finish();
    }
    const std::string path = folder + "history_whole.h5", broken = folder + "history_broken.h5";
    HistoryWriter file = HistoryWriter::create(path, some_channels(), {}, {.replace = true, .chunk = 8});
    append_rows(file, 0, 15);
    bool found = false;
    const WriteHook hook([&](const WriteCall&) {
        if (found) return 0;
        std::filesystem::copy_file(path, broken, std::filesystem::copy_options::overwrite_existing);
        const HistoryInfo info = read_history_info(broken);
        found = info.needs_repair && info.rows == 16;
        return 0;
    });
    append_rows(file, 15, 16);
    CHECK(found);
}
