// A cantilever under loads per length: uniform, falling to zero at the tip, on the outer half alone. A single element
// deflects and turns at the tip as in linear statics, in closed form; and the moment at the root.
#include <cardan/elements/cardan_beam/distributed_load.hpp>
#include <cardan/elements/cardan_beam/section_loads.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/equilibrium/steady_state.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    constexpr double L = 4, EI = 640e3, p = 1, a = L / 2;  // m, N m^2, N/m; the outer half begins at a
    struct Case {
        const char* name;
        std::function<double(double s)> force;  // N/m, along z
        double deflection, turn, moment;        // at the tip, m and rad; at the root, N m
    };
    const Case cases[] = {{"uniform", [](double) { return p; }, p * std::pow(L, 4) / (8 * EI),
                           p * std::pow(L, 3) / (6 * EI), p * L * L / 2},
                          {"falling", [](double s) { return p * (1 - s / L); }, p * std::pow(L, 4) / (30 * EI),
                           p * std::pow(L, 3) / (24 * EI), p * L * L / 6},
                          {"outer half", [](double s) { return s > a ? p : 0; },
                           p * (3 * std::pow(L, 4) - 4 * L * std::pow(a, 3) + std::pow(a, 4)) / (24 * EI),
                           p * (std::pow(L, 3) - std::pow(a, 3)) / (6 * EI), p * (L * L - a * a) / 2}};

    std::printf("%-11s %20s %12s %20s %12s %20s %12s\n", "load", "deflection, um", "closed form", "turn, urad",
                "closed form", "moment, N m", "closed form");
    for (const Case& load : cases) {
        Tree tree;
        ForceSet forces;
        const BeamLine line = uniform_beam(L, {.mass = 15, .EI_flap = EI, .EI_edge = EI});
        const CardanBeam beam =
            add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"},
                            {.elements = 1, .partition = Partition::static_moment, .torsion = false});
        const auto per_length = [&load](double s) { return Wrench{Vec3(0, 0, load.force(s)), Vec3::Zero()}; };
        add_distributed_load(tree, forces, beam, {load.name, per_length, WrenchAxes::base, {a}});
        const System system(tree, forces);
        const solvers::SteadyState rest = solvers::steady_state(system, -1);
        require_result(rest, "the beam under its load");

        Workspace workspace(system.model);
        const Kinematics kin = kinematics(system.model, rest.at.q, workspace);
        const Pose<double> tip = pose(kin, beam.tip());
        const JointLoads loads = joint_loads({rest.at, kin}, system.forces, rest.at.qdd);
        const Vec6 root = equilibrium_loads(beam, kin, system.forces, loads, 0).values;  // N, Vy, Vz, T, My, Mz
        std::printf("%-11s %20.4f %12.4f %20.4f %12.4f %20.4f %12.4f\n", load.name, 1e6 * tip.p.z(),
                    1e6 * load.deflection, 1e6 * std::atan2(tip.R(2, 0), tip.R(0, 0)), 1e6 * load.turn, -root(4),
                    load.moment);
    }
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
