#include "examples/studies/beam_accuracy/method.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

constexpr double sixth = 1. / 6;

// K and Gauss + N place their hinges themselves: delta is ignored.
CardanBeamOptions chain(double delta, Partition partition, double bending_armature = 0, double torsion_armature = 0) {
    CardanBeamOptions options;
    options.delta = delta;
    options.partition = partition;
    options.bending_armature = bending_armature;
    options.torsion_armature = torsion_armature;
    return options;
}

CardanBeamOptions with(CardanBeamOptions options, HingeLaw law) {
    options.hinge_law = law;
    return options;
}

CardanBeamOptions with(CardanBeamOptions options, CurvedFlexibility rule) {
    options.curved_flexibility = rule;
    return options;
}

std::vector<Method> table() {
    constexpr auto N = Partition::segment_masses, S = Partition::static_moment;
    // Twice the coefficient of (beta h)^4 in omega^2 that it removes (docs/theory.md, accuracy).
    const double of_g = 17. / 1080 - std::sqrt(3.) / 108, of_s = -1. / 360;
    const HingeLaw swing{.isotropic = true}, frame{.section_frame = true};
    return {
        {"G", "G: Gauss points, segment masses", Scheme::chain, chain(delta_gauss, N), 0, 7},
        {"S", "S: hinges at 1/6, static moments", Scheme::chain, chain(sixth, S), 1, 5},
        {"Gauss + N", "Gauss + N: compliance Gauss points", Scheme::chain,
         chain(delta_gauss, Partition::compliance_gauss), 5, 6},
        {"K", "K: mean differences", Scheme::chain, chain(delta_gauss, Partition::mean_difference), 6, 12, true},
        {"Ga", "G with armature", Scheme::chain, chain(delta_gauss, N, of_g, -1. / 12), 5, 6},
        {"Sa", "S with armature", Scheme::chain, chain(sixth, S, of_s, -1. / 12), 4, 4},
        {"Hermite", "Hermite, consistent matrices", Scheme::hermite, {}, 2, 9},
        {"static", "static shapes, consistent matrices", Scheme::statics, {}, 4, 10},
        {"mixed", "mixed, geometrically exact", Scheme::mixed, {}, 3, 11},
        {"corotational", "corotational Hermite", Scheme::corotational, {}, 4, 10},
        {"G chord", "G along the chord", Scheme::chain, with(chain(delta_gauss, N), CurvedFlexibility::chord), 5, 6},
        {"S chord", "S along the chord", Scheme::chain, with(chain(sixth, S), CurvedFlexibility::chord), 4, 4},
        {"G swing", "G, isotropic hinges", Scheme::chain, with(chain(delta_gauss, N), swing), 2, 8},
        {"S swing", "S, isotropic hinges", Scheme::chain, with(chain(sixth, S), swing), 6, 10},
        {"G frame", "G, hinges in the section's frame", Scheme::chain, with(chain(delta_gauss, N), frame), 6, 12},
        {"S frame", "S, hinges in the section's frame", Scheme::chain, with(chain(sixth, S), frame), 2, 8},
    };
}

}  // namespace

const std::vector<Method>& methods() {
    static const std::vector<Method> all = table();
    return all;
}

const Method& method(const std::string& key) {
    for (const Method& m : methods())
        if (m.key == key) return m;
    throw InputError("method", "key", key, "one of the table in method.cpp");
}

}  // namespace cardan::accuracy
