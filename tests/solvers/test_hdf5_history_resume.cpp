// Integrations that are recorded into files, broken off and resumed.
#include "mbs/error.hpp"
#include "solvers/hdf5_history.hpp"
#include "tests/solvers/history_rows.hpp"
#include "tests/solvers/write_hook.hpp"
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
    forces.set_gravity({0, 0, -9.81});
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
        CHECK(integrator.statistics().restarts >= 1);
    }
};

/// The rows at some times.
History at(const std::vector<double>& times, const History& all) {
    History some{all.title, all.channels, {}, std::vector<std::vector<double>>(all.values.size())};
    for (std::size_t row = 0; row < all.time.size(); ++row) {
        if (!std::ranges::binary_search(times, all.time[row])) continue;
        some.time.push_back(all.time[row]);
        for (std::size_t c = 0; c < all.values.size(); ++c) some.values[c].push_back(all.values[c][row]);
    }
    return some;
}

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
    CHECK(resumed.time.size() == run.times.size() + 1);  // with the moment at which it was broken off
    const double worst = difference(run.uninterrupted(), at(run.times, resumed));
    CAPTURE(worst);
    CHECK(worst < 1e-6);
    CHECK(worst > 0);  // the method started anew
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
    const double worst = difference(run.uninterrupted(), read_history(path));
    CAPTURE(worst);
    CHECK(worst < 1e-6);
}

TEST_CASE("history: a run that was finished is prolonged", "[property]") {
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
    CHECK(difference(run.uninterrupted(), read_history(path)) < 1e-6);
}

TEST_CASE("history: an exception out of a user's function costs no rows") {
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
    CHECK(difference(run.uninterrupted(), read_history(path)) < 1e-6);
}

TEST_CASE("history: a recorder with other channels than the file is refused") {
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
