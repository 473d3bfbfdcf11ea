#include "mbs/base/error.hpp"
#include "mbs/base/version.hpp"
#include "solvers/hdf5/detail/history.hpp"
#include "solvers/hdf5/detail/structure.hpp"

#include <hdf5.h>

#include <algorithm>
#include <limits>
#include <set>

namespace cardan::solvers::detail {
namespace {

constexpr unsigned keep_order = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
constexpr unsigned deflate_level = 4;
constexpr std::size_t longest_name = 200;  // bytes; netCDF allows 256
// Attributes of a variable lie in its header up to this number, with an index of their own beyond it.
constexpr unsigned compact_attributes = 32;

/// Attribute `frame` of channels without a direction.
constexpr const char* no_frame = "none";

constexpr const char* description_name = "run/input_description";

/// Storage that file.write() cannot make: without an end, filled with NaN.
Handle storage_of_variables(const Hdf5File::Impl& impl, int chunk) {
    Handle list = impl.own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "", "be created");
    const hsize_t length = static_cast<hsize_t>(chunk);
    const double no_value = std::numeric_limits<double>::quiet_NaN();
    H5Pset_attr_creation_order(list.get(), keep_order);
    H5Pset_attr_phase_change(list.get(), compact_attributes, compact_attributes / 2);
    H5Pset_obj_track_times(list.get(), false);
    H5Pset_chunk(list.get(), 1, &length);
    H5Pset_fill_value(list.get(), H5T_NATIVE_DOUBLE, &no_value);
    H5Pset_shuffle(list.get());
    H5Pset_deflate(list.get(), deflate_level);
    H5Pset_fletcher32(list.get());
    return list;
}

void create_variable(Hdf5File& file, const std::string& name, const Handle& storage) {
    const Quiet quiet;
    Hdf5File::Impl& impl = Hdf5File::Impl::of(file);
    impl.change(name, [&] {
        const hsize_t none = 0, no_end = H5S_UNLIMITED;
        const Handle space = impl.own(H5Screate_simple(1, &none, &no_end), H5Sclose, name, "be created");
        const Handle link = impl.own(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name, "be created");
        H5Pset_char_encoding(link.get(), H5T_CSET_UTF8);
        Handle made = impl.own(
            H5Dcreate2(impl.file, name.c_str(), H5T_IEEE_F64LE, space.get(), link.get(), storage.get(), H5P_DEFAULT),
            H5Dclose, name, "be created");
        impl.ok(made.close(), name, "be created");
    });
}

bool letter(unsigned char c) {
    return c == '_' || c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// netCDF: no '/', no control characters, no blank at the end, the first character a letter, a digit or '_'.
std::string netcdf_name(std::string name) {
    for (char& c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '/' || code < 0x20 || code == 0x7f) c = '_';
    }
    if (name.size() > longest_name) {
        std::size_t end = longest_name;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;  // inside of a character
        name.resize(end);
    }
    if (name.back() == ' ') name.back() = '_';
    return letter(static_cast<unsigned char>(name.front())) ? name : "_" + name;
}

// The version comes first: texts of version 1 lie in a heap without checksums.
void check_format(const Hdf5File& file) {
    const bool versioned = file.has_attribute("/", "format") && file.has_attribute("/", "format_version");
    const std::int64_t version = versioned ? file.int_attribute("/", "format_version") : history_format_version;
    if (version != history_format_version)
        throw FileError(file.path(), text("is a history of format version ", version, "; this program reads version ",
                                          history_format_version,
                                          "; h5py, xarray and ncdump read it, a new run makes "
                                          "a new one"));
    if (!versioned || file.string_attribute("/", "format") != history_format)
        throw FileError(file.path(), text("is an HDF5 file, but no history: it lacks the attribute format = \"",
                                          history_format, "\""));
}

std::size_t length_of(const Hdf5File& file, const std::string& name) {
    const Shape shape = file.shape(name);
    if (shape.size() != 1) throw FileError(file.path(), text(name, ": has ", shape.size(), " axes, not one"));
    return shape.front();
}

int chunk_of(const Hdf5File::Impl& impl, const std::string& name) {
    const Quiet quiet;
    const Handle dataset = impl.open_dataset(name);
    const Handle list = impl.own(H5Dget_create_plist(dataset.get()), H5Pclose, name, "be read");
    hsize_t length = 0;
    impl.ok(H5Pget_chunk(list.get(), 1, &length), name, "be read in chunks");
    return static_cast<int>(length);
}

}  // namespace

std::vector<std::string> variable_names(const std::vector<Channel>& channels) {
    std::set<std::string> taken{"time", "run"};
    std::vector<std::string> names;
    for (const Channel& channel : channels) {
        const std::string plain = netcdf_name(channel.name);
        std::string name = plain;
        for (int i = 2; !taken.insert(name).second; ++i) name = text(plain, "_", i);
        names.push_back(name);
    }
    return names;
}

Handle creation_list(const Hdf5File::Impl& impl) {
    Handle list = impl.own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "", "be created");
    H5Pset_link_creation_order(list.get(), keep_order);
    H5Pset_attr_creation_order(list.get(), keep_order);
    H5Pset_obj_track_times(list.get(), false);
    return list;
}

void write_about(Hdf5File& file, const HistoryMetadata& about) {
    const std::pair<const char*, std::string> texts[] = {
        {"title", about.title},     {"Conventions", "CF-1.8"},           {"format", history_format},
        {"program", about.program}, {"version", std::string(version())}, {"method", about.method}};
    for (const auto& [name, value] : texts) file.set_attribute("/", {name, value});
    file.set_attribute("/", {"format_version", std::int64_t{history_format_version}});
    file.set_attribute("/", {finished_attribute, std::int64_t{0}});
    file.write(description_name, std::vector<std::string>{about.description}, {}, "text that the run was made from");
}

void create_variables(Hdf5File& file, const std::vector<Channel>& channels, int chunk) {
    const Handle storage = storage_of_variables(Hdf5File::Impl::of(file), chunk);
    create_variable(file, "time", storage);
    file.set_attribute("time", {"units", "s"});
    file.set_attribute("time", {"long_name", "time"});
    file.set_attribute("time", {"axis", "T"});
    file.make_dimension("time");
    const std::vector<std::string> names = variable_names(channels);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const Channel& c = channels[i];
        create_variable(file, names[i], storage);
        for (const auto& [attribute, value] : {std::pair{"units", c.units},
                                               {"long_name", c.long_name},
                                               {"channel", c.name},
                                               {"frame", c.frame.empty() ? no_frame : c.frame},
                                               {"point", c.point},
                                               {"alias", c.alias}})
            if (!value.empty()) file.set_attribute(names[i], {attribute, value});
        file.attach(names[i], 0, "time");
    }
}

Handle open_variable(const Hdf5File& file, const std::string& name) {
    const Quiet quiet;
    const Hdf5File::Impl& impl = Hdf5File::Impl::of(file);
    const Handle list = impl.own(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, name, "be opened");
    const std::size_t chunk = static_cast<std::size_t>(chunk_of(impl, name)) * sizeof(double);
    H5Pset_chunk_cache(list.get(), 1, chunk, 1);
    return impl.own(H5Dopen2(impl.file, name.c_str(), list.get()), H5Dclose, name, "be opened");
}

StoredHistory read_frame(const Hdf5File& file) {
    check_format(file);
    StoredHistory stored;
    HistoryInfo& info = stored.info;
    const auto attribute = [&](const char* name) { return file.string_attribute("/", name); };
    info.about = {attribute("title"), attribute("method"), file.read_strings(description_name).front(),
                  attribute("program")};
    info.version = attribute("version");
    info.finished = file.int_attribute("/", finished_attribute) != 0;
    info.rows = length_of(file, "time");
    check_chunks(file, "time");
    stored.chunk = chunk_of(Hdf5File::Impl::of(file), "time");
    for (const std::string& name : file.children())
        if (name != "time" && file.has_attribute(name, "channel")) stored.variables.push_back(name);
    const auto time = [&](std::size_t row) { return read_rows(file, "time", row, 1).front(); };
    info.first_time = info.rows > 0 ? time(0) : std::numeric_limits<double>::quiet_NaN();
    info.last_time = info.rows > 0 ? time(info.rows - 1) : info.first_time;
    read_state(file, info);
    return stored;
}

Channel read_channel(const Hdf5File& file, const std::string& variable, std::size_t rows) {
    if (const std::size_t length = length_of(file, variable); length < rows)
        throw FileError(file.path(), text(variable, ": has ", length, " values, time has ", rows));
    check_chunks(file, variable);
    const auto attribute = [&](const char* which) {
        return file.has_attribute(variable, which) ? file.string_attribute(variable, which) : std::string();
    };
    const std::string frame = attribute("frame");
    return {attribute("channel"),           attribute("units"), attribute("long_name"),
            frame == no_frame ? "" : frame, attribute("point"), attribute("alias")};
}

StoredHistory read_stored(const Hdf5File& file) {
    StoredHistory stored = read_frame(file);
    for (const std::string& name : stored.variables)
        stored.info.channels.push_back(read_channel(file, name, stored.info.rows));
    return stored;
}

std::vector<double> read_rows(const Hdf5File& file, const std::string& variable, std::size_t first, std::size_t count) {
    const Quiet quiet;
    const Hdf5File::Impl& impl = Hdf5File::Impl::of(file);
    const Handle dataset = impl.open_dataset(variable);
    const Handle space = impl.own(H5Dget_space(dataset.get()), H5Sclose, variable, "be read");
    const hsize_t start = first, length = count;
    impl.ok(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &start, nullptr, &length, nullptr), variable, "be read");
    const Handle memory = impl.own(H5Screate_simple(1, &length, nullptr), H5Sclose, variable, "be read");
    std::vector<double> values(count);
    impl.ok(H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()), variable,
            "be read");
    return values;
}

}  // namespace cardan::solvers::detail
