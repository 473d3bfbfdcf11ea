/// @file
/// The wind boxes of tests/data/wind: 16 planes of 5 x 4 points, 15 m across, 20 m upward, of 60 x 60 m around the
/// height of 70 m; 10 m/s, 0.5 s. Their numbers are random. values.csv has the wind in them at places and times as
/// InflowWind's driver gives it (OpenFAST 5.0.0 in double precision), six digits of each.
#pragma once

#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/hawc2_box.hpp"

#include <cmath>

namespace cardan::test {

inline std::string wind_file(const std::string& name) {
    return data_file("wind/" + name);
}

/// What the files of HAWC2's kind do not say: their sizes, and how the case "hawc" adds to them.
inline turbines::Hawc2Box hawc2_box_in(const std::string& folder) {
    turbines::Hawc2Box box;
    box.files = {folder + "/hawc_u.bin", folder + "/hawc_v.bin", folder + "/hawc_w.bin"};
    box.planes = 16;
    box.rows = 4;
    box.columns = 5;
    box.plane_spacing = 5;
    box.row_spacing = 20;
    box.column_spacing = 15;
    box.mean.speed = 10;
    box.mean.reference_height = 70;
    box.mean.shear = Shear::power;
    box.mean.exponent = 0.2;
    box.start = 4;
    return box;
}

/// A row of values.csv.
struct WindValue {
    Vec3 place;
    double time;
    Vec3 velocity;
};

/// Those of one case.
inline std::vector<WindValue> wind_values(const std::string& wanted) {
    std::vector<WindValue> out;
    for (const std::string& line : lines_of(bytes_of(wind_file("values.csv")))) {
        std::istringstream in(line);
        std::string name, number;
        std::getline(in, name, ',');
        if (name != wanted) continue;
        std::vector<double> row;
        while (std::getline(in, number, ',')) row.push_back(read_number(number).value);
        out.push_back({{row[0], row[1], row[2]}, row[3], {row[4], row[5], row[6]}});
    }
    return out;
}

/// Half a unit of the last of six digits, and 1e-6 m/s for numbers of the box in single precision there.
inline double digits_of(double printed) {
    return 1e-6 + (printed == 0 ? 0 : 0.5 * std::pow(10, std::floor(std::log10(std::abs(printed))) - 5));
}

}  // namespace cardan::test
