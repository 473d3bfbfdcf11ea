/// @file
/// HDF5 files: self-describing arrays in groups, written so that a broken file never poses as a complete one.
#pragma once

#include <complex>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cardan::solvers {

/// Extents of an array, slowest axis first (row-major); {} is a single number.
using Shape = std::vector<std::size_t>;

using AttributeValue = std::variant<std::string, double, std::int64_t>;

/// An attribute of a data set or a group.
struct Attribute {
    std::string name;
    AttributeValue value;
};

using Attributes = std::vector<Attribute>;

/// Endings of the names of the two arrays that hold complex numbers.
constexpr const char* real_part = "_real";
constexpr const char* imaginary_part = "_imag";

/// Metadata of every array of numbers; neither units nor long_name may be empty. A pure number has units "1".
struct Description {
    std::string units;      ///< SI, e.g. "kg m2 s-1"
    std::string long_name;  ///< one line, e.g. "natural frequency, undamped"
    Attributes more = {};   ///< frame, point, alias ...
};

/// A file being written, or open for reading. Names are paths: "modes/frequency"; missing groups are created.
///
/// Data are written to "<path>.partial". finish() completes the file and renames it; it must be called. Without it, the
/// destructor closes the partial file, which stays and can be read, under that name, up to the last thing written. An
/// older file under `path` is untouched until finish(). The partial file is locked while it is open.
///
/// Every failure is a FileError with path, object and reason; a disk that fills up is noticed at the latest by
/// finish(). After a failed write the file cannot be finished. Misuse (a name used twice, inconsistent sizes, a missing
/// unit) is an InputError and leaves the file as it was.
///
/// Arrays from 32 KiB on are chunked, shuffled, deflated and given checksums; smaller ones lie within headers, which
/// have checksums. Groups and attributes keep the order in which they were made; no times are stored: the same data
/// give the same bytes. Complex numbers are two arrays, "<name>_real" and "<name>_imag": compounds, as h5py writes
/// them, are left out by netCDF 4.9.0 and are no complex numbers to later ones. Texts are UTF-8: attributes of fixed
/// length, arrays with one more axis along the characters, as in netCDF (with the attribute _Encoding where programs
/// decode them correctly: one text, or ASCII); the scale of that axis, "string<length>", lies in the same group.
///
/// Only one thread at a time may use any of these files: the high-level part of the C library is not thread-safe.
class Hdf5File {
public:
    /// Begins a new file.
    [[nodiscard]] static Hdf5File create(const std::filesystem::path& path);
    /// Opens an existing file for reading.
    [[nodiscard]] static Hdf5File open(const std::filesystem::path& path);

    Hdf5File(Hdf5File&&) noexcept;
    Hdf5File& operator=(Hdf5File&&) noexcept;
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;
    ~Hdf5File();

    /// The name given to create() or open().
    [[nodiscard]] const std::string& path() const;

    /// @name Writing
    ///@{

    /// A new data set; values.size() is the product of the extents.
    void write(std::string_view name, std::span<const double> values, const Shape& shape, const Description& about);
    void write(std::string_view name, std::span<const int> values, const Shape& shape, const Description& about);
    void write(std::string_view name, std::span<const std::int64_t> values, const Shape& shape,
               const Description& about);
    /// Two data sets, name + real_part and name + imaginary_part.
    void write(std::string_view name, std::span<const std::complex<double>> values, const Shape& shape,
               const Description& about);
    /// Texts have no units; they must be UTF-8 without the character NUL. The character axis is not part of shapes.
    void write(std::string_view name, std::span<const std::string> values, const Shape& shape,
               std::string_view long_name, const Attributes& more = {});

    /// Creates a group and its parents, or adds attributes to an existing one.
    void make_group(std::string_view name, const Attributes& attributes = {});
    /// Adds or replaces an attribute of a group or data set; "/" is the root.
    void set_attribute(std::string_view object, const Attribute& attribute);

    /// Turns a data set of numbers with one axis into a dimension scale.
    void make_dimension(std::string_view name);
    /// A new dimension scale 0, 1, 2 ... for axes over items that have names but no values of their own.
    void make_index(std::string_view name, std::size_t count, std::string_view long_name);
    /// Attaches the scale to axis `axis` (from 0) of a data set; both must have the same length.
    void attach(std::string_view dataset, std::size_t axis, std::string_view scale);

    /// Hands all data to the operating system; a program that ends later without finish() leaves what was written so
    /// far.
    void flush();
    /// Completes the file and renames it to path(). The object is closed afterwards, even if this throws.
    void finish();
    ///@}

    /// @name Reading (also from a file being written)
    ///@{
    [[nodiscard]] bool has(std::string_view name) const;
    [[nodiscard]] bool has_attribute(std::string_view object, std::string_view attribute) const;
    /// Names within a group in order of creation (alphabetical in files that do not record it).
    [[nodiscard]] std::vector<std::string> children(std::string_view group = "/") const;
    [[nodiscard]] Shape shape(std::string_view name) const;
    [[nodiscard]] std::vector<double> read_doubles(std::string_view name) const;
    /// Rejects floating-point numbers.
    [[nodiscard]] std::vector<std::int64_t> read_ints(std::string_view name) const;
    /// Two data sets as write() makes them, or one of compounds {r, i}, as in files of earlier versions and of h5py.
    [[nodiscard]] std::vector<std::complex<double>> read_complex(std::string_view name) const;
    /// Character arrays with one more axis, or strings of variable or fixed length as written by other programs.
    [[nodiscard]] std::vector<std::string> read_strings(std::string_view name) const;
    /// The path of the scale attached to an axis; empty if there is none.
    [[nodiscard]] std::string dimension(std::string_view dataset, std::size_t axis) const;

    [[nodiscard]] std::string string_attribute(std::string_view object, std::string_view attribute) const;
    [[nodiscard]] double double_attribute(std::string_view object, std::string_view attribute) const;
    [[nodiscard]] std::int64_t int_attribute(std::string_view object, std::string_view attribute) const;
    ///@}

    struct Impl;  ///< internal

private:
    explicit Hdf5File(std::unique_ptr<Impl> impl);
    [[nodiscard]] Impl& writable() const;
    [[nodiscard]] Impl& readable() const;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardan::solvers
