/// @file
/// Labels that a mode may be named after, and how sure a name is at one rotor speed. Internal: not for users of the
/// library.
#pragma once

#include "solvers/campbell_data/diagram.hpp"
#include "solvers/mode_names/energy_shares.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// A component mode with a pattern, or a coordinate (several branches may be).
struct Label {
    int component = -1;
    RotorPattern pattern = RotorPattern::none;
    int harmonic = 1;
    int row = -1;
    double least = 0;  ///< RotorPattern::single: part of the blades' energy from which on one of them moves alone
};

/// All labels of a diagram, and what of a mode's energy is under each. What is said of a mode depends on this mode and
/// its rotor speed only, not on other speeds: names that are sure are the same in every diagram.
class ModeLabels {
public:
    /// @param energy_shares  kept as a reference, as `rows`
    /// @param rows   names of the rows
    /// @param whirl  the rotor's pairs are backward and forward, else cosine and sine
    ModeLabels(const std::vector<CampbellPoint>& points, const EnergyFractions& energy_shares,
               const std::vector<std::string>& rows, bool whirl);

    const std::vector<Label>& all() const { return labels_; }
    void add_row(int row) { labels_.push_back({.row = row}); }

    /// EnergyFraction of a mode under a label, 0 ... 1. At standstill there is no whirl: backward and forward get equal
    /// shares.
    static double part(const CampbellMode& mode, const Label& label);
    /// Share of the energy under a label; at standstill that of a whirl counts its pair.
    static double held(double rotor_speed, const CampbellMode& mode, const Label& label);
    /// The label with the largest share; `own` if none is larger. Nothing whirls at standstill: a name there holds the
    /// energy of its pair.
    Label strongest(double rotor_speed, const CampbellMode& mode, const Label& own) const;
    /// Label that holds `certain_share` of the energy of a mode, whatever it is followed from; null: none. At
    /// standstill either of a pair.
    const Label* certain(double rotor_speed, const CampbellMode& mode) const;
    /// Reason why a label is in doubt for a mode: its component holds less than half of the elastic energy, another one
    /// has `rival_share` of it, another pattern has as much, or the blades do not move in the pattern. Empty: it is
    /// sure.
    std::string doubt(double rotor_speed, const CampbellMode& mode, const Label& label) const;
    /// "1st blade flap (backward)"; of a coordinate with the kind of the motion
    std::string name(const Label& label, const CampbellMode& mode) const;
    /// "1st blade flap (backward)" of a label with a component.
    std::string name(const Label& label) const;

private:
    const EnergyFractions& energy_shares_;
    const std::vector<std::string>& rows_;
    std::vector<Label> labels_;
};

/// "hard to follow (MAC 0.45)"; empty from `min_reliable_mac` on.
std::string doubt_of_mac(double mac);

/// The name of a motion of a coordinate: "yaw (rigid)", "teeter (locked at 1 per rev and growing)", "teeter (2nd)".
std::string motion_name(const std::string& row, const std::string& kind, const std::string& number,
                        const std::string& tendency);

/// Branches are compared by these.
bool is_same(const Label& a, const Label& b);
/// True for two whirls of the same component and harmonic, or for its cosine and sine.
bool is_pair(const Label& a, const Label& b);

}  // namespace cardan::solvers
