/// @file
/// Turbulence for a machine in a few numbers, with the values of IEC 61400-1 for the rest.
///
///     TurbulenceRequest request = iec_turbulence(IecTurbulence::ntm, iec_class("IB"), 90, 12);
///     request.grid = rotor_grid(90, 126);
///     const MadeTurbulence made = make_turbulence(request);
///     write_turbsim("box.bts", made.box, {.mean = made.mean, .text = made.note, .tower = true});
///     const Wind wind(wind_box_of(made), made.mean);  // or at once
#pragma once

#include "elements/turbulence/box_statistics.hpp"
#include "elements/turbulence/kaimal_box.hpp"
#include "elements/turbulence/mann_box.hpp"
#include "elements/turbulence/turbulence_box.hpp"
#include "elements/wind/iec_class.hpp"
#include "elements/wind/steady_wind.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace cardan {

/// The spectra of the standard, annexes B and C: independent components, or a tensor.
enum class TurbulenceModel : std::uint8_t { kaimal, mann };
const char* name_of(TurbulenceModel model);

/// Numbers of a grid around a rotor.
struct RotorGridOptions {
    int rows = 31, columns = 31;
    std::optional<double> width = {}, height = {};  ///< m; none: 1.2 times the rotor's diameter, as rotor_grid()
    double duration = 600;                          ///< s, at least
    double time_step = 0.05;                        ///< s
};

/// A grid whose middle is the hub, for a machine that moves and yaws in it. It is 1.2 diameters wide and high, so that
/// a tenth of a diameter is spare on each side for the motion of the tower and for the hub, which lies an overhang away
/// from the tower's axis; where the ground is near, it reaches from the hub down by the rotor's radius and three
/// quarters of what is left below it, and as far up. The duration is rounded up to an even number of steps without a
/// prime factor above 100.
/// @param hub_height, rotor_diameter  m
/// @throws InputError for a rotor that reaches the ground, a grid that does not hold the rotor or reaches the ground,
/// and numbers out of range
BoxGrid rotor_grid(double hub_height, double rotor_diameter, const RotorGridOptions& options = {});

/// The turbulence that is asked for.
struct TurbulenceRequest {
    TurbulenceModel model = TurbulenceModel::kaimal;
    double speed = 0;                       ///< of the mean wind at hub height, m/s
    double deviation = 0;                   ///< sigma_1 of u at the hub, m/s: iec_normal_turbulence() ...
    double hub_height = 0;                  ///< m
    double exponent = iec_normal_exponent;  ///< of the mean wind's power law; extreme winds: iec_extreme_exponent
    BoxGrid grid = {};                      ///< rotor_grid()
    std::uint64_t seed = 1;
    bool scaled = false;  ///< to the standard deviations exactly, at the grid's centre; else as the seed has it
    TransverseCoherence transverse = TransverseCoherence::as_u;  ///< of Kaimal's v and w
    PlaneOrder order = PlaneOrder::last_first;                   ///< of Mann's planes
    int threads = 1;                                             ///< 0: one per processor
    /// Called now and then; true ends the work.
    std::function<bool()> cancelled = {};
    /// Called likewise; the work is done when done equals total.
    std::function<void(int done, int total)> progress = {};

    /// @throws InputError for numbers out of range; the grid's are checked where a box is made
    void check() const;
};

/// The spectra and the coherence that a request asks for, of infinite time and without a grid.
struct TurbulenceTarget {
    std::variant<Kaimal, MannParameters> model;
    double speed = 0;  ///< m/s

    /// One-sided spectra of u, v, w, (m/s)^2/Hz.
    Vec3 spectra(double frequency) const;
    /// Coherence of a component (0, 1, 2: u, v, w) at two points of the same height, not squared: real, as S_ij is. Of
    /// Mann's tensor it may be negative.
    /// @param distance  m, > 0
    double coherence(int component, double frequency, double distance) const;
    Vec3 deviations() const;  ///< m/s
};
/// Turbulent winds of IEC 61400-1.
enum class IecTurbulence : std::uint8_t {
    ntm,   ///< normal turbulence
    etm,   ///< extreme turbulence
    ewm1,  ///< extreme wind of one year
    ewm50  ///< extreme wind of 50 years
};
const char* name_of(IecTurbulence kind);
/// A request with speed, standard deviation and exponent of the standard, without a grid.
/// @param speed  mean at the hub, m/s; of extreme winds, whose class has it, 0
/// @throws InputError for a speed that is not positive, or one of an extreme wind, and as IecClass::check()
TurbulenceRequest iec_turbulence(IecTurbulence kind, const IecClass& wind_class, double hub_height, double speed = 0);

/// The target of a request: Kaimal turbulence as kaimal_turbulence(), or Mann's as iec_mann() with the dissipation that
/// makes the tensor's own deviation of u sigma_1.
TurbulenceTarget target_of(const TurbulenceRequest& request);

/// Turbulence that was made.
struct MadeTurbulence {
    TurbulenceBox box;             ///< no steps: it was cancelled
    SteadyWind mean;               ///< to be added
    RealisedTurbulence realised;   ///< what the box has
    Vec3 expected = Vec3::Zero();  ///< deviations expected of all seeds in a box of this size and length, m/s
    std::string note;              ///< the request in a line of ASCII: request_of_note()
};

/// Makes the turbulence of a request: kaimal_box() or mann_box(). The same request makes the same box, with any number
/// of threads. Mann's is scaled to sigma_1 as expected of all seeds, and with `scaled` at the centre.
/// @throws InputError, MemoryError as these
MadeTurbulence make_turbulence(const TurbulenceRequest& request);

/// A wind of turbulence in memory, to be used at once. It is periodic and repeats below its grid what the lowest row
/// has, and beside and above it the edge (OutsideBox::hold).
std::shared_ptr<const WindBox> wind_box_of(MadeTurbulence made);

/// The request without its grid and threads, that a note of a box is of; none: the note is not one of
/// make_turbulence().
std::optional<TurbulenceRequest> request_of_note(std::string_view note);

}  // namespace cardan
