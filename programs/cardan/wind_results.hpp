/// @file
/// Output of `cardan steady --wind`: text, files and pictures.
#pragma once

#include "mbs/system/channel.hpp"
#include "programs/cardan/revolution.hpp"
#include "turbines/operation/wind_operation.hpp"

#include <string>
#include <vector>

namespace cardan::program {

struct WindResults {
    std::string title;
    std::vector<turbines::WindOperatingPoint> points;    ///< that converged, at least one
    std::vector<Channel> channels;                       ///< the main ones
    std::vector<std::vector<MeanAndRange>> values = {};  ///< of the channels over a revolution, by point
};
WindResults wind_results(const turbines::WindOperation& machine, std::vector<turbines::WindOperatingPoint> points,
                         const StationOptions& stations, std::string title);

void print(const WindResults& results);
/// Results of another mesh for the same operation, in one line.
/// @param finer  a single point
std::string beside(const WindResults& results, std::size_t point, const WindResults& finer);
/// PREFIX.csv, PREFIX_sections.csv.  @throws FileError
void write_csv(const WindResults& results, const std::string& prefix);
/// @throws FileError
/// @param air  turbines::air_in_equilibrium()
void write_hdf5(const WindResults& results, const std::string& path, const std::string& air,
                const std::string& description);

/// @name Pictures: PREFIX, PREFIX_sections, PREFIX_coefficients, .svg and .png
///@{
/// Over the wind speed, of two points at least.
void draw_points(const WindResults& results, const std::string& prefix);
/// Along the blade, of at most six winds.
void draw_sections(const WindResults& results, const std::string& prefix);
/// Draws the coefficients of the rotor that does not bend, over the tip-speed ratio, for some pitch angles.
void draw_coefficients(const std::string& title, const AeroBlade& blade, const RotorAirOptions& options, int blades,
                       double cone, const std::string& prefix);
///@}

}  // namespace cardan::program
