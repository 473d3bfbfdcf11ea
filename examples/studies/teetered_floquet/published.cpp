#include "examples/studies/teetered_floquet/published.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace cardan::teetered {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Row {
    const char* name;
    const char* in_paper;
    int figure;
    double at_100, digit_at_100, rigid, digit_rigid;
    std::array<double, 4> paper;  // ratio 10, 100, 1000, rigid: Table III (its column 100 is Table II's last)
};

constexpr std::array<Row, 18> rows{{
    {"1st tower side-side", "1st tower lateral bending", 0, 0.7112, 1e-4, none, 0, {0.219, 0.292, 0.760, none}},
    {"2nd tower side-side", "2nd tower lateral bending", 0, 13.092, 1e-3, none, 0, {3.164, 8.377, 22.225, none}},
    {"1st tower fore-aft", "1st tower fore-aft bending", 0, 0.7026, 1e-4, none, 0, {0.920, 0.938, 1.494, none}},
    {"2nd tower fore-aft", "2nd tower fore-aft bending", 0, 12.856, 1e-3, none, 0, {4.584, 7.615, 23.985, none}},
    {"1st tower torsion", "1st tower torsion", 0, 136.67, 1e-2, none, 0, {21.460, 56.431, 148.091, none}},
    {"2nd tower torsion", "2nd tower torsion", 0, 410.01, 1e-2, none, 0, {79.450, 97.049, 235.723, none}},
    {"1st blade flap (symmetric)", "1st symm. flap", 3, 3.557, 1e-3, 3.4015, 1e-4, {0.217, 0.320, 0.667, 0.802}},
    {"1st blade flap (antisymmetric)",
     "1st anti-symm. flap",
     5,
     10.167,
     1e-3,
     10.167,
     1e-3,
     {2.624, 2.624, 2.624, 2.624}},
    {"2nd blade flap (symmetric)", "2nd symm. flap", 4, 20.359, 1e-3, 20.069, 1e-3, {4.660, 4.710, 4.737, 5.495}},
    {"2nd blade flap (antisymmetric)",
     "2nd anti-symm. flap",
     6,
     34.073,
     1e-3,
     34.073,
     1e-3,
     {9.578, 9.583, 9.583, 9.583}},
    {"1st blade torsion (symmetric)",
     "1st symm. torsion",
     7,
     43.837,
     1e-3,
     43.837,
     1e-3,
     {13.937, 13.936, 13.937, 13.937}},
    {"1st blade torsion (antisymmetric)",
     "1st anti-symm. torsion",
     9,
     44.18,
     1e-2,
     43.875,
     1e-3,
     {14.093, 13.935, 13.947, 13.972}},
    {"2nd blade torsion (symmetric)",
     "2nd symm. torsion",
     8,
     131.480,
     1e-3,
     131.480,
     1e-3,
     {41.610, 41.610, 41.610, 41.610}},
    {"2nd blade torsion (antisymmetric)",
     "2nd anti-symm. torsion",
     10,
     131.9,
     0.5,
     131.49,
     1e-2,
     {41.724, 41.662, 41.610, 41.620}},
    {"1st blade edge (symmetric)", "1st symm. lead-lag", 11, 3.091, 1e-3, 3.2434, 1e-4, {0.467, 0.491, 0.494, 0.496}},
    {"1st blade edge (antisymmetric)",
     "1st anti-symm. lead-lag",
     13,
     3.447,
     1e-3,
     3.411,
     1e-3,
     {0.477, 0.655, 0.633, 0.639}},
    {"2nd blade edge (symmetric)", "2nd symm. lead-lag", 12, 19.771, 1e-3, 19.712, 1e-3, {4.223, 4.465, 5.300, 5.356}},
    {"2nd blade edge (antisymmetric)",
     "2nd anti-symm. lead-lag",
     14,
     20.118,
     1e-3,
     20.018,
     1e-3,
     {4.660, 5.345, 5.647, 5.588}},
}};

std::optional<double> known(double value) {
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace

std::vector<KnownMode> known_modes(double ratio) {
    constexpr std::array<double, 4> ratios{10, 100, 1000, std::numeric_limits<double>::infinity()};
    std::vector<KnownMode> modes;
    for (const Row& row : rows) {
        KnownMode& mode = modes.emplace_back();
        mode.name = row.name;
        mode.in_paper = row.in_paper;
        mode.figure = row.figure;
        if (ratio == 100) mode.reference = known(row.at_100), mode.digit = row.digit_at_100;
        if (std::isinf(ratio)) mode.reference = known(row.rigid), mode.digit = row.digit_rigid;
        for (std::size_t i = 0; i < ratios.size(); ++i)
            if (ratio == ratios[i]) mode.paper = known(row.paper[i]);
    }
    return modes;
}

}  // namespace cardan::teetered
