/// @file
/// Common parts of the programs that compute Campbell diagrams.
#pragma once

#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/remarks.hpp"
#include "programs/shared/words.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/pictures/campbell.hpp"
#include "solvers/pictures/roots.hpp"
#include "turbines/analysis/rising.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <utility>
#include <vector>

namespace cardan::program {

inline constexpr auto rpm_format = "numbers and FIRST:LAST:STEP separated by commas, rev/min";

/// The option --rpm: "0:12:1,12.1", in rising order.
/// @return rad/s;  @throws InputError naming the option
inline std::vector<double> rotor_speeds(const std::string& given) {
    std::vector<double> speeds;
    for (const NumberRange& range : ranges("--rpm", given, rpm_format)) {
        if (!(range.first >= 0 && range.last >= range.first && range.step > 0))
            throw InputError("--rpm", "value", given, text(rpm_format, ", >= 0, FIRST <= LAST, STEP > 0"));
        for (const double speed : solvers::rpm_range(range.first, range.last, range.step)) speeds.push_back(speed);
    }
    return turbines::rising(std::move(speeds), "--rpm", "rotor speeds", units::rpm, "rpm", print_remark);
}

inline void speed_progress(int done, int total) {
    progress(text("rotor speed ", done, " of ", total, done == total ? "\n" : ""));
}

/// Options of a diagram with progress that Ctrl-C stops.
inline solvers::CampbellOptions campbell_options(double max_frequency_hz) {
    solvers::CampbellOptions options;
    options.max_frequency_hz = max_frequency_hz;
    options.progress = speed_progress;
    options.cancelled = interrupted;
    return options;
}

/// Prints a table to standard output.  @throws FileError
inline void print_table(const solvers::Campbell& diagram, bool states = false) {
    if (!(std::cout << solvers::table(diagram, states) << std::flush))
        throw FileError("standard output", "the table could not be written");
}

/// PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png.  @throws FileError
inline void write_files(const solvers::Campbell& diagram, const std::string& prefix,
                        const solvers::CampbellPlotOptions& picture = {}) {
    solvers::write_hdf5(diagram, prefix + ".h5");
    solvers::write_csv(diagram, prefix + ".csv");
    for (const char* kind : {".svg", ".png"}) solvers::plot(diagram, prefix + kind, picture);
}

/// Writes the files of a diagram, PREFIX_roots.svg and PREFIX_roots.png among them.
/// @param shown  of the diagram, in pictures
inline void write_files_and_roots(const solvers::Campbell& diagram, const solvers::Campbell& shown,
                                  const std::string& prefix, const solvers::CampbellPlotOptions& picture) {
    solvers::write_hdf5(diagram, prefix + ".h5");
    solvers::write_csv(diagram, prefix + ".csv");
    for (const char* kind : {".svg", ".png"}) {
        solvers::plot(shown, prefix + kind, picture);
        solvers::plot_roots(
            shown, prefix + "_roots" + kind,
            {.title = picture.title, .max_frequency_hz = picture.max_frequency_hz, .states = picture.states});
    }
    if (!picture.states && !shown.states.empty())
        std::printf("roots that are mostly states of the air are left out: --air-roots\n");
    std::printf("\nfiles: %s.h5, .csv, .svg, .png, _roots.svg, .png\n", prefix.c_str());
}

/// One of several panels: modes of some families (empty: all) with one ordinal (0: all) up to a frequency (0: all).
inline solvers::CampbellPlotOptions panel(std::vector<std::string> families, std::string title, int ordinal,
                                          double max_frequency_hz) {
    solvers::CampbellPlotOptions p;
    p.families = std::move(families);
    p.title = std::move(title);
    p.ordinal = ordinal;
    p.max_frequency_hz = max_frequency_hz;
    return p;
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
            const auto rpm = std::lround(diagram.points[point].rotor_speed * units::to_rpm);
            for (const char* kind : {".svg", ".png"})
                solvers::plot_mode(diagram, branch, point,
                                   folder / text(file_name(branch.name), "_", rpm, "rpm", kind));
        }
}

}  // namespace cardan::program
