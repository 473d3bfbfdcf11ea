/// @file
/// Pictures of Campbell diagrams and mode shapes, through gnuplot.
#pragma once

#include "solvers/campbell_data/diagram.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <filesystem>
#include <optional>

namespace cardan::solvers {

/// A diagram that is drawn over another one.
struct OtherDiagram {
    std::string name;
    const Campbell* diagram = nullptr;
};

struct CampbellPlotOptions {
    std::vector<std::string> families = {};  ///< only these families; empty: all
    int ordinal = 0;                         ///< only the first, second, ... of each family; 0: all
    std::string title = {};                  ///< empty: the machine's name
    double max_frequency_hz = 0;             ///< modes entirely above are left out; 0: automatic
    bool damping_panel = true;
    bool states = false;  ///< also the branches of states (Branch::of_states)
    /// A diagram of one blade, drawn beside the machine's (thin black lines).
    const Campbell* isolated_blade = nullptr;
    /// Damping over decades, where no mode grows and the most damped one has 30 times the damping of the least: what
    /// the air does to blades that flap and that move in the plane of the rotor.
    bool log_damping = false;
    /// Drawn over the diagram, as points in the colours of the families, over the same speeds or parameter; at most
    /// four. Their names and `name`, that of the diagram itself, are in the legend.
    std::vector<OtherDiagram> others = {};
    std::string name = {};
};

/// Frequency panel over damping panel; nP lines dashed; colour by family, line style by rotor pattern, doubtful points
/// hollow. The file extension selects the format: .svg, .png or .pdf.
/// @throws InputError for diagrams over each other that are not over the same speeds or parameter, or too many;
/// FileError, Error (gnuplot's message)
void plot(const Campbell& diagram, const std::filesystem::path& path, const CampbellPlotOptions& options = {});

/// Several selections of one diagram as panels of one picture, two per row, without damping.
void plot_panels(const Campbell& diagram, const std::filesystem::path& path,
                 const std::vector<CampbellPlotOptions>& panels);

/// Differences of two diagrams (see differences()) over rotor speed, frequency over damping; modes with less than one
/// per cent of the largest frequency difference are left out.
/// @param what  "A minus B", for the title; empty: the methods
/// @throws FileError, Error (gnuplot's message); InputError without any common mode and as differences()
void plot_differences(const Campbell& diagram, const Campbell& reference, const std::filesystem::path& path,
                      const std::string& what = {});

/// A mode of a branch at one point: side view (x, z), front view (y, z) seen along the wind and top view (x, y);
/// undeformed grey, deformed in colour at the instant of largest motion and a quarter period later (the two together
/// show whirl). For Floquet modes the periodic shape at azimuth 0, blade 1 up.
void plot_mode(const Campbell& diagram, const Branch& branch, std::size_t point, const std::filesystem::path& path);

}  // namespace cardan::solvers
