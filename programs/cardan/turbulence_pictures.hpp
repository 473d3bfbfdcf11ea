/// @file
/// A box of turbulent wind in figures and in a picture.
#pragma once

#include "elements/turbulence/turbulence_request.hpp"
#include "elements/wind/wind_box.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// A box that is looked at, and where.
struct BoxView {
    const WindBox* box = nullptr;
    SteadyWind mean = {};               ///< that is added to the box
    std::string title;                  ///< of the picture
    double hub_height = 0;              ///< m
    std::optional<double> diameter;     ///< of the rotor, m
    std::optional<double> rotor_speed;  ///< rad/s
    TurbulenceTarget target;
    std::string target_name;          ///< in legends
    std::function<bool()> cancelled;  ///< true ends the work
};

/// A point of the picture's third panel: three quarters of the rotor's radius, or of what fits around the hub.
double turning_radius(const BoxView& view);

/// A line of the table of print_box(), m/s.
void print_velocities(const std::string& what, const Vec3& values);

/// Size, times, checksum, note; mean and standard deviations at the hub.
void print_box(const BoxView& view);

/// Five panels: u at the hub over time; spectra of u, v, w at the hub; what a point of a turning blade sees, or without
/// a rotor speed the mean and the deviation over the height; coherence of u at three distances; u in a plane. Targets
/// are black lines.
/// @return whether it was drawn: else it was cancelled
/// @throws FileError, Error (gnuplot's message)
bool draw_box(const BoxView& view, const std::filesystem::path& path);

}  // namespace cardan::program
