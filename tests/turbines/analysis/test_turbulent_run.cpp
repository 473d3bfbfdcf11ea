// The NREL 5 MW machine in turbulence, rotor speed and pitch held: aerodynamics and structure without a controller.
//
// Reference: OpenFAST in the same box. Its machine bends in two flap shapes and one edge shape, its sections leave out
// their sweep, that of bending included, which is 1.1 % of the thrust: tests/turbines/aerodynamics.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/tables/csv.hpp"

#include <cmath>
#include <numeric>
#include <span>
#include <string>

namespace cardan::testing::turbulent_run_tests {

namespace {

using namespace turbines;

constexpr double step = 0.1;  // s

std::string data(const char* file) {
    return std::string(CARDAN_SOURCE_DIR) + "/tests/data/wind/" + file;
}

solvers::History run_in_turbulence(Wake wake) {
    Machine machine = read_machine("nrel5mw-fast");
    machine.description.drive_train.main_shaft = rigid_joint;  // as in the reference
    Simulation run(machine, {.rotor_speed = 12.1 * units::rpm,
                             .wind = data("turbsim_14.bts"),
                             .air = {.tower_nacelle = false, .wake = wake, .airfoils = Airfoils::steady},
                             .controller = Controller::none(),
                             .machine = {.pitch = 8.7 * units::degree,
                                         .generator = GeneratorDof::locked,
                                         .blade_elements = 6,
                                         .tower_elements = 3},
                             .tolerance = 1e-3});
    return run.record({.duration = 180, .step = step}).history;
}

// Without the first minute: one period of the box.
std::span<const double> values(const solvers::History& history, const char* channel) {
    return std::span(history[channel]).subspan(601);
}

struct Statistics {
    double mean, std;
};
Statistics statistics(std::span<const double> x) {
    const auto n = static_cast<double>(x.size());
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
    double sum = 0;
    for (const double one : x) sum += (one - mean) * (one - mean);
    return {mean, std::sqrt(sum / n)};
}

// Of what is left when the means are taken off, over the standard deviation of the reference.
double difference(std::span<const double> own, std::span<const double> other) {
    std::vector<double> apart;
    apart.reserve(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) apart.push_back(own[i] - other[i]);
    return statistics(apart).std / statistics(other).std;
}

}  // namespace

TEST_CASE("turbulent run: loads of the NREL 5 MW machine with two wakes, beside OpenFAST", "[crosscheck]") {
    const CsvTable table = CsvTable::read(data("nrel5mw_statistics.csv")),
                   series = CsvTable::read(data("nrel5mw_series.csv"));
    const solvers::History with_lags = run_in_turbulence(Wake::oye), without = run_in_turbulence(Wake::equilibrium);
    for (const std::string channel :
         {"RtAeroPwr", "RtAeroFxh", "RootMyc1", "RootMyc2", "RootMyc3", "RootMxc1", "TwrBsMyt"}) {
        CAPTURE(channel);
        std::size_t row = 0;
        double effect = 1, expected_effect = 1;
        for (const solvers::History* history : {&with_lags, &without}) {
            CAPTURE(row);
            const Statistics own = statistics(values(*history, channel.c_str()));
            const double mean = table.column(channel + "_mean")[row], std = table.column(channel + "_std")[row];
            CHECK(own.mean == Approx(mean).epsilon(0.015));
            CHECK(own.std == Approx(std).epsilon(0.03));
            effect = own.std / effect;
            expected_effect = std / expected_effect;
            ++row;
        }
        // A wake that lags lets more of the turbulence through: thrust 8 %, root moments 13 %.
        CHECK(effect == Approx(expected_effect).margin(0.03));
    }
    for (const char* channel : {"RtAeroFxh", "RootMyc1"}) {
        CAPTURE(channel);
        CHECK(difference(values(with_lags, channel), series.column(channel)) < 0.1);
    }
}

}  // namespace cardan::testing::turbulent_run_tests
