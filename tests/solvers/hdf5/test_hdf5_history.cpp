#include "mbs/base/error.hpp"
#include "mbs/base/version.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <cstdlib>
#include <thread>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::test;
using Catch::Matchers::Contains;

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::vector<Channel> rotor_channels() {
    return {{"rotor speed", "rad s-1", "speed of the rotor", "", "hub", "RotSpeed"},
            {"blade 1/root: M_y", "N m", "bending moment", "blade 1 root", "blade root", "RootMyb1"},
            {"kinetic energy", "J", "kinetic energy"}};
}

/// Names of the variables of a file, in their order.
std::vector<std::string> variables_of(const std::string& path) {
    std::vector<std::string> names = Hdf5File::open(path).children();
    std::erase(names, "run");
    std::erase(names, "time");
    return names;
}

bool has_program(const char* name) {
    return std::system(text("command -v ", name, " >/dev/null 2>&1").c_str()) == 0;
}

std::string output_of(const std::string& command, const std::string& file) {
    REQUIRE(std::system((command + " >" + file + " 2>&1").c_str()) == 0);
    return bytes_of(file);
}

}  // namespace

TEST_CASE("history: what was appended is read back", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    for (const std::size_t rows : {0, 1, 15, 16, 17, 100}) {
        CAPTURE(rows);
        write_rows(path, rows, {.replace = true, .chunk = 16});
        const History history = read_history(path);
        CHECK(history.title == "gust");
        CHECK(history.channels.size() == 3);
        CHECK(history.time.size() == rows);
        CHECK(wrong_values(history) == 0);
        const HistoryInfo info = read_history_info(path);
        CHECK(info.rows == rows);
        CHECK(same(info.first_time, rows > 0 ? 0 : no_value));
        CHECK(same(info.last_time, rows > 0 ? time_of(rows - 1) : no_value));
        CHECK(info.finished);
        CHECK_FALSE(info.being_written);
        CHECK_FALSE(info.needs_repair);
        CHECK_FALSE(info.checkpoint);
        CHECK_FALSE(info.statistics);
        CHECK(folder.files() == 1);
    }
}

TEST_CASE("history: no channels, or infinite values, are allowed", "[property]") {
    const Folder folder;
    HistoryWriter only_time = HistoryWriter::create(folder / "a.h5", {});
    only_time.append(-1, {});
    only_time.finish();
    CHECK(read_history(folder / "a.h5").time == std::vector<double>{-1});
    HistoryWriter writer = HistoryWriter::create(folder / "b.h5", some_channels(1));
    const double infinity = std::numeric_limits<double>::infinity();
    writer.append(0, std::vector<double>{infinity});
    writer.finish();
    CHECK(read_history(folder / "b.h5").values.front() == std::vector<double>{infinity});
}

TEST_CASE("history: a file says what it holds", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    HistoryWriter writer = HistoryWriter::create(path, rotor_channels(), about, {.chunk = 2});
    CHECK(writer.path() == path);
    for (int row = 0; row < 3; ++row) writer.append(row, std::vector<double>{1, 2, 3});
    IntegrationStatistics statistics;
    statistics.steps = 12;
    statistics.restarts = 2;
    statistics.order = 5;
    statistics.last_step = 0.25;
    writer.finish(statistics);
    const HistoryInfo info = read_history_info(path);
    CHECK(info.about.title == about.title);
    CHECK(info.about.method == about.method);
    CHECK(info.about.description == about.description);
    CHECK(info.about.program == "test");
    CHECK(info.version == version());
    REQUIRE(info.statistics);
    CHECK(info.statistics->steps == 12);
    CHECK(info.statistics->restarts == 2);
    CHECK(info.statistics->order == 5);
    CHECK(info.statistics->last_step == 0.25);
    CHECK(info.channels.at(1).name == "blade 1/root: M_y");
    CHECK(info.channels.at(1).units == "N m");
    CHECK(info.channels.at(1).long_name == "bending moment");
    CHECK(info.channels.at(1).frame == "blade 1 root");
    CHECK(info.channels.at(1).point == "blade root");
    CHECK(info.channels.at(1).alias == "RootMyb1");

    const Hdf5File file = Hdf5File::open(path);
    CHECK(file.children() ==
          std::vector<std::string>{"run", "time", "rotor speed", "blade 1_root: M_y", "kinetic energy"});
    CHECK(file.string_attribute("/", "Conventions") == "CF-1.8");
    CHECK(file.int_attribute("/", "finished") == 1);
    CHECK(file.string_attribute("time", "units") == "s");
    CHECK(file.string_attribute("time", "CLASS") == "DIMENSION_SCALE");
    CHECK(file.dimension("blade 1_root: M_y", 0) == "/time");
    CHECK(file.string_attribute("blade 1_root: M_y", "channel") == "blade 1/root: M_y");
    CHECK(file.string_attribute("rotor speed", "point") == "hub");
    CHECK(file.string_attribute("rotor speed", "frame") == "none");
    CHECK(info.channels.at(0).frame.empty());
    CHECK(file.read_strings("run/input_description").front() == about.description);
    CHECK(file.string_attribute("run/statistics/last_step", "units") == "s");
}

TEST_CASE("history: names of channels become names of variables", "[property]") {
    const Folder folder;
    const std::string umlaut = "\xC3\xA4";
    std::string longest(199, 'a');
    std::vector<Channel> channels;
    for (const std::string& name : {std::string("a/b"), std::string("a_b"), std::string("time"), std::string("run"),
                                    std::string("."), std::string("-x "), std::string("tab\there"), umlaut,
                                    longest + umlaut + "a", longest + umlaut + "b", std::string("a\\b, \"c\" [d]")})
        channels.push_back({.name = name, .units = "1", .long_name = "x"});
    HistoryWriter writer = HistoryWriter::create(folder / "a.h5", channels);
    writer.append(0, std::vector<double>(channels.size(), 1));
    writer.finish();
    CHECK(variables_of(folder / "a.h5") == std::vector<std::string>{"a_b", "a_b_2", "time_2", "run_2", "_.", "_-x_",
                                                                    "tab_here", umlaut, longest, longest + "_2",
                                                                    "a\\b, \"c\" [d]"});
    const History back = read_history(folder / "a.h5");
    for (std::size_t i = 0; i < channels.size(); ++i) CHECK(back.channels.at(i).name == channels[i].name);
    if (has_program("ncdump")) CHECK_NOTHROW(output_of("ncdump -h " + folder / "a.h5", folder / "out"));
}

TEST_CASE("history: netCDF's own program reads it", "[property]") {
    if (!has_program("ncdump")) {
        WARN("not tested: there is no ncdump");
        return;
    }
    const Folder folder;
    {
        HistoryWriter writer = HistoryWriter::create(folder / "a.h5", rotor_channels(), about, {.chunk = 2});
        for (int row = 0; row < 5; ++row) writer.append(row, std::vector<double>{1.5, no_value, 3.0 * row});
    }
    const std::string header = output_of("ncdump -h " + (folder / "a.h5"), folder / "out");
    CHECK_THAT(header, Contains("time = UNLIMITED ; // (5 currently)"));
    CHECK_THAT(header, Contains("double kinetic\\ energy(time) ;"));
    CHECK_THAT(header, Contains("rotor\\ speed:units = \"rad s-1\""));
    CHECK_THAT(output_of("ncdump -v 'kinetic energy' " + (folder / "a.h5"), folder / "out"),
               Contains("0, 3, 6, 9, 12"));
}

TEST_CASE("history: chosen channels and a range of time are read", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    std::vector<Channel> channels = some_channels();
    channels[2].alias = "Third";
    HistoryWriter writer = HistoryWriter::create(path, channels, {}, {.chunk = 16});
    append_rows(writer, 0, 50);
    writer.finish();
    const History part = read_history(path, {{"Third", "channel 0"}, time_of(10), time_of(40)});
    REQUIRE(part.channels.size() == 2);
    CHECK(part.channels[0].name == "channel 2");
    REQUIRE(part.time.size() == 31);
    for (std::size_t i = 0; i < 31; ++i) {
        CHECK(part.time[i] == time_of(10 + i));
        CHECK(part.values[0][i] == value_of(2, 10 + i));
        CHECK(part["channel 0"][i] == value_of(0, 10 + i));
    }
    CHECK(read_history(path, {.from = 0.105, .to = 0.125}).time == std::vector<double>{time_of(11), time_of(12)});
    CHECK(read_history(path, {.from = 0.101, .to = 0.109}).time.empty());
    CHECK(read_history(path, {.from = 3, .to = 1}).time.empty());
    CHECK(read_history(path, {.from = 100}).values.at(2).empty());
    CHECK_THROWS_WITH(read_history(path, {{"channel 9"}}), Contains("'channel 9'") && Contains("'channel 1'"));
}

TEST_CASE("history: rows are flushed when a chunk is full, when asked, and after an interval", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    {
        HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, {.chunk = 10, .flush_interval = 1e9});
        CHECK(read_history_info(path).rows == 0);
        append_rows(writer, 0, 9);
        CHECK(writer.flushed_rows() == 0);
        CHECK(writer.rows() == 9);
        append_rows(writer, 9, 13);
        CHECK(writer.flushed_rows() == 10);
        CHECK(read_history_info(path).rows == 10);
        writer.flush();
        CHECK(writer.flushed_rows() == 13);
        append_rows(writer, 13, 20);
        CHECK(writer.flushed_rows() == 20);
        append_rows(writer, 20, 22);
    }
    const HistoryInfo info = read_history_info(path);
    CHECK(info.rows == 22);  // the destructor flushes
    CHECK_FALSE(info.finished);
    CHECK(wrong_values(read_history(path)) == 0);
    HistoryWriter writer = HistoryWriter::create(folder / "b.h5", some_channels(), {}, {.flush_interval = 0.05});
    append_rows(writer, 0, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    append_rows(writer, 1, 2);
    CHECK(writer.flushed_rows() == 2);
}

TEST_CASE("history: a checkpoint is kept with every flush", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, {.chunk = 8, .flush_interval = 1e9});
    writer.take_checkpoints([&] { return checkpoint_of(writer.rows() - 1); });
    CHECK_FALSE(read_checkpoint(path));
    for (std::size_t row = 0; row < 30; ++row) {
        append_rows(writer, row, row + 1);
        if (writer.flushed_rows() == 0) continue;
        const HistoryInfo info = read_history_info(path);
        CHECK(info.checkpoint_rows == info.rows);
        CHECK(whole(info));
        CHECK(info.statistics->steps == static_cast<long>(info.rows) - 1);
    }
    writer.take_checkpoints({});
    writer.finish();
    CHECK(read_history_info(path).rows == 30);
    CHECK(read_history_info(path).checkpoint_rows == 24);
    CHECK(read_checkpoint(path)->time == time_of(23));
}

TEST_CASE("history: appending goes on after the checkpoint, or after the last row without one", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    const bool checkpoints = GENERATE(false, true), finished = GENERATE(false, true);
    CAPTURE(checkpoints, finished);
    {
        HistoryWriter writer = HistoryWriter::create(path, some_channels(), about, {.chunk = 8});
        if (checkpoints) writer.take_checkpoints([&] { return checkpoint_of(writer.rows() - 1); });
        append_rows(writer, 0, 21);
        writer.flush();
        writer.take_checkpoints({});
        append_rows(writer, 21, 27);
        if (finished) writer.finish();
    }
    {
        HistoryWriter writer = HistoryWriter::append_to(path, some_channels());
        const std::size_t kept = checkpoints ? 21 : 27;
        CHECK(writer.rows() == kept);
        CHECK(writer.last_time() == time_of(kept - 1));
        CHECK_FALSE(read_history_info(path).finished);
        CHECK(read_history_info(path).rows == kept);
        CHECK(read_history_info(path).about.description == about.description);
        CHECK_THROWS_AS(writer.append(writer.last_time(), values_of(3, 0)), InputError);
        append_rows(writer, kept, 40);
        writer.finish();
    }
    CHECK(wrong_values(read_history(path)) == 0);
    CHECK(read_history_info(path).rows == 40);
    CHECK(read_history_info(path).finished);
}

TEST_CASE("history: only the same channels are appended", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    write_rows(path, 20);
    const std::string before = bytes_of(path);
    const auto reason = [&](const std::vector<Channel>& channels) {
        CHECK_THROWS_AS(HistoryWriter::append_to(path, channels), InputError);
        return message_of([&] { (void)HistoryWriter::append_to(path, channels); });
    };
    std::vector<Channel> channels = some_channels();
    channels[1].units = "mm";
    CHECK_THAT(reason(channels), Contains("channel 2 is 'channel 1' [mm], in the file 'channel 1' [m]"));
    channels = some_channels();
    std::swap(channels[0], channels[2]);
    CHECK_THAT(reason(channels), Contains("channel 1 is 'channel 2' [m], in the file 'channel 0' [m]"));
    CHECK_THAT(reason(some_channels(4)), Contains("channel 4 is 'channel 3' [m], in the file none"));
    CHECK_THAT(reason(some_channels(2)), Contains("channel 3 is none, in the file 'channel 2' [m]"));
    CHECK(bytes_of(path) == before);
}

TEST_CASE("history: wrong rows and checkpoints are refused and do no harm", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    HistoryWriter writer = HistoryWriter::create(path, some_channels());
    append_rows(writer, 0, 3);
    const auto refused = [](auto action) {
        CHECK_THROWS_AS(action(), InputError);
        return message_of(action);
    };
    const std::vector<double> row = values_of(3, 3);
    for (const double time : {time_of(2), time_of(1), no_value, std::numeric_limits<double>::infinity()})
        CHECK_THAT(refused([&] { writer.append(time, row); }),
                   Contains("time [s] = ") && Contains("later than that of the row before, 0.02"));
    CHECK_THAT(refused([&] { writer.append(1, values_of(2, 3)); }), Contains("number of values = 2; allowed: 3"));
    writer.take_checkpoints([] { return checkpoint_of(1); });
    CHECK_THAT(refused([&] { writer.flush(); }), Contains("time of the checkpoint [s] = 0.01"));
    writer.take_checkpoints([] { return checkpoint_of(2); });
    writer.flush();
    writer.take_checkpoints([] {
        Checkpoint other = checkpoint_of(3);
        other.q = other.qd = Vector::Zero(5);
        return other;
    });
    CHECK_THAT(refused([&] { writer.flush(); }), Contains("coordinates of the checkpoint = 5; allowed: 2"));
    writer.take_checkpoints([]() -> Checkpoint { throw std::runtime_error("of the source"); });
    CHECK_THROWS_WITH(writer.flush(), "of the source");
    writer.take_checkpoints({});
    append_rows(writer, 3, 5);
    writer.finish();
    CHECK(wrong_values(read_history(path)) == 0);
    CHECK(read_history(path).time.size() == 5);
    CHECK_THAT(refused([&] { writer.append(1, row); }), Contains("a.h5: the history is closed"));
    CHECK_THAT(refused([&] { writer.finish(); }), Contains("closed"));
    const HistoryWriter moved = std::move(writer);
    CHECK_THAT(refused([&] { writer.flush(); }), Contains("moved"));  // NOLINT: the point of the test
    CHECK(moved.path() == path);
}

TEST_CASE("history: wrong channels and options are refused", "[property]") {
    const Folder folder;
    const auto refused = [&](const std::vector<Channel>& channels, const HistoryStorage& storage = {}) {
        const auto action = [&] { (void)HistoryWriter::create(folder / "a.h5", channels, {}, storage); };
        CHECK_THROWS_AS(action(), InputError);
        return message_of(action);
    };
    CHECK_THAT(refused({{"", "m", "x"}}), Contains("channel = ''; allowed: name, units and long_name not empty"));
    CHECK_THAT(refused({{"a", "", "x"}}), Contains("channel = 'a'"));
    CHECK_THAT(refused({{"a", "m", ""}}), Contains("channel = 'a'"));
    CHECK_THAT(refused({{"a", "m", "x"}, {"b", "m", "x", "", "", "a"}}), Contains("'a', twice"));
    CHECK_THAT(refused({{std::string("a\0b", 3), "m", "x"}}), Contains("channel 1: a text has the character NUL"));
    CHECK_THAT(refused({{"a", "m", "x"}, {"b\xC3", "m", "x"}}), Contains("channel 2: a text has"));
    CHECK_THAT(refused({{"a", "m", "x", "", "\xFF"}}), Contains("channel 1: a text has"));
    CHECK_THAT(refused({}, {.chunk = 0}), Contains("samples of a chunk = 0; allowed: 1 ... 1048576"));
    CHECK_THAT(refused({}, {.flush_interval = no_value}), Contains("flush interval [s] = nan; allowed: >= 0"));
    CHECK(folder.files() == 0);
}
