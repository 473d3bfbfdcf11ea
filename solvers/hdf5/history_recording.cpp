#include "solvers/hdf5/history_recording.hpp"

#include <utility>

namespace cardan::solvers {

namespace {

void take_checkpoints(HistoryWriter& writer, Integrator& integrator) {
    if (integrator.resumable()) writer.take_checkpoints([&integrator] { return integrator.checkpoint(); });
}

}  // namespace

HistoryRecording::HistoryRecording(const std::string& title, const Recorder& recorder)
    : history_{title, recorder.channels(), {}, std::vector<std::vector<double>>(recorder.channels().size())} {}

HistoryRecording::HistoryRecording(const std::filesystem::path& file, const HistoryMetadata& about,
                                   Integrator& integrator, const Recorder& recorder)
    : HistoryRecording(about.title, recorder) {
    writer_ = HistoryWriter::create(file, recorder.channels(), about, {.replace = true});
    take_checkpoints(*writer_, integrator);
}

HistoryRecording::HistoryRecording(const std::filesystem::path& file, Integrator& integrator, const Recorder& recorder)
    : history_(read_history(file)), writer_(HistoryWriter::append_to(file, recorder.channels())) {
    take_checkpoints(*writer_, integrator);
    // What came after the checkpoint comes again.
    history_.time.resize(writer_->rows());
    for (std::vector<double>& values : history_.values) values.resize(writer_->rows());
}

bool HistoryRecording::append(double time, const std::vector<double>& values) {
    if (!history_.time.empty() && time <= history_.time.back()) return false;
    if (writer_) writer_->append(time, values);
    history_.time.push_back(time);
    for (std::size_t i = 0; i < values.size(); ++i) history_.values[i].push_back(values[i]);
    return true;
}

void HistoryRecording::close(bool complete) {
    if (!writer_) return;
    if (complete)
        writer_->finish();
    else
        writer_->flush();
    writer_.reset();
}

}  // namespace cardan::solvers
