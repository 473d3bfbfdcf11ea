/// @file
/// Root loci: eigenvalues of a Campbell diagram in the complex plane.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <filesystem>
#include <string>

namespace cardan::solvers {

struct RootPlotOptions {
    std::string title = {};       ///< empty: the machine's name
    double max_frequency_hz = 0;  ///< 0: the largest of the branches
    bool states = false;          ///< also the motions of states
};

/// Each branch as a line through its eigenvalues, from a circle at the first point to a dot at the last: damped
/// frequency over growth rate. Growing motions lie in the shaded half. Motions of states, where they are asked for, are
/// small grey crosses, and lines where they are followed. The file extension selects the format: .svg, .png or .pdf.
/// @throws FileError, Error (gnuplot's message), InputError without points or branches
void plot_roots(const Campbell& diagram, const std::filesystem::path& path, const RootPlotOptions& options = {});

}  // namespace cardan::solvers
