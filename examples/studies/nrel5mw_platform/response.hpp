/// @file
/// The periodic response of the blades, by integration in time until the transient has died away.
#pragma once

#include "solvers/time/recorder.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan::platform {

/// Least common multiple of some periods, s: at most 40 times the longest one.
/// @throws InputError if there is none within a relative 1e-9
double common_period(const std::vector<double>& periods);

struct ResponseOptions {
    double period = 0;                       ///< s, that is compared with the one before
    std::vector<std::string> compared = {};  ///< channels: deflections
    double settled = 5e-6;                   ///< largest change of these from one period to the next, m
    int max_periods = 300;                   ///< then it ends unsettled
    double step = 0.1;                       ///< largest time between rows up to the last period, s
    int samples = 720;                       ///< of the last period
    std::function<void(int period, double change)> progress = {};
};

struct Response {
    solvers::History last;        ///< one period, both ends included
    std::vector<double> changes;  ///< in every period from the one before, m; the first: infinite
    bool settled = false;
    bool stalled = false;   ///< ended because the changes have ceased to fall
    bool complete = false;  ///< false: cancelled
};

/// Integrates from where the integrator is until the response is periodic, and one period more.
/// @param row  receives all rows; those where two periods meet come twice
/// @throws NumericalError if the integration fails
Response periodic_response(solvers::Integrator& integrator, solvers::Recorder& recorder, const ResponseOptions& options,
                           const solvers::RecordRow& row);

}  // namespace cardan::platform
