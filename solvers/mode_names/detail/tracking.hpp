/// @file
/// Tracking of modes over rotor speed or another parameter.
#pragma once

#include "solvers/campbell_data/diagram.hpp"
#include "solvers/mode_names/detail/neighbour_names.hpp"
#include "solvers/mode_names/detail/state_names.hpp"
#include "solvers/mode_names/energy_shares.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// Score between 0 and 1 below which two modes are never taken for the same.
inline constexpr double min_score = 0.1;

/// Contents of a branch.
enum class BranchesOf : std::uint8_t {
    names,   ///< modes of one name: where two curves exchange their characters, modes go over (HandOver)
    curves,  ///< modes of one track, whatever becomes of them
};

/// Links the modes of consecutive points by optimal assignment on the complex energy MAC, never by frequency order.
/// Points may differ in anything but their rows. Oscillations, and motions named after a coordinate, begin a track.
class Tracker {
public:
    /// Complex energy MAC of the last known mode of every track (rows) with the modes of a point (columns).
    /// @param system  the (transformed) system of the point: its energy product weighs the MAC
    Matrix mac(const SecondOrderSystem& system, const CampbellPoint& point) const;
    /// Adds a point by its score and MAC from mac() or periodic_mac(): one row per track (see last()), one column per
    /// mode.
    /// @param score  the assignment maximises its sum; below min_score a track ends
    /// @param mac    kept with the branch
    /// @throws InputError for matrices of another size
    void add(const Matrix& score, const Matrix& mac, const CampbellPoint& point);
    /// Last known mode of every track.
    std::vector<const CampbellMode*> last() const;
    /// True if add() would continue all vibrations of the last point up to a frequency beyond doubt: with a MAC of
    /// `min_reliable_mac` at least, and with no other mode whose MAC is four fifths of that and whose eigenvalue is
    /// nearer. Both hold for a point that is near enough, whatever the modes. Motions of states need not be certain,
    /// nor modes with a damping ratio above 0.5, which mix with them and are far from growing.
    bool continues(const Matrix& score, const Matrix& mac, const CampbellPoint& point, double largest_hz) const;

    /// Branches with names: every branch gets the component and rotor pattern that hold most of its elastic energy over
    /// the sweep, or the coordinate that moves most, no name twice (assignment again).
    /// Branches of states have names of their own: take_branches_of_states().
    /// @param rows  names of the rows
    /// @param states  in the order of Mode::states
    /// @param whirl  name the rotor's pairs backward and forward, else cosine and sine
    /// @param neighbour  with all points; null: none
    std::vector<Branch> branches(const std::vector<CampbellPoint>& points, const EnergyFractions& energy_shares,
                                 const std::vector<std::string>& rows, const std::vector<NamedState>& states,
                                 bool whirl, BranchesOf of, NeighbourNames* neighbour = nullptr) const;

private:
    struct Track {
        std::vector<int> mode;
        std::vector<double> mac;
    };
    void require_size(const Matrix& matrix, const CampbellPoint& point) const;

    double mac_between(std::size_t before, int mode_before, std::size_t point, int mode) const;

    std::vector<Track> tracks_;
    std::vector<Matrix> mac_;  // by point: as given to add()
    std::vector<CampbellMode> last_;
    std::size_t points_ = 0;
};

}  // namespace cardan::solvers
