/// @file
/// Names on the command line of fields of the library's options: its errors and remarks name fields.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace cardan::program {

/// A text of the library with options in the place of the fields that it names.
inline std::string in_options(std::string text) {
    // Longer names before those that they begin with.
    constexpr auto names = std::to_array<std::pair<std::string_view, std::string_view>>({
        {"MachineSettings::generator = GeneratorDof::free", "--generator free"},
        {"MachineSettings::yaw = YawDof::prescribed", "--yaw driven"},
        {"MachineSettings::yaw", "--yaw"},
        {"MachineSettings::foundation", "--foundation"},
        {"MachineSettings::blade_damping", "--blade-damping"},
        {"MachineSettings::tower_damping", "--tower-damping"},
        {"MachineSettings::tower, blades", "--tower bends, --blades bend"},
        {"MachineSettings::pitch_stiffness", "--pitch-stiffness"},
        {"MachineSettings::pitch_damping", "--pitch-damping"},
        {"MachineOperation::rated_power [W]", "--rated-power [kW]"},
        {"Controller::baseline()", "--controller baseline"},
        {"Controller::period", "--controller-period"},
        {"Controller::generator_efficiency", "--generator-efficiency"},
        {"Controller::library", "--controller"},
        {"Controller::input", "--controller-input"},
        {"Controller::individual_pitch", "--pitch-control"},
        {"Controller::actuators", "--pitch-actuator"},
        {"AirSettings::shear_exponent", "--shear"},
        {"OutsideBox::hold or OutsideBox::repeat", "--wind-outside hold or repeat"},
        {"SimulationSettings::rotor_speed", "--rpm"},
        {"SimulationSettings::rotor_torque", "--rotor-torque"},
        {"SimulationSettings::wind", "--wind"},
        {"SimulationSettings::controller", "--controller"},
        {"SimulationSettings::generator_torque", "--generator-torque"},
        {"SimulationSettings::generator_slope", "--generator-slope"},
        {"SimulationSettings::azimuth", "--azimuth"},
        {"SimulationSettings::tolerance", "--tolerance"},
        {"SimulationSettings::qd", "--qd"},
        {"SimulationSettings::q", "--q"},
        {"RecordSettings::resume", "--resume"},
        {"RecordSettings::duration", "--duration"},
        {"RecordSettings::step", "--step"},
        {"CampbellSettings::rotor_speeds", "--rpm"},
        {"CampbellSettings::pitch_schedule", "--pitch-schedule"},
        {"CampbellSettings::max_frequency_hz", "--max-frequency"},
        {"CampbellSettings::like", "--like"},
        {"CampbellSettings::harmonics", "--harmonics"},
        {"CampbellSettings::winds", "--wind"},
        {"OperationSettings::rated_power", "--rated-power KW"},
        {"OperationSettings::rated_rotor_speed", "--rated-rpm"},
        {"OperationSettings::min_rotor_speed", "--min-rpm"},
        {"WindRunOptions::winds", "--wind"},
        {"LinearModelSettings::wind", "--wind"},
        {"PartModesSettings::max_frequency_hz", "--max-frequency"},
        {"LinearModelSettings::rotor_speed", "--rpm"},
        {"LinearModelSettings::max_frequency_hz", "--max-frequency"},
        {"LinearModelSettings::harmonics", "--harmonics"},
        {"LinearModelSettings::azimuths", "--azimuths"},
        {"LinearModelSettings::error", "--error"},
        {"MachineOperation::schedule", "--schedule"},
    });
    for (const auto& [field, option] : names) {
        for (std::size_t at = text.find(field); at != std::string::npos; at = text.find(field, at + option.size()))
            text.replace(at, field.size(), option);
    }
    return text;
}

}  // namespace cardan::program
