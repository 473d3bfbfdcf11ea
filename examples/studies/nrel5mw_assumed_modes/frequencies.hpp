/// @file
/// Frequencies of the rotating blade: what the paper of 2018 prints, and by which model.
#pragma once

#include "examples/studies/machines/nrel5mw_assumed_modes.hpp"

#include <array>
#include <string>
#include <vector>

namespace cardan::paper2018 {

inline constexpr std::size_t modes = 5;
inline const std::array<std::string, modes> mode_names{"1st flap", "1st edge", "2nd flap", "2nd edge", "1st torsion"};

/// Frequencies at one rotor speed, Hz; 0: not known.
using Frequencies = std::array<double, modes>;

/// Rotor speeds of the paper's Tables 1 and 2, and rated speed, for which it prints nothing.
inline constexpr std::array<double, 7> printed_rpm{0, 3, 6, 9, 12, 12.1, 15};
inline constexpr std::array<Frequencies, 7> printed{{{0.6824, 1.0925, 1.9921, 4.0464, 5.7446},
                                                     {0.7005, 1.0967, 2.0304, 4.0584, 0},
                                                     {0.7442, 1.1088, 2.1328, 4.0933, 0},
                                                     {0.7965, 1.1273, 2.2732, 4.1484, 0},
                                                     {0.8486, 1.1504, 2.4300, 4.2207, 0},
                                                     {},
                                                     {0.8983, 1.1763, 2.5923, 4.3072, 0}}};
/// The other columns of its Table 1, at rest: FAST's program Modes, and ADAMS by a reference of the paper.
inline constexpr Frequencies printed_modes{0.6830, 1.0968, 1.9909, 4.0714, 0};
inline constexpr Frequencies printed_adams{0.6745, 1.1033, 1.8394, 3.8997, 0};
/// Converged by a method that shares nothing with either model, to 1e-4 Hz (docs/nrel5mw_blade.md).
inline constexpr std::array<double, 3> exact_rpm{0, 6, 12.1};
inline constexpr std::array<Frequencies, 3> exact{{{0.6772, 1.0855, 1.9516, 3.9962, 5.4709},
                                                   {0.6904, 1.0875, 1.9663, 4.0015, 5.4719},
                                                   {0.7288, 1.0936, 2.0105, 4.0173, 5.4753}}};

/// The named modes of a blade, distinguished by their elastic energy, without velocity terms.
struct NamedModes {
    Frequencies hz{};
    std::array<Vector, modes> shape;
};
/// @throws NumericalError if one of them is missing
NamedModes named_modes(const AssumedModesBlade& blade, double rpm);
/// Frequencies with the velocity terms, that is, Coriolis forces.
Frequencies gyroscopic_frequencies(const AssumedModesBlade& blade, double rpm);
/// Frequencies by converged functions with the velocity terms, of the blade stretched by its centrifugal force.
Frequencies stretched_frequencies(double rpm);
/// First torsion at rest by the paper's model, Hz: the blade as it is; its polar inertia without the mass factor;
/// the tabulated inertia taken to be about the pitch axis instead of the mass centre.
std::array<double, 3> torsion_at_rest(const AssumedModesBasis& basis);
/// The paper's model at rest without twist and offset of mass centres: flap and edge are uncoupled.
Frequencies untwisted_at_rest(const AssumedModesBasis& basis);

/// Frequencies of the joint chain.
std::vector<Frequencies> chain_frequencies(int elements, const std::vector<double>& rpm);

}  // namespace cardan::paper2018
