#include "solvers/pictures/detail/campbell_style.hpp"

#include "mbs/base/units.hpp"

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

std::vector<double> abscissae(const Campbell& diagram) {
    if (!diagram.parameters.empty()) return diagram.parameters;
    std::vector<double> rpm;
    for (const CampbellPoint& p : diagram.points) rpm.push_back(p.rotor_speed * units::to_rpm);
    return rpm;
}

std::string abscissa_label(const Campbell& diagram) {
    return diagram.parameter.empty() ? "rotor speed, rev/min" : diagram.parameter;
}

}  // namespace cardan::solvers
