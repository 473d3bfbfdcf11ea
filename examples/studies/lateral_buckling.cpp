// A deep, narrow cantilever under a weight at its tip gives way sideways and twists. All is in units of its length, of
// its bending stiffness sideways, EI_z, and of its torsional stiffness, GJ = EI_z. References for the critical weight:
// without deflection before buckling, the first zero of the Bessel function J_{-1/4}(P/2) [Prandtl 1899]; with it, for
// a finite EI_y, the sideways perturbation of the bent rod by an independent program. Picture: lateral_buckling.svg:
// beams with EI_y = 10 EI_z under weights that pull a little sideways.
#include "elements/cardan_beam/single_beam.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/error.hpp"
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

// @param sideways  part of the weight of 1 that pulls sideways
SingleBeam beam(int elements, double EI_y, double sideways) {
    EngineeringSection section{.mass = 1, .GJ = 1, .EI_flap = EI_y, .EI_edge = 1};
    section.j_flap = section.j_edge = 0.01;
    CardanBeamOptions options;
    options.elements = elements;
    SingleBeam out = clamped_beam(uniform_beam(1, section), options);
    FrameLoad weight;
    weight.name = "weight";
    weight.frame = out.beam.tip();
    weight.wrench.force = Vec3(0, sideways, -1);
    out.system.forces = out.system.forces.with_load(weight, out.system.model);
    return out;
}

// With z = P/2, J_{-1/4}(z) is (z/2)^(-1/4) times the sum of (-z^2/4)^k / (k! (3/4) (7/4) ... (k - 1/4)).
double prandtl() {
    const auto series = [](double P) {
        double term = 1, sum = 1;
        for (int k = 1; k < 40; ++k) sum += term *= -P * P / 16 / (k * (k - 0.25));
        return sum;
    };
    double low = 3, high = 5;
    while (high - low > 1e-14) {
        const double P = (low + high) / 2;
        (series(P) > 0 ? low : high) = P;
    }
    return low;
}

solvers::EquilibriumPath path(const System& system, std::vector<double> weights) {
    solvers::EquilibriumPathOptions options;
    options.factors = std::move(weights);
    options.stability_tolerance = 1e-7;
    solvers::EquilibriumPath out = solvers::equilibrium_path(system, options);
    require_result(out);
    return out;
}

// Where the stiffness of the bent beam first has a negative pivot.
double on_path(int elements, double EI_y) {
    const SingleBeam straight = beam(elements, EI_y, 0);
    const solvers::EquilibriumPath found = path(straight.system, {0, 1, 2, 3, 4, 5, 6});
    if (!found.stability_change) throw NumericalError("the beam does not buckle");
    return found.stability_change->factor();
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("lateral_buckling", "Lateral buckling of a cantilever under a weight at its tip.");
    int elements = 32;
    study.line.add_option("--elements", elements, "cardanic beam elements").range(1, 128);
    return study.run(argc, argv, [&] {
        const SingleBeam stiff = beam(elements, 1e6, 0);
        const std::vector<solvers::BucklingMode> linear = solvers::linear_buckling(stiff.system);
        if (linear.empty()) throw NumericalError("the beam does not buckle");
        program::compare_with("zero of the Bessel function");
        program::compare("critical weight, EI_y infinite", linear[0].factor, prandtl(), 6);
        program::compare_with("perturbation of the bent rod");
        const double critical = on_path(elements, 10);
        program::compare("EI_y = 10 EI_z", critical, 4.624632264, 6);
        program::compare("EI_y = 20 EI_z", on_path(elements, 20), 4.274845155, 6);
        program::compare("EI_y = 100 EI_z", on_path(elements, 100), 4.059627406, 6);
        std::vector<double> weights;
        for (int i = 0; i <= 60; ++i) weights.push_back(0.1 * i);
        std::vector<solvers::StackPanel> panels{{"sideways, lengths"}, {"down, lengths"}};
        for (const double sideways : {0.001, 0.01, 0.05}) {
            const SingleBeam bent = beam(elements, 10, sideways);
            for (solvers::StackPanel& panel : panels) panel.curves.push_back({text("pull sideways ", sideways, " P")});
            for (const solvers::EquilibriumPathPoint& point : path(bent.system, weights).points) {
                const Vec3 tip = bent.tip(point.at.q).p;
                for (auto [panel, value] : {std::pair(0, tip.y()), {1, -tip.z()}}) {
                    entry(panels, panel).curves.back().x.push_back(point.factor);
                    entry(panels, panel).curves.back().y.push_back(value);
                }
            }
        }
        solvers::draw({.title = "Cantilever under a weight at its tip, EI_y = 10 EI_z",
                       .x_label = "weight P, EI_z over length squared",
                       .x_high = 6,
                       .panels = panels,
                       .marks = {{critical, "critical"}}},
                      study.picture);
    });
}
