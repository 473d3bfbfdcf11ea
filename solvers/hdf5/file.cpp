#include "solvers/hdf5/file.hpp"

#include "mbs/base/error.hpp"
#include "solvers/hdf5/detail/checks.hpp"
#include "solvers/hdf5/detail/file.hpp"
#include "solvers/hdf5/detail/storage.hpp"
#include "solvers/hdf5/detail/text.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace cardan::solvers {
namespace {

using detail::check_attributes;
using detail::checked_attributes;
using detail::checked_name;
using detail::flaw;
using detail::Handle;
using detail::Quiet;
using detail::refuse;

constexpr unsigned keep_order = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
constexpr std::size_t big_array = 32768;       // bytes; smaller ones lie in the header, whose checksum they share
constexpr std::size_t largest_chunk = 524288;  // bytes; two of them fit into the chunk cache of the C library
constexpr unsigned deflate_level = 1;          // of shuffled doubles; 4 saves one per cent more

void check_fill(const std::string& path, std::string_view name, std::size_t given, const Shape& shape) {
    std::size_t count = std::ranges::count(shape, 0U) > 0 ? 0 : 1;
    for (const std::size_t n : shape)
        if (n != 0 && __builtin_mul_overflow(count, n, &count))
            refuse(path, name, text(given, " values do not fill a shape of more than 2^64"));
    if (count != given) refuse(path, name, text(given, " values do not fill a shape of ", count));
}

/// Every value has a checksum: that of the header, in which small arrays lie, or that of its chunk. Chunks have at most
/// largest_chunk bytes and are cut along the slowest axes first.
void set_layout(hid_t list, std::vector<hsize_t> extents, std::size_t bytes_per_value) {
    const auto bytes = [&] {
        hsize_t product = bytes_per_value;
        for (const hsize_t n : extents) product *= n;
        return product;
    };
    if (bytes() == 0) return;
    if (extents.empty() || bytes() < big_array) {
        H5Pset_layout(list, H5D_COMPACT);
        return;
    }
    for (hsize_t& n : extents) {
        while (n > 1 && bytes() > largest_chunk) n = (n + 1) / 2;
    }
    H5Pset_chunk(list, static_cast<int>(extents.size()), extents.data());
    H5Pset_shuffle(list);
    H5Pset_deflate(list, deflate_level);
    H5Pset_fletcher32(list);
}

/// The steps of writing that several members need.
struct Hdf5Writer {
    Hdf5File::Impl& impl;

    void put_attribute(hid_t object, std::string_view where, const Attribute& a) const {
        const std::string what = text(where, ", attribute ", a.name);
        if (impl.ok(H5Aexists(object, a.name.c_str()), what, "be found") > 0) {
            impl.ok(H5Adelete(object, a.name.c_str()), what, "be replaced");
        }
        const Handle space = impl.own(H5Screate(H5S_SCALAR), H5Sclose, what, "be created");
        const auto put = [&](hid_t memory, hid_t stored, const void* value) {
            Handle made = impl.own(H5Acreate2(object, a.name.c_str(), stored, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                                   H5Aclose, what, "be created");
            impl.ok(H5Awrite(made.get(), memory, value), what, "be written");
            impl.ok(made.close(), what, "be written");
        };
        if (const auto* s = std::get_if<std::string>(&a.value)) {
            const Handle type = detail::text_type(s->size());
            put(type.get(), type.get(), s->c_str());
        } else if (const auto* x = std::get_if<double>(&a.value)) {
            put(H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, x);
        } else {
            put(H5T_NATIVE_INT64, H5T_STD_I64LE, &std::get<std::int64_t>(a.value));
        }
    }

    /// The groups above the last part of the name, and that one too when asked for.
    void ensure_groups(const std::string& name, bool with_last) const {
        const Handle list = impl.own(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, name, "be created");
        H5Pset_link_creation_order(list.get(), keep_order);
        H5Pset_attr_creation_order(list.get(), keep_order);
        H5Pset_obj_track_times(list.get(), false);
        for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
            if (end == std::string::npos && !with_last) return;
            const std::string part = name.substr(0, end);
            if (!impl.exists(part)) {
                const hid_t id = H5Gcreate2(impl.file, part.c_str(), H5P_DEFAULT, list.get(), H5P_DEFAULT);
                Handle made = impl.own(id, H5Gclose, text("group ", part), "be created");
                impl.ok(made.close(), part, "be written");
            }
            if (end == std::string::npos) return;
        }
    }

    struct Array {
        const void* data;
        std::size_t count;
        hid_t memory_type;
        hid_t file_type;
        std::size_t bytes_per_value;
    };

    void put_array(std::string_view given_name, const Array& array, const Shape& shape,
                   const Attributes& attributes) const {
        const std::string name = checked_name(impl.path, given_name);
        check_fill(impl.path, name, array.count, shape);
        if (shape.size() > H5S_MAX_RANK) refuse(impl.path, name, "too many axes");
        if (impl.exists(name)) refuse(impl.path, name, "exists already");
        refuse_dataset_as_group(name);
        impl.change(name, [&] {
            ensure_groups(name, false);
            const std::vector<hsize_t> extents(shape.begin(), shape.end());
            const Handle space =
                impl.own(extents.empty() ? H5Screate(H5S_SCALAR)
                                         : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                         H5Sclose, name, "be created");
            const Handle list = impl.own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name, "be created");
            H5Pset_attr_creation_order(list.get(), keep_order);
            H5Pset_obj_track_times(list.get(), false);
            set_layout(list.get(), extents, array.bytes_per_value);
            const hid_t id =
                H5Dcreate2(impl.file, name.c_str(), array.file_type, space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT);
            Handle made = impl.own(id, H5Dclose, name, "be created");
            impl.ok(H5Dwrite(made.get(), array.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.data), name,
                    "be written");
            for (const Attribute& a : attributes) put_attribute(made.get(), name, a);
            impl.ok(made.close(), name, "be written");
        });
    }

    /// The scale, beside the data set, of the axis that runs over the characters of a text.
    std::string character_scale(const std::string& dataset, std::size_t length) const {
        const std::string plain = text(dataset.substr(0, dataset.rfind('/') + 1), "string", length);
        std::string name = plain;
        for (int i = 2; impl.exists(name); ++i) {
            if (is_character_scale(name, length)) return name;
            name = text(plain, "_", i);
        }
        impl.change(name, [&] {
            const hsize_t extent = length;
            const Handle space = impl.own(H5Screate_simple(1, &extent, nullptr), H5Sclose, name, "be created");
            const Handle list = impl.own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name, "be created");
            H5Pset_attr_creation_order(list.get(), keep_order);
            H5Pset_obj_track_times(list.get(), false);
            Handle made = impl.own(
                H5Dcreate2(impl.file, name.c_str(), H5T_IEEE_F32BE, space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
                H5Dclose, name, "be created");
            impl.ok(H5DSset_scale(made.get(), detail::name_without_values(length).c_str()), name, "become a dimension");
            impl.ok(made.close(), name, "be written");
        });
        return name;
    }

    bool is_character_scale(const std::string& name, std::size_t length) const {
        const Handle object = impl.open_object(name);
        return H5Iget_type(object.get()) == H5I_DATASET && H5DSis_scale(object.get()) > 0 &&
               impl.shape(object.get(), name) == Shape{length};
    }

    /// "a/b" cannot be made where a is a data set.
    void refuse_dataset_as_group(const std::string& name) const {
        for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
            const std::string part = name.substr(0, end);
            if (impl.exists(part) && H5Iget_type(impl.open_object(part).get()) != H5I_GROUP) {
                refuse(impl.path, name, text(part, " is a data set, not a group"));
            }
        }
    }
};

}  // namespace

Hdf5File::Hdf5File(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
    const Quiet quiet;
    auto impl = std::make_unique<Impl>(path.string());
    impl->pending.emplace(path);
    const Handle list = impl->own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "", "be created");
    H5Pset_link_creation_order(list.get(), keep_order);
    H5Pset_attr_creation_order(list.get(), keep_order);
    H5Pset_obj_track_times(list.get(), false);
    const Handle access = detail::writing_access(impl->disk);
    impl->ok(access.get(), "", "be created");
    impl->pending->hand_over();
    impl->file = H5Fcreate(impl->pending->partial().c_str(), H5F_ACC_TRUNC, list.get(), access.get());
    impl->ok(impl->file, "", "be created");
    if (impl->disk.error != 0) impl->fail("", "be created");
    return Hdf5File(std::move(impl));
}

void Hdf5File::write(std::string_view name, std::span<const double> values, const Shape& shape,
                     const Description& about) {
    const Quiet quiet;
    Impl& impl = writable();
    Hdf5Writer{impl}.put_array(name, {values.data(), values.size(), H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, sizeof(double)},
                               shape, checked_attributes(impl.path, name, about));
}

void Hdf5File::write(std::string_view name, std::span<const int> values, const Shape& shape, const Description& about) {
    const Quiet quiet;
    Impl& impl = writable();
    Hdf5Writer{impl}.put_array(name, {values.data(), values.size(), H5T_NATIVE_INT, H5T_STD_I32LE, sizeof(int)}, shape,
                               checked_attributes(impl.path, name, about));
}

void Hdf5File::write(std::string_view name, std::span<const std::int64_t> values, const Shape& shape,
                     const Description& about) {
    const Quiet quiet;
    Impl& impl = writable();
    Hdf5Writer{impl}.put_array(name,
                               {values.data(), values.size(), H5T_NATIVE_INT64, H5T_STD_I64LE, sizeof(std::int64_t)},
                               shape, checked_attributes(impl.path, name, about));
}

void Hdf5File::write(std::string_view name, std::span<const std::complex<double>> values, const Shape& shape,
                     const Description& about) {
    (void)checked_attributes(path(), name, about);
    const std::string clean = checked_name(path(), name);
    for (const char* part : {real_part, imaginary_part})
        if (has(text(clean, part))) refuse(path(), text(clean, part), "exists already");
    std::vector<double> part(values.size());
    std::ranges::transform(values, part.begin(), [](std::complex<double> z) { return z.real(); });
    write(text(clean, real_part), part, shape, {about.units, about.long_name + ", real part", about.more});
    std::ranges::transform(values, part.begin(), [](std::complex<double> z) { return z.imag(); });
    write(text(clean, imaginary_part), part, shape, {about.units, about.long_name + ", imaginary part", about.more});
}

void Hdf5File::write(std::string_view name, std::span<const std::string> values, const Shape& shape,
                     std::string_view long_name, const Attributes& more) {
    const Quiet quiet;
    Impl& impl = writable();
    if (long_name.empty()) refuse(impl.path, name, "long_name is missing");
    Attributes all{{"long_name", std::string(long_name)}};
    if (detail::may_be_decoded(values)) all.push_back({"_Encoding", "utf-8"});
    all.insert(all.end(), more.begin(), more.end());
    check_attributes(impl.path, name, all);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (const std::string why = flaw(values[i]); !why.empty()) refuse(impl.path, name, text("text ", i, " ", why));
    check_fill(impl.path, name, values.size(), shape);
    const detail::CharacterBlock block(values);
    const Handle type = detail::text_type(1);
    Shape extents = shape;
    extents.push_back(block.length);
    const Hdf5Writer writer{impl};
    writer.put_array(name, {block.characters.data(), block.characters.size(), type.get(), type.get(), 1}, extents, all);
    const std::string clean = checked_name(impl.path, name);
    attach(clean, shape.size(), writer.character_scale(clean, block.length));
}

void Hdf5File::make_group(std::string_view name, const Attributes& attributes) {
    const Quiet quiet;
    Impl& impl = writable();
    const std::string clean = checked_name(impl.path, name);
    const Hdf5Writer writer{impl};
    check_attributes(impl.path, clean, attributes);
    writer.refuse_dataset_as_group(clean + "/");
    impl.change(clean, [&] {
        writer.ensure_groups(clean, true);
        const Handle group = impl.open_object(clean);
        for (const Attribute& a : attributes) writer.put_attribute(group.get(), clean, a);
    });
}

void Hdf5File::set_attribute(std::string_view object, const Attribute& attribute) {
    const Quiet quiet;
    Impl& impl = writable();
    check_attributes(impl.path, object, {attribute});
    const Handle opened = impl.open_object(object);
    impl.change(object, [&] { Hdf5Writer{impl}.put_attribute(opened.get(), object, attribute); });
}

void Hdf5File::make_dimension(std::string_view name) {
    const Quiet quiet;
    Impl& impl = writable();
    const Handle dataset = impl.open_dataset(name);
    if (impl.shape(dataset.get(), name).size() != 1) refuse(impl.path, name, "a dimension has exactly one axis");
    if (H5DSis_scale(dataset.get()) > 0) refuse(impl.path, name, "is a dimension already");
    const std::string label(name.substr(name.rfind('/') + 1));
    impl.change(name, [&] { impl.ok(H5DSset_scale(dataset.get(), label.c_str()), name, "become a dimension"); });
}

void Hdf5File::make_index(std::string_view name, std::size_t count, std::string_view long_name) {
    std::vector<std::int64_t> index(count);
    std::iota(index.begin(), index.end(), 0);
    write(name, index, {count}, {"1", std::string(long_name)});
    make_dimension(name);
}

void Hdf5File::attach(std::string_view dataset, std::size_t axis, std::string_view scale) {
    const Quiet quiet;
    Impl& impl = writable();
    const Handle array = impl.open_dataset(dataset);
    const Handle dimension = impl.open_dataset(scale);
    const Shape extents = impl.shape(array.get(), dataset);
    if (H5DSis_scale(dimension.get()) <= 0) refuse(impl.path, scale, "is not a dimension; call make_dimension first");
    if (H5DSis_scale(array.get()) > 0) refuse(impl.path, dataset, "is itself a dimension");
    if (axis >= extents.size()) refuse(impl.path, dataset, text("axis ", axis, " of ", extents.size()));
    const std::size_t length = impl.shape(dimension.get(), scale).front();
    if (extents[axis] != length) {
        refuse(impl.path, dataset, text("axis ", axis, " has ", extents[axis], " values, ", scale, " has ", length));
    }
    impl.change(dataset, [&] {
        impl.ok(H5DSattach_scale(array.get(), dimension.get(), static_cast<unsigned>(axis)), dataset,
                text("get the dimension ", scale));
    });
}

void Hdf5File::flush() {
    const Quiet quiet;
    Impl& impl = writable();
    impl.change("", [&] { impl.ok(H5Fflush(impl.file, H5F_SCOPE_GLOBAL), "", "be flushed"); });
}

void Hdf5File::finish() {
    const Quiet quiet;
    Impl& impl = readable();
    if (!impl.pending) refuse(impl.path, "finish", "the file is open for reading");
    if (impl.failed) {
        impl.close();
        throw FileError(impl.path, text("cannot be completed: an earlier write failed; what there is lies in ",
                                        impl.pending->partial()));
    }
    herr_t code = H5Fflush(impl.file, H5F_SCOPE_GLOBAL);
    if (code >= 0 && impl.disk.error == 0) code = H5Fclose(std::exchange(impl.file, -1));
    if (code < 0 || impl.disk.error != 0) {
        try {
            impl.fail("", "be completed");
        } catch (...) {
            impl.close();
            throw;
        }
    }
    impl.pending->commit();
}

}  // namespace cardan::solvers
