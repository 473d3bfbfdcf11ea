#include "solvers/pictures/detail/campbell_style.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>

namespace cardan::solvers {

int dash(RotorPattern pattern) {
    switch (pattern) {
        case RotorPattern::backward:
        case RotorPattern::antisymmetric:
            return 2;
        case RotorPattern::forward:
            return 4;
        case RotorPattern::differential:
            return 3;
        default:
            return 1;
    }
}

std::size_t colour_index(const Campbell& diagram, const Branch& branch) {
    std::vector<std::string> seen;
    for (const Branch& b : diagram.branches) {
        if (b.family == branch.family) return seen.size();
        if (std::find(seen.begin(), seen.end(), b.family) == seen.end()) seen.push_back(b.family);
    }
    return seen.size();
}

std::vector<double> abscissae(const Campbell& diagram) {
    if (!diagram.parameters.empty()) return diagram.parameters;
    std::vector<double> rpm;
    for (const CampbellPoint& p : diagram.points) rpm.push_back(p.rotor_speed * units::to_rpm);
    return rpm;
}

void require_points(const Campbell& diagram) {
    if (diagram.points.empty() || diagram.branches.empty())
        throw InputError(diagram.machine, "rotor speeds in the diagram", diagram.points.size(),
                         "at least one, with modes");
}

std::string abscissa_label(const Campbell& diagram) {
    return diagram.parameter.empty() ? "rotor speed, rev/min" : diagram.parameter;
}

}  // namespace cardan::solvers
