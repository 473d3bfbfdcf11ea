/// @file
/// Arguments of `cardan plot`, and its pictures of time histories.
#pragma once

#include "mbs/base/text.hpp"
#include "solvers/pictures/history.hpp"

#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace cardan::program {

struct PlotArguments {
    std::string out, title;
    std::vector<std::string> files, channels, marks, formats{"svg", "png"};
    bool list = false, energy = false, spectrum = false, density = false, together = false, degrees = true;
    bool linear_trend = false;
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
    double segment = 0, max_frequency = 0, rpm = 0;
    int blades = 3;
};

/// The pictures PREFIX.svg, PREFIX.png ...; says what is in them.
template <class Draw>
void draw_files(const PlotArguments& a, const std::string& suffix, const std::string& what, const Draw& picture) {
    std::string files;
    for (const std::string& format : a.formats) {
        const std::string path = text(a.out, suffix, ".", format);
        picture(path);
        files += (files.empty() ? "" : ", ") + path;
    }
    std::cout << files << ": " << what << "\n";
}

/// "TIME=LABEL", s.  @throws InputError
std::vector<solvers::HistoryMark> marks(const std::vector<std::string>& given);

/// Draws the histories of all files over each other, or lists what is in them.
/// @param names  of the files, for legends
/// @return exit code
int draw_histories(const PlotArguments& arguments, const std::vector<std::string>& names);

}  // namespace cardan::program
