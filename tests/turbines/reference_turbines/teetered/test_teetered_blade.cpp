// The blade of the two-bladed teetered machine, clamped to a rigid hub, at rest and at 6.02 rad/s.
#include "examples/studies/beams/mixed_beam.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/teetered_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"
#include "turbines/reference_turbines/teetered.hpp"

using namespace cardan;
using namespace cardan::testing;
using turbines::AssemblyOptions;

namespace {

struct BladeFrequencies {
    std::vector<double> flap, lag, torsion;  // rad/s, rising
};

BladeFrequencies blade_frequencies(const AssemblyOptions& options, double rotor_speed) {
    const auto blade = turbines::isolated_blade(turbines::teetered_description(), options);
    const Model& model = blade.system().model;
    const auto n = model.size();
    DynamicState at = at_rest(n);
    at.qd(blade.rotor().spin) = rotor_speed;
    const auto system = solvers::restrict_to(solvers::linearise(blade.system(), at), model.coordinates().free());
    BladeFrequencies found;
    for (const solvers::Mode& mode : solvers::modes(system)) {
        Eigen::Index most = 0;
        solvers::energy_by_row(system, mode).maxCoeff(&most);
        const std::string& name = model.coordinates()[entry(system.coordinates, most)].name;
        const auto is = [&](const char* what) { return name.find(what) != std::string::npos; };
        (is("bending y")   ? found.flap
         : is("bending z") ? found.lag
                           : found.torsion)
            .push_back(std::abs(mode.eigenvalue));
    }
    return found;
}

oracles::BladeOnArm exact_blade(bool lag) {
    return {.length = 8.42,
            .mass = 67.5772,
            .stiffness = 1e7,
            .rotary_inertia = lag ? 4.9999 : 1e-4,
            .arm = 1.8,
            .rotor_speed = teetered_speed,
            .lag = lag};
}

}  // namespace

TEST_CASE("teetered machine's blade: torsion is that of the discrete rod, stiffened by the flattening of the sections",
          "[analytic]") {
    // Rod of n elements, masses lumped at the ends: omega = 2 n c/L sin((2k - 1) pi/4n), c^2 = GJ/I1; an armature of
    // a I1 L/n on each spring: omega^2 (1 + 4 a sin^2) instead of omega^2. Spin adds (I3 - I2)/I1 Omega^2.
    const double c = std::sqrt(1e7 / 5);
    for (int n : {1, 2, 6})
        for (double a : {0.0, -1. / 12})
            for (double rotor_speed : {0.0, teetered_speed}) {
                AssemblyOptions options = turbines::teetered_paper_assembly(n);
                options.blade_beam->torsion_armature = a;
                const auto torsion = blade_frequencies(options, rotor_speed).torsion;
                REQUIRE(torsion.size() == static_cast<std::size_t>(n));
                for (int k = 1; k <= n; ++k) {
                    const double s = std::sin((2 * k - 1) * pi / (4 * n));
                    const double spring = std::pow(2 * n * c / 8.42 * s, 2);
                    const double squared = (spring + 0.99996 * rotor_speed * rotor_speed) / (1 + 4 * a * s * s);
                    CHECK(entry(torsion, k - 1) == Approx(std::sqrt(squared)).epsilon(1e-9));
                }
            }
}

TEST_CASE("teetered machine's blade: flap and lag converge to the exact blade with rotary inertia", "[analytic]") {
    // The second-order error is that of the geometric stiffness and of the rotary inertia.
    const auto flap = exact_blade(false).frequencies(2), lag = exact_blade(true).frequencies(2);
    // To the digits that another solution of the same equations gives.
    CHECK(flap[0] / teetered_speed == Approx(3.4015).epsilon(0).margin(1e-4));
    CHECK(lag[0] / teetered_speed == Approx(3.2434).epsilon(0).margin(1e-4));
    CHECK(flap[1] / teetered_speed == Approx(20.069).epsilon(0).margin(1e-3));
    CHECK(lag[1] / teetered_speed == Approx(19.712).epsilon(0).margin(1e-3));
    const auto error = [&](int elements, bool of_lag, std::size_t k) {
        const auto found = blade_frequencies(turbines::teetered_paper_assembly(elements), teetered_speed);
        return (of_lag ? found.lag[k] / lag[k] : found.flap[k] / flap[k]) - 1;
    };
    for (bool of_lag : {false, true}) {
        CAPTURE(of_lag);
        CHECK(std::abs(error(6, of_lag, 0)) < 3e-4);
        CHECK(std::abs(error(6, of_lag, 1)) < 1e-3);
        CHECK(order(error(16, of_lag, 0), error(32, of_lag, 0)) == Approx(2).margin(0.1));
        CHECK(std::abs(error(32, of_lag, 0)) < 1e-5);
        CHECK(std::abs(error(32, of_lag, 1)) < 2e-5);
    }
}

TEST_CASE("teetered machine's blade: on the teeter hinge the exact blade, the mixed beam and the table agree",
          "[crosscheck]") {
    // Antisymmetric flap of the rigid-tower machine: each blade turns the arm and half of the hub (50, 5, 50 kg m^2).
    oracles::BladeOnArm hinged = exact_blade(false);
    hinged.hinged = true;
    hinged.hub_inertia = 25;
    hinged.hub_difference = (5. - 50.) / 2;
    const auto exact = hinged.frequencies(3);
    CHECK(exact[1] / teetered_speed == Approx(10.167).epsilon(0).margin(1e-3));
    CHECK(exact[2] / teetered_speed == Approx(34.073).epsilon(0).margin(1e-3));
    const auto d = turbines::teetered_description();
    MixedSetting setting;
    setting.omega = {0, 0, teetered_speed};
    setting.root_position = {1.8, 0, 0};
    setting.pin = MixedPin{{0, 1, 0}, {-1.8, 0, 0}, {}};
    setting.pin->body.J = Vec3(25, 25, 2.5).asDiagonal();
    const auto mixed = [&](int elements) {
        const MixedBeam beam(d.blade.line, elements);
        double nearest = 0;
        for (const DescriptorMode& mode : mixed_modes(beam, setting, mixed_steady_state(beam, setting).x))
            if (std::abs(mode.eigenvalue.imag() - exact[1]) < std::abs(nearest - exact[1]))
                nearest = mode.eigenvalue.imag();
        return nearest;
    };
    const double n12 = mixed(12), n24 = mixed(24);
    CHECK(n24 + (n24 - n12) / 3 == Approx(exact[1]).epsilon(2e-4));  // order 2, one step of extrapolation
}

TEST_CASE("teetered machine's blade: with the paper's element the second torsion is far above three times the first",
          "[analytic]") {
    // The element is a box scheme: a rod of n elements has 2 n c/L tan((2k - 1) pi/4n), so that with two of them the
    // second frequency is 5.8 times the first whatever GJ and inertia are. Table II of the paper has 46.212/15.482
    // = 2.98.
    const auto d = turbines::teetered_description();
    MixedSetting setting;
    setting.omega = {0, 0, teetered_speed};
    setting.root_position = {1.8, 0, 0};
    const double c = std::sqrt(1e7 / 5);
    for (int n : {2, 3, 4}) {
        const MixedBeam beam(d.blade.line, n);
        const auto modes = mixed_modes(beam, setting, mixed_steady_state(beam, setting).x);
        double box[2] = {0, 0};
        for (int k : {1, 2}) {
            const double rod = 2 * n * c / 8.42 * std::tan((2 * k - 1) * pi / (4 * n));
            box[k - 1] = std::sqrt(rod * rod + 0.99996 * teetered_speed * teetered_speed);
            double nearest = 1e300;
            for (const DescriptorMode& mode : modes)
                nearest = std::min(nearest, std::abs(mode.eigenvalue.imag() - box[k - 1]));
            CHECK(nearest < 1e-6 * box[k - 1]);
        }
        CHECK(box[1] / box[0] > (n == 2 ? 5.8 : 3.3));
    }
}
