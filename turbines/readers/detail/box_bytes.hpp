/// @file
/// Parts that the readers of wind boxes have in common. Internal to the readers: not installed.
#pragma once

#include "elements/wind/box_files.hpp"
#include "elements/wind/wind_box.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/mapped_file.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

namespace cardan::turbines {

static_assert(std::endian::native == std::endian::little, "wind boxes are mapped as they are: little endian");

/// The numbers at the beginning of a binary file, one after the other. What is wrong is a FileError with the byte.
class BoxHeader {
public:
    explicit BoxHeader(const MappedFile& file) : file_(file) {}

    template <class Number>
    Number next(std::string_view what) {
        Number value;
        std::memcpy(&value, take(sizeof value, what), sizeof value);
        return value;
    }
    /// The next int32 (Number = std::int16_t: int16).
    template <class Number = std::int32_t>
    int integer(std::string_view what, int min, int max) {
        return in_range(what, next<Number>(what), min, max);
    }
    /// The next float32, finite and not beyond the limits.
    double real(std::string_view what, double min, double max);
    /// The next float32, > 0.
    double positive(std::string_view what, double max);
    std::string_view characters(std::string_view what, int count);
    void skip(std::string_view what, std::size_t bytes) { take(bytes, what); }

    std::size_t at() const { return at_; }  ///< byte of what comes next
    /// About the number that was read last.
    [[noreturn]] void fail(std::string_view what) const;

private:
    const std::byte* take(std::size_t bytes, std::string_view what);
    int in_range(std::string_view what, int value, int min, int max) const;

    const MappedFile& file_;
    std::size_t at_ = 0, last_ = 0;
};

/// Product of counts, none of them negative; the largest number there is where it is larger.
std::size_t saturated_product(std::initializer_list<std::size_t> counts);

/// Checks the length of a file.  @throws FileError that says what it should have
/// @param header   bytes before the numbers
/// @param numbers  bytes of the numbers, a saturated_product()
/// @param because  what asks for so many: "4 x 5 points, ..."
void require_length(const MappedFile& file, std::size_t header, std::size_t numbers, std::string_view because);

/// The program's own word on a file, fit for results: characters that cannot be printed become blanks, none at the
/// ends.
std::string printable(std::string_view text);

/// Files that a box was read from, in the order of BoxOrigin::files, and their checksum.
class BoxSources {
public:
    /// Maps one more file.
    const MappedFile& map(const std::filesystem::path& path);
    /// Counts all bytes of the mapped file that was added last.
    void sum();
    /// Counts bytes of a file that was read otherwise, or piece by piece: pieces but the last a multiple of eight.
    void sum(std::span<const std::byte> bytes) { checksum_ = checksum_of(bytes, checksum_); }
    void name(const std::filesystem::path& path) { names_.push_back(path.string()); }

    BoxOrigin origin(std::string format, std::string note = {}) const;
    /// Lets a box keep the mapped files, and find out whether they change.
    void keep_in(WindBoxData& box) const;

private:
    BoxFiles files_;
    std::vector<std::string> names_;
    std::uint64_t checksum_ = checksum_of({});
};

/// Numbers of a mapped file.
/// @param place  of step 0, row 0, column 0, bytes
BoxNumbers numbers_in(const MappedFile& file, int number, BoxNumbers::Type type, std::size_t place);

}  // namespace cardan::turbines
