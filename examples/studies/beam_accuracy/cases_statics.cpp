// Buckling and large deflections: what needs no mass.
#include "elements/sections/beam_line.hpp"
#include "examples/studies/beam_accuracy/cases.hpp"
#include "examples/studies/beam_accuracy/chain.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

using enum Check::Kind;

// Starts along x and turns to +y. [Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961-986]
struct Bend {
    static constexpr double radius = 100, angle = pi / 4;
    static BeamLine line() {
        EngineeringSection s;
        s.mass = 1, s.EA = 1e7, s.GJ = 5e6 / 6, s.EI_flap = s.EI_edge = 1e7 / 12;
        s.j_flap = s.j_edge = 1. / 12;
        return along(uniform_beam(radius * angle, s),
                     ReferenceLine::curve(
                         [](double t) { return Vec3(radius * std::sin(t), radius * (1 - std::cos(t)), 0); },
                         [](double t) { return Vec3(radius * std::cos(t), radius * std::sin(t), 0); }, 0, angle));
    }
    static Vec3 tip() { return {radius * std::sin(angle), radius * (1 - std::cos(angle)), 0}; }
};

struct Loaded {
    TipLoad load;
    Vec3 exact;
};

// Distance of the tip from where it belongs over the true displacement.
Study tips(Study study, const BeamLine& line, const Vec3& rest, const std::vector<Loaded>& loads) {
    study.compute = [line, rest, loads](const Method& method, int n) {
        std::vector<double> errors;
        for (const Loaded& l : loads) {
            // The rotation parameters of the mixed element are counted from the root axes and end before half a turn.
            if (method.scheme == Scheme::mixed && l.load.moment.norm() >= pi)
                errors.push_back(std::nan(""));
            else
                errors.push_back((loaded_tip(method, line, n, l.load) - l.exact).norm() / (l.exact - rest).norm());
        }
        return errors;
    };
    study.mixed_elements = 32;
    return study;
}

constexpr auto shooting = "Cosserat rod by shooting, docs/verification.md";

Study hinges(const std::string& name, const std::string& title, double GJ, double EI_edge, const Vec3& force,
             const Vec3& exact, std::vector<std::string> methods, std::vector<Check> checks) {
    EngineeringSection section;
    section.mass = 1, section.j_flap = section.j_edge = 0.01;
    section.GJ = GJ, section.EI_flap = 1, section.EI_edge = EI_edge;
    Study s{name, title};
    s.quantities = {{"tip", 0, shooting}};
    s.methods = std::move(methods);
    s.checks = std::move(checks);
    s.elements = {2, 3, 4, 6, 8, 12, 16, 32};
    return tips(s, uniform_beam(1, section), {1, 0, 0}, {{{.force = force, .steps = 5, .torsion = true}, exact}});
}

}  // namespace

Study column() {
    const BeamLine line = uniform_beam(1, slender());
    Study s{"column", "clamped column under a dead tip load, P L^2/EI"};
    s.quantities = {{"critical load", pi * pi / 4, "pi^2/4"}};
    s.methods = {"G", "S", "K", "Hermite", "mixed"};
    s.compute = [line](const Method& method, int n) -> std::vector<double> { return {buckling_load(method, line, n)}; };
    s.note = "S and K: the place of the hinges alone matters, 1/6.";
    s.checks = {{error, "G", 0, 4, 100 * (2.4589078 / (pi * pi / 4) - 1), 0.0001},
                {error, "S", 0, 4, 100 * (2.4673602 / (pi * pi / 4) - 1), 0.005},
                {error, "K", 0, 4, 100 * (2.4673602 / (pi * pi / 4) - 1), 0.005},
                {order, "G", 0, 32, 2, 0.05},
                {order, "S", 0, 16, 4, 0.05},
                {order, "K", 0, 16, 4, 0.05},
                {order, "Hermite", 0, 16, 4, 0.05},
                {order, "mixed", 0, 16, 2, 0.05}};
    return s;
}

Study elastica() {
    Study s{"elastica", "cantilever under a dead transverse tip force P L^2/EI = 5, and a tip moment pi EI/L: tip"};
    s.quantities = {{"tip force 5", 0, "elastica, elliptic integrals, docs/verification.md"},
                    {"tip moment pi", 0, "half circle"}};
    s.methods = {"G", "S", "K", "corotational", "mixed"};
    s.checks = {{order, "G", 0, 16, 2, 0.05},           {order, "S", 0, 16, 4, 0.05},
                {order, "corotational", 0, 16, 4, 0.1}, {order, "mixed", 0, 32, 2, 0.05},
                {order, "G", 1, 16, 2, 0.05},           {order, "S", 1, 16, 4, 0.05},
                {order, "corotational", 1, 16, 4, 0.1}, {order, "K", 0, 16, 4, 0.05},
                {order, "K", 1, 16, 4, 0.05},           {error, "K", 0, 4, 0.0201, 0.01}};
    return tips(s, uniform_beam(1, slender()), {1, 0, 0},
                {{{.force = {0, 0, 5}}, {1 - 0.387628361, 0, 0.713791524}}, {{.moment = {0, -pi, 0}}, {0, 0, 2 / pi}}});
}

Study bend() {
    Study s{"bend", "45-degree bend without shear flexibility, force out of its plane: tip"};
    s.quantities = {{"F = 6", 0, shooting}, {"F = 60", 0, shooting}, {"F = 600", 0, shooting}};
    s.methods = {"G", "S", "G chord", "S chord"};
    s.checks = {{order, "G", 0, 32, 2, 0.05},         {order, "S", 0, 32, 2, 0.05},
                {order, "G chord", 0, 32, 2, 0.05},   {order, "S chord", 2, 32, 2, 0.05},
                {error, "S chord", 0, 8, 0.12, 0.01}, {error, "S", 0, 8, 0.0024, 0.02}};
    s.elements = {2, 3, 4, 6, 8, 12, 16, 32};
    const auto load = [](double F) {
        return TipLoad{.force = {0, 0, F}, .steps = 4, .extension = true, .torsion = true};
    };
    return tips(s, Bend::line(), Bend::tip(),
                {{load(6), {70.702249123518, 29.284261753986, 1.127150771324}},
                 {load(60), {69.896582333737, 28.801083256291, 11.038267549587}},
                 {load(600), {47.152150217636, 15.685355776664, 53.471762950030}}});
}

Study round_hinges() {
    return hinges("round", "round beam, EI = GJ = 1, force (0, 2, 2): tip", 1, 1, {0, 2, 2},
                  {0.760267720202, 0.415976397684, 0.415976397684}, {"G", "S", "G swing", "S swing", "mixed"},
                  {{order, "G", 0, 32, 2, 0.05},
                   {order, "S", 0, 32, 2, 0.05},
                   {order, "G swing", 0, 32, 2, 0.05},
                   {order, "S swing", 0, 32, 4, 0.05},
                   {order, "mixed", 0, 32, 2, 0.05}});
}

Study flat_hinges() {
    return hinges("flat", "flat beam, EI = 1 and 4, GJ = 0.8, force (0, 4, 1.5): tip", 0.8, 4, {0, 4, 1.5},
                  {0.801732682163, 0.330560027212, 0.419297609561}, {"G", "S", "G frame", "S frame", "mixed"},
                  {{order, "G", 0, 32, 2, 0.05},
                   {order, "G frame", 0, 32, 2, 0.05},
                   {order, "S frame", 0, 32, 2, 0.05},
                   {error, "G", 0, 8, 0.415, 0.01},
                   {error, "G frame", 0, 8, 0.136, 0.01}});
}

}  // namespace cardan::accuracy
