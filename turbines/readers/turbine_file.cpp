#include "turbines/readers/turbine_file.hpp"

#include "mbs/base/error.hpp"

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

void admit_unusual(TurbineFile& file, const std::string& name) {
    if (file.description.unusual) return;
    const std::string why = refused(file.description, false);
    if (why.empty() || !refused(file.description, true).empty()) return;  // what cannot be is refused on assembly
    file.description.unusual = true;
    file.notes.push_back({name, 0, unusual_entries, "unusual", text("taken as they are: ", why)});
}

}  // namespace cardan::turbines
