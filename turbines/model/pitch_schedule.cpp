#include "turbines/model/pitch_schedule.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan::turbines {

double pitch_at(const std::vector<PitchAtWind>& schedule, double wind) {
    constexpr const char* here = "minimum pitch over the wind speed";
    if (schedule.empty()) throw InputError(here, "number of rows", 0, "at least 1");
    for (std::size_t i = 1; i < schedule.size(); ++i)
        if (!(schedule[i].wind > schedule[i - 1].wind))
            throw InputError(here, "wind speed [m/s]", schedule[i].wind, "ascending");
    const auto next = std::ranges::find_if(schedule, [wind](const PitchAtWind& one) { return one.wind >= wind; });
    if (next == schedule.begin()) return schedule.front().pitch;
    if (next == schedule.end()) return schedule.back().pitch;
    const PitchAtWind &a = next[-1], &b = *next;
    return a.pitch + (wind - a.wind) / (b.wind - a.wind) * (b.pitch - a.pitch);
}

}  // namespace cardan::turbines
