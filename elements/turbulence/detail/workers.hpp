/// @file
/// Independent pieces of work on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace cardan::detail {

/// The number of threads that is asked for; 0: one per processor.
inline int thread_count(int asked) {
    return asked > 0 ? asked : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Calls work(index) for 0 <= index < count, each once, in the order of their indices as threads become free; the
/// calling thread is one of them. Fewer threads are used where the system has no more.
/// @param make_work  called once per thread: returns its `work` with what it needs for itself
/// @param go_on      called by the calling thread alone, with the number of pieces that are done, at last with all;
///                   false ends the work
/// @return whether all is done. Rethrows the first exception after all threads have ended.
template <class MakeWork, class GoOn>
bool share_out(int count, int threads, const MakeWork& make_work, const GoOn& go_on) {
    std::atomic<int> next = 0, done = 0;
    std::atomic<bool> stop = false;
    std::mutex mutex;
    std::exception_ptr failure;
    int reported = 0;
    const auto run = [&](bool caller) {
        try {
            auto work = make_work();
            for (int index = next++; index < count && !stop; index = next++) {
                work(index);
                ++done;
                if (caller && !go_on(reported = done)) stop = true;
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
            stop = true;
        }
    };
    {
        std::vector<std::jthread> others;
        try {
            for (int i = 1; i < std::min(threads, count); ++i) others.emplace_back(run, false);
        } catch (const std::system_error&) {
            // those that there are do all
        }
        run(true);
    }
    if (failure) std::rethrow_exception(failure);
    if (done != count) return false;
    if (reported != count) static_cast<void>(go_on(count));
    return true;
}

}  // namespace cardan::detail
