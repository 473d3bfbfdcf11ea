/// @file
/// Pictures of time histories and of their spectra, through gnuplot.
#pragma once

#include "solvers/pictures/display_units.hpp"
#include "solvers/signals/history.hpp"
#include "solvers/signals/spectrum.hpp"

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Channels that share a panel, by name or alias. They must have the same units.
struct HistoryPanel {
    std::vector<std::string> channels;
};

/// One panel for each channel.
std::vector<HistoryPanel> one_panel_each(const std::vector<std::string>& channels);

/// Groups channels with the same display units, in the order in which the units occur, at most seven (the number of
/// colours) per panel. Pure numbers get panels of their own.
/// @throws InputError for an unknown channel
std::vector<HistoryPanel> panels_by_units(const History& history, const std::vector<std::string>& channels,
                                          AngleUnits angles = AngleUnits::degrees);

/// An event: a vertical line through all panels.
struct HistoryMark {
    double time = 0;  ///< s
    std::string label;
};

/// Units are part of every label. Numbers are SI with decimal prefixes (kN m, mm) where appropriate; angles in degrees
/// and speeds in rpm are the default because they are easiest to read.
struct HistoryPlotOptions {
    std::string title = {};                                  ///< empty: that of the history
    double from = -std::numeric_limits<double>::infinity();  ///< s
    double to = std::numeric_limits<double>::infinity();     ///< s
    AngleUnits angles = AngleUnits::degrees;
    std::vector<HistoryMark> marks = {};
    int width = 1200;  ///< pixels; each column of pixels keeps its smallest and largest value
};

/// One of several histories in a picture.
struct NamedHistory {
    std::string name;  ///< in the legend, before the channel
    const History* history = nullptr;
};

/// Panels above each other over one time axis, with the channels' long names above them. The file extension selects the
/// format: .svg, .png or .pdf.
/// @throws InputError for an unknown channel, different units in one panel, fewer than two samples from `from` to `to`,
/// different numbers of values and times, descending times; FileError, Error (gnuplot's message)
void plot(const History& history, const std::vector<HistoryPanel>& panels, const std::filesystem::path& path,
          const HistoryPlotOptions& options = {});

/// Plots several histories over each other, from the first time of any to the last. A channel that some of them have is
/// drawn of those; with different units there it is refused as within a panel.
/// @throws InputError also for a channel that none has
void plot(std::span<const NamedHistory> histories, const std::vector<HistoryPanel>& panels,
          const std::filesystem::path& path, const HistoryPlotOptions& options = {});

/// Energy balance from the recorder's channels: kinetic energy, change of potential energy since the start, dissipated
/// energy and the energy supplied by drives and loads in one panel, the integration error in a second one. Kinetic +
/// potential + dissipated - supplied energy is constant up to this error.
/// @throws as plot(); InputError if an energy was not recorded
void plot_energies(const History& history, const std::filesystem::path& path, const HistoryPlotOptions& options = {});

struct SpectrumPlotOptions {
    std::string title = {};  ///< empty: that of the history
    AngleUnits angles = AngleUnits::degrees;
    SpectrumOptions spectrum = {};  ///< includes the time range
    bool density = false;           ///< power spectral densities instead of amplitudes
    double max_frequency_hz = 0;    ///< 0: half the sampling frequency
    double rotor_frequency_hz = 0;  ///< > 0: lines at its multiples nP where there is room, see rotor_multiples()
    int blades = 3;
    int width = 1200;  ///< pixels
};

/// Spectra with logarithmic amplitudes over frequency, panels as above.
/// @throws InputError as plot() and as spectrum(), and for frequencies or blades that are negative
void plot_spectra(const History& history, const std::vector<HistoryPanel>& panels, const std::filesystem::path& path,
                  const SpectrumPlotOptions& options = {});
/// Plots the spectra of several histories over each other.
void plot_spectra(std::span<const NamedHistory> histories, const std::vector<HistoryPanel>& panels,
                  const std::filesystem::path& path, const SpectrumPlotOptions& options = {});

}  // namespace cardan::solvers
