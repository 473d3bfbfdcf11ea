#include "programs/shared/progress.hpp"

#include "mbs/base/text.hpp"

#include <algorithm>
#include <iostream>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace cardan::program {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr Seconds first_line = 10s, between_lines = 30s, on_terminal = 1s;
constexpr double part_of_time = 0.1;
constexpr std::string_view clear_line = "\r\033[K";

bool is_terminal() {
    static const bool terminal = isatty(STDERR_FILENO) != 0;
    return terminal;
}

// What is being done, since when it has been shown, and whether a terminal shows it. For all threads.
struct Status {
    std::mutex mutex;
    std::string what;
    Clock::time_point since;
    bool shown = false;
};
Status& status() {
    static Status one;
    return one;
}

std::string words(std::string_view what) {
    constexpr std::string_view blank = " \r\n\t";
    if (what.starts_with(clear_line)) what.remove_prefix(clear_line.size());
    const std::size_t first = what.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return std::string(what.substr(first, what.find_last_not_of(blank) - first + 1));
}

std::string duration(Seconds passed) {
    const auto seconds = static_cast<long>(passed.count());
    return seconds < 120 ? text(seconds, " s") : text(seconds / 60, " min");
}

void take_off_terminal(Status& s) {
    if (s.shown) std::cerr << clear_line << std::flush;
    s.shown = false;
}

}  // namespace

void progress(const std::string& what) {
    Status& s = status();
    const std::scoped_lock lock(s.mutex);
    s.what = words(what);
    s.since = Clock::now();
    const bool stays = what.ends_with('\n');
    if (is_terminal()) {
        take_off_terminal(s);
        std::cerr << s.what << (stays ? "\n" : "") << std::flush;
        s.shown = !stays && !s.what.empty();
    }
    if (stays) s.what.clear();
}

void clear_progress() {
    Status& s = status();
    const std::scoped_lock lock(s.mutex);
    take_off_terminal(s);
}

void end_progress() {
    progress("");
}

LongWork::LongWork(std::string name) : name_(std::move(name)), teller_([this] { run(); }) {}

LongWork::~LongWork() {
    {
        const std::scoped_lock lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    teller_.join();
    end_progress();
}

void LongWork::tell(bool terminal) const {
    Status& s = status();
    const std::scoped_lock lock(s.mutex);
    const Clock::time_point now = Clock::now();
    const std::string passed = duration(now - begin_);
    if (!terminal) {
        std::cerr << name_ << ": " << (s.what.empty() ? "at work" : s.what) << ", after " << passed << "\n"
                  << std::flush;
        return;
    }
    if (s.what.empty() || now - s.since < 2 * on_terminal) return;
    std::cerr << clear_line << s.what << ", " << passed << std::flush;
    s.shown = true;
}

void LongWork::run() {
    const bool terminal = is_terminal();
    std::unique_lock lock(mutex_);
    Seconds wait = terminal ? on_terminal : first_line;
    while (!changed_.wait_for(lock, wait, [this] { return over_; })) {
        tell(terminal);
        if (!terminal) wait = std::max(between_lines, part_of_time * Seconds(Clock::now() - begin_));
    }
}

}  // namespace cardan::program
