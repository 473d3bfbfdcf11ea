#include "turbines/analysis/in_unit.hpp"

#include "mbs/base/text.hpp"

#include <cmath>
#include <limits>

namespace cardan::turbines {

double in_unit(double value, double unit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double nearest = value / unit;
    double best = nearest;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const double number : {nearest, std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)}) {
        const std::size_t length = digits(number).size();
        if (number * unit != value || length >= fewest) continue;
        best = number;
        fewest = length;
    }
    return best;
}

}  // namespace cardan::turbines
