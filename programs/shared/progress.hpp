/// @file
/// Progress of a program, for people: on a terminal a line that changes, in files and pipes a line now and then.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace cardan::program {

/// Shows what is being done in the place of what was: "wind speed 3 of 8". On a terminal it is shown at once. A line
/// feed behind it: it is done, and stays there. A carriage return before it and spaces behind it mean nothing.
void progress(const std::string& what);

/// Takes the line off a terminal, for what is printed in its place. What is being done is still known.
void clear_progress();

/// The work is done: nothing is shown from here on, until progress() is.
void end_progress();

/// Tells of long work, as long as it lives: after ten seconds in a file or pipe, and from then on every half minute or
/// every tenth of the time that has passed, whichever is longer. On a terminal the line has the time beside it.
class LongWork {
public:
    /// @param name  of the program
    explicit LongWork(std::string name);
    ~LongWork();
    LongWork(const LongWork&) = delete;
    LongWork& operator=(const LongWork&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    void tell(bool terminal) const;
    void run();

    std::string name_;
    Clock::time_point begin_ = Clock::now();
    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::thread teller_;  // last: it uses the others
};

}  // namespace cardan::program
