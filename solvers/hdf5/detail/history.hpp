/// @file
/// Layout of histories, shared by writer and reader. Internal: not for users of the library.
#pragma once

#include "solvers/hdf5/detail/file.hpp"
#include "solvers/hdf5/detail/journal_driver.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"

#include <string>
#include <vector>

namespace cardan::solvers::detail {

/// Value of the attribute `format` of the root.
constexpr const char* history_format = "cardan history";
constexpr int history_format_version = 2;

/// Names of the variables that hold the channels: the channel names, as far as netCDF allows them.
[[nodiscard]] std::vector<std::string> variable_names(const std::vector<Channel>& channels);

/// Creation properties of a new file.
[[nodiscard]] Handle creation_list(const Hdf5File::Impl& impl);
/// Everything but the time and the channels.
void write_about(Hdf5File& file, const HistoryMetadata& about);
/// The time and the channels, without rows.
void create_variables(Hdf5File& file, const std::vector<Channel>& channels, int chunk);
/// Name of the attribute that says whether the history is finished.
constexpr const char* finished_attribute = "finished";

/// @param rows  rows up to the checkpoint
void put_checkpoint(Hdf5File& file, const Checkpoint& checkpoint, std::size_t rows);
void put_statistics(Hdf5File& file, const IntegrationStatistics& statistics);
/// Statistics and checkpoint, if there are any.
void read_state(const Hdf5File& file, HistoryInfo& info);

/// A data set of one axis, opened to be lengthened and written, with room for one chunk in memory.
[[nodiscard]] Handle open_variable(const Hdf5File& file, const std::string& name);

/// Stored contents; being_written and needs_repair are not known here.
struct StoredHistory {
    HistoryInfo info;
    std::vector<std::string> variables;  ///< one per channel
    int chunk = 1;
};
/// All but the channels.  @throws FileError if it is no history or if its parts do not fit together
[[nodiscard]] StoredHistory read_frame(const Hdf5File& file);
/// @param rows  number of values that the variable must have
[[nodiscard]] Channel read_channel(const Hdf5File& file, const std::string& variable, std::size_t rows);
/// Reads frame and channels.
[[nodiscard]] StoredHistory read_stored(const Hdf5File& file);
/// Rows first ... first + count - 1 of a variable.
[[nodiscard]] std::vector<double> read_rows(const Hdf5File& file, const std::string& variable, std::size_t first,
                                            std::size_t count);

/// Opens as link.reading says; the link must outlive the file.
[[nodiscard]] Hdf5File open_journaled(const std::string& path, JournalLink& link);

/// A history open for reading, whether or not somebody writes it.
class HistorySource {
public:
    explicit HistorySource(std::string path);
    HistorySource(const HistorySource&) = delete;
    HistorySource& operator=(const HistorySource&) = delete;
    ~HistorySource() = default;

    /// Calls use(file), during which no writer's flush becomes visible; one may occur between two calls.
    template <class Use>
    auto read(const Use& use) {
        for (int i = 0; i < attempts; ++i) {
            open();
            try {
                auto result = use(*file_);
                if (!link_.file->expired()) return result;
            } catch (const FileError&) {
                if (!link_.file->expired()) throw;
            }
        }
        throw FileError(path_, "is being written, and this program was stopped several times while reading it");
    }

    [[nodiscard]] bool live() const { return link_.file->live(); }
    [[nodiscard]] bool journal_found() const { return link_.file->journal_found(); }
    /// Length of the contents, and of the file on the disk as it was found.
    [[nodiscard]] std::uint64_t end() const { return link_.end; }
    [[nodiscard]] std::uint64_t disk_size() const { return static_cast<std::uint64_t>(link_.file->found().st_size); }

private:
    static constexpr int attempts = 5;
    void open();

    std::string path_;
    JournalLink link_;
    struct stat first_ {};  ///< of the first opening
    std::optional<Hdf5File> file_;
};

}  // namespace cardan::solvers::detail
