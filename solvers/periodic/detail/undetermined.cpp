#include "solvers/periodic/detail/undetermined.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan::solvers {

void Undetermined::note(const RotorEquations& equations, Eigen::Index row, Eigen::Index harmonic) {
    const std::string& name = equations.name(row);
    std::string words;
    if (equations.is_multiplier(row)) {
        words = text("the reaction '", name, "' is not unique: its equation is redundant");
    } else if (harmonic == 0) {
        mean_ = true;
        words = text("the mean of '", name, "' is held by nothing and stays near where it started");
    } else {
        words = text("harmonic ", harmonic, " of '", name,
                     "' is not determined (a natural frequency at this multiple of the rotor speed)");
    }
    if (std::ranges::find(words_, words) == words_.end()) words_.push_back(std::move(words));
}

void Undetermined::clear() {
    words_.clear();
    mean_ = false;
}

}  // namespace cardan::solvers
