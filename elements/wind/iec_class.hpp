/// @file
/// Classes of wind turbines and what they say of the wind at the hub: extreme speeds and turbulence of IEC 61400-1,
/// ed. 3 (2005, amendment 2010) and ed. 4 (2019), which have the same formulas.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cardan {

/// A class of wind turbines is three numbers; iec_class() has those of the standard.
struct IecClass {
    double reference_speed = 50;                ///< V_ref, the ten-minute mean of 50 years at the hub, m/s
    double reference_intensity = 0.16;          ///< I_ref, expected turbulence intensity at 15 m/s
    double mean_speed = 0.2 * reference_speed;  ///< V_ave, of a year at the hub, m/s

    /// @throws InputError unless V_ref is within 1 and 200 m/s, I_ref within 0 and 1, V_ave between 0 and V_ref
    void check() const;
    friend bool operator==(const IecClass&, const IecClass&) = default;
};

/// Reads the name of a class in any case, with or without blanks: I (V_ref 50 m/s), II (42.5) or III (37.5), then A+
/// (I_ref 0.18, ed. 4 only), A (0.16), B (0.14) or C (0.12), such as "IB" or "II A+"; S with its own V_ref in m/s, such
/// as "S 45 B".
/// @throws InputError for every other name, and as IecClass::check()
IecClass iec_class(std::string_view name);
/// Names a class: "I B", "S 45 B"; one without such a name "S (V_ref 45 m/s, I_ref 0.15, V_ave 9 m/s)".
std::string name_of(const IecClass& wind_class);

/// The recurrence of an extreme wind says how rare it is.
enum class IecRecurrence : std::uint8_t { one_year, fifty_years };

/// The power law has one exponent for the normal wind onshore (IEC 61400-1), one offshore (IEC 61400-3), and one for
/// extreme winds.
inline constexpr double iec_normal_exponent = 0.2, iec_offshore_exponent = 0.14, iec_extreme_exponent = 0.11;

/// The scale of the turbulence is Lambda_1 = 0.7 min(z, 60 m).
/// @param hub_height  z, m
/// @throws InputError unless it is positive
double iec_turbulence_scale(double hub_height);

/// The standard deviation along the mean wind in normal turbulence (NTM) is sigma_1 = I_ref (0.75 V + 5.6 m/s), its 90%
/// quantile, in m/s.
/// @param speed  V, mean at the hub, m/s
/// @throws InputError for a negative speed, and as IecClass::check()
double iec_normal_turbulence(const IecClass& wind_class, double speed);

/// The standard deviation along the mean wind in extreme turbulence (ETM) is sigma_1 = c I_ref [0.072 (V_ave/c + 3)
/// (V/c - 4) + 10], c = 2 m/s, in m/s.
/// @param speed  V, mean at the hub, m/s
/// @throws InputError for a negative speed, and as IecClass::check()
double iec_extreme_turbulence(const IecClass& wind_class, double speed);

/// The steady extreme wind (EWM), a mean of 3 s, has the speeds V_e50 = 1.4 V_ref and V_e1 = 0.8 V_e50 at the hub, m/s.
/// It changes with height by iec_extreme_exponent.
/// @throws InputError as IecClass::check()
double iec_steady_extreme_speed(const IecClass& wind_class, IecRecurrence recurrence);

/// The turbulent extreme wind (EWM) has the ten-minute means V_50 = V_ref and V_1 = 0.8 V_50 at the hub, m/s. It
/// changes with height by iec_extreme_exponent.
/// @throws InputError as IecClass::check()
double iec_turbulent_extreme_speed(const IecClass& wind_class, IecRecurrence recurrence);

/// The turbulent extreme wind (EWM) has this turbulence intensity along its mean: sigma_1 = 0.11 V.
inline constexpr double iec_turbulent_extreme_intensity = 0.11;

}  // namespace cardan
