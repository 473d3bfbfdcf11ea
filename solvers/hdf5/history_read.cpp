#include "mbs/base/error.hpp"
#include "solvers/hdf5/detail/history.hpp"
#include "solvers/hdf5/detail/structure.hpp"

#include <hdf5.h>

#include <algorithm>

namespace cardan::solvers {
namespace detail {

Hdf5File open_journaled(const std::string& path, JournalLink& link) {
    const Quiet quiet;
    Hdf5File::Impl::check_readable(path);
    check_beginning(path);
    auto impl = std::make_unique<Hdf5File::Impl>(path);
    impl->in_place = !link.reading;
    link.disk = &impl->disk;
    const Handle access = journaled_access(link);
    impl->ok(access.get(), "", "be opened");
    impl->file = H5Fopen(path.c_str(), link.reading ? H5F_ACC_RDONLY : H5F_ACC_RDWR, access.get());
    impl->ok(impl->file, "", "be opened as an HDF5 file");
    impl->journal = link.file;
    return Hdf5File::Impl::wrap(std::move(impl));
}

HistorySource::HistorySource(std::string path) : path_(std::move(path)) {
    open();
}

void HistorySource::open() {
    if (file_ && !link_.file->stale()) return;
    const bool again = file_.has_value();
    file_.reset();
    link_ = {.reading = true};
    file_ = open_journaled(path_, link_);
    const struct stat& found = link_.file->found();
    if (!again) first_ = found;
    if (found.st_dev != first_.st_dev || found.st_ino != first_.st_ino)
        throw FileError(path_, "was replaced by another file while it was read");
}

}  // namespace detail

namespace {

using detail::HistorySource;
using detail::StoredHistory;

/// With how the file was found; channel by channel, because a reader must not hold up a writer for long.
StoredHistory stored_history(HistorySource& source) {
    StoredHistory stored = source.read([&](const Hdf5File& file) {
        StoredHistory frame = detail::read_frame(file);
        frame.info.being_written = source.live();
        frame.info.needs_repair = !source.live() && (source.journal_found() || source.disk_size() != source.end());
        return frame;
    });
    for (const std::string& name : stored.variables)
        stored.info.channels.push_back(
            source.read([&](const Hdf5File& file) { return detail::read_channel(file, name, stored.info.rows); }));
    return stored;
}

/// Indices of the chosen channels in the order in which they are asked for.
std::vector<std::size_t> chosen(const HistoryInfo& info, const HistorySelection& selection) {
    std::vector<std::size_t> indices;
    if (selection.channels.empty())
        for (std::size_t i = 0; i < info.channels.size(); ++i) indices.push_back(i);
    const History names{info.about.title, info.channels, {}, {}};
    for (const std::string& channel : selection.channels) indices.push_back(names.index(channel));
    return indices;
}

}  // namespace

HistoryInfo read_history_info(const std::filesystem::path& path) {
    HistorySource source(path.string());
    return stored_history(source).info;
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path) {
    return read_history_info(path).checkpoint;
}

History read_history(const std::filesystem::path& path, const HistorySelection& selection) {
    HistorySource source(path.string());
    const StoredHistory stored = stored_history(source);
    const std::size_t rows = stored.info.rows;  // those that a writer adds meanwhile are not for us
    const auto read = [&](const std::string& name, std::size_t first, std::size_t count) {
        return source.read([&](const Hdf5File& file) { return detail::read_rows(file, name, first, count); });
    };
    History history;
    history.title = stored.info.about.title;
    const std::vector<double> time = read("time", 0, rows);
    const auto from = std::ranges::lower_bound(time, selection.from);
    const auto to = std::max(from, std::ranges::upper_bound(time, selection.to));
    history.time.assign(from, to);
    for (const std::size_t i : chosen(stored.info, selection)) {
        history.channels.push_back(stored.info.channels[i]);
        history.values.push_back(
            read(stored.variables[i], static_cast<std::size_t>(from - time.begin()), history.time.size()));
    }
    return history;
}

HistoryRepair repair_history(const std::filesystem::path& path) {
    const HistoryInfo info = read_history_info(path);
    if (!info.needs_repair && !info.being_written) return {};
    detail::JournalLink link{.reading = false};
    const Hdf5File file = detail::open_journaled(path.string(), link);  // completes a flush that was broken off
    (void)detail::read_stored(file);
    const auto size = static_cast<std::uint64_t>(link.file->found().st_size);
    const HistoryRepair repair{link.file->journal_found(), size - std::min(size, link.end)};
    detail::commit(link);  // cuts the file off at its end
    if (link.disk->error != 0) Hdf5File::Impl::of(file).fail("", "be repaired");
    return repair;
}

}  // namespace cardan::solvers
