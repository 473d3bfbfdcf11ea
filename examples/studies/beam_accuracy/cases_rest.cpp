// Vibrations at rest.
#include "examples/studies/beam_accuracy/cases.hpp"
#include "examples/studies/beam_accuracy/chain.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

using enum Check::Kind;

// Root of cos x cosh x = -1 squared: clamped-free Euler-Bernoulli beam.
double clamped_free(int mode) {
    double x = mode == 1 ? 1.8751 : (mode - 0.5) * pi;
    for (int i = 0; i < 20; ++i) x -= (std::cos(x) + 1 / std::cosh(x)) / (-std::sin(x) - std::tanh(x) / std::cosh(x));
    return x * x;
}

// (beta h)^4 of a mode.
double dispersion(int mode, int elements) {
    return std::pow(clamped_free(mode), 2) / std::pow(elements, 4);
}

std::vector<double> first(std::vector<double> values, std::size_t count) {
    values.resize(count, std::nan(""));
    return values;
}

std::function<std::vector<double>(const Method&, int)> flap_of(const BeamLine& line, std::size_t count) {
    return [line, count](const Method& method, int n) {
        return first(bending_modes(method, {line, Plane::flap}, equal_ends(line.length, n)).flap, count);
    };
}

std::vector<Quantity> limits(const BeamLine& line, std::size_t count) {
    const BendingModes limit = hermite_limit({line, Plane::flap});
    std::vector<Quantity> quantities;
    for (std::size_t k = 0; k < count; ++k)
        quantities.push_back(
            {"mode " + std::to_string(k + 1), limit.flap.at(k), "Hermite, 192 elements, extrapolated"});
    return quantities;
}

}  // namespace

Study uniform_at_rest() {
    Study s{"uniform", "uniform Euler-Bernoulli cantilever, omega in sqrt(EI/(mu L^4))"};
    for (int mode : {1, 2, 3})
        s.quantities.push_back({"mode " + std::to_string(mode), clamped_free(mode), "cos x cosh x = -1"});
    s.methods = {"G", "S", "K", "Ga", "Sa", "Hermite", "mixed"};
    s.compute = flap_of(uniform_beam(1, slender()), 3);
    s.checks = {{order, "G", 0, 16, 4.1, 0.1},
                {order, "S", 0, 16, 4, 0.05},
                {order, "K", 0, 16, 4, 0.05},
                {order, "Ga", 0, 8, 6, 0.1},
                {order, "Sa", 0, 8, 6, 0.1},
                {order, "Hermite", 0, 16, 4, 0.05},
                {order, "mixed", 0, 16, 2, 0.05},
                {error, "Hermite", 1, 16, 100 * dispersion(2, 16) / 720 / 2, 0.02},
                {error, "S", 1, 16, -100 * dispersion(2, 16) / 720 / 2, 0.02},
                {error, "K", 1, 32, -100 * dispersion(2, 32) / 720 / 2, 0.02},
                {error, "K", 0, 4, -0.00355, 0.01},
                {error, "G", 1, 32, 100 * dispersion(2, 32) * (17. / 2160 - std::sqrt(3.) / 216) / 2, 0.05}};
    return s;
}

Study timoshenko() {
    EngineeringSection section = slender();
    section.GA_y = section.GA_z = 1 / (0.05 * 0.05 * 3.12);
    section.j_flap = section.j_edge = 0.05 * 0.05;
    Study s{"timoshenko", "uniform Timoshenko cantilever, r/L = 0.05, E/kG = 3.12"};
    const std::vector<double> exact{3.43527496, 19.10362328, 46.60313987};
    for (std::size_t k = 0; k < exact.size(); ++k)
        s.quantities.push_back({"mode " + std::to_string(k + 1), exact[k], "Huang 1961, docs/verification.md"});
    s.methods = {"G", "S", "K", "Hermite", "mixed"};
    s.compute = flap_of(uniform_beam(1, section), 3);
    s.note = "Hermite here: shape functions of the Timoshenko beam.";
    s.checks = {{order, "G", 0, 32, 2, 0.05},     {order, "S", 0, 32, 2, 0.05},     {order, "Hermite", 0, 32, 2, 0.05},
                {order, "G", 2, 32, 2, 0.1},      {error, "S", 0, 4, 0.0101, 0.02}, {order, "K", 0, 32, 2, 0.1},
                {error, "K", 0, 4, 0.00587, 0.01}};
    return s;
}

Study wedge() {
    const BeamLine line{1, {}, [](double x) {
                            const double t = 1 - x / 2;
                            EngineeringSection section = slender();
                            section.mass = t, section.EI_flap = section.EI_edge = t * t * t;
                            return section.section();
                        }};
    Study s{"wedge", "tapered cantilever, A ~ 1 - x/2, I ~ (1 - x/2)^3"};
    s.quantities = limits(line, 2);
    s.methods = {"G", "S", "K", "Gauss + N", "Sa", "Hermite", "static", "mixed"};
    s.compute = flap_of(line, 2);
    s.checks = {{order, "G", 0, 32, 4, 0.1},       {order, "S", 0, 32, 4, 0.1},
                {order, "Hermite", 0, 32, 4, 0.1}, {order, "static", 0, 32, 4, 0.1},
                {error, "G", 0, 4, -0.0111, 0.01}, {error, "S", 0, 4, -0.0194, 0.01},
                {order, "K", 0, 32, 4, 0.1},       {order, "Gauss + N", 0, 32, 4, 0.1},
                {error, "K", 0, 4, 0.00125, 0.01}, {error, "Gauss + N", 0, 4, 0.00359, 0.01}};
    return s;
}

Study strong_taper() {
    const BeamLine line{1, {}, [](double x) {
                            EngineeringSection section = slender();
                            section.mass = std::pow(10, -1.5 * x);
                            section.EI_flap = section.EI_edge = std::pow(10, -3 * x);
                            return section.section();
                        }};
    Study s{"taper", "cantilever, mu = 10^(-1.5 x), EI = 10^(-3 x)"};
    s.quantities = limits(line, 2);
    s.methods = {"G", "S", "K", "Gauss + N", "Hermite", "static", "mixed"};
    s.compute = flap_of(line, 2);
    s.checks = {{order, "G", 0, 32, 4, 0.1},
                {order, "S", 0, 32, 4, 0.1},
                {order, "Hermite", 0, 32, 4, 0.1},
                {order, "static", 0, 32, 4, 0.1},
                {error, "G", 0, 4, -0.204, 0.01},
                {order, "K", 0, 32, 4, 0.1},
                {order, "Gauss + N", 0, 32, 4, 0.1},
                {error, "K", 0, 4, 0.0963, 0.01},
                {error, "Gauss + N", 0, 4, 0.0998, 0.01}};
    return s;
}

Study torsion() {
    EngineeringSection section = slender();
    section.GJ = 1;
    section.j_flap = section.j_edge = 0.5;
    section.EI_flap = section.EI_edge = 1e4;
    const BeamLine line = uniform_beam(1, section);
    Study s{"torsion", "torsion of a uniform clamped bar, omega in sqrt(GJ/(J L^2))"};
    s.quantities = {{"mode 1", pi / 2, "pi/2"}};
    s.methods = {"G", "Ga", "Hermite", "mixed"};
    s.compute = [line](const Method& method, int n) -> std::vector<double> {
        if (method.scheme != Scheme::hermite) return {torsion_frequency(method, line, n)};
        // Linear bar with consistent mass: dispersion in closed form.
        const double c = std::cos(pi / (2 * n));
        return {n * std::sqrt(6 * (1 - c) / (2 + c))};
    };
    s.note = "Hermite here: linear bar elements with consistent mass. S is the same as G.";
    s.checks = {{error, "G", 0, 8, 100 * (32 / pi * std::sin(pi / 32) - 1), 1e-06},
                {order, "G", 0, 32, 2, 0.05},
                {order, "Ga", 0, 32, 4, 0.05},
                {order, "Hermite", 0, 32, 2, 0.05},
                {error, "mixed", 0, 8, 100 * (32 / pi * std::tan(pi / 32) - 1), 1e-06}};
    return s;
}

}  // namespace cardan::accuracy
