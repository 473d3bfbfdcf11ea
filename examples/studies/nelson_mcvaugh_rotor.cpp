// The rotor of Nelson and McVaugh (1976) by the cardanic beam element: Campbell diagram on bearings that are alike in
// all directions, or softer in one than in the other, and critical speeds. The beam is Rayleigh's as in the paper,
// rigid in shear and with rotary inertia, or (--shear) Timoshenko's. References: exact transfer matrices (equal
// bearings) and 72 finite elements of Rayleigh's beam (unequal ones) of an independent program; the critical speeds
// that the paper found with 18 elements. Picture: nelson_mcvaugh_rotor.svg.
#include "examples/studies/nelson_mcvaugh_rotor/rotor.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/units.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double rpm = 1 / units::to_rpm;
constexpr std::size_t whirls = 6;

// The lowest whirl speeds, rad/s: in fixed axes the equations are constant whatever the bearings.
std::vector<double> whirls_at(const nelson_mcvaugh::Rotor& rotor, double speed) {
    const Eigen::Index n = rotor.system.model.size();
    DynamicState at = at_rest(n);
    at.qd(rotor.map.spin) = speed;  // no loads: the straight shaft is in equilibrium
    const solvers::SecondOrderSystem turning =
        solvers::restrict_to(solvers::linearise(rotor.system, at), rotor.unknowns);
    const solvers::ColemanTransform to_fixed(rotor.map, rotor.unknowns);
    std::vector<double> out;
    for (const solvers::Mode& mode : solvers::modes(to_fixed.transform(turning, 0, speed), 2e4))
        if (mode.oscillates()) out.push_back(mode.eigenvalue.imag());
    std::ranges::sort(out);
    if (out.size() < whirls) throw NumericalError("too few whirls");
    return out;
}

// Where whirl number i is as fast as the rotor, by the secant rule, rad/s.
double critical_speed(const nelson_mcvaugh::Rotor& rotor, std::size_t i) {
    const double near = whirls_at(rotor, 0)[i];
    double a = 0.98 * near, b = 1.02 * near;
    const auto excess = [&](double speed) { return whirls_at(rotor, speed)[i] - speed; };
    double at_a = excess(a), at_b = excess(b);
    for (int k = 0; k < 20 && std::abs(b - a) > 1e-8 * near; ++k) {
        const double c = b - at_b * (b - a) / (at_b - at_a);
        a = b, at_a = at_b;
        b = c, at_b = excess(c);
    }
    return b;
}

struct Case {
    const char* name;
    Eigen::Matrix2d bearing;  // N/m
    bool shear;
    const char* source;
    std::array<double, whirls> critical;  // rpm
};

Eigen::Matrix2d matrix(double diagonal, double beside) {
    return (Eigen::Matrix2d() << diagonal, beside, beside, diagonal).finished();
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("nelson_mcvaugh_rotor", "The rotor of Nelson and McVaugh (1976): Campbell diagram.");
    int per_segment = 2;
    bool shear = false;
    study.line.add_option("--elements", per_segment, "beam elements of each diameter").range(1, 8);
    study.line.add_flag("--shear", shear, "Timoshenko's beam in the picture instead of Rayleigh's");
    return study.run(argc, argv, [&] {
        const Eigen::Matrix2d equal = matrix(4.3781714e7, 0), unequal = matrix(3.503e7, -8.756e6);
        const char* const matrices = "transfer matrices";
        for (const Case& one : {Case{"equal bearings, Rayleigh",
                                     equal,
                                     false,
                                     matrices,
                                     {15488.98, 17176.09, 46635.06, 49991.15, 64758.51, 96452.04}},
                                {"equal bearings, Timoshenko",
                                 equal,
                                 true,
                                 matrices,
                                 {15373.17, 17026.91, 46392.27, 49676.18, 64181.47, 95192.27}},
                                {"unequal bearings, Rayleigh",
                                 unequal,
                                 false,
                                 "72 finite elements",
                                 {13937.7, 16526.0, 39904.2, 48265.1, 59629.4, 93170.4}}}) {
            const nelson_mcvaugh::Rotor rotor = nelson_mcvaugh::rotor(per_segment, one.shear, one.bearing);
            program::compare_with(text(one.source, "; ", one.name, "; rev/min"));
            for (std::size_t i = 0; i < whirls; ++i) {
                const double speed = critical_speed(rotor, i) / rpm;
                program::compare(text("critical speed ", i + 1), speed, one.critical[i], 1);
            }
        }
        solvers::PanelStack picture{
            .title = text("Whirl speeds of the rotor of Nelson and McVaugh, equal and unequal bearings, ",
                          shear ? "Timoshenko" : "Rayleigh"),
            .x_label = "speed of rotation, 1000/min",
            .x_high = 100};
        for (const auto& [name, bearing] : {std::pair("equal", equal), {"unequal", unequal}}) {
            const nelson_mcvaugh::Rotor rotor = nelson_mcvaugh::rotor(per_segment, shear, bearing);
            solvers::StackPanel panel{text(name, ", 1000/min")};
            for (std::size_t i = 0; i < whirls; ++i) panel.curves.push_back({text("whirl ", i + 1)});
            for (int k = 0; k <= 50; ++k) {
                const std::vector<double> found = whirls_at(rotor, 2000 * k * rpm);
                for (std::size_t i = 0; i < whirls; ++i) {
                    panel.curves[i].x.push_back(2 * k);
                    panel.curves[i].y.push_back(found[i] / rpm / 1000);
                }
            }
            panel.curves.push_back({"speed of rotation", {0, 100}, {0, 100}});
            picture.panels.push_back(panel);
        }
        solvers::draw(picture, study.picture);
    });
}
