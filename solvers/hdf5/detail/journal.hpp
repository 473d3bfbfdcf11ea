/// @file
/// A file that changes only in atomic commits, even if its writer is killed. Internal: not for users of the library.
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

/// A file that reaches the disk by commits: between them the bytes on disk are those of the last commit, so that any
/// program can read them. Writes below the end of the committed contents are held back in memory, in blocks; writes
/// beyond it go to disk immediately, where nobody looks. commit() then
///   1. writes the held-back blocks and a footer with a checksum, the journal, behind all that,
///   2. overwrites the first bytes, in which a format has its signature, by a mark,
///   3. writes the blocks to their places, those first bytes last,
///   4. cuts the journal off.
/// If killed in step 1, the footer is missing and the last commit stands. If killed later, whoever opens the file next
/// finds the footer and journal and obtains the new commit: a writer by repeating steps 2 to 4, a reader in memory. A
/// program that knows nothing of journals finds no signature in a half-committed file and rejects it.
///
/// Two kinds of locks: a writer holds an exclusive flock() as long as it has the file open, as HDF5 itself does, so
/// that there is only one writer and no unsuspecting reader. A reader that finds it held is `live`: it blocks steps 2
/// to 4 by a lock on bytes far beyond any file's end, for two seconds at most. What it has read until then belongs to
/// one commit; anything read later must be discarded (expired()). A writer waits longer than that and then continues in
/// any case.
///
/// Functions return errno, 0 on success. Nothing here uses HDF5.
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

    /// Creates or empties the file, opens it for changes (first completing an interrupted commit), or opens it for
    /// reading. EWOULDBLOCK: another program or object is writing it, or reading it while this one wants to write.
    /// @param held  descriptor of this file that is open for reading and writing and holds its lock, which is taken
    /// over;
    ///              negative: none
    int open(const char* path, Mode mode, int held = -1);
    int close();

    /// Bytes of the contents as of opening.
    [[nodiscard]] std::uint64_t size() const { return end_; }
    /// The file on the disk as it was found.
    [[nodiscard]] const struct stat& found() const { return found_; }
    [[nodiscard]] bool journal_found() const { return journal_found_; }
    [[nodiscard]] Mode mode() const { return mode_; }
    [[nodiscard]] bool live() const { return live_; }
    [[nodiscard]] bool expired() const { return live_ && Clock::now() - opened_ > lease; }
    /// True if a reader should close and reopen the file before reading more.
    [[nodiscard]] bool stale() const { return live_ && Clock::now() - opened_ > lease / 4; }
    /// Makes each commit wait for the disk, which makes it safe against power loss.
    void synchronise(bool on) { synchronise_ = on; }

    /// Reads what was written, committed or not; zeros beyond the end.
    int read(std::uint64_t address, std::span<char> to) const;
    /// Writes bytes; after a disk error, which is remembered (error()), everything goes to memory and nothing is
    /// committed any more.
    void write(std::uint64_t address, std::span<const char> from);
    /// @param end  length of the contents from now on
    /// @return also ENOENT if the file has been removed, EIO if it has been truncated
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
    std::uint64_t protected_ = 0;  ///< `end_`, rounded up to whole blocks
    int error_ = 0;
    std::map<std::uint64_t, Block> blocks_;  ///< held back, by address
};

}  // namespace cardan::solvers::detail
