/// @file
/// Notes on what a search for limits of stability leaves open. Internal to solvers/stability: not installed.
#pragma once

#include "solvers/campbell/diagram.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cardan::solvers {

/// Motions that may flutter; of Floquet's theory also those that are locked to the rotor.
bool vibrates(const CampbellMode& mode);

/// Growth of a mode beyond rounding, 1/s.
/// @param growth  StabilityOptions::growth
double excess(const Mode& mode, double growth);

/// Collects StabilityLimits::note.
class SearchNotes {
public:
    /// @param parameter   with its unit; empty: the rotor speed
    /// @param growth      StabilityOptions::growth
    /// @param largest_hz  modes that stay above it are not followed
    SearchNotes(const std::string& parameter, double growth, double largest_hz)
        : parameter_(parameter.empty() ? "rotor speed, rad/s" : parameter), growth_(growth), largest_hz_(largest_hz) {}

    /// "wind speed, m/s 12"
    std::string at(double parameter) const { return text(parameter_, " ", parameter); }
    /// No note twice.
    void add(const std::string& note);
    /// The next point, with all its modes.
    void see(double parameter, const CampbellPoint& point);
    /// Notes what grows without a limit of its own, and what is not followed although it grows, or is all that
    /// vibrates.
    /// @param diagram  of the points that were seen
    void tell_growth(const Campbell& diagram);
    const std::string& words() const { return words_; }

private:
    bool grows(const CampbellMode* mode) const;
    void tell_branch(const Campbell& diagram, const Branch& branch, std::size_t point);
    void tell_high_modes(const Campbell& diagram);

    std::string parameter_;
    double growth_, largest_hz_;
    std::vector<double> parameters_;                     // of the points that were seen
    std::vector<std::pair<std::size_t, Complex>> high_;  // growing ones beyond the largest frequency, by point
    bool diverges_ = false;                              // at the first
    double lowest_hz_ = std::numeric_limits<double>::infinity();
    std::string words_;
};

}  // namespace cardan::solvers
