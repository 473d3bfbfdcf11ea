#include "turbines/readers/turbine_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

std::string refused(TurbineDescription machine, bool unusual) {
    machine.unusual = unusual;
    return refusal_of(std::move(machine));
}

}  // namespace

std::string refusal_of(TurbineDescription machine) {
    machine.missing.clear();
    if (machine.drive_train.generator_inertia == 0) machine.drive_train.generator_inertia = 1;
    try {
        machine.check();
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

std::size_t FileNote::entries() const {
    return line == 0 ? static_cast<std::size_t>(std::ranges::count(keyword, ',')) + 1 : 1;
}

void set_dofs(const FileDofs& dofs, TurbineDescription& description) {
    description.drive_train.spin = dofs.generator ? CoordinateRole::free : CoordinateRole::prescribed;
    TowerDescription& tower = description.tower;
    tower.rigid = !dofs.tower_fore_aft && !dofs.tower_side_side;
    tower.locked_fore_aft = !tower.rigid && !dofs.tower_fore_aft;
    tower.locked_side_side = !tower.rigid && !dofs.tower_side_side;
    description.blade.rigid = !dofs.blades;
    for (auto& [number, blade] : description.individual_blades)
        if (blade) blade->rigid = !dofs.blades;
}

FileDofs dofs_of(const TurbineDescription& description) {
    const TowerDescription& tower = description.tower;
    return {.generator = description.drive_train.spin == CoordinateRole::free,
            .tower_fore_aft = !tower.rigid && !tower.locked_fore_aft,
            .tower_side_side = !tower.rigid && !tower.locked_side_side,
            .blades = !description.blade.rigid};
}

double pitch_at(const std::vector<PitchAt>& schedule, double rotor_speed) {
    if (schedule.empty()) throw InputError("schedule of the pitch", "entries", 0, "at least one");
    if (schedule.size() == 1) return schedule.front().pitch;
    std::vector<double> speeds, angles;
    for (const PitchAt& one : schedule) {
        speeds.push_back(one.rotor_speed);
        angles.push_back(one.pitch);
    }
    return place_among(speeds, std::clamp(rotor_speed, speeds.front(), speeds.back())).of(angles);
}

void admit_unusual(TurbineFile& file, const std::string& name) {
    if (file.description.unusual) return;
    const std::string why = refused(file.description, false);
    if (why.empty() || !refused(file.description, true).empty()) return;  // what cannot be is refused on assembly
    file.description.unusual = true;
    file.notes.push_back({name, 0, unusual_entries, "unusual", text("taken as they are: ", why)});
}

}  // namespace cardan::turbines
