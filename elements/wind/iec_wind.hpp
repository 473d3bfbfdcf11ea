/// @file
/// Winds of IEC 61400-1 that are functions of time, for a machine: normal, extreme, gusts; their names on a command
/// line.
#pragma once

#include "elements/wind/gust.hpp"
#include "elements/wind/iec_class.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace cardan {

/// The winds of the standard without turbulence are the normal one, gusts and steady extremes.
enum class IecWindKind : std::uint8_t {
    nwp,             ///< normal wind profile
    eog,             ///< extreme operating gust
    edc,             ///< extreme direction change
    ecd,             ///< extreme coherent gust with direction change
    ews_vertical,    ///< extreme wind shear over the height
    ews_horizontal,  ///< extreme wind shear across the wind
    ewm1,            ///< steady extreme wind of one year
    ewm50            ///< steady extreme wind of 50 years
};

/// A wind's name is its kind, sign and speed. The standard asks for both signs of EDC, ECD and EWS.
struct IecWindName {
    IecWindKind kind = IecWindKind::nwp;
    /// 1 or -1, of EDC and ECD (1: turns from x towards y, to the left), vertical EWS (1: more above the hub) and
    /// horizontal EWS (1: more on the left). 1 for others.
    int sign = 1;
    double speed = 0;  ///< mean at the hub, m/s; 0 for the extreme winds, whose class has it

    friend bool operator==(const IecWindName&, const IecWindName&) = default;
};

/// Reads the name of a wind in any case: nwp:V, eog:V, edc+:V, edc-:V, ecd+:V, ecd-:V, ewsv+:V, ewsv-:V (vertical),
/// ewsh+:V, ewsh-:V (horizontal), with V the speed at the hub in m/s, and ewm1, ewm50.
/// @throws InputError for every other name, with those that are allowed
IecWindName iec_wind_name(std::string_view name);
/// Names a wind as iec_wind_name() reads it.
std::string name_of(const IecWindName& wind);

/// An IecMachine is what the winds ask of a machine and its site.
struct IecMachine {
    IecClass wind_class = {};
    double hub_height = 0;                  ///< above the ground, m
    double rotor_diameter = 0;              ///< m
    double exponent = iec_normal_exponent;  ///< of the normal wind profile; offshore: iec_offshore_exponent

    /// @throws InputError for heights and diameters that are not positive, an exponent that is not between 0 and 1, and
    /// as IecClass::check()
    void check() const;
};

/// The amplitude of EOG is V_gust = min{1.35 (V_e1 - V), 3.3 sigma_1 / (1 + 0.1 D/Lambda_1)}, with sigma_1 of NTM, m/s.
/// @param speed  V, mean at the hub, m/s
/// @throws InputError unless V is within 0 and V_ref, and as IecMachine::check()
double iec_eog_speed(const IecMachine& machine, double speed);

/// The angle of EDC is theta_e = 4 arctan{sigma_1 / [V (1 + 0.1 D/Lambda_1)]}, with sigma_1 of NTM, at most pi, rad.
/// @param speed  V, mean at the hub, m/s
/// @throws InputError unless V is within 0 and V_ref, and as IecMachine::check()
double iec_edc_angle(const IecMachine& machine, double speed);

/// ECD adds this speed, V_cg, m/s.
inline constexpr double iec_ecd_speed = 15;

/// The angle of ECD is theta_cg = 180 deg below 4 m/s, 720 deg m/s / V above, rad.
/// @param speed  V, mean at the hub, m/s
/// @throws InputError unless V is within 0 and V_ref, and as IecMachine::check()
double iec_ecd_angle(const IecMachine& machine, double speed);

/// The amplitude of EWS is K = 2.5 m/s + 0.2 6.4 sigma_1 (D/Lambda_1)^(1/4), with sigma_1 of NTM, m/s: the tips' wind
/// changes by up to K, one by more, one by less.
/// @param speed  V, mean at the hub, m/s
/// @throws InputError unless V is within 0 and V_ref, and as IecMachine::check()
double iec_ews_speed(const IecMachine& machine, double speed);

/// These are the durations of EOG, EDC, ECD and EWS in s; what EDC and ECD change stays.
inline constexpr double iec_eog_duration = 10.5, iec_edc_duration = 6, iec_ecd_duration = 10, iec_ews_duration = 12;

/// Makes the gust of a wind; nwp, ewm1 and ewm50 have none (GustKind::none).
/// @param start  s
/// @throws InputError for a sign that the kind does not have, and as the amplitude of its kind and Gust::check()
Gust iec_gust(const IecMachine& machine, const IecWindName& wind, double start);

/// Makes the steady wind under a gust, or all of a wind without one: about the hub, with the power law of the machine,
/// for ewm1 and ewm50 that of the extreme wind; without upflow (the standard asks for up to 8 deg) and along x (the
/// extreme wind: for up to 15 deg to both sides).
/// @throws InputError for a speed that is not positive, and as IecMachine::check() and SteadyWind::check()
SteadyWind iec_wind(const IecMachine& machine, const IecWindName& wind);

}  // namespace cardan
