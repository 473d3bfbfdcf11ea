/// @file
/// Files that a run leaves behind: channels that are recorded, the table of the last period, the pictures.
#pragma once

#include "solvers/time/recorder.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace cardan::platform {

/// Tip deflections and root loads of the blades, positions of all coordinates, forces of the drives. With the energies
/// and the counters of the integration this is what is recorded; rates are left out, which would double the file.
std::vector<ChannelGroup> recorded_channels(const turbines::Turbine& machine);
solvers::RecorderOptions recorder_options();
/// Channels of all blades, m.
std::vector<std::string> tip_deflections(const turbines::Turbine& machine);

/// Endings of the files.
inline const std::initializer_list<const char*> outputs{".h5", ".csv", ".svg", ".png", "_energy.png", "_spectrum.png"};

/// Energies, blade loads and deflections, positions and forces of driven coordinates: name and unit of every channel in
/// the first line, SI.
void write_csv(const turbines::Turbine& machine, const solvers::History& period, const std::string& path);

/// Options of what the pictures show.
struct PictureOptions {
    double period = 0;       ///< s
    double periodic_to = 0;  ///< s, end of the rows in equal steps: that of the transient
    double rotor_speed = 0;  ///< rad/s
};

struct Drawn {
    double largest_kinetic_energy = 0;  ///< of the run, J
    double exchanged_energy = 0;        ///< see program::exchanged_energy()
    std::string files;                  ///< endings, for people
};
/// Draws from PREFIX.h5 the pictures PREFIX.svg and .png with motions, deflections and root moments in the last three
/// periods, PREFIX_energy.png of the whole run, PREFIX_spectrum.png of up to ten periods until `periodic_to`.
Drawn draw_pictures(const turbines::Turbine& machine, const std::string& prefix, const PictureOptions& options);

}  // namespace cardan::platform
