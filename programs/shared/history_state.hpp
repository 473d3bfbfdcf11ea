/// @file
/// State of the file of a time history.
#pragma once

#include "solvers/hdf5/history.hpp"

namespace cardan::program {

inline const char* state_in_words(const solvers::HistoryInfo& info) {
    if (info.being_written) return "being written";
    return info.finished ? "finished" : "broken off";
}

}  // namespace cardan::program
