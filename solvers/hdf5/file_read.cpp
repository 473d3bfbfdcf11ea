#include "mbs/base/error.hpp"
#include "solvers/hdf5/detail/file.hpp"
#include "solvers/hdf5/detail/storage.hpp"
#include "solvers/hdf5/detail/text.hpp"
#include "solvers/hdf5/file.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cerrno>
#include <fcntl.h>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace cardan::solvers {
namespace {

using detail::Handle;
using detail::Quiet;

/// "/a/b", "a/b" and "" (the root) as the C library wants them.
std::string absolute(std::string_view name) {
    return name.starts_with('/') ? std::string(name) : text("/", name);
}

/// Called by the C library, so nothing is thrown: the path of the first scale of an axis.
herr_t keep_name(hid_t, unsigned, hid_t scale, void* out) noexcept {
    try {
        const ssize_t length = H5Iget_name(scale, nullptr, 0);
        if (length < 0) return -1;
        auto& name = *static_cast<std::string*>(out);
        name.resize(static_cast<std::size_t>(length));
        H5Iget_name(scale, name.data(), name.size() + 1);
        return 1;  // stop
    } catch (...) {
        return -1;
    }
}

/// Numbers or texts of a data set or of an attribute, by the same few steps.
struct Source {
    const Hdf5File::Impl& impl;
    std::string what;
    Handle type;
    Handle space;
    std::function<herr_t(hid_t memory_type, void* to)> read;

    [[noreturn]] void refuse(std::string_view why) const { throw FileError(impl.path, text(what, ": ", why)); }

    [[nodiscard]] std::vector<hsize_t> extents() const {
        const int axes = impl.ok(H5Sget_simple_extent_ndims(space.get()), what, "be read");
        std::vector<hsize_t> result(static_cast<std::size_t>(axes));
        if (axes > 0) impl.ok(H5Sget_simple_extent_dims(space.get(), result.data(), nullptr), what, "be read");
        return result;
    }

    /// The C library multiplies without looking for an overflow.
    [[nodiscard]] std::size_t count() const {
        const auto points =
            static_cast<std::size_t>(impl.ok(H5Sget_simple_extent_npoints(space.get()), what, "be read"));
        double values = 1;
        for (const hsize_t n : extents()) values *= static_cast<double>(n);
        constexpr double max = 1e15;
        if (values > max) refuse(text(values, " values do not fit into memory"));
        return points;
    }

    template <class Value>
    [[nodiscard]] std::vector<Value> room(std::size_t n) const {
        try {
            return std::vector<Value>(n);
        } catch (const std::bad_alloc&) {
        } catch (const std::length_error&) {
        }
        refuse(text(n, " values do not fit into memory"));
    }

    template <class Value>
    [[nodiscard]] std::vector<Value> numbers(hid_t memory_type) const {
        std::vector<Value> values = room<Value>(count());
        impl.ok(read(memory_type, values.data()), what, "be read");
        return values;
    }

    [[nodiscard]] std::vector<double> doubles() const {
        const H5T_class_t kind = H5Tget_class(type.get());
        if (kind != H5T_FLOAT && kind != H5T_INTEGER) refuse("holds no real numbers");
        return numbers<double>(H5T_NATIVE_DOUBLE);
    }

    [[nodiscard]] std::vector<std::int64_t> ints() const {
        if (H5Tget_class(type.get()) != H5T_INTEGER) refuse("holds no integers");
        return numbers<std::int64_t>(H5T_NATIVE_INT64);
    }

    [[nodiscard]] std::vector<std::complex<double>> complex_numbers() const {
        const bool compound = H5Tget_class(type.get()) == H5T_COMPOUND;
        if (!compound || H5Tget_member_index(type.get(), "r") < 0 || H5Tget_member_index(type.get(), "i") < 0) {
            refuse("holds no complex numbers {r, i}");
        }
        const Handle memory(H5Tcreate(H5T_COMPOUND, 2 * sizeof(double)), H5Tclose);
        H5Tinsert(memory.get(), "r", 0, H5T_NATIVE_DOUBLE);
        H5Tinsert(memory.get(), "i", sizeof(double), H5T_NATIVE_DOUBLE);
        return numbers<std::complex<double>>(memory.get());
    }

    [[nodiscard]] std::vector<std::string> strings() const {
        if (H5Tget_class(type.get()) != H5T_STRING) refuse("holds no texts");
        if (detail::is_character_array(type.get(), static_cast<int>(extents().size()))) return character_array();
        std::vector<std::string> result = room<std::string>(count());
        if (H5Tis_variable_str(type.get()) > 0) {
            std::vector<char*> texts = room<char*>(result.size());
            const auto give_back = [this](std::vector<char*>* all) {  // the texts belong to the C library
                if (!all->empty()) H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, all->data());
            };
            const std::unique_ptr<std::vector<char*>, decltype(give_back)> borrowed(&texts, give_back);
            impl.ok(read(type.get(), texts.data()), what, "be read");
            for (std::size_t k = 0; k < result.size(); ++k) {
                if (texts[k] != nullptr) result[k] = texts[k];
            }
        } else {
            const std::size_t size = H5Tget_size(type.get());
            std::vector<char> bytes = room<char>(size * result.size());
            impl.ok(read(type.get(), bytes.data()), what, "be read");
            const H5T_str_t padding = H5Tget_strpad(type.get());
            for (std::size_t k = 0; k < result.size(); ++k)
                result[k] = detail::text_of(&bytes[k * size], size, padding);
        }
        return result;
    }

    /// Characters whose last axis runs over a text.
    [[nodiscard]] std::vector<std::string> character_array() const {
        const std::size_t total = count(), length = static_cast<std::size_t>(extents().back());
        std::vector<char> bytes = room<char>(total);
        impl.ok(read(type.get(), bytes.data()), what, "be read");
        std::vector<std::string> result = room<std::string>(length == 0 ? 0 : total / length);
        for (std::size_t k = 0; k < result.size(); ++k)
            result[k] = detail::text_of(&bytes[k * length], length, H5T_STR_NULLPAD);
        return result;
    }
};

Source source_dataset(const Hdf5File::Impl& impl, std::string_view name, const Handle& dataset) {
    return {impl, std::string(name), impl.own(H5Dget_type(dataset.get()), H5Tclose, name, "be read"),
            impl.own(H5Dget_space(dataset.get()), H5Sclose, name, "be read"),
            [id = dataset.get()](hid_t memory, void* to) {
                return H5Dread(id, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
            }};
}

/// Calls use(source) for an attribute with one value.
template <class Use>
auto with_attribute(const Hdf5File::Impl& impl, std::string_view object, std::string_view name, Use use) {
    const std::string what = text(object, ", attribute ", name);
    const Handle owner = impl.open_object(object);
    const Handle attribute =
        impl.own(H5Aopen(owner.get(), std::string(name).c_str(), H5P_DEFAULT), H5Aclose, what, "be read");
    const Source source{impl, what, impl.own(H5Aget_type(attribute.get()), H5Tclose, what, "be read"),
                        impl.own(H5Aget_space(attribute.get()), H5Sclose, what, "be read"),
                        [id = attribute.get()](hid_t memory, void* to) { return H5Aread(id, memory, to); }};
    if (source.count() != 1) source.refuse("does not have exactly one value");
    return use(source).front();
}

}  // namespace

void Hdf5File::Impl::fail(std::string_view object, std::string_view action) const {
    std::string reason = detail::innermost_reason();
    if (disk.error != 0) reason = std::generic_category().message(disk.error);
    if (disk.error == EWOULDBLOCK) reason = lock_holder(path);
    if (reason.empty()) reason = "the HDF5 library gives no reason";
    throw FileError(path, text(object, object.empty() ? "" : ": ", "cannot ", action, ": ", reason));
}

bool Hdf5File::Impl::exists(std::string_view name) const {
    const std::string full = absolute(name);
    if (full == "/") return true;
    for (std::size_t end = full.find('/', 1), above = 0;; above = end, end = full.find('/', end + 1)) {
        const htri_t found = H5Lexists(file, full.substr(0, end).c_str(), H5P_DEFAULT);
        if (found < 0 && is_group(above == 0 ? "/" : full.substr(0, above))) fail(name, "be looked for");
        if (found <= 0) return false;
        if (end == std::string::npos) return true;
    }
}

// What cannot be opened may be one: it is damaged.
bool Hdf5File::Impl::is_group(const std::string& name) const {
    const Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
    return !object.valid() || H5Iget_type(object.get()) == H5I_GROUP;
}

Handle Hdf5File::Impl::open_object(std::string_view name) const {
    if (!exists(name)) throw FileError(path, text("there is no '", name, "' in it"));
    return own(H5Oopen(file, absolute(name).c_str(), H5P_DEFAULT), H5Oclose, name, "be opened");
}

Handle Hdf5File::Impl::open_dataset(std::string_view name) const {
    Handle object = open_object(name);
    if (H5Iget_type(object.get()) != H5I_DATASET) throw FileError(path, text(name, ": is not a data set"));
    return object;
}

Shape Hdf5File::Impl::shape(hid_t dataset, std::string_view name) const {
    const Handle space = own(H5Dget_space(dataset), H5Sclose, name, "be read");
    const int axes = ok(H5Sget_simple_extent_ndims(space.get()), name, "be read");
    std::vector<hsize_t> extents(static_cast<std::size_t>(axes));
    if (axes > 0) ok(H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr), name, "be read");
    return {extents.begin(), extents.end()};
}

Hdf5File::Impl& Hdf5File::readable() const {
    if (!impl_) throw InputError("Hdf5File: the object was moved from");
    if (impl_->file < 0) throw InputError(text(impl_->path, ": the file is closed"));
    return *impl_;
}

Hdf5File::Impl& Hdf5File::writable() const {
    Impl& impl = readable();
    if (!impl.pending && !impl.in_place)
        throw InputError(text(impl.path, ": the file is open for reading, not for writing"));
    if (impl.failed) throw FileError(impl.path, "cannot be continued: an earlier write failed");
    return impl;
}

const std::string& Hdf5File::path() const {
    if (!impl_) throw InputError("Hdf5File: the object was moved from");
    return impl_->path;
}

void Hdf5File::Impl::check_readable(const std::string& path) {
    std::error_code code;
    const std::filesystem::file_status there = std::filesystem::status(path, code);
    if (std::filesystem::is_directory(there)) throw FileError(path, "is a folder, not a file");
    if (std::filesystem::is_other(there)) throw FileError(path, "is not an ordinary file");
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) throw FileError(path, text("cannot be opened: ", std::generic_category().message(errno)));
    ::close(fd);
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
    const Quiet quiet;
    auto impl = std::make_unique<Impl>(path.string());
    Impl::check_readable(impl->path);
    impl->file = H5Fopen(impl->path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    impl->ok(impl->file, "", "be opened as an HDF5 file");
    return Hdf5File(std::move(impl));
}

bool Hdf5File::has(std::string_view name) const {
    const Quiet quiet;
    return readable().exists(name);
}

bool Hdf5File::has_attribute(std::string_view object, std::string_view attribute) const {
    const Quiet quiet;
    const Impl& impl = readable();
    const Handle opened = impl.open_object(object);
    return impl.ok(H5Aexists(opened.get(), std::string(attribute).c_str()), object, "be read") > 0;
}

std::vector<std::string> Hdf5File::children(std::string_view group) const {
    const Quiet quiet;
    const Impl& impl = readable();
    const Handle opened = impl.open_object(group);
    if (H5Iget_type(opened.get()) != H5I_GROUP) throw FileError(impl.path, text(group, ": is not a group"));
    const Handle list = impl.own(H5Gget_create_plist(opened.get()), H5Pclose, group, "be read");
    unsigned order = 0;
    H5Pget_link_creation_order(list.get(), &order);
    const H5_index_t index = (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
    H5G_info_t info{};
    impl.ok(H5Gget_info(opened.get(), &info), group, "be listed");
    std::vector<std::string> names;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
        const auto name = [&](char* to, std::size_t size) {
            return impl.ok(H5Lget_name_by_idx(opened.get(), ".", index, H5_ITER_INC, k, to, size, H5P_DEFAULT), group,
                           "be listed");
        };
        std::string& next = names.emplace_back(static_cast<std::size_t>(name(nullptr, 0)), '\0');
        name(next.data(), next.size() + 1);
    }
    return names;
}

Shape Hdf5File::shape(std::string_view name) const {
    const Quiet quiet;
    const Impl& impl = readable();
    const Handle dataset = impl.open_dataset(name);
    Shape extents = impl.shape(dataset.get(), name);
    const Handle type = impl.own(H5Dget_type(dataset.get()), H5Tclose, name, "be read");
    if (detail::is_character_array(type.get(), static_cast<int>(extents.size()))) extents.pop_back();
    return extents;
}

std::vector<double> Hdf5File::read_doubles(std::string_view name) const {
    const Quiet quiet;
    const Handle dataset = readable().open_dataset(name);
    return source_dataset(*impl_, name, dataset).doubles();
}

std::vector<std::int64_t> Hdf5File::read_ints(std::string_view name) const {
    const Quiet quiet;
    const Handle dataset = readable().open_dataset(name);
    return source_dataset(*impl_, name, dataset).ints();
}

std::vector<std::complex<double>> Hdf5File::read_complex(std::string_view name) const {
    const Quiet quiet;
    if (!readable().exists(name) && readable().exists(text(name, real_part))) {
        const std::vector<double> re = read_doubles(text(name, real_part)),
                                  im = read_doubles(text(name, imaginary_part));
        if (re.size() != im.size())
            throw FileError(impl_->path, text(name, ": ", re.size(), " real parts, ", im.size(), " imaginary parts"));
        std::vector<std::complex<double>> z(re.size());
        for (std::size_t k = 0; k < z.size(); ++k) z[k] = {re[k], im[k]};
        return z;
    }
    const Handle dataset = readable().open_dataset(name);
    return source_dataset(*impl_, name, dataset).complex_numbers();
}

std::vector<std::string> Hdf5File::read_strings(std::string_view name) const {
    const Quiet quiet;
    const Handle dataset = readable().open_dataset(name);
    return source_dataset(*impl_, name, dataset).strings();
}

std::string Hdf5File::dimension(std::string_view dataset, std::size_t axis) const {
    const Quiet quiet;
    const Impl& impl = readable();
    const Handle opened = impl.open_dataset(dataset);
    const std::size_t axes = impl.shape(opened.get(), dataset).size();
    if (axis >= axes) throw InputError(text(impl.path, ": ", dataset, ": axis ", axis, " of ", axes));
    std::string name;
    const herr_t code = H5DSiterate_scales(opened.get(), static_cast<unsigned>(axis), nullptr, keep_name, &name);
    impl.ok(code, dataset, "be asked for its dimensions");
    return name;
}

std::string Hdf5File::string_attribute(std::string_view object, std::string_view attribute) const {
    const Quiet quiet;
    return with_attribute(readable(), object, attribute, [](const Source& s) { return s.strings(); });
}

double Hdf5File::double_attribute(std::string_view object, std::string_view attribute) const {
    const Quiet quiet;
    return with_attribute(readable(), object, attribute, [](const Source& s) { return s.doubles(); });
}

std::int64_t Hdf5File::int_attribute(std::string_view object, std::string_view attribute) const {
    const Quiet quiet;
    return with_attribute(readable(), object, attribute, [](const Source& s) { return s.ints(); });
}

}  // namespace cardan::solvers
