#include "mbs/error.hpp"
#include "solvers/campbell.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace cardan::solvers {

namespace {

const CampbellMode* mode_at(const Campbell& diagram, const Branch& branch, std::size_t point) {
    const int index = branch.mode.at(point);
    return index < 0 ? nullptr : &diagram.points[point].modes[static_cast<std::size_t>(index)];
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<double> Campbell::rotor_speeds() const {
    std::vector<double> speeds;
    for (const CampbellPoint& point : points) speeds.push_back(point.rotor_speed);
    return speeds;
}

double Campbell::natural_hz(const Branch& branch, std::size_t point) const {
    const CampbellMode* mode = mode_at(*this, branch, point);
    return mode ? mode->mode.natural_hz() : nan;
}

double Campbell::damped_hz(const Branch& branch, std::size_t point) const {
    const CampbellMode* mode = mode_at(*this, branch, point);
    return mode ? mode->mode.damped_hz() : nan;
}

double Campbell::damping_ratio(const Branch& branch, std::size_t point) const {
    const CampbellMode* mode = mode_at(*this, branch, point);
    return mode ? mode->mode.damping_ratio() : nan;
}

const Branch& Campbell::branch(std::string_view name) const {
    std::string known;
    for (const Branch& b : branches) {
        if (b.name == name) return b;
        known += text(known.empty() ? "'" : ", '", b.name, "'");
    }
    throw InputError(text("unknown mode '", name, "'; the diagram has ", known));
}

std::vector<FrameMotion> Campbell::motion(const Branch& branch, std::size_t point) const {
    if (point >= motions.size() || branch.mode.at(point) < 0)
        throw InputError(machine, "mode shape of", text("'", branch.name, "' at point ", point),
                         "a point where the branch has a mode, in a diagram made with keep_shapes");
    return motions[point][static_cast<std::size_t>(branch.mode[point])];
}

std::string table(const Campbell& diagram) {
    std::ostringstream out;
    if (diagram.points.empty()) return "no rotor speeds computed\n";
    std::vector<std::size_t> shown{0};
    for (std::size_t i : {diagram.points.size() / 2, diagram.points.size() - 1})
        if (i != shown.back()) shown.push_back(i);
    out << diagram.machine << ": natural frequency, Hz (damping ratio, %); " << diagram.method << "\n\n"
        << std::left << std::setw(34) << "mode" << std::right << std::fixed;
    for (std::size_t i : shown)
        out << std::setw(15) << std::setprecision(1) << diagram.points[i].rotor_speed * 30 / pi << " rpm  ";
    out << "\n";
    for (const Branch& branch : diagram.branches) {
        out << std::left << std::setw(34) << branch.name << std::right;
        for (std::size_t i : shown) {
            if (branch.mode[i] < 0)
                out << std::setw(21) << "-";
            else
                out << std::setw(10) << std::setprecision(4) << diagram.natural_hz(branch, i) << " (" << std::setw(6)
                    << std::setprecision(2) << 100 * diagram.damping_ratio(branch, i) << ")"
                    << (branch.doubtful[i] ? " ?" : "  ");
        }
        out << "\n";
    }
    out << "\n? the name is doubtful there: the mode is a mixture or was hard to follow\n";
    if (!diagram.crossings.empty()) {
        out << "\ncrossings with multiples of the rotor speed\n";
        for (const Crossing& crossing : diagram.crossings)
            out << "  " << std::setw(2) << crossing.multiple << "P at " << std::setw(6) << std::setprecision(2)
                << crossing.rotor_speed * 30 / pi << " rpm, " << std::setw(7) << std::setprecision(4)
                << crossing.frequency_hz << " Hz: " << diagram.branches[static_cast<std::size_t>(crossing.branch)].name
                << "\n";
    }
    if (!diagram.warning.empty()) out << "\nwarning: " << diagram.warning << "\n";
    if (!diagram.complete) out << "\nthe sweep was interrupted: only the rotor speeds above were computed\n";
    return out.str();
}

}  // namespace cardan::solvers
