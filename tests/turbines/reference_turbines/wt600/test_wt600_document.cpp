// docs/wt600.md and docs/conventions.md say what the programs and the code say.
#include "mbs/base/entry.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

#include <regex>
#include <sstream>

using namespace cardan;
using namespace cardan::testing;

namespace {

std::string document(const char* name) {
    return test::bytes_of(text(CARDAN_SOURCE_DIR, "/docs/", name));
}

// "1st flap, sine (yaw) → backward" and the numbers behind it; empty if no row begins with the name.
std::vector<double> table_row(const std::string& page, const std::string& name) {
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| " + name + " |")) continue;
        std::istringstream cells(line.substr(name.size() + 4));
        std::vector<double> numbers;
        for (std::string cell; std::getline(cells, cell, '|');) numbers.push_back(std::stod(cell));
        return numbers;
    }
    return {};
}

}  // namespace

TEST_CASE("docs/wt600.md: its table of frequencies is what the machine has with three elements at 0, 27 and 33 rpm",
          "[property]") {
    const turbines::Turbine machine = turbines::wt600(undamped());
    const solvers::Campbell d = solvers::campbell(machine.system(), machine.rotor(), solvers::rpm_range(0, 33, 3));
    const std::string page = document("wt600.md");
    for (const auto& [row, branch] : std::vector<std::pair<std::string, const char*>>{
             {"1st tower fore-aft (longitudinal)", "1st tower fore-aft"},
             {"1st tower side-side (lateral)", "1st tower side-side"},
             {"rotor tilt", "rotor tilt"},
             {"rotor yaw", "rotor yaw"},
             {"1st flap, collective", "1st blade flap (collective)"},
             {"1st flap, sine (yaw) → backward", "1st blade flap (backward)"},
             {"1st flap, cosine (tilt) → forward", "1st blade flap (forward)"},
             {"1st edge (lag), cosine → backward", "1st blade edge (backward)"},
             {"1st edge, sine → forward", "1st blade edge (forward)"},
             {"1st drive-train torsion", "1st drive-train torsion"},
             {"2nd tower fore-aft", "2nd tower fore-aft"},
             {"2nd tower side-side", "2nd tower side-side"},
             {"2nd flap, collective", "2nd blade flap (collective)"},
             {"1st edge, collective", "1st blade edge (collective)"}}) {
        INFO(row);
        const std::vector<double> printed = table_row(page, row);
        REQUIRE(printed.size() == 6);
        for (const auto& [column, point] : {std::pair{0, 0}, std::pair{2, 9}, std::pair{4, 11}})
            CHECK(entry(printed, column) == Approx(hz(d, branch, point)).margin(1.01e-5).epsilon(0));
    }
}

TEST_CASE("docs/wt600.md: as many channels are recorded as it says", "[property]") {
    turbines::Wt600OperationOptions options;
    options.assembly = turbines::wt600_paper_assembly();
    const turbines::Wt600Operation machine = turbines::wt600_operation(options);
    const System& system = machine.turbine.system();
    const Vector rest = Vector::Zero(system.model.size());
    solvers::Integrator integrator(system, {}, 0, rest, rest, {});
    const std::size_t channels = solvers::Recorder(integrator, machine.channels).channels().size();
    CHECK_THAT(document("wt600.md"), Catch::Matchers::Contains(text("recording ", channels, " channels")));
}

TEST_CASE("docs/conventions.md: the members of the kinematics that it names exist", "[property]") {
    const std::string header = test::bytes_of(text(CARDAN_SOURCE_DIR, "/mbs/kernels/kinematics.hpp"));
    const std::string page = document("conventions.md");
    const std::regex mention("`kin\\.(\\w+)\\(\\w\\)`");
    int found = 0;
    for (std::sregex_iterator it(page.begin(), page.end(), mention), end; it != end; ++it, ++found) {
        INFO((*it)[0]);
        CHECK(std::regex_search(header, std::regex("\\b" + (*it)[1].str() + "\\(int \\w\\) const")));
    }
    CHECK(found >= 4);
}
