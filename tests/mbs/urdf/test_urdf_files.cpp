// Files of URDF: read, written whole or not at all, errors with path and reason.
#include "tests/mbs/urdf/urdf_texts.hpp"
#include "tests/support/files.hpp"

using namespace cardan;
using namespace cardan::testing;
using cardan::test::bytes_of;
using cardan::test::Folder;
using cardan::test::message_of;
using cardan::test::SizeLimit;

namespace {

Tree small_tree() {
    Random random(31);
    return random_tree(random);
}

template <class Action>
bool is_file_error(Action action) {
    try {
        action();
    } catch (const FileError&) {
        return true;
    } catch (...) {
        return false;
    }
    return false;
}

}  // namespace

TEST_CASE("urdf files: what is written is read again, and errors in it name the path", "[property]") {
    const Folder folder;
    const std::string path = folder / "arm.urdf";
    write_urdf(path, small_tree());
    CHECK(folder.files() == 1);
    CHECK(bytes_of(path) == to_urdf(small_tree()));
    CHECK(read_urdf(path).tree.bodies().size() == small_tree().bodies().size());
    std::ofstream(path) << "<robot name=\"x\">\n<link/></robot>";
    check_refused([&] { (void)read_urdf(path); }, {path + ":2: link ''"});
    std::ofstream(path, std::ios::trunc).close();
    check_refused([&] { (void)read_urdf(path); }, {path + ": is empty"});
}

TEST_CASE("urdf files: a missing file or a folder is a FileError with path and reason", "[property]") {
    const Folder folder;
    const std::string missing = folder / "none.urdf";
    CHECK(is_file_error([&] { (void)read_urdf(missing); }));
    CHECK(message_of([&] { (void)read_urdf(missing); }) == missing + ": cannot be read: No such file or directory");
    CHECK(is_file_error([&] { (void)read_urdf(folder.path); }));
    CHECK(message_of([&] { (void)read_urdf(folder.path); }).find("is a folder, not a file") != std::string::npos);
}

TEST_CASE("urdf files: a path that cannot be written is a FileError, and nothing is left behind", "[property]") {
    const Folder folder;
    const Tree tree = small_tree();
    for (const std::string& path : {folder / "no/such/x.urdf", std::string("/dev/null"), folder.path.string(),
                                    std::string(), folder.path.string() + "/"}) {
        CAPTURE(path);
        CHECK(is_file_error([&] { write_urdf(path, tree); }));
    }
    CHECK(message_of([&] { write_urdf(folder / "no/such/x.urdf", tree); }).find("no/such' does not exist") !=
          std::string::npos);
    CHECK(message_of([&] { write_urdf("/dev/null", tree); }) ==
          "/dev/null: exists and is not an ordinary file; it is "
          "not replaced");
    CHECK(folder.files() == 0);
}

TEST_CASE("urdf files: on a full disk the old file stays and no part of the new one", "[property]") {
    const Folder folder;
    const std::string path = folder / "arm.urdf";
    std::ofstream(path) << "old";
    {
        const SizeLimit limit(500);
        CHECK(message_of([&] { write_urdf(path, small_tree()); }) == path + ": cannot be completed: File too large");
    }
    CHECK(bytes_of(path) == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("urdf files: a tree that cannot be written leaves the old file alone", "[property]") {
    const Folder folder;
    const std::string path = folder / "arm.urdf";
    std::ofstream(path) << "old";
    check_refused([&] { write_urdf(path, small_tree(), {"", {}}); }, {"robot needs a name"});
    CHECK(bytes_of(path) == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("urdf files: a folder in the place of the unfinished file is not removed", "[property]") {
    const Folder folder;
    const std::string path = folder / "arm.urdf", taken = path + ".partial";
    std::filesystem::create_directory(taken);
    CHECK(is_file_error([&] { write_urdf(path, small_tree()); }));
    CHECK(std::filesystem::is_directory(taken));
    CHECK_FALSE(std::filesystem::exists(path));
}
