#include "solvers/hdf5/history.hpp"

#include "mbs/base/error.hpp"
#include "solvers/hdf5/detail/checks.hpp"
#include "solvers/hdf5/detail/history.hpp"
#include "solvers/hdf5/detail/history_writer.hpp"

#include <hdf5.h>

#include <algorithm>
#include <set>
#include <unistd.h>
#include <utility>

namespace cardan::solvers {

namespace {

void check(const std::string& path, const std::vector<Channel>& channels) {
    std::set<std::string> seen;
    for (const Channel& channel : channels) {
        if (channel.name.empty() || channel.units.empty() || channel.long_name.empty())
            throw InputError(path, "channel", text("'", channel.name, "'"), "name, units and long_name not empty");
        for (const std::string* words :
             {&channel.name, &channel.units, &channel.long_name, &channel.frame, &channel.point, &channel.alias})
            if (!detail::flaw(*words).empty())
                throw InputError(text(path, ": channel ", &channel - channels.data() + 1,
                                      ": a text has the character NUL or is not UTF-8"));
        for (const std::string& name : {channel.name, channel.alias})
            if (!name.empty() && !seen.insert(name).second)
                throw InputError(path, "name or alias of a channel", text("'", name, "', twice"), "unique");
    }
}

void check(const std::string& path, const HistoryStorage& storage) {
    constexpr int longest = 1 << 20;
    if (storage.chunk < 1 || storage.chunk > longest)
        throw InputError(path, "samples of a chunk", storage.chunk, text("1 ... ", longest));
    if (!(storage.flush_interval >= 0)) throw InputError(path, "flush interval [s]", storage.flush_interval, ">= 0");
}

/// First difference in names and units; empty: none.
std::string difference(const std::vector<Channel>& stored, const std::vector<Channel>& given) {
    const auto shown = [](const std::vector<Channel>& list, std::size_t i) {
        return i < list.size() ? text("'", list[i].name, "' [", list[i].units, "]") : std::string("none");
    };
    for (std::size_t i = 0; i < std::max(stored.size(), given.size()); ++i)
        if (shown(stored, i) != shown(given, i))
            return text("channel ", i + 1, " is ", shown(given, i), ", in the file ", shown(stored, i));
    return {};
}

Hdf5File create_journaled(const PendingFile& pending, detail::JournalLink& link) {
    const detail::Quiet quiet;
    auto impl = std::make_unique<Hdf5File::Impl>(pending.path());
    impl->in_place = true;
    link.disk = &impl->disk;
    const detail::Handle list = detail::creation_list(*impl);
    const detail::Handle access = detail::journaled_access(link);
    impl->ok(access.get(), "", "be created");
    link.held = pending.release();
    impl->file = H5Fcreate(pending.partial().c_str(), H5F_ACC_TRUNC, list.get(), access.get());
    if (link.held >= 0) ::close(std::exchange(link.held, -1));  // not even opened
    impl->ok(impl->file, "", "be created");
    return Hdf5File::Impl::wrap(std::move(impl));
}

/// While it lives, checkpoints are taken from an integrator.
class CheckpointsFrom {
public:
    CheckpointsFrom(const Integrator& integrator, HistoryWriter& into) : into_(into) {
        if (integrator.resumable()) into_.take_checkpoints([&integrator] { return integrator.checkpoint(); });
    }
    ~CheckpointsFrom() { into_.take_checkpoints({}); }
    CheckpointsFrom(const CheckpointsFrom&) = delete;
    CheckpointsFrom& operator=(const CheckpointsFrom&) = delete;

private:
    HistoryWriter& into_;
};

}  // namespace

HistoryWriter::HistoryWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HistoryWriter::HistoryWriter(HistoryWriter&&) noexcept = default;
HistoryWriter& HistoryWriter::operator=(HistoryWriter&&) noexcept = default;
HistoryWriter::~HistoryWriter() = default;

HistoryWriter HistoryWriter::create(const std::filesystem::path& path, const std::vector<Channel>& channels,
                                    const HistoryMetadata& about, const HistoryStorage& storage) {
    auto impl = std::make_unique<Impl>();
    impl->path = path.string();
    check(impl->path, channels);
    check(impl->path, storage);
    std::error_code code;
    if (!storage.replace && std::filesystem::is_regular_file(path, code))
        throw FileError(impl->path, "is there already; replace it only on purpose, or append to it");
    const PendingFile pending(path);
    try {
        impl->file = create_journaled(pending, impl->link);
        detail::write_about(*impl->file, about);
        detail::create_variables(*impl->file, channels, storage.chunk);
        impl->channels = channels;
        impl->chunk = static_cast<std::size_t>(storage.chunk);
        impl->open_variables(detail::variable_names(channels));
        impl->begin_writing(storage);
        pending.commit(storage.replace);
    } catch (...) {
        impl.reset();
        pending.discard();
        throw;
    }
    return HistoryWriter(std::move(impl));
}

HistoryWriter HistoryWriter::append_to(const std::filesystem::path& path, const std::vector<Channel>& channels,
                                       const HistoryStorage& storage) {
    auto impl = std::make_unique<Impl>();
    impl->path = path.string();
    check(impl->path, storage);
    impl->file = detail::open_journaled(impl->path, impl->link);
    const detail::StoredHistory stored = detail::read_stored(*impl->file);
    if (const std::string which = difference(stored.info.channels, channels); !which.empty())
        throw InputError(impl->path, "channels to append", which, "those of the file");
    impl->channels = channels;
    impl->chunk = static_cast<std::size_t>(stored.chunk);
    impl->stored = stored.info.checkpoint ? stored.info.checkpoint_rows : stored.info.rows;
    if (stored.info.checkpoint) impl->coordinates = stored.info.checkpoint->q.size();
    if (impl->stored > 0) impl->last_time = detail::read_rows(*impl->file, "time", impl->stored - 1, 1).front();
    impl->file->set_attribute("/", {detail::finished_attribute, std::int64_t{0}});
    impl->open_variables(stored.variables);
    impl->begin_writing(storage);
    return HistoryWriter(std::move(impl));
}

HistoryWriter::Impl& HistoryWriter::open() const {
    if (!impl_) throw InputError("HistoryWriter: the object was moved from");
    if (!impl_->file) throw InputError(text(impl_->path, ": the history is closed"));
    return *impl_;
}

void HistoryWriter::append(double time, std::span<const double> values) {
    open().append(time, values);
}

void HistoryWriter::take_checkpoints(std::function<Checkpoint()> source) {
    if (source) (void)open();
    if (impl_) impl_->source = std::move(source);
}

void HistoryWriter::flush() {
    open().flush();
}

void HistoryWriter::finish() {
    Impl& impl = open();
    try {
        impl.finish(nullptr);
    } catch (...) {
        impl.give_up();
        throw;
    }
}

void HistoryWriter::finish(const IntegrationStatistics& statistics) {
    Impl& impl = open();
    try {
        impl.finish(&statistics);
    } catch (...) {
        impl.give_up();
        throw;
    }
}

const std::string& HistoryWriter::path() const {
    if (!impl_) throw InputError("HistoryWriter: the object was moved from");
    return impl_->path;
}

const std::vector<Channel>& HistoryWriter::channels() const {
    return open().channels;
}

std::size_t HistoryWriter::rows() const {
    return open().stored + open().times.size();
}

std::size_t HistoryWriter::flushed_rows() const {
    return open().stored;
}

double HistoryWriter::last_time() const {
    return open().last_time;
}

Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, HistoryWriter& into) {
    if (const std::string which = difference(into.channels(), recorder.channels()); !which.empty())
        throw InputError(into.path(), "channels to record", which, "those of the file");
    const CheckpointsFrom checkpoints(integrator, into);
    const std::vector<double> left(std::ranges::upper_bound(times, into.last_time()), times.end());
    Advance result = record(integrator, recorder, left,
                            [&](double time, const std::vector<double>& values) { into.append(time, values); });
    into.flush();
    return result;
}

}  // namespace cardan::solvers
