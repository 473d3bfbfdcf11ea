#include "examples/studies/beam_accuracy/cases.hpp"

#include "examples/studies/beam_accuracy/figure.hpp"

namespace cardan::accuracy {

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"uniform", "Euler-Bernoulli cantilever at rest, modes 1-3", uniform_at_rest},
        {"timoshenko", "cantilever with shear and rotary inertia, r/L = 0.05", timoshenko},
        {"wedge", "tapered cantilever, A ~ 1 - x/2, I ~ (1 - x/2)^3", wedge},
        {"taper", "cantilever with EI falling to a thousandth", strong_taper},
        {"torsion", "torsion of a uniform bar", torsion},
        {"eta3", "rotating uniform cantilever, eta = 3", rotating_slowly},
        {"eta12", "rotating uniform cantilever, eta = 12", rotating_fast},
        {"column", "buckling under a dead tip load", column},
        {"elastica", "large plane deflections", elastica},
        {"bend", "45-degree bend", bend},
        {"round", "hinge laws: round beam bent diagonally", round_hinges},
        {"flat", "hinge laws: flat beam bent and twisted", flat_hinges},
        {"wt600_rest", "600 kW blade at rest, bending only", wt600_at_rest},
        {"wt600_27", "600 kW blade at 27 rpm, bending only", wt600_rotating},
        {"wt600_placed", "600 kW blade at rest, elements of equal phase", wt600_placed},
        {"nrel_rest", "NREL 5 MW blade at rest, bending only", nrel_at_rest},
        {"nrel_12", "NREL 5 MW blade at 12.1 rpm, bending only", nrel_rotating},
        {"nrel_placed", "NREL 5 MW blade at rest, elements of equal phase", nrel_placed},
    };
    return all;
}

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all{
        {"beam_rest",
         "Cantilevers at rest, frequency of mode 1",
         {{"uniform", 0, "uniform, Euler-Bernoulli"},
          {"timoshenko", 0, "uniform, Timoshenko, r/L = 0.05"},
          {"taper", 0, "EI falling to 1/1000"}},
         {"Ga", "Sa"}},
        {"beam_rotating",
         "Rotating uniform cantilever",
         {{"eta3", 0, "η = 3, flap 1"}, {"eta12", 0, "η = 12, flap 1"}, {"eta12", 2, "η = 12, lag 1"}},
         {"Sa"}},
        {"beam_statics",
         "Torsion, buckling, large plane deflection",
         {{"torsion", 0, "torsion, frequency 1"},
          {"column", 0, "buckling load"},
          {"elastica", 0, "elastica, tip force 5: tip"}}},
        {"beam_space",
         "Large deflections in space: tip",
         {{"bend", 0, "45-degree bend, F = 6"},
          {"bend", 2, "45-degree bend, F = 600"},
          {"round", 0, "round straight beam, diagonal force"}}},
        {"beam_blades",
         "Blades, bending only, flap 1",
         {{"wt600_27", 0, "600 kW, 27 rpm, equal elements"},
          {"nrel_12", 0, "5 MW, 12.1 rpm, equal elements"},
          {"nrel_placed", 0, "5 MW, 0 rpm, equal phase"}}},
    };
    return all;
}

}  // namespace cardan::accuracy
