#include "solvers/hdf5/history_recording.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace cardan::solvers {

namespace {

void take_checkpoints(HistoryWriter& writer, Integrator& integrator) {
    if (integrator.resumable()) writer.take_checkpoints([&integrator] { return integrator.checkpoint(); });
}

// Of the channels that are kept, ascending.
std::vector<std::size_t> columns_of(const History& names, const std::vector<std::string>& kept) {
    std::vector<std::size_t> columns;
    if (kept.empty()) {
        columns.resize(names.channels.size());
        std::iota(columns.begin(), columns.end(), std::size_t{0});
        return columns;
    }
    for (const std::string& channel : kept) columns.push_back(names.index(channel));
    std::ranges::sort(columns);
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
}

}  // namespace

HistoryRecording::HistoryRecording(const std::string& title, const Recorder& recorder,
                                   const std::vector<std::string>& kept, const std::filesystem::path& file)
    : columns_(columns_of({title, recorder.channels(), {}, {}}, kept)), file_(kept.empty() ? "" : file) {
    history_.title = title;
    history_.values.resize(columns_.size());
    for (const std::size_t column : columns_) history_.channels.push_back(recorder.channels()[column]);
}

HistoryRecording::HistoryRecording(const std::string& title, const Recorder& recorder,
                                   const std::vector<std::string>& kept)
    : HistoryRecording(title, recorder, kept, {}) {}

HistoryRecording::HistoryRecording(const std::filesystem::path& file, const HistoryMetadata& about,
                                   Integrator& integrator, const Recorder& recorder,
                                   const std::vector<std::string>& kept)
    : HistoryRecording(about.title, recorder, kept, file) {
    writer_ = HistoryWriter::create(file, recorder.channels(), about, {.replace = true});
    take_checkpoints(*writer_, integrator);
}

HistoryRecording::HistoryRecording(const std::filesystem::path& file, Integrator& integrator, const Recorder& recorder,
                                   const std::vector<std::string>& kept)
    : HistoryRecording("", recorder, kept, file) {
    if (file_.empty()) history_ = read_history(file);
    writer_ = HistoryWriter::append_to(file, recorder.channels());
    take_checkpoints(*writer_, integrator);
    if (!file_.empty()) return;
    // What came after the checkpoint comes again.
    history_.time.resize(writer_->rows());
    for (std::vector<double>& values : history_.values) values.resize(writer_->rows());
}

// -infinity: no rows yet.
double HistoryRecording::last_time() const {
    if (writer_) return writer_->last_time();
    return history_.time.empty() ? -std::numeric_limits<double>::infinity() : history_.time.back();
}

bool HistoryRecording::append(double time, const std::vector<double>& values) {
    if (time <= last_time()) return false;
    if (writer_) writer_->append(time, values);
    if (!file_.empty()) return true;
    history_.time.push_back(time);
    for (std::size_t i = 0; i < columns_.size(); ++i) history_.values[i].push_back(values[columns_[i]]);
    return true;
}

void HistoryRecording::close(bool complete) {
    if (!writer_) return;
    if (complete)
        writer_->finish();
    else
        writer_->flush();
    writer_.reset();
    if (file_.empty()) return;
    std::vector<std::string> names;
    names.reserve(history_.channels.size());
    for (const Channel& channel : history_.channels) names.push_back(channel.name);
    history_ = read_history(file_, {.channels = names});
}

}  // namespace cardan::solvers
