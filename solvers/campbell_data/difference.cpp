#include "solvers/campbell_data/difference.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace cardan::solvers {

namespace {

const Branch* find(const Campbell& diagram, const std::string& name) {
    const auto found = std::find_if(diagram.branches.begin(), diagram.branches.end(),
                                    [&](const Branch& branch) { return branch.name == name; });
    return found == diagram.branches.end() ? nullptr : &*found;
}

// First, middle and last in rotation.
std::vector<std::size_t> shown_points(const Campbell& diagram, std::size_t count) {
    std::size_t first = 0;
    while (first + 1 < count && diagram.points[first].rotor_speed == 0) ++first;
    std::vector<std::size_t> shown;
    for (const std::size_t i : {first, (first + count - 1) / 2, count - 1})
        if (shown.empty() || i != shown.back()) shown.push_back(i);
    return shown;
}

}  // namespace

std::vector<BranchDifference> differences(const Campbell& diagram, const Campbell& reference) {
    const std::size_t points = std::min(diagram.points.size(), reference.points.size());
    for (std::size_t i = 0; i < points; ++i)
        if (diagram.points[i].rotor_speed != reference.points[i].rotor_speed)
            throw InputError("difference of Campbell diagrams", text("rotor speed number ", i + 1, " [rad/s]"),
                             diagram.points[i].rotor_speed,
                             text(reference.points[i].rotor_speed, ", as the other has"));
    if (diagram.parameter != reference.parameter)
        throw InputError("difference of Campbell diagrams", "parameter", text("'", diagram.parameter, "'"),
                         text("'", reference.parameter, "', as the other has"));
    for (std::size_t i = 0; i < std::min(diagram.parameters.size(), reference.parameters.size()); ++i)
        if (diagram.parameters[i] != reference.parameters[i])
            throw InputError("difference of Campbell diagrams", text(diagram.parameter, ", number ", i + 1),
                             diagram.parameters[i], text(reference.parameters[i], ", as the other has"));
    std::vector<BranchDifference> list;
    for (const Branch& branch : diagram.branches) {
        const Branch* other = find(reference, branch.name);
        if (!other || branch.row >= 0) continue;
        BranchDifference& one = list.emplace_back();
        one.name = branch.name;
        one.family = branch.family;
        one.pattern = branch.pattern;
        for (std::size_t i = 0; i < points; ++i) {
            one.frequency_hz.push_back(diagram.damped_hz(branch, i) - reference.damped_hz(*other, i));
            one.damping_ratio.push_back(diagram.damping_ratio(branch, i) - reference.damping_ratio(*other, i));
            if (std::isfinite(one.frequency_hz.back()))
                one.largest_hz = std::max(one.largest_hz, std::abs(one.frequency_hz.back()));
        }
    }
    return list;
}

std::string difference_table(const Campbell& diagram, const Campbell& reference) {
    const std::vector<BranchDifference> list = differences(diagram, reference);
    const std::size_t points = std::min(diagram.points.size(), reference.points.size());
    if (points == 0 || list.empty()) return "no modes to compare\n";
    const std::vector<std::size_t> shown = shown_points(diagram, points);
    std::ostringstream out = text_stream();
    out << diagram.method << "\nagainst " << reference.method
        << ":\ndamped frequency, Hz (difference, mHz; of the damping ratio, 1e-3 %)\n\n"
        << std::left << std::setw(34) << "mode" << std::right << std::fixed;
    for (const std::size_t i : shown)
        out << std::setw(24) << std::setprecision(1) << diagram.points[i].rotor_speed * units::to_rpm << " rpm  ";
    out << "\n";
    for (const BranchDifference& one : list) {
        out << std::left << std::setw(34) << one.name << std::right;
        const Branch& branch = diagram.branch(one.name);
        for (const std::size_t i : shown) {
            if (!std::isfinite(one.frequency_hz[i])) {
                out << std::setw(30) << "-";
                continue;
            }
            out << std::setw(10) << std::setprecision(4) << diagram.damped_hz(branch, i) << " (" << std::setw(8)
                << std::setprecision(3) << 1e3 * one.frequency_hz[i] << ";" << std::setw(7) << std::setprecision(2)
                << 1e5 * one.damping_ratio[i] << ")" << (branch.doubtful[i] ? "?" : " ");
        }
        out << "\n";
    }
    return out.str();
}

}  // namespace cardan::solvers
