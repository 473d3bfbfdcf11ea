#include "turbines/readers/turbine_file.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

// What is refused; empty: nothing. An inertia that a file does not give is the user's to set.
std::string refused(TurbineDescription machine, bool unusual) {
    machine.unusual = unusual;
    if (machine.drive_train.generator_inertia == 0) machine.drive_train.generator_inertia = 1;
    try {
        machine.check();
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

}  // namespace

double pitch_at(const std::vector<PitchAt>& schedule, double rotor_speed) {
    if (schedule.empty()) throw InputError("schedule of the pitch", "entries", 0, "at least one");
    const auto after = std::ranges::upper_bound(schedule, rotor_speed, {}, &PitchAt::rotor_speed);
    if (after == schedule.begin()) return schedule.front().pitch;
    if (after == schedule.end()) return schedule.back().pitch;
    const PitchAt &low = *(after - 1), &high = *after;
    return low.pitch +
           (high.pitch - low.pitch) * (rotor_speed - low.rotor_speed) / (high.rotor_speed - low.rotor_speed);
}

void admit_unusual(TurbineFile& file, const std::string& name) {
    if (file.description.unusual) return;
    const std::string why = refused(file.description, false);
    if (why.empty() || !refused(file.description, true).empty()) return;  // what cannot be is refused on assembly
    file.description.unusual = true;
    file.notes.push_back({name, 0, unusual_entries, "unusual", text("taken as they are: ", why)});
}

}  // namespace cardan::turbines
