/// @file
/// A file that changes in commits, each of which happens wholly or not at all, whenever its writer is killed.
/// Internal: not for users of the library.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace cardan::solvers::detail {

/// Bytes on the disk between commits are those of the last commit, so that any program can read them. What is written
/// below their end is held back in memory, in blocks; what is written behind it goes there at once, where nobody looks.
/// commit() then
///   1. writes the held-back blocks and a footer with a checksum, the journal, behind all that,
///   2. overwrites the first bytes, in which a format has its signature, by a mark,
///   3. writes the blocks to their places, those first bytes last,
///   4. cuts the journal off.
/// Killed in 1: the footer is not there, the last commit stands. Killed later: whoever opens the file next finds footer
/// and journal and has the new commit, a writer by doing 2 to 4 again, a reader in memory. A program that knows nothing
/// of journals finds no signature in what is neither the one nor the other, and refuses it.
///
/// Two kinds of locks: a writer holds flock() exclusively as long as it has the file open, as HDF5 itself has it, so
/// that there is one writer and no reader unawares. A reader that finds it held is `live`: it holds steps 2 to 4 off
/// by a lock on bytes far behind any file's end, for two seconds at most; what it has read until then is one commit,
/// what it read later must be thrown away (expired()). A writer waits longer than that and goes on in any case.
///
/// Functions return errno, 0: done. No HDF5 in here.
class JournaledFile {
public:
    enum class Mode : std::uint8_t { create, change, read };
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t block_size = 512;
    static constexpr std::chrono::milliseconds lease{2000};

    JournaledFile() = default;
    JournaledFile(const JournaledFile&) = delete;
    JournaledFile& operator=(const JournaledFile&) = delete;
    ~JournaledFile();  ///< closes without commit

    /// Creates or empties, opens for change (a commit that was broken off is completed first), or opens for reading.
    /// EWOULDBLOCK: another program or object is writing it, or reading it while this one wants to write.
    int open(const char* path, Mode mode);
    int close();

    /// Bytes of the contents as of opening.
    [[nodiscard]] std::uint64_t size() const { return end_; }
    /// The file on the disk as it was found.
    [[nodiscard]] const struct stat& found() const { return found_; }
    [[nodiscard]] bool journal_found() const { return journal_found_; }
    [[nodiscard]] Mode mode() const { return mode_; }
    [[nodiscard]] bool live() const { return live_; }
    [[nodiscard]] bool expired() const { return live_ && Clock::now() - opened_ > lease; }
    /// Time for a reader to close the file and to open it anew, if more is to be read.
    [[nodiscard]] bool stale() const { return live_ && Clock::now() - opened_ > lease / 4; }
    /// Each commit waits until the disk has it, which makes it safe against loss of power.
    void synchronise(bool on) { synchronise_ = on; }

    /// What was written, committed or not; zeros behind the end.
    int read(std::uint64_t address, std::span<char> to) const;
    /// After an error of the disk, which is kept (error()), all goes to memory and nothing is committed any more.
    void write(std::uint64_t address, std::span<const char> from);
    /// @param end  length of the contents from now on
    /// @return also ENOENT if the file has been removed, EIO if somebody has cut it off
    int commit(std::uint64_t end);
    [[nodiscard]] int error() const { return error_; }

private:
    using Block = std::array<char, block_size>;
    int lock_for(Mode mode);
    int wait_for_writer();
    int find_journal(std::uint64_t file_size);
    void hold(std::uint64_t address, std::span<const char> from);
    int read_disk(std::uint64_t address, std::span<char> to) const;
    [[nodiscard]] std::vector<char> journal(std::uint64_t start, std::uint64_t end) const;
    void check_place();
    int write_journal(std::uint64_t end);
    int apply(std::uint64_t end);
    int write_blocks() const;
    int fail(int reason);

    int fd_ = -1;
    Mode mode_ = Mode::read;
    bool journal_found_ = false, live_ = false, synchronise_ = false;
    Clock::time_point opened_;
    struct stat found_ {};
    std::uint64_t end_ = 0;        ///< of the last commit
    std::uint64_t protected_ = 0;  ///< the same, rounded up to whole blocks
    int error_ = 0;
    std::map<std::uint64_t, Block> blocks_;  ///< held back, by address
};

}  // namespace cardan::solvers::detail
