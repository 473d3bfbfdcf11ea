/// @file
/// Vertically stacked panels with a common x-axis, as one gnuplot picture.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace cardan::solvers {

struct StackCurve {
    std::string label = {};              ///< in the legend above the panel
    std::vector<double> x = {}, y = {};  ///< a y that is not finite is a gap
};

struct StackPanel {
    std::string y_label = {};
    std::vector<StackCurve> curves = {};  ///< at most one per colour of the palette
    bool logarithmic = false;             ///< at most six decades below the largest value
};

/// A vertical line through all panels.
struct StackMark {
    double x = 0;
    std::string label = {};
};

struct PanelStack {
    std::string title = {};
    std::string x_label = {};
    double x_low = 0, x_high = 1;
    std::vector<StackPanel> panels = {};
    std::vector<StackMark> marks =
        {};            ///< marks outside the axis range are left out; labels that would overlap move up
    int width = 1200;  ///< pixels
};

/// The height follows from the panels, legends and labels.
/// @throws InputError for no panel, a panel without curves or with more than the palette has colours, an empty axis, a
///         width below 400 pixels, or a picture that would be higher than 20000; FileError, Error (gnuplot's message)
void draw(const PanelStack& stack, const std::filesystem::path& path);

}  // namespace cardan::solvers
