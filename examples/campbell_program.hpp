/// @file
/// What the programs that compute Campbell diagrams have in common.
#pragma once

#include "solvers/plot_campbell.hpp"

#include "examples/program.hpp"
#include <cctype>
#include <charconv>
#include <cmath>

namespace cardan::program {

/// The option --rpm: FIRST:LAST:STEP or one number, rev/min.
/// @return rad/s;  @throws InputError
inline std::vector<double> rotor_speeds(const std::string& given) {
    std::vector<double> numbers;
    const char* at = given.data();
    const char* const end = at + given.size();
    while (true) {
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || (next != end && *next != ':'))
            throw InputError("--rpm", "value", given, "FIRST:LAST:STEP or one number, rev/min");
        numbers.push_back(value);
        if (next == end) break;
        at = next + 1;
    }
    if (numbers.size() == 1) return solvers::rpm_range(numbers[0], numbers[0], 1);
    if (numbers.size() != 3) throw InputError("--rpm", "value", given, "FIRST:LAST:STEP or one number, rev/min");
    return solvers::rpm_range(numbers[0], numbers[1], numbers[2]);
}

inline void speed_progress(int done, int total) {
    progress(text("\rrotor speed ", done, " of ", total, done == total ? "\n" : ""));
}

/// "1st blade flap (symmetric)" -> "1st_blade_flap_symmetric"
inline std::string file_name(const std::string& mode) {
    std::string name;
    for (char c : mode)
        if (std::isalnum(static_cast<unsigned char>(c)))
            name += c;
        else if (!name.empty() && name.back() != '_')
            name += '_';
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name;
}

/// Mode shapes at the first and the last rotor speed: FOLDER/<mode>_<rpm>rpm.svg, .png.
/// @throws FileError
inline void draw_modes(const solvers::Campbell& diagram, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError(folder.string(), error.message());
    std::vector<std::size_t> points{0};
    if (diagram.points.size() > 1) points.push_back(diagram.points.size() - 1);
    for (const solvers::Branch& branch : diagram.branches)
        for (std::size_t point : points) {
            if (branch.mode[point] < 0) continue;
            const auto rpm = std::lround(diagram.points[point].rotor_speed * 30 / pi);
            for (const char* kind : {".svg", ".png"})
                solvers::plot_mode(diagram, branch, point,
                                   folder / text(file_name(branch.name), "_", rpm, "rpm", kind));
        }
}

}  // namespace cardan::program
