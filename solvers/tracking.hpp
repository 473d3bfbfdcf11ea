/// @file
/// Modes followed over rotor speed.
#pragma once

#include "solvers/campbell.hpp"

namespace cardan::solvers {

/// Links the modes of consecutive points by optimal assignment on the complex energy MAC, never by frequency order.
class Tracker {
public:
    /// @param system  the (transformed) system of the point: its energy product weighs the MAC
    void add(const SecondOrderSystem& system, const CampbellPoint& point);

    /// Branches with names: every branch gets the component and rotor pattern that hold most of its elastic energy over
    /// the sweep, no name twice (assignment again).
    /// @param whirl  name the rotor's pairs backward and forward, else cosine and sine
    std::vector<Branch> branches(const std::vector<CampbellPoint>& points, const Identification& identification,
                                 bool whirl) const;

private:
    struct Track {
        std::vector<int> mode;
        std::vector<double> mac;
    };
    std::vector<Track> tracks_;
    std::vector<Mode> last_;  ///< last known mode of every track
    std::size_t points_ = 0;
};

}  // namespace cardan::solvers
