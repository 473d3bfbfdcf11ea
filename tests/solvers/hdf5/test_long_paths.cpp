// Paths longer than the system takes: an error of the file, not of the standard library.
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/text_file.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::solvers;

TEST_CASE("files: over-long names and paths are refused by every reader and writer", "[property]") {
    const std::string name(300, 'n'), path = "/tmp/" + std::string(5000, 'p');  // PATH_MAX 4096, NAME_MAX 255
    std::string folders = "/tmp";
    while (folders.size() < 5000) folders += "/" + std::string(200, 'f');
    for (const std::string& file : {"/tmp/" + name + ".h5", path + ".h5", folders + "/a.h5"}) {
        CHECK_THROWS_AS(text_file(file), FileError);
        CHECK_THROWS_AS(write_file(file, "text"), FileError);
        CHECK_THROWS_AS(Hdf5File::create(file), FileError);
        CHECK_THROWS_AS(Hdf5File::open(file), FileError);
        CHECK_THROWS_AS(HistoryWriter::create(file, {}), FileError);
        CHECK_THROWS_AS(HistoryWriter::append_to(file, {}), FileError);
        CHECK_THROWS_AS(read_history(file), FileError);
        CHECK_THROWS_AS(repair_history(file), FileError);
    }
}
