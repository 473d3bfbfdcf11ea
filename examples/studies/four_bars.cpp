// Windows of four-bars side by side (IFToMM benchmark A02): rods of 1 m and 1 kg, started upright with 1 m/s at the
// upper left corner. In every revolution all links pass through one line, where a parallelogram could change into an
// anti-parallelogram: a solver that does has failed. Beside it, the rate of the one coordinate that there is,
//     (N+1)/3 + N kg m^2 theta'' = -g ((N+1)/2 + N) cos(theta).
// Picture: four_bars.svg.
#include "elements/machine_elements/joints.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/solids.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

#include <cstdio>
#include <cstdlib>
#include <iostream>

using namespace cardan;

namespace {

constexpr double gravity = 9.81;

// A rod along x that turns about z, and the frame at its end.
FrameId add_rod(Tree& tree, FrameId at, const std::string& name) {
    const JointedFrame joint = add_joint(tree, at, JointKind::revolute, Axis::z, name, {"linkage"});
    tree.weld(joint.frame, slender_bar(1, Vec3::Zero(), Vec3::UnitX()));
    return tree.add_frame(joint.frame, Placement::translation({1, 0, 0}), name + " end");
}

System windows(int number) {
    Tree tree;
    LoopSet loops;
    FrameId coupler;
    for (int i = 0; i <= number; ++i) {
        const FrameId foot = tree.add_frame(Tree::base(), Placement::translation({1.0 * i, 0, 0}), text("foot ", i));
        const FrameId top = add_rod(tree, foot, text("upright ", i));
        if (i > 0) loops.add_joint({text("corner ", i), CutKind::cylindrical, coupler, top});
        if (i < number) coupler = add_rod(tree, top, text("coupler ", i));
    }
    ForceSet forces;
    forces.set_gravity({0, -gravity, 0});
    return {tree, forces, loops};
}

}  // namespace

int main(int argc, char** argv) try {
    const int number = argc > 1 ? std::atoi(argv[1]) : 2;
    if (number < 1 || number > 100) throw InputError("four_bars", "number of windows", number, "1 ... 100");
    const System system = windows(number);
    Vector q(system.model.size()), qd = q;
    for (int i = 0; i < system.model.size(); ++i) {
        const double sign = system.model.coordinates()[i].name.starts_with("upright") ? 1 : -1;
        q(i) = sign * pi / 2;
        qd(i) = -sign;
    }
    solvers::IntegrationOptions options;
    options.tolerances = {1e-9, 1e-10, 1e-10, 1e-10, 1e-10};
    solvers::Integrator run(system, {}, 0, q, qd, options);
    solvers::Recorder recorder(run, {});
    solvers::History history;
    history.title = text(number, number == 1 ? " window" : " windows", " of four-bars");
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 10, 0.005), history));
    solvers::plot(history, {{{"upright 0 rate"}}, {{"energy error"}}}, "four_bars.svg");

    // Energy of the one coordinate gives its rate at the angle that was reached.
    const double inertia = (number + 1) / 3.0 + number, weight = gravity * ((number + 1) / 2.0 + number);
    const double theta = run.state().q(0), rate = run.state().qd(0);
    const double by_energy = std::sqrt(1 + 2 * weight / inertia * (1 - std::sin(theta)));
    std::printf("after 10 s: x %.8f, y %.8f, rate %.8f (by energy %.8f), %ld steps\n", std::cos(theta), std::sin(theta),
                rate, std::copysign(by_energy, rate), run.statistics().steps);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
