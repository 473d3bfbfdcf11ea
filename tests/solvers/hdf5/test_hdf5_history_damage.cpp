// Files of histories that cannot be written, exist already, are not histories, or are damaged.
#include "mbs/base/error.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <fstream>
#include <unistd.h>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("history: a path that cannot be written is an error that says why", "[property]") {
    const Folder folder;
    const auto reason = [&](const std::string& path) {
        CHECK_THROWS_AS(HistoryWriter::create(path, some_channels()), FileError);
        return message_of([&] { (void)HistoryWriter::create(path, some_channels()); });
    };
    CHECK_THAT(reason(folder / "none/a.h5"), Contains("none/a.h5: the folder ") && Contains("does not exist"));
    CHECK_THAT(reason(folder.path.string()), Contains("is a folder, not a file"));
    CHECK_THAT(reason("/dev/null"), Contains("is not an ordinary file"));
    CHECK_THAT(reason(""), Contains("a file name is needed"));
    if (::geteuid() != 0) {  // root may write anywhere
        write_rows(folder / "a.h5", 3);
        fs::permissions(folder / "a.h5", fs::perms::owner_read);
        CHECK_THROWS_WITH(HistoryWriter::append_to(folder / "a.h5", some_channels()), Contains("Permission denied"));
        fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
        CHECK_THAT(reason(folder / "b.h5"), Contains("Permission denied"));
        fs::permissions(folder.path, fs::perms::owner_all);
    }
}

TEST_CASE("history: an existing file is replaced on purpose only, and not before the new one can be read",
          "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    write_rows(path, 20);
    const std::string before = bytes_of(path);
    CHECK_THROWS_WITH(HistoryWriter::create(path, some_channels()), Contains("a.h5: is there already"));
    CHECK_THROWS_AS(HistoryWriter::create(path, {{"a", "m", "x\0y"}, {"a", "m", "x"}}, {}, {.replace = true}),
                    InputError);
    CHECK(bytes_of(path) == before);
    HistoryWriter writer = HistoryWriter::create(path, some_channels(), {.title = "new"}, {.replace = true});
    CHECK(read_history_info(path).about.title == "new");
    CHECK(folder.files() == 1);
}

TEST_CASE("history: files that are not histories, or are damaged, are an error that says so", "[property]") {
    const Folder folder;
    const auto reason = [&](const std::string& path) {
        CHECK_THROWS_AS(read_history(path), FileError);
        CHECK_THROWS_AS(read_checkpoint(path), FileError);
        CHECK_THROWS_AS(repair_history(path), FileError);
        CHECK_THROWS_AS(HistoryWriter::append_to(path, some_channels()), FileError);
        return message_of([&] { (void)read_history_info(path); });
    };
    const std::string path = folder / "a.h5";
    CHECK_THAT(reason(path), Contains("a.h5: cannot be opened: No such file"));
    CHECK_THAT(reason(folder.path.string()), Contains("is a folder"));
    const std::string prose(2000, 'x');
    std::ofstream(folder / "text") << prose;
    CHECK_THAT(reason(folder / "text"), Contains("cannot be opened as an HDF5 file: file signature not found"));
    CHECK(bytes_of(folder / "text") == prose);
    {
        Hdf5File other = Hdf5File::create(folder / "other.h5");
        other.write("time", std::vector<double>{1, 2}, {2}, {"s", "time"});
        other.finish();
    }
    const std::string other = bytes_of(folder / "other.h5");
    CHECK_THAT(reason(folder / "other.h5"), Contains("is an HDF5 file, but no history"));
    CHECK(bytes_of(folder / "other.h5") == other);
    write_rows(path, 5000, {.chunk = 1024});
    const std::string whole = bytes_of(path);
    for (const double part : {0.999, 0.9, 0.5, 0.1}) {
        CAPTURE(part);
        fs::resize_file(path, static_cast<std::uintmax_t>(part * static_cast<double>(whole.size())));
        CHECK_THAT(reason(path), Contains("cannot be opened as an HDF5 file: "));
        std::ofstream(path, std::ios::binary | std::ios::trunc) << whole;
    }
    CHECK(wrong_values(read_history(path)) == 0);
}

TEST_CASE("history: damaged values are noticed, and the other channels can be read", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    write_rows(path, 20'000, {.chunk = 20'000});
    {
        std::fstream damage(path, std::ios::in | std::ios::out | std::ios::binary);
        damage.seekp(static_cast<std::streamoff>(fs::file_size(path) / 2));
        damage << "xxxxxxxxxxxxxxxx";
    }
    std::size_t noticed = 0;
    for (const char* channel : {"channel 0", "channel 1", "channel 2"}) {
        const std::string message = message_of([&] { (void)read_history(path, {{channel}}); });
        if (message == "nothing was thrown") continue;
        ++noticed;
        CHECK_THAT(message, Contains(text("a.h5: ", channel, ": cannot be read: ")));
    }
    CHECK(noticed == 1);
}

TEST_CASE("history: repair leaves an intact file as it is, and cuts off what does not belong to it", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    write_rows(path, 40);
    const std::string good = bytes_of(path);
    CHECK_FALSE(repair_history(path).changed());
    CHECK(bytes_of(path) == good);
    std::ofstream(path, std::ios::binary | std::ios::app) << std::string(1000, 'x');
    CHECK(read_history_info(path).needs_repair);
    CHECK(wrong_values(read_history(path)) == 0);
    const HistoryRepair repair = repair_history(path);
    CHECK_FALSE(repair.flush_completed);
    CHECK(repair.bytes_removed == 1000);
    CHECK(bytes_of(path) == good);
}
