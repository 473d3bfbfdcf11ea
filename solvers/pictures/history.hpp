/// @file
/// Pictures of time histories and of their spectra, through gnuplot.
#pragma once

#include "solvers/pictures/display_units.hpp"
#include "solvers/signals/history.hpp"
#include "solvers/signals/spectrum.hpp"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Channels that share a panel, by name or alias. They have the same units.
struct HistoryPanel {
    std::vector<std::string> channels;
};

/// One panel for each channel.
std::vector<HistoryPanel> panels_one_each(const std::vector<std::string>& channels);

/// Channels with the same shown units together, in the order in which the units come, at most seven (the colours) in a
/// panel. Pure numbers stay alone.
/// @throws InputError for an unknown channel
std::vector<HistoryPanel> panels_by_units(const History& history, const std::vector<std::string>& channels,
                                          AngleUnits angles = AngleUnits::degrees);

/// An event: a vertical line through all panels.
struct HistoryMark {
    double time = 0;  ///< s
    std::string label;
};

/// Units are part of every label. Numbers are SI with decimal prefixes (kN m, mm) as their size asks for; angles in
/// degrees and speeds in rpm are the default because they are read most easily.
struct HistoryPlotOptions {
    std::string title = {};                                  ///< empty: that of the history
    double from = -std::numeric_limits<double>::infinity();  ///< s
    double to = std::numeric_limits<double>::infinity();     ///< s
    AngleUnits angles = AngleUnits::degrees;
    std::vector<HistoryMark> marks = {};
    int width = 1200;  ///< pixels; each keeps the smallest and the largest value of what falls on it
};

/// Panels above each other over one time axis, with the channels' long names above them. The ending of the path says
/// the kind: .svg, .png or .pdf.
/// @throws InputError for an unknown channel, units in a panel that differ, fewer than two samples from `from` to `to`,
///         values and times that are not equally many, times that fall; FileError, Error (gnuplot's message)
void plot(const History& history, const std::vector<HistoryPanel>& panels, const std::filesystem::path& path,
          const HistoryPlotOptions& options = {});

/// Where the energy is, from the recorder's channels: kinetic energy, change of the potential energy since the start,
/// dissipated energy and what drives and loads supplied in one panel, the error of the integration in a second one.
/// Kinetic + potential + dissipated less supplied energy keeps its value but for this error.
/// @throws as plot(); InputError if an energy was not recorded
void plot_energies(const History& history, const std::filesystem::path& path, const HistoryPlotOptions& options = {});

struct SpectrumPlotOptions {
    std::string title = {};  ///< empty: that of the history
    AngleUnits angles = AngleUnits::degrees;
    SpectrumOptions spectrum = {};  ///< with the part of the history
    bool density = false;           ///< power spectral densities instead of amplitudes
    double max_frequency_hz = 0;    ///< 0: half the sampling frequency
    double rotor_frequency_hz = 0;  ///< > 0: lines at its multiples nP where they have room, see rotor_multiples()
    int blades = 3;
    int width = 1200;  ///< pixels
};

/// Spectra with logarithmic amplitudes over frequency, panels as above.
/// @throws InputError as plot() and as spectrum(), and for frequencies or blades that are negative
void plot_spectra(const History& history, const std::vector<HistoryPanel>& panels, const std::filesystem::path& path,
                  const SpectrumPlotOptions& options = {});

}  // namespace cardan::solvers
