/// @file
/// Motions that the equations of a periodic steady state leave open. Internal to solvers: not installed.
#pragma once

#include "solvers/periodic/detail/rotor_equations.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// Sentences about unknowns that nothing determines, each once.
class Undetermined {
public:
    /// Coefficient `harmonic` (0: the mean) of an unknown.
    void note(const RotorEquations& equations, Eigen::Index row, Eigen::Index harmonic);
    void clear();

    const std::vector<std::string>& words() const { return words_; }
    /// A mean is among them.
    bool mean() const { return mean_; }

private:
    std::vector<std::string> words_;
    bool mean_ = false;
};

}  // namespace cardan::solvers
