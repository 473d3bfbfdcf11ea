// The Princeton beam (Dowell and Traybar 1975): a slender strip of aluminium, clamped at one end, with a weight at the
// other. Turned between the planes of its stiff and its soft side the strip bends about both axes and twists.
// Reference: a geometrically exact rod with shear and extension, an independent program, by shooting. (The measured
// points of the experiment are not at hand.)
// Picture: princeton_beam.svg.
#include "elements/cardan_beam/single_beam.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double length = 0.508, height = 12.377e-3, thickness = 3.2024e-3;      // m
constexpr double E = 71.7e9, nu = 0.31, G = E / (2 * (1 + nu)), density = 2700;  // N/m^2, kg/m^3

// The height lies along z, the thickness along y.
SingleBeam strip(int elements) {
    constexpr double A = height * thickness, t = thickness / height;
    constexpr double I_y = thickness * height * height * height / 12,
                     I_z = height * thickness * thickness * thickness / 12;
    EngineeringSection section{.mass = density * A, .EA = E * A, .EI_flap = E * I_y, .EI_edge = E * I_z};
    section.GJ = G * 4 * I_z * (1 - 0.63 * t * (1 - std::pow(t, 4) / 12));  // of a rectangle, to 0.5 %  [Roark]
    section.GA_y = section.GA_z = 5.0 / 6 * G * A;
    section.j_flap = density * I_y;
    section.j_edge = density * I_z;
    CardanBeamOptions options;
    options.elements = elements;
    return clamped_beam(uniform_beam(length, section), options);
}

struct Tip {
    double along, side, up, twist;  // m towards the clamp, m in y, m in z; rad, of the thickness out of the horizontal
};

// The weight grows in quarters: all at once would be too far for Newton's method.
Tip under_weight(const SingleBeam& beam, double weight, double angle) {
    FrameLoad load;
    load.name = "weight";
    load.frame = beam.beam.tip();
    Vector q;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        load.wrench.force = share * weight * Vec3(0, std::sin(angle), std::cos(angle));
        System loaded = beam.system;
        loaded.forces = beam.system.forces.with_load(load, loaded.model);
        const solvers::SteadyState state = solvers::steady_state(loaded, -1, {.initial = q});
        require_result(state);
        q = state.at.q;
    }
    const Pose<double> tip = beam.tip(q);
    return {length - tip.p.x(), tip.p.y(), tip.p.z(), std::atan2(tip.R(2, 1), tip.R(1, 1))};
}

struct Row {
    double weight, degrees;
    Tip exact;
};
constexpr Row rows[] = {{4.448, 30, {0.001916789, 0.039949370, 0.004751056, 0.005079672}},
                        {4.448, 60, {0.005527060, 0.068129106, 0.002862176, 0.004997702}},
                        {8.896, 30, {0.007660765, 0.079455843, 0.010147089, 0.020356967}},
                        {8.896, 60, {0.020473146, 0.129923412, 0.006654145, 0.019162503}},
                        {13.345, 30, {0.017163182, 0.117901573, 0.016777466, 0.045870603}},
                        {13.345, 60, {0.041206250, 0.181920963, 0.011715808, 0.040611752}},
                        {13.345, 90, {0.050405680, 0.200692911, 0, 0}}};

}  // namespace

int main(int argc, char** argv) {
    program::Study study("princeton_beam", "The Princeton beam: tip under three weights at an angle to the strip.");
    int elements = 16;
    study.line.add_option("--elements", elements, "cardanic beam elements").range(1, 128);
    return study.run(argc, argv, [&] {
        const SingleBeam beam = strip(elements);
        program::compare_with("geometrically exact rod");
        for (const Row& row : rows) {
            const Tip tip = under_weight(beam, row.weight, row.degrees * units::degree);
            program::compare(text(row.weight, " N at ", row.degrees, " deg: side, mm"), 1e3 * tip.side,
                             1e3 * row.exact.side, 4);
            program::compare("  up, mm", 1e3 * tip.up, 1e3 * row.exact.up, 4);
            program::compare("  along, mm", 1e3 * tip.along, 1e3 * row.exact.along, 4);
            program::compare("  twist, mrad", 1e3 * tip.twist, 1e3 * row.exact.twist, 4);
        }
        std::vector<solvers::StackPanel> panels{{"side, mm"}, {"up, mm"}, {"twist, mrad"}};
        for (const double weight : {4.448, 8.896, 13.345}) {
            for (solvers::StackPanel& panel : panels) panel.curves.push_back({text(weight, " N")});
            for (int degrees = 0; degrees <= 90; degrees += 5) {
                const Tip tip = under_weight(beam, weight, degrees * units::degree);
                const double values[] = {tip.side, tip.up, tip.twist};
                for (std::size_t i = 0; i < panels.size(); ++i) {
                    panels[i].curves.back().x.push_back(degrees);
                    panels[i].curves.back().y.push_back(1e3 * values[i]);
                }
            }
        }
        solvers::draw({.title = "Princeton beam: displacement and twist of the tip",
                       .x_label = "angle of the weight, deg (0: along the height of the strip)",
                       .x_high = 90,
                       .panels = panels},
                      study.picture);
    });
}
