/// @file
/// Gusts are changes of a wind over time that formulas describe: the extreme winds of IEC 61400-1.
#pragma once

#include "elements/wind/steady_wind.hpp"

#include <cstdint>
#include <vector>

namespace cardan {

/// The kind of a gust says what of the wind changes, and how.
enum class GustKind : std::uint8_t {
    none,
    eog,            ///< extreme operating gust: the speed dips, rises, dips and is what it was
    edc,            ///< extreme direction change: the direction turns and stays
    ecd,            ///< extreme coherent gust with direction change: speed and direction rise together and stay
    ews_vertical,   ///< extreme wind shear over the height: it comes and goes
    ews_horizontal  ///< extreme wind shear across the wind
};
/// The name of a kind is "none", "EOG", "EDC", "ECD", "vertical EWS" or "horizontal EWS".
const char* name_of(GustKind kind);

/// A gust adds to a wind, steady or not, with s = (t - start) / duration between 0 and 1 [IEC 61400-1, ed. 3 and
/// 4, 6.3],
///
///     EOG  -0.37 speed sin(3 pi s) (1 - cos 2 pi s)                        to its speed at all places,
///     EDC  angle (1 - cos pi s)/2                                          to its direction,
///     ECD  speed (1 - cos pi s)/2 and angle (1 - cos pi s)/2               to both,
///     EWS  gradient (1 - cos 2 pi s)/2 (z - hub height), or times y'       to its speed,
///
/// with y' the distance from the base's origin to the left as seen along the wind. Before it nothing is added; after it
/// nothing by EOG and EWS, all by EDC and ECD. At start and end the rates of change are continuous (of EOG the second
/// derivatives, too).
///
/// A positive angle turns the wind as SteadyWind::direction counts, from x towards y: anticlockwise from above, so that
/// it blows to the left of where it did. InflowWind of OpenFAST and files for it count clockwise. A positive gradient
/// is more wind above the hub and on the left.
///
/// The formula of EWS goes on outside of the rotor: close to the ground the wind may blow backwards.
struct Gust {
    GustKind kind = GustKind::none;
    double start = 0;     ///< s
    double duration = 0;  ///< s
    /// m/s, of EOG (V_gust, which is not its highest: that is 0.74 of it, at half its duration) and ECD (V_cg).
    double speed = 0;
    double angle = 0;     ///< rad, of EDC and ECD
    double gradient = 0;  ///< m/s per m, at half the duration, of EWS
    /// m above the ground from which the wind counts heights: there a vertical EWS changes nothing.
    double hub_height = 90;

    /// The wind with what the gust adds to it at that time.
    /// @throws InputError for an EWS in a wind whose speed is zero, or as good as zero next to it: the shear of a wind
    /// is a factor of its speed
    SteadyWind applied(const SteadyWind& wind, double time) const;
    /// Times at which the gust is not smooth: start and end; none of GustKind::none.
    std::vector<double> breaks() const;
    double end() const { return start + duration; }  ///< s
    /// @throws InputError for what is not finite or out of range, and for a speed, an angle or a gradient that the kind
    /// does not have. Of GustKind::none nothing is asked.
    void check() const;

    friend bool operator==(const Gust&, const Gust&) = default;
};

}  // namespace cardan
