// Files that are mapped: what is in them, what cannot be mapped, what others do to them meanwhile.
#include "mbs/base/mapped_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/process_memory.hpp"

#include <algorithm>
#include <sys/stat.h>

namespace cardan::testing::mapped_file_tests {

namespace {

std::string text_in(const MappedFile& file) {
    return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

}  // namespace

TEST_CASE("mapped file: its bytes, also after it was replaced or removed", "[property]") {
    const test::Folder folder;
    const std::string path = folder / "a", other = folder / "b";
    std::ofstream(path) << "what was there";
    const MappedFile file(path);
    CHECK(file.path() == path);
    CHECK(text_in(file) == "what was there");
    std::ofstream(other) << "new";
    std::filesystem::rename(other, path);
    CHECK(text_in(file) == "what was there");
    CHECK_NOTHROW(file.require_whole());
    CHECK(text_in(MappedFile(path)) == "new");
    std::filesystem::remove(path);
    CHECK(text_in(file) == "what was there");
}

TEST_CASE("mapped file: what cannot be mapped is refused, and what is shortened is noticed", "[property]") {
    const test::Folder folder;
    const auto message = [](const std::string& path) { return test::message_of([&] { MappedFile{path}; }); };
    CHECK(message(folder / "none") == (folder / "none") + ": cannot be read: No such file or directory");
    CHECK(message(folder.path.string()) == folder.path.string() + ": is a folder, not a file");
    const std::string path = folder / "a", pipe = folder / "pipe";
    std::ofstream{path};
    CHECK(message(path) == path + ": is empty");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(message(pipe) == pipe + ": is not an ordinary file, which alone can be mapped");
    std::ofstream(path) << "0123456789";
    if (::geteuid() != 0) {  // who may read everything
        std::filesystem::permissions(path, std::filesystem::perms::none);
        CHECK(message(path) == path + ": cannot be read: Permission denied");
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    }
    const MappedFile file(path);
    CHECK_NOTHROW(file.require_whole());
    std::filesystem::resize_file(path, 4);
    CHECK(test::message_of([&] { file.require_whole(); }).find("has now 4 bytes, 10 when it was opened") !=
          std::string::npos);
}

TEST_CASE("mapped file: a long one takes no memory of the process", "[property]") {
    const test::Folder folder;
    const std::string path = folder / "long";
    std::ofstream(path) << "begin";
    constexpr std::uintmax_t length = std::uintmax_t{1} << 30;
    std::filesystem::resize_file(path, length);  // what is not written takes no place on the disk
    const long before = test::anonymous_memory();
    const MappedFile file(path);
    REQUIRE(file.bytes().size() == length);
    const auto every_page = [&] {
        std::size_t zeros = 0;
        for (std::size_t i = 4096; i < std::size_t{64} << 20; i += 4096) zeros += file.bytes()[i] == std::byte{0};
        return zeros;
    };
    CHECK(every_page() == (64 << 20) / 4096 - 1);
    CHECK(file.bytes().back() == std::byte{0});
    CHECK(test::anonymous_memory() - before < 4096);
}

}  // namespace cardan::testing::mapped_file_tests
