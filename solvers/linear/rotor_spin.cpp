#include "solvers/linear/rotor_spin.hpp"

#include <set>

namespace cardan::solvers {

std::vector<int> rotor_multiples(int blades) {
    if (blades == 2) return {1, 2, 4, 6};
    std::set<int> n{1, 2, 3};
    for (int k = 1; k <= 4 && blades > 0; ++k) n.insert(k * blades);
    return {n.begin(), n.end()};
}

}  // namespace cardan::solvers
