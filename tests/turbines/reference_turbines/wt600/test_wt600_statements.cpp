// What Zhao, Maisser and Wu, Renewable Energy 32 (2007) 532-546, state about the modes of the 600 kW machine, on the
// diagram computed with our data set: 0 to 40 rpm, damped, generator free, natural frequencies in the fixed frame
// (Coleman). Two of the statements hold only for eigenvalues at a frozen azimuth: test_wt600_frozen_azimuth.cpp. The
// paper prints curves without numbers, so the bounds below are ours.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

#include <map>

using namespace cardan;
using namespace cardan::testing;
using solvers::Campbell;
using solvers::RotorPattern;

namespace {

constexpr double to_hz = 1 / (2 * pi);

// Frequencies at rest when one stiffness of the machine is multiplied: what it couples with, it moves.
template <class Change>
std::vector<double> frequencies_at_rest(Change change) {
    turbines::TurbineDescription d = turbines::wt600_description();
    change(d);
    return frequencies(turbines::assemble(d, undamped()), 0);
}
double nearest(const std::vector<double>& list, double value) {
    return *std::min_element(list.begin(), list.end(),
                             [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
}
double gap(const std::vector<double>& list, double value) {
    return std::abs(nearest(list, value) - value);
}

}  // namespace

TEST_CASE("statement 1: the collective lag is far above the isolated blade's and coupled with drive-train torsion",
          "[published]") {
    for (int point : {0, 20, 40}) {
        CHECK(hz(diagram(), lag_collective, point) > 2.3 * hz(blade_diagram(), "1st blade edge", point));
        CHECK(part(diagram(), lag_collective, point, "drive-train torsion") > 0.15);
    }
    // With stiff shafts it drops by more than a hertz.
    const auto stiff = frequencies_at_rest([](turbines::TurbineDescription& d) {
        d.drive_train.main_shaft.stiffness *= 1e4;
        d.drive_train.high_speed_shaft.stiffness *= 1e4;
    });
    CHECK(nearest(stiff, 8.345) < 7.0);
}

TEST_CASE("statement 1: the differential lags at rest are close together, a little above the isolated blade's",
          "[published]") {
    const double isolated = hz(blade_diagram(), "1st blade edge", 0), a = hz(diagram(), lag_backward, 0),
                 b = hz(diagram(), lag_forward, 0);
    CHECK(a > isolated);
    CHECK(b > a);
    CHECK(b < 1.07 * isolated);
    CHECK(b - a < 0.03 * a);
}

TEST_CASE("statement 1: the differential lags couple with yaw and tilt of the rotor, not with drive-train torsion",
          "[published]") {
    CHECK(part(diagram(), lag_backward, 0, "rotor yaw") > 0.02);
    CHECK(part(diagram(), lag_backward, 0, "rotor tilt") < 0.002);
    CHECK(part(diagram(), lag_forward, 0, "rotor tilt") > 0.05);
    CHECK(part(diagram(), lag_forward, 0, "rotor yaw") < 0.002);
    for (const char* lag : {lag_backward, lag_forward}) {
        for (int point : {0, 10, 20, 27, 33}) CHECK(part(diagram(), lag, point, "drive-train torsion") < 0.01);
        // At 40 rpm the forward one comes near drive-train torsion (4.37 and 4.52 Hz), both with lateral tower motion.
        CHECK(part(diagram(), lag, 40, "drive-train torsion") < 0.025);
    }
    // Stiff shafts leave them where they are, a stiff yaw drive moves the first, a stiff main frame the second.
    const auto shafts = frequencies_at_rest([](turbines::TurbineDescription& d) {
        d.drive_train.main_shaft.stiffness *= 1e4;
        d.drive_train.high_speed_shaft.stiffness *= 1e4;
    });
    CHECK(gap(shafts, 3.5675) < 1e-3);
    CHECK(gap(shafts, 3.6496) < 1e-3);
    const auto yaw = frequencies_at_rest([](turbines::TurbineDescription& d) { d.yaw.rotation.stiffness *= 1e4; });
    CHECK(gap(yaw, 3.6496) < 1e-3);
    CHECK(gap(yaw, 3.5675) > 0.05);
    const auto tilt =
        frequencies_at_rest([](turbines::TurbineDescription& d) { d.nacelle.tilt_bearing.stiffness *= 1e4; });
    CHECK(gap(tilt, 3.5675) < 1e-3);
    CHECK(gap(tilt, 3.6496) > 0.05);
}

TEST_CASE("statement 1 in operation: in the fixed frame the differential lags split by twice the rotor speed",
          "[analytic]") {
    // The paper says that they stay close; that is so in frozen-azimuth eigenvalues only. Two motions of nearly one
    // frequency in the rotating frame, delta apart at rest, come out sqrt(delta^2 + (2 Omega)^2) apart in the fixed
    // one.
    const double apart = hz(diagram(), lag_forward, 0) - hz(diagram(), lag_backward, 0);
    for (int point = 1; point <= 20; ++point)
        CHECK(hz(diagram(), lag_forward, point) - hz(diagram(), lag_backward, point) ==
              Approx(std::hypot(apart, 2 * point * rpm * to_hz)).epsilon(0.03));
}

TEST_CASE("statement 2: the collective flap couples with the first longitudinal tower mode", "[published]") {
    for (int point : {0, 20, 40}) {
        CHECK(part(diagram(), flap_collective, point, "tower fore-aft") > 0.008);
        CHECK(part(diagram(), flap_collective, point, "tower side-side") < 5e-4);
        CHECK(share(diagram(), mode_of(diagram(), "1st tower fore-aft", point), "blade flap").collective > 0.003);
    }
    // On a rigid tower it falls to the isolated blade's frequency, but for the play of the yaw bearing.
    const auto rigid = frequencies_at_rest([](turbines::TurbineDescription& d) {
        d.tower.line.section = [own = d.tower.line.section](double x) {
            BeamSection s = own(x);
            s.compliance /= 1e4;
            return s;
        };
    });
    CHECK(hz(diagram(), flap_collective, 0) > 1.027 * hz(blade_diagram(), "1st blade flap", 0));
    CHECK(nearest(rigid, 1.8) == Approx(hz(blade_diagram(), "1st blade flap", 0)).epsilon(5e-3));
}

TEST_CASE("statement 2: the differential flaps couple at rest one with yaw, one with tilt", "[published]") {
    CHECK(part(diagram(), flap_backward, 0, "rotor yaw") > 0.3);
    CHECK(part(diagram(), flap_backward, 0, "rotor tilt") < 0.01);
    CHECK(part(diagram(), flap_forward, 0, "rotor tilt") > 0.25);
    CHECK(part(diagram(), flap_forward, 0, "rotor yaw") < 0.01);
}

TEST_CASE("statement 2: the collective flap lies below both differential ones, all three above the isolated blade's",
          "[published]") {
    for (int point = 0; point <= 40; ++point) {
        const double collective = hz(diagram(), flap_collective, point);
        CHECK(collective > hz(blade_diagram(), "1st blade flap", point));
        CHECK(collective < hz(diagram(), flap_backward, point));
        CHECK(hz(diagram(), flap_backward, point) < hz(diagram(), flap_forward, point));
    }
}

TEST_CASE("statement 2: collective and forward flap rise with rotor speed; the backward one falls in the fixed frame",
          "[published]") {
    CHECK(monotonic(branch_hz(diagram(), flap_collective), +1));
    CHECK(hz(diagram(), flap_collective, 40) > 1.1 * hz(diagram(), flap_collective, 0));
    // Forward flap and backward lag veer at 20 to 33 rpm: the energy of the pattern tells where it is.
    const auto forward = [](int point) {
        return pattern_hz(diagram(), point, "blade flap", 1, RotorPattern::forward, 2.2, 4.6);
    };
    CHECK(monotonic(forward, +1));
    CHECK(monotonic(branch_hz(diagram(), flap_backward), -1));
    CHECK(hz(diagram(), flap_backward, 40) == Approx(2.568).margin(2e-3));
}

TEST_CASE("statement 3: forward whirl rises and backward whirl falls with rotor speed", "[published]") {
    struct Pattern {
        const char* family;
        int ordinal;
        double low, high;  // Hz; leaves out rotor yaw and tilt, which have a part of the flap's energy
        int up_to;         // rpm
    };
    // The second backward flap falls up to 33 rpm, the machine's highest speed; from there on centrifugal stiffening
    // (the isolated blade's second flap rises by 0.29 Hz up to 40 rpm) makes up for it: 5.9511, 5.8973, 5.9020 Hz.
    for (const Pattern& p : {Pattern{"blade flap", 1, 2.2, 4.6, 40}, Pattern{"blade edge", 1, 2.9, 4.6, 40},
                             Pattern{"blade flap", 2, 5.7, 8.0, 33}}) {
        INFO(p.ordinal << " " << p.family);
        const auto whirl = [&p](RotorPattern pattern) {
            return [&p, pattern](int point) {
                return pattern_hz(diagram(), point, p.family, p.ordinal, pattern, p.low, p.high);
            };
        };
        CHECK(monotonic(whirl(RotorPattern::forward), +1, 1, p.up_to));
        CHECK(monotonic(whirl(RotorPattern::backward), -1, 1, p.up_to));
    }
}

TEST_CASE("statement 3: at rest no mode whirls; in operation yaw whirls forward, tilt backward", "[property]") {
    const turbines::Turbine machine = turbines::wt600(undamped());
    const double speed[] = {0};
    const Campbell at_rest = solvers::campbell(machine.system(), machine.rotor(), speed);
    for (const auto& mode : at_rest.points[0].modes)
        for (const solvers::EnergyFraction& s : mode.shares)
            if (s.cosine + s.sine > 1e-3) CHECK(std::abs(s.whirl) < 1e-9);
    for (int point : {10, 20, 40}) {
        CHECK(share(diagram(), mode_of(diagram(), "rotor tilt", point), "blade flap").whirl < -0.98);
        CHECK(share(diagram(), mode_of(diagram(), "rotor yaw", point), "blade flap").whirl > 0.95);
    }
}

TEST_CASE("statement 4: lateral tower modes hardly change with rotor speed", "[published]") {
    for (int point = 0; point <= 40; ++point) {
        CHECK(hz(diagram(), "1st tower side-side", point) ==
              Approx(hz(diagram(), "1st tower side-side", 0)).epsilon(2.5e-3));
        CHECK(hz(diagram(), "2nd tower side-side", point) ==
              Approx(hz(diagram(), "2nd tower side-side", 0)).epsilon(5e-3));
    }
}

TEST_CASE("statement 4: the first longitudinal tower mode falls with rotor speed, the second rises", "[published]") {
    CHECK(monotonic(branch_hz(diagram(), tower_longitudinal), -1));
    CHECK(monotonic(branch_hz(diagram(), "2nd tower fore-aft"), +1));
    CHECK(hz(diagram(), "1st tower fore-aft", 40) < 0.985 * hz(diagram(), "1st tower fore-aft", 0));
    CHECK(hz(diagram(), "2nd tower fore-aft", 40) > 1.006 * hz(diagram(), "2nd tower fore-aft", 0));
}

TEST_CASE("statement 5: rotor yaw rises with rotor speed, rotor tilt falls", "[published]") {
    CHECK(monotonic(branch_hz(diagram(), "rotor yaw"), +1));
    CHECK(monotonic(branch_hz(diagram(), "rotor tilt"), -1));
    CHECK(hz(diagram(), "rotor yaw", 40) > 1.4 * hz(diagram(), "rotor yaw", 0));
    CHECK(hz(diagram(), "rotor tilt", 40) < 0.72 * hz(diagram(), "rotor tilt", 0));
}

TEST_CASE("statement 5: yaw and tilt do not interact at rest; in operation each takes part in the other's mode",
          "[published]") {
    // At rest to a few per cent of the energy only: the twisted blades couple everything a little.
    CHECK(part(diagram(), "rotor yaw", 0, "rotor tilt") < 1e-3);
    CHECK(part(diagram(), "rotor tilt", 0, "rotor yaw") < 1e-3);
    for (int point : {20, 30, 40}) {
        CHECK(part(diagram(), "rotor yaw", point, "rotor tilt") > 0.2);
        CHECK(part(diagram(), "rotor tilt", point, "rotor yaw") > 0.15);
    }
    // Yaw runs a quarter of a period apart from tilt.
    const auto hub = motion_of(diagram(), "rotor tilt", 30, "hub");
    const Complex ratio = hub(2) / hub(1);
    CHECK(std::abs(ratio.imag()) > 0.3);
    CHECK(std::abs(ratio.real()) < 0.1 * std::abs(ratio.imag()));
}

TEST_CASE("statement 6: lag frequencies rise only slightly with rotor speed", "[published]") {
    const auto rise = [](double at_40, double at_0) { return at_40 / at_0 - 1; };
    const double isolated = rise(hz(blade_diagram(), "1st blade edge", 40), hz(blade_diagram(), "1st blade edge", 0));
    const double collective = rise(hz(diagram(), lag_collective, 40), hz(diagram(), lag_collective, 0));
    CHECK(isolated > 0);
    CHECK(isolated < 0.012);
    CHECK(collective > 0);
    CHECK(collective < 0.012);
    // The two differential ones split; their mean rises by no more than 3 %. Flap rises by 12 %.
    const auto mean = [](int point) {
        return (pattern_hz(diagram(), point, "blade edge", 1, RotorPattern::forward, 2.9, 4.6) +
                pattern_hz(diagram(), point, "blade edge", 1, RotorPattern::backward, 2.9, 4.6)) /
               2;
    };
    CHECK(rise(mean(40), mean(0)) > 0);
    CHECK(rise(mean(40), mean(0)) < 0.03);
    CHECK(rise(hz(blade_diagram(), "1st blade flap", 40), hz(blade_diagram(), "1st blade flap", 0)) > 0.1);
}

TEST_CASE("statement 7: the first longitudinal tower mode has no lateral part at rest, one in quadrature in operation",
          "[published]") {
    const auto lateral = [](int point) {
        const auto top = motion_of(diagram(), "1st tower fore-aft", point, "tower top");
        return Complex(top(4) / top(3));
    };
    CHECK(std::abs(lateral(0).imag()) < 1e-3);
    CHECK(std::abs(lateral(0).real()) < 0.03);  // the axis of the mode is turned by the blades' twist
    for (int point = 0; point < 40; ++point)
        CHECK(std::abs(lateral(point + 1).imag()) > std::abs(lateral(point).imag()));
    CHECK(std::abs(lateral(20).imag()) > 0.3);
}

TEST_CASE("statement 7: in that mode blades 2 and 3 flap alike at rest and in opposite phase in operation",
          "[published]") {
    const auto flap = [](int point, int blade) {
        const auto top = motion_of(diagram(), "1st tower fore-aft", point, "tower top");
        return flap_of_tip(diagram(), "1st tower fore-aft", point, blade) / top(3);
    };
    CHECK(std::abs(flap(0, 2) - flap(0, 3)) < 0.05 * std::abs(flap(0, 2)));
    // In phase with the tower both move alike; what rotation adds is a quarter period off and opposite.
    for (int point : {20, 40}) {
        const Complex b2 = flap(point, 2), b3 = flap(point, 3);
        CHECK(b2.imag() * b3.imag() < 0);
        CHECK(std::abs(b2.imag() + b3.imag()) < 0.1 * std::abs(b2.imag()));
        CHECK(std::abs(b2.imag()) > std::abs(b2.real()));
        CHECK(std::abs(std::arg(b2 / b3)) > 100 * units::degree);
    }
}

TEST_CASE("statement 8: crossings with 1P, 2P, 3P ... lie on branch and line, and none is missing", "[property]") {
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    solvers::CampbellOptions options;
    options.keep_shapes = false;
    const Campbell d = solvers::campbell(machine.system(), machine.rotor(), solvers::rpm_range(0, 46, 2), options);
    std::map<int, int> per_multiple;
    for (const solvers::Crossing& crossing : d.crossings) {
        CHECK(crossing.frequency_hz == Approx(crossing.multiple * crossing.rotor_speed * to_hz).epsilon(1e-12));
        const auto& branch = entry(d.branches, crossing.branch);
        const auto i = static_cast<std::size_t>(crossing.rotor_speed / (2 * rpm));
        const double low = d.damped_hz(branch, i), high = d.damped_hz(branch, i + 1);
        CHECK(crossing.frequency_hz >= std::min(low, high));
        CHECK(crossing.frequency_hz <= std::max(low, high));
        ++per_multiple[crossing.multiple];
    }
    // Counted on the frequencies themselves: a branch starts above the line nP and ends below it or not.
    for (int n : {1, 2, 3, 6, 9, 12}) {  // and the first multiples of three blades
        int below = 0;
        for (const solvers::Branch& branch : d.branches)
            below += d.damped_hz(branch, d.points.size() - 1) < n * 46 * rpm * to_hz;
        CHECK(per_multiple[n] == below);
    }
    CHECK(per_multiple[1] == 2);  // both first tower modes at 42 to 43 rpm
    CHECK(per_multiple[3] == 5);  // both first tower modes, tilt, yaw, collective flap
    CHECK(std::is_sorted(d.crossings.begin(), d.crossings.end(),
                         [](const auto& a, const auto& b) { return a.rotor_speed < b.rotor_speed; }));
}
