// Numbers of the 600 kW machine as the library gave them in November 2026. They are not a reference: what is known to
// be right is in tests/turbines and tests/elements. A change here is to be understood and noted in the changelog.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("pinned: frequencies and damping ratios of the damped 600 kW machine at 0, 20 and 40 rpm", "[regression]") {
    struct Row {
        const char* branch;
        double hz_0, ratio_0, hz_20, ratio_20, hz_40, ratio_40;
    };
    const Row rows[] = {
        {"1st tower fore-aft", 0.712874, 0.004918, 0.710218, 0.004875, 0.700152, 0.004722},
        {"1st tower side-side", 0.717456, 0.004953, 0.718022, 0.004965, 0.718814, 0.004979},
        {"rotor tilt", 1.274483, 0.002873, 1.053761, 0.003541, 0.887550, 0.004077},
        {"rotor yaw", 1.332125, 0.003150, 1.629260, 0.002569, 1.995037, 0.002449},
        {"1st blade flap (collective)", 1.811787, 0.005210, 1.871601, 0.005044, 2.039547, 0.004562},
        {"1st blade flap (backward)", 2.796318, 0.007057, 2.688130, 0.007818, 2.568154, 0.009019},
        {"1st blade flap (forward)", 2.913258, 0.007508, 3.076652, 0.007124, 3.015045, 0.010868},
        {"1st blade edge (backward)", 3.567529, 0.010025, 3.303099, 0.010515, 3.426079, 0.006323},
        {"1st blade edge (forward)", 3.649627, 0.010156, 3.974252, 0.009314, 4.369283, 0.009112},
        {"1st drive-train torsion", 4.507584, 0.021821, 4.510766, 0.021846, 4.522172, 0.021476},
        {"2nd tower fore-aft", 5.046829, 0.029652, 5.060123, 0.030992, 5.082356, 0.032845},
        {"2nd tower side-side", 5.303570, 0.030449, 5.311189, 0.031561, 5.325242, 0.032365},
        {"2nd blade flap (collective)", 5.375934, 0.022369, 5.431304, 0.019628, 5.618795, 0.016265},
        {"2nd blade flap (backward)", 5.951128, 0.017592, 5.913712, 0.018226, 5.901994, 0.018727},
        {"2nd blade flap (forward)", 6.400047, 0.017760, 6.571835, 0.016829, 6.978018, 0.015373},
        {"1st blade edge (collective)", 8.345669, 0.026453, 8.366490, 0.026377, 8.428734, 0.026150},
    };
    const solvers::Campbell& d = diagram();
    CHECK(d.branches.size() == std::size(rows));
    for (const Row& row : rows) {
        INFO(row.branch);
        const solvers::Branch& branch = d.branch(row.branch);
        for (const auto& [point, f, ratio] : {std::tuple{std::size_t{0}, row.hz_0, row.ratio_0},
                                              {std::size_t{20}, row.hz_20, row.ratio_20},
                                              {std::size_t{40}, row.hz_40, row.ratio_40}}) {
            CHECK(d.natural_hz(branch, point) == Approx(f).margin(2e-6).epsilon(0));
            CHECK(d.damping_ratio(branch, point) == Approx(ratio).margin(2e-6).epsilon(0));
        }
    }
}

TEST_CASE("pinned: crossings of the 600 kW machine with 2P and 3P up to 40 rpm", "[regression]") {
    struct Row {
        const char* branch;
        int multiple;
        double rpm, hz;
    };
    const Row rows[] = {
        {"1st tower fore-aft", 3, 14.23058, 0.711529},  {"1st tower side-side", 3, 14.35564, 0.717782},
        {"rotor tilt", 3, 20.89367, 1.044683},          {"1st tower fore-aft", 2, 21.29524, 0.709841},
        {"1st tower side-side", 2, 21.54234, 0.718078}, {"rotor tilt", 2, 29.06768, 0.968923},
        {"rotor yaw", 3, 39.84303, 1.992152},
    };
    const solvers::Campbell& d = diagram();
    std::size_t i = 0;
    for (const solvers::Crossing& crossing : d.crossings) {
        if (crossing.multiple > 3) continue;
        REQUIRE(i < std::size(rows));
        CHECK(entry(d.branches, crossing.branch).name == rows[i].branch);
        CHECK(crossing.multiple == rows[i].multiple);
        CHECK(crossing.rotor_speed / rpm == Approx(rows[i].rpm).margin(2e-5).epsilon(0));
        CHECK(crossing.frequency_hz == Approx(rows[i].hz).margin(2e-6).epsilon(0));
        ++i;
    }
    CHECK(i == std::size(rows));
}

TEST_CASE("pinned: the parked 600 kW machine under its own weight, two elements, delta = 1/6", "[regression]") {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(2);
    options.delta = 1. / 6;
    options.gravity = Vec3(0, 0, -units::standard_gravity);
    const turbines::Turbine machine = turbines::wt600(options);
    const auto steady = solvers::steady_state(machine.system(), machine.rotor().spin);
    REQUIRE(steady.converged);
    const Model& model = machine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, steady.at.q, workspace);
    struct Row {
        const char* frame;
        Vec3 place;
    };
    for (const Row& row : {Row{"tower top", {-0.0101428, 0, 50.6999983}}, Row{"hub", {-2.8026567, 0, 52.4167487}},
                           Row{"blade 1 node 2", {-1.1246995, -0.0008125, 73.8511684}},
                           Row{"blade 2 node 2", {-3.6114868, -18.5991289, 41.6618723}},
                           Row{"blade 3 node 2", {-3.6365900, 18.6004639, 41.6660820}}}) {
        INFO(row.frame);
        CHECK((pose(kin, model.frame(row.frame)).p - row.place).cwiseAbs().maxCoeff() < 2e-7);
    }
}
