#include "solvers/hdf5/detail/journal.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <iterator>
#include <string_view>
#include <sys/file.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace cardan::solvers::detail {
namespace {

using Clock = JournaledFile::Clock;

/// The last bytes of a file whose commit was broken off after step 1.
struct Footer {
    std::uint64_t magic, blocks, start, end, checksum;
};
constexpr std::uint64_t magic = 0x314c4e4a4e445243;  // "CRDNJNL1", little-endian: a journal is for the same machine
constexpr std::string_view mark =
    "\x89"
    "CRDNBSY";  // as long as HDF5's signature
constexpr std::uint64_t record_size = sizeof(std::uint64_t) + JournaledFile::block_size;

std::uint64_t whole_blocks(std::uint64_t address) {
    constexpr std::uint64_t size = JournaledFile::block_size;
    return (address + size - 1) / size * size;
}

/// Checksum of whole words: the multiplicative part of FNV-1a with a shift that brings high bits down.
std::uint64_t checksum(std::span<const char> bytes) {
    std::uint64_t sum = 0xcbf29ce484222325;
    for (std::size_t at = 0; at + sizeof sum <= bytes.size(); at += sizeof sum) {
        std::uint64_t word = 0;
        std::memcpy(&word, &bytes[at], sizeof word);
        sum = (sum ^ word) * 0x100000001b3;
        sum ^= sum >> 29;
    }
    return sum;
}

int write_all(int fd, std::uint64_t address, std::span<const char> from) {
    while (!from.empty()) {
        const ssize_t n = ::pwrite(fd, from.data(), from.size(), static_cast<off_t>(address));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return n < 0 ? errno : ENOSPC;
        from = from.subspan(static_cast<std::size_t>(n));
        address += static_cast<std::uint64_t>(n);
    }
    return 0;
}

int set_size(int fd, std::uint64_t size) {
    return ::ftruncate(fd, static_cast<off_t>(size)) == 0 ? 0 : errno;
}

// Others may hold a lock that long to see whether there is one.
constexpr std::chrono::milliseconds glance{50};

bool is_at(const char* path, const struct stat& file) {
    struct stat now {};
    return ::stat(path, &now) == 0 && now.st_dev == file.st_dev && now.st_ino == file.st_ino;
}

// The lock of live readers: a byte that readers share and a commit has for itself, and before it a gate that a waiting
// commit closes, so that no new reader comes in. They belong to the open file, not to the process.
constexpr off_t gate = off_t{1} << 61, readers = gate + 1;

bool try_lock(int fd, short type, off_t byte) {
    struct flock request {};
    request.l_type = type;
    request.l_whence = SEEK_SET;
    request.l_start = byte;
    request.l_len = 1;
    // A file system without locks has no live readers: it has no flock() either that would tell them of a writer.
    return ::fcntl(fd, F_OFD_SETLK, &request) == 0 || (errno != EAGAIN && errno != EACCES);
}

bool lock_until(Clock::time_point deadline, int fd, short type, off_t byte) {
    while (!try_lock(fd, type, byte)) {
        if (Clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

/// A writer's: while it lives no reader begins, and those that have begun are done or have expired.
class ReadersOff {
public:
    explicit ReadersOff(int fd) : fd_(fd) {
        const auto deadline = Clock::now() + 2 * JournaledFile::lease;
        lock_until(deadline, fd_, F_WRLCK, gate);
        lock_until(deadline, fd_, F_WRLCK, readers);
    }
    ~ReadersOff() {
        try_lock(fd_, F_UNLCK, readers);
        try_lock(fd_, F_UNLCK, gate);
    }
    ReadersOff(const ReadersOff&) = delete;
    ReadersOff& operator=(const ReadersOff&) = delete;

private:
    int fd_;
};

}  // namespace

JournaledFile::~JournaledFile() {
    close();
}

int JournaledFile::open(const char* path, Mode mode, int held) {
    mode_ = mode;
    const int access = mode == Mode::read ? O_RDONLY : mode == Mode::change ? O_RDWR : O_RDWR | O_CREAT;
    fd_ = held >= 0 ? held : ::open(path, access | O_CLOEXEC, 0666);
    if (fd_ < 0) return errno;
    if (const int reason = held >= 0 ? 0 : lock_for(mode); reason != 0) return reason;
    if (::fstat(fd_, &found_) != 0) return errno;
    // The file may have got another name while this waited for its lock.
    if (mode == Mode::create) return is_at(path, found_) ? set_size(fd_, 0) : EWOULDBLOCK;
    if (const int reason = find_journal(static_cast<std::uint64_t>(found_.st_size)); reason != 0) return reason;
    protected_ = whole_blocks(end_);
    return journal_found_ && mode == Mode::change ? apply(end_) : 0;
}

int JournaledFile::lock_for(Mode mode) {
    const int kind = (mode == Mode::read ? LOCK_SH : LOCK_EX) | LOCK_NB;
    const auto deadline = Clock::now() + glance;
    bool held = false;
    while ((held = ::flock(fd_, kind) != 0 && errno == EWOULDBLOCK) && mode == Mode::create && Clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!held) return 0;
    return mode == Mode::read ? wait_for_writer() : EWOULDBLOCK;
}

int JournaledFile::wait_for_writer() {
    live_ = true;
    const auto deadline = Clock::now() + 5 * lease;
    while (Clock::now() < deadline) {
        if (try_lock(fd_, F_RDLCK, gate)) {
            opened_ = Clock::now();  // before the lock: should this process be stopped here, its time goes on
            const bool in = try_lock(fd_, F_RDLCK, readers);
            try_lock(fd_, F_UNLCK, gate);
            if (in && !expired()) return 0;
            if (in) try_lock(fd_, F_UNLCK, readers);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return EWOULDBLOCK;
}

int JournaledFile::close() {
    if (fd_ < 0) return 0;
    return ::close(std::exchange(fd_, -1)) == 0 ? 0 : errno;
}

int JournaledFile::find_journal(std::uint64_t file_size) {
    end_ = file_size;
    Footer footer{};
    if (file_size < sizeof footer) return 0;
    const std::span last(reinterpret_cast<char*>(&footer), sizeof footer);
    if (const int reason = read_disk(file_size - sizeof footer, last); reason != 0) return reason;
    const std::uint64_t room = file_size - sizeof footer;
    if (footer.magic != magic || footer.blocks > room / record_size || footer.end > footer.start ||
        footer.start != room - footer.blocks * record_size)
        return 0;
    std::vector<char> bytes(file_size - footer.start);
    if (const int reason = read_disk(footer.start, bytes); reason != 0) return reason;
    if (checksum(std::span(bytes).first(bytes.size() - sizeof footer.checksum)) != footer.checksum) return 0;
    for (std::uint64_t k = 0; k < footer.blocks; ++k) {
        const char* record = &bytes[k * record_size];
        std::uint64_t address = 0;
        std::memcpy(&address, record, sizeof address);
        std::memcpy(blocks_[address].data(), record + sizeof address, block_size);
    }
    end_ = footer.end;
    journal_found_ = true;
    return 0;
}

int JournaledFile::read_disk(std::uint64_t address, std::span<char> to) const {
    while (!to.empty()) {
        const ssize_t n = ::pread(fd_, to.data(), to.size(), static_cast<off_t>(address));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        if (n == 0) break;
        to = to.subspan(static_cast<std::size_t>(n));
        address += static_cast<std::uint64_t>(n);
    }
    std::ranges::fill(to, '\0');
    return 0;
}

int JournaledFile::read(std::uint64_t address, std::span<char> to) const {
    if (const int reason = read_disk(address, to); reason != 0) return reason;
    const std::uint64_t end = address + to.size();
    for (auto it = blocks_.lower_bound(address / block_size * block_size); it != blocks_.end() && it->first < end;
         ++it) {
        const std::uint64_t first = std::max(address, it->first), last = std::min(end, it->first + block_size);
        std::memcpy(&to[first - address], &it->second[first - it->first], last - first);
    }
    return 0;
}

void JournaledFile::write(std::uint64_t address, std::span<const char> from) {
    const std::uint64_t below = address < protected_ ? std::min<std::uint64_t>(from.size(), protected_ - address) : 0;
    hold(address, from.first(below));
    if (below == from.size()) return;
    if (error_ == 0) error_ = write_all(fd_, address + below, from.subspan(below));
    if (error_ != 0) hold(address + below, from.subspan(below));
}

void JournaledFile::hold(std::uint64_t address, std::span<const char> from) {
    while (!from.empty()) {
        const std::uint64_t start = address / block_size * block_size, offset = address - start;
        const std::uint64_t count = std::min<std::uint64_t>(from.size(), block_size - offset);
        const auto [block, made] = blocks_.try_emplace(start);
        if (made && count < block_size && read_disk(start, block->second) != 0) block->second.fill('\0');
        std::memcpy(&block->second[offset], from.data(), count);
        from = from.subspan(count);
        address += count;
    }
}

std::vector<char> JournaledFile::journal(std::uint64_t start, std::uint64_t end) const {
    std::vector<char> bytes(blocks_.size() * record_size + sizeof(Footer));
    char* to = bytes.data();
    for (const auto& [address, block] : blocks_) {
        std::memcpy(to, &address, sizeof address);
        std::memcpy(to + sizeof address, block.data(), block_size);
        to += record_size;
    }
    Footer footer{magic, blocks_.size(), start, end, 0};
    std::memcpy(to, &footer, sizeof footer);
    footer.checksum = checksum(std::span(bytes).first(bytes.size() - sizeof footer.checksum));
    std::memcpy(to, &footer, sizeof footer);
    return bytes;
}

int JournaledFile::fail(int reason) {
    if (error_ == 0) error_ = reason;
    return error_;
}

// Removed or truncated by somebody else: writes would be lost, or no longer form a file.
void JournaledFile::check_place() {
    struct stat now {};
    if (::fstat(fd_, &now) != 0)
        fail(errno);
    else if (now.st_nlink == 0)
        fail(ENOENT);
    else if (static_cast<std::uint64_t>(now.st_size) < end_)
        fail(EIO);
}

int JournaledFile::commit(std::uint64_t end) {
    if (error_ == 0) check_place();
    if (error_ == 0 && !blocks_.empty()) write_journal(end);
    if (error_ == 0) apply(end);
    return error_;
}

int JournaledFile::write_journal(std::uint64_t end) {
    if (const auto [first, made] = blocks_.try_emplace(0); made)
        if (const int reason = read_disk(0, first->second); reason != 0) return fail(reason);
    const std::uint64_t start = whole_blocks(std::max(end, end_));
    int reason = set_size(fd_, start);
    if (reason == 0) reason = write_all(fd_, start, journal(start, end));
    if (reason == 0 && synchronise_ && ::fdatasync(fd_) != 0) reason = errno;
    if (reason == 0) return 0;
    set_size(fd_, end_);  // gives the room back, if that can be done
    return fail(reason);
}

// In runs of neighbours, the first block last and its first bytes last of all; until then the mark stands in their
// place.
int JournaledFile::write_blocks() const {
    const auto first = blocks_.find(0);  // journals of older versions need not have it
    if (first != blocks_.end())
        if (const int reason = write_all(fd_, 0, mark); reason != 0) return reason;
    std::vector<char> run;
    for (auto it = first == blocks_.end() ? blocks_.begin() : std::next(first); it != blocks_.end();) {
        const std::uint64_t start = it->first;
        for (run.clear(); it != blocks_.end() && it->first == start + run.size(); ++it)
            run.insert(run.end(), it->second.begin(), it->second.end());
        if (const int reason = write_all(fd_, start, run); reason != 0) return reason;
    }
    if (first == blocks_.end()) return 0;
    const std::span<const char> block = first->second;
    const int reason = write_all(fd_, mark.size(), block.subspan(mark.size()));
    return reason != 0 ? reason : write_all(fd_, 0, block.first(mark.size()));
}

int JournaledFile::apply(std::uint64_t end) {
    const ReadersOff off(fd_);
    if (const int reason = write_blocks(); reason != 0) return fail(reason);
    if (synchronise_ && ::fdatasync(fd_) != 0) return fail(errno);
    if (const int reason = set_size(fd_, end); reason != 0) return fail(reason);
    blocks_.clear();
    end_ = end;
    protected_ = whole_blocks(end);
    return 0;
}

}  // namespace cardan::solvers::detail
