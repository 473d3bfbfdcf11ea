#include "solvers/campbell_data/shares.hpp"

namespace cardan::solvers {

double WhirlShare::of(RotorPattern pattern) const {
    switch (pattern) {
        case RotorPattern::backward:
            return (cosine + sine) * (1 - whirl) / 2;
        case RotorPattern::forward:
            return (cosine + sine) * (1 + whirl) / 2;
        case RotorPattern::cosine:
            return cosine;
        case RotorPattern::sine:
            return sine;
        default:
            return 0;
    }
}

double EnergyFraction::of(RotorPattern pattern, int harmonic) const {
    if (pattern == RotorPattern::none || pattern == RotorPattern::collective || pattern == RotorPattern::symmetric)
        return collective;
    if (pattern == RotorPattern::single) return 0;  // no combination of the blades
    if (pattern == RotorPattern::differential || pattern == RotorPattern::antisymmetric) return differential;
    if (harmonic == 1) return WhirlShare{cosine, sine, whirl}.of(pattern);
    const auto at = static_cast<std::size_t>(harmonic - 2);
    return at < higher.size() ? higher[at].of(pattern) : 0;
}

double EnergyFraction::total() const {
    double sum = collective + cosine + sine + differential;
    for (const WhirlShare& pair : higher) sum += pair.cosine + pair.sine;
    return sum;
}

const char* pattern_name(RotorPattern pattern) {
    switch (pattern) {
        case RotorPattern::none:
            return "none";
        case RotorPattern::collective:
            return "collective";
        case RotorPattern::backward:
            return "backward";
        case RotorPattern::forward:
            return "forward";
        case RotorPattern::cosine:
            return "cosine";
        case RotorPattern::sine:
            return "sine";
        case RotorPattern::differential:
            return "differential";
        case RotorPattern::symmetric:
            return "symmetric";
        case RotorPattern::antisymmetric:
            return "antisymmetric";
        case RotorPattern::single:
            return "single";
    }
    return "";
}

}  // namespace cardan::solvers
