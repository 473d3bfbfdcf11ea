#include "solvers/campbell_data/diagram.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

FloquetKind CampbellMode::kind() const {
    if (floquet) return floquet->kind;
    return mode.oscillates() ? FloquetKind::oscillation : FloquetKind::aperiodic;
}

std::string CampbellMode::kind_name() const {
    switch (kind()) {
        case FloquetKind::oscillation:
            return "oscillation";
        case FloquetKind::aperiodic:
            return "aperiodic";
        case FloquetKind::synchronous:
            return text("locked at ", std::lround(floquet->per_period()), " per rev");
        case FloquetKind::subharmonic:
            return text("locked at ", std::lround(2 * floquet->per_period()), "/2 per rev");
        case FloquetKind::rigid:
            break;
    }
    return "rigid";
}

const CampbellMode* Campbell::mode(const Branch& branch, std::size_t point) const {
    const int index = branch.mode.at(point);
    return index < 0 ? nullptr : &entry(points[point].modes, index);
}

std::vector<double> Campbell::rotor_speeds() const {
    std::vector<double> speeds;
    for (const CampbellPoint& point : points) speeds.push_back(point.rotor_speed);
    return speeds;
}

double Campbell::natural_hz(const Branch& branch, std::size_t point) const {
    const CampbellMode* m = mode(branch, point);
    return m ? m->mode.natural_hz() : nan;
}

double Campbell::damped_hz(const Branch& branch, std::size_t point) const {
    const CampbellMode* m = mode(branch, point);
    return m ? m->mode.damped_hz() : nan;
}

double Campbell::damping_ratio(const Branch& branch, std::size_t point) const {
    const CampbellMode* m = mode(branch, point);
    return m && m->kind() != FloquetKind::rigid ? m->mode.damping_ratio() : nan;
}

const Branch* Campbell::find_branch(std::string_view name) const {
    const auto found = std::find_if(branches.begin(), branches.end(), [&](const Branch& b) { return b.name == name; });
    return found == branches.end() ? nullptr : &*found;
}

const Branch& Campbell::branch(std::string_view name) const {
    if (const Branch* const found = find_branch(name)) return *found;
    std::string known;
    for (const Branch& b : branches) known += text(known.empty() ? "'" : ", '", b.name, "'");
    throw InputError(text("unknown mode '", name, "'; the diagram has ", known));
}

std::vector<FrameMotion> Campbell::motion(const Branch& branch, std::size_t point) const {
    if (point >= motions.size() || branch.mode.at(point) < 0)
        throw InputError(machine, "mode shape of", text("'", branch.name, "' at point ", point),
                         "a point where the branch has a mode, in a diagram made with keep_shapes");
    return entry(motions[point], branch.mode[point]);
}

}  // namespace cardan::solvers
