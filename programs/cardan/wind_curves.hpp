/// @file
/// Operating points as curves over the wind speed: of a run, or of its file, one or several in a picture.
#pragma once

#include "programs/cardan/wind_results.hpp"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cardan::program {

struct WindCurves {
    std::string name;  ///< in the legend, where there are several
    std::string title;
    std::vector<double> winds;                              ///< m/s, rising
    std::map<std::string, std::vector<double>> quantities;  ///< SI, by their names in the file: "power"
    std::vector<Channel> channels;                          ///< name and units
    std::vector<std::vector<MeanAndRange>> values;          ///< by channel, by wind; SI
};

WindCurves curves_of(const WindResults& results);

/// Whether a file holds operating points over the wind.
bool is_wind_result(const std::filesystem::path& path);
/// @throws FileError
WindCurves read_wind_curves(const std::filesystem::path& path, std::string name);

/// Power, thrust, rotor speed, pitch, coefficients, and of channels the mean, of a single run also minimum and maximum.
/// @param channels  by name; empty: deflection, twist and root moment of blade 1, as far as they are there
/// @param path      its ending selects the format
/// @throws InputError for a channel that none has, or for fewer than two winds
void draw(std::span<const WindCurves> curves, const std::vector<std::string>& channels, const std::string& title,
          const std::filesystem::path& path);

}  // namespace cardan::program
