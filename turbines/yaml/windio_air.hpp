/// @file
/// Aerodynamics of the blades from turbine files of windIO (YAML), versions 1 and 2.
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "turbines/readers/turbine_file.hpp"
#include "turbines/yaml/model_addition.hpp"

#include <filesystem>
#include <vector>

namespace cardan::turbines {

/// Sections and polars of the blade, as AeroDynFile; windIO has no options of the air.
struct WindioAir {
    AeroBlade blade;
    RotorAirOptions options;
    double density = 1.225;  ///< kg/m^3
    std::vector<FileNote> notes;
    std::string source;  ///< text of the file
    /// Unsteady airfoils in the place of the polars of the blade, one for each, where air is to lag:
    /// UnsteadyAeroOptions::airfoils. The files have no data of it: unsteady_airfoils().
    std::vector<UnsteadyAirfoil> airfoils = {};
};

/// The outer shape of the blade (outer_shape_bem, outer_shape) and the airfoils it names. Sections lie wherever chord,
/// twist, thickness or an airfoil are given; values are linear in between. The thickness of a section is `rthick`, else
/// that of monotone cubics through those of the airfoils along the span; between two airfoils coefficients and
/// aerodynamic centre are linear in it. Where `rthick` lies beyond the two airfoils around a section, the nearest two
/// along the span count between which it lies. Aerodynamic centres lie off the reference axis by their distance along
/// the chord (pitch_axis, section_offset_y) and, if given, across it (section_offset_x). Several polars of an airfoil
/// are those at several Reynolds numbers. Density and viscosity of the air come from `environment`, else they are those
/// of the standard atmosphere. What the structure needs is not read: masses and sections may be missing.
/// @param hub_radius  places of the sections are given from the blade's root, m
/// @param additions   windIO as well, with these entries alone
/// @throws ParseError with file, line, value and what is allowed; FileError
WindioAir read_windio_air(const std::filesystem::path& path, double hub_radius,
                          const std::vector<ModelAddition>& additions = {});
/// @param file  name for messages
WindioAir parse_windio_air(const std::string& text, const std::string& file, double hub_radius,
                           const std::vector<ModelAddition>& additions = {});

}  // namespace cardan::turbines
