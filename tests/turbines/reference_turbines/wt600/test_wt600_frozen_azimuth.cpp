// Readings of the paper's Figs. 8 and 9, which do not say in which frame their curves are: the 600 kW machine
// linearised with the rotor frozen at one azimuth, and motions as seen in axes that turn with the rotor. Two of the
// paper's statements do not hold in the fixed frame; frozen azimuths, which are no motions of the machine, have both,
// rotating axes one.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;
using solvers::CampbellMethod;

namespace {

const solvers::Campbell& frozen() {
    return diagram(CampbellMethod::frozen_azimuth);
}

// The branch that starts at a frequency at rest: names by whirl mean nothing here.
const solvers::Branch& branch_from(double hz_at_rest) {
    for (const solvers::Branch& branch : frozen().branches)
        if (std::abs(frozen().natural_hz(branch, 0) - hz_at_rest) < 1e-3) return branch;
    throw Error(text("no branch starts at ", hz_at_rest, " Hz"));
}

std::array<double, 2> growth_rates(CampbellMethod method, double rotor_speed) {
    const turbines::Turbine machine = turbines::wt600(undamped());
    solvers::CampbellOptions options;
    options.method = method;
    const double speed[] = {rotor_speed};
    const auto d = solvers::campbell(machine.system(), machine.rotor(), speed, options);
    std::array<double, 2> range{0, 0};
    for (const solvers::CampbellMode& mode : d.points[0].modes) {
        range[0] = std::min(range[0], mode.mode.eigenvalue.real());
        range[1] = std::max(range[1], mode.mode.eigenvalue.real());
    }
    return range;
}

}  // namespace

TEST_CASE("frozen azimuth: says what it is in method and warning", "[property]") {
    CHECK(frozen().method == "frozen azimuth");  // what is known of it, not who may have used it
    CHECK_THAT(frozen().warning, Catch::Matchers::Contains("no motions of the machine"));
    CHECK_THAT(frozen().warning, Catch::Matchers::Contains("spurious damping"));
    CHECK_THAT(solvers::table(frozen()), Catch::Matchers::Contains("warning: " + frozen().warning));
    CHECK_THAT(diagram().method, Catch::Matchers::Contains("Coleman"));
    CHECK(diagram().warning.empty());
}

TEST_CASE("frozen azimuth: is the same as the fixed frame at rest and nowhere else", "[property]") {
    const auto& f = frozen().points;
    const auto& c = diagram().points;
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(f[0].modes[i].mode.natural_hz() == Approx(c[0].modes[i].mode.natural_hz()).epsilon(1e-10));
    double difference = 0;
    for (std::size_t i = 0; i < 16; ++i)
        difference =
            std::max(difference, std::abs(f[20].modes[i].mode.natural_hz() - c[20].modes[i].mode.natural_hz()));
    CHECK(difference > 0.25);
}

TEST_CASE("frozen azimuth, statement 1 in operation: the two differential lags stay close together", "[published]") {
    const solvers::Branch &a = branch_from(3.5675), &b = branch_from(3.6496);
    for (std::size_t point = 0; point <= 40; ++point) {
        const double isolated = hz(blade_diagram(), "1st blade edge", static_cast<int>(point));
        const double low = frozen().natural_hz(a, point), high = frozen().natural_hz(b, point);
        CHECK(low > isolated);
        CHECK(high < 1.1 * isolated);
        CHECK(high - low > 0);
        CHECK(high - low < 0.05 * low);
    }
    // In the fixed frame they are 1.3 Hz apart at 40 rpm.
    CHECK(pattern_hz(diagram(), 40, "blade edge", 1, solvers::RotorPattern::forward, 2.9, 4.6) -
              pattern_hz(diagram(), 40, "blade edge", 1, solvers::RotorPattern::backward, 2.9, 4.6) >
          1.1);
}

TEST_CASE("frozen azimuth, statement 2: all three first flap frequencies rise with rotor speed", "[published]") {
    for (double at_rest : {1.8118, 2.7963, 2.9133}) {
        INFO("flap from " << at_rest << " Hz");
        const solvers::Branch& branch = branch_from(at_rest);
        for (std::size_t point = 0; point < 40; ++point)
            CHECK(frozen().natural_hz(branch, point + 1) > frozen().natural_hz(branch, point));
        CHECK(frozen().natural_hz(branch, 40) > 1.03 * at_rest);
    }
}

TEST_CASE("frozen azimuth, statements 4 and 5: longitudinal tower modes, yaw and tilt go as in the fixed frame",
          "[published]") {
    const auto rises = [](double hz_at_rest, double sign) {
        const solvers::Branch& branch = branch_from(hz_at_rest);
        for (std::size_t point = 0; point < 40; ++point)
            if (!(sign * (frozen().natural_hz(branch, point + 1) - frozen().natural_hz(branch, point)) > 0))
                return false;
        return true;
    };
    CHECK(rises(0.7129, -1));
    CHECK(rises(5.0468, +1));
    CHECK(rises(1.2745, -1));
    CHECK(rises(1.3321, +1));
}

TEST_CASE("rotating axes, statement 1 in operation: the two differential lags are close together there as well",
          "[published][discrete]") {
    // What whirls forward or backward in the fixed frame has one rotor speed less or more in rotating axes.
    for (int point = 1; point <= 20; ++point) {
        const double turn = point / 60.0;
        const double a = hz(diagram(), lag_backward, point) + turn, b = hz(diagram(), lag_forward, point) - turn;
        const double isolated = hz(blade_diagram(), "1st blade edge", point);
        CHECK(std::min(a, b) > isolated);
        CHECK(std::max(a, b) < 1.07 * isolated);
        CHECK(std::abs(b - a) < 0.03 * a);
    }
    // Numbers of another implementation.
    CHECK(hz(diagram(), lag_backward, 20) + 20 / units::minute == Approx(3.6365).margin(2e-4));
    CHECK(hz(diagram(), lag_forward, 20) - 20 / units::minute == Approx(3.6409).margin(2e-4));
}

TEST_CASE("rotating axes, statement 2: of the two differential flaps one rises and one falls", "[property]") {
    // Contrary to the statement: a rotor speed is more than what they change by in the fixed frame.
    for (int point = 0; point < 20; ++point) {
        const double turn = point / 60.0, next = (point + 1) / 60.0;
        CHECK(hz(diagram(), flap_backward, point + 1) + next > hz(diagram(), flap_backward, point) + turn);
        CHECK(hz(diagram(), flap_forward, point + 1) - next < hz(diagram(), flap_forward, point) - turn);
    }
}

TEST_CASE("frozen azimuth: the undamped machine seems to grow by 0.048 1/s at 40 rpm; in the fixed frame it does not",
          "[property]") {
    // The system is conservative in the frame that turns with the rotor: no growth is possible.
    const auto fixed = growth_rates(CampbellMethod::coleman, 40 * rpm);
    CHECK(fixed[1] < 1e-9);
    CHECK(fixed[0] > -1e-9);
    const auto at_20 = growth_rates(CampbellMethod::frozen_azimuth, 20 * rpm),
               at_40 = growth_rates(CampbellMethod::frozen_azimuth, 40 * rpm);
    CHECK(at_20[1] > 0.005);
    CHECK(at_40[1] == Approx(0.048).margin(1e-3));
    CHECK(at_40[0] < -0.02);
}
