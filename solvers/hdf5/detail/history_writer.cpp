#include "solvers/hdf5/detail/history_writer.hpp"

#include "mbs/base/error.hpp"

#include <hdf5.h>

#include <cmath>

namespace cardan::solvers {

using detail::Handle;
using detail::Quiet;
using Clock = std::chrono::steady_clock;

void HistoryWriter::Impl::give_up() noexcept {
    try {
        if (file && !raw().failed && link.commit_at_close) write([] {});
    } catch (const std::exception&) {  // whoever gives up has an error already; what was flushed stands
    }
    variables.clear();
    file.reset();
}

void HistoryWriter::Impl::open_variables(const std::vector<std::string>& names) {
    variables.push_back(detail::open_variable(*file, "time"));
    for (const std::string& name : names) variables.push_back(detail::open_variable(*file, name));
}

void HistoryWriter::Impl::begin_writing(const HistoryStorage& storage) {
    link.file->synchronise(storage.synchronise);
    link.commit_at_close = true;
    flush_interval = storage.flush_interval;
    times.reserve(chunk);
    values.reserve(chunk * channels.size());
    write([] {});
}

void HistoryWriter::Impl::check_alive() const {
    if (raw().failed)
        throw FileError(path, text("cannot be continued: an earlier write failed; ", stored, " rows are in the file"));
}

void HistoryWriter::Impl::append(double time, std::span<const double> row) {
    check_alive();
    if (!std::isfinite(time) || !(time > last_time))
        throw InputError(path, "time [s]", time, text("finite and later than that of the row before, ", last_time));
    if (row.size() != channels.size())
        throw InputError(path, "number of values", row.size(), text(channels.size(), ", one per channel"));
    times.push_back(time);
    values.insert(values.end(), row.begin(), row.end());
    last_time = time;
    const std::chrono::duration<double> passed = Clock::now() - flushed_at;
    if ((stored + times.size()) % chunk == 0 || passed.count() >= flush_interval) flush();
}

std::optional<Checkpoint> HistoryWriter::Impl::take_checkpoint() {
    if (!source) return {};
    Checkpoint checkpoint = source();
    if (checkpoint.time < last_time)
        throw InputError(path, "time of the checkpoint [s]", checkpoint.time,
                         text("at least that of the last row, ", last_time));
    if (coordinates < 0) coordinates = checkpoint.q.size();
    if (checkpoint.q.size() != coordinates || checkpoint.qd.size() != coordinates)
        throw InputError(path, "coordinates of the checkpoint", checkpoint.q.size(),
                         text(coordinates, ", as in earlier ones"));
    return checkpoint;
}

void HistoryWriter::Impl::flush() {
    check_alive();
    const std::optional<Checkpoint> checkpoint = take_checkpoint();
    if (times.empty() && !checkpoint) return;
    write([&] {
        if (checkpoint) detail::put_checkpoint(*file, *checkpoint, stored + times.size());
    });
}

void HistoryWriter::Impl::finish(const IntegrationStatistics* statistics) {
    const Quiet quiet;
    check_alive();
    const std::optional<Checkpoint> checkpoint = take_checkpoint();
    link.file->synchronise(true);
    write([&] {
        if (checkpoint) detail::put_checkpoint(*file, *checkpoint, stored + times.size());
        if (statistics) detail::put_statistics(*file, *statistics);
        file->set_attribute("/", {detail::finished_attribute, std::int64_t{1}});
    });
    variables.clear();
    raw().change("", [&] { raw().ok(raw().close(), "", "be completed"); });
    file.reset();
}

/// The rows that are not stored yet, and more, in one commit.
template <class Extras>
void HistoryWriter::Impl::write(const Extras& extras) {
    const Quiet quiet;
    try {
        raw().change("", [&] {
            extras();
            set_length(stored + times.size());
            std::vector<double> column(times.size());
            for (std::size_t i = 0; i < variables.size() && !times.empty(); ++i) write_column(i, column);
            raw().ok(H5Fflush(raw().file, H5F_SCOPE_GLOBAL), "", "be flushed");
            detail::commit(link);
        });
    } catch (...) {
        link.commit_at_close = false;
        throw;
    }
    stored += times.size();
    times.clear();
    values.clear();
    flushed_at = Clock::now();
}

void HistoryWriter::Impl::set_length(std::size_t rows) const {
    const hsize_t length = rows;
    for (const Handle& variable : variables)
        raw().ok(H5Dset_extent(variable.get(), &length), "length of the variables", "be changed");
}

void HistoryWriter::Impl::write_column(std::size_t variable, std::vector<double>& column) const {
    for (std::size_t row = 0; row < times.size(); ++row)
        column[row] = variable == 0 ? times[row] : values[row * channels.size() + variable - 1];
    const std::string& name = variable == 0 ? "time" : channels[variable - 1].name;
    const hid_t id = variables[variable].get();
    const hsize_t first = stored, count = column.size();
    const Handle memory = raw().own(H5Screate_simple(1, &count, nullptr), H5Sclose, name, "be written");
    const Handle space = raw().own(H5Dget_space(id), H5Sclose, name, "be written");
    raw().ok(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr), name, "be written");
    raw().ok(H5Dwrite(id, H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, column.data()), name,
             "be written");
}

}  // namespace cardan::solvers
