// A two-bladed rotor behind its tower, coned, tilted, teetering and free to yaw, without gravity and with it: its
// motions about the periodic steady state by Floquet theory, the yaw exponents among them.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/turbines/reference_turbines/teetered.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

namespace {

turbines::TurbineDescription downwind_machine() {
    turbines::TurbineDescription machine = turbines::teetered_description();  // downwind, free to yaw and to teeter
    machine.name = "two blades downwind, coned, tilted, free to yaw";
    machine.nacelle.tilt = -3 * units::degree;  // downwind end up
    machine.blade.cone = 5 * units::degree;     // tips downwind
    machine.hub.teeter->undersling = 0.35;      // m: the rotor's centre of mass on the teeter axis
    return machine;
}

solvers::Campbell diagram_of(double gravity) {
    turbines::AssemblyOptions options = turbines::teetered_paper_assembly(3);
    options.gravity = {0, 0, -gravity};
    const turbines::Turbine turbine = turbines::assemble(downwind_machine(), options);
    solvers::CampbellOptions sweep;
    sweep.max_frequency_hz = 6;
    sweep.floquet.fixed_means = {
        turbine.system().model.index("yaw")};  // nothing holds its mean: it stays where it starts
    return solvers::campbell(turbine.system(), turbine.rotor(), {30 * units::rpm, 45 * units::rpm, 60 * units::rpm},
                             sweep);
}

void print_exponents(const solvers::Campbell& diagram) {
    std::printf("rotor speed, rpm   exponent, 1/s\n");
    for (const solvers::Branch& branch : diagram.branches) {
        if (branch.family != "yaw" && branch.family != "teeter") continue;
        for (std::size_t i = 0; i < diagram.points.size(); ++i)
            if (const solvers::CampbellMode* mode = diagram.mode(branch, i))
                std::printf("%10.1f %16.6f %+.6f i  %s\n", diagram.points[i].rotor_speed * units::to_rpm,
                            mode->mode.eigenvalue.real(), mode->mode.eigenvalue.imag(), branch.name.c_str());
    }
}

}  // namespace

int main() try {
    for (const double gravity : {0.0, units::standard_gravity}) {
        std::printf("\ngravity %g m/s^2\n", gravity);
        std::fflush(stdout);
        const solvers::Campbell diagram = diagram_of(gravity);
        std::cout << solvers::table(diagram) << std::endl;
        print_exponents(diagram);
    }
    return 0;
} catch (const cardan::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
