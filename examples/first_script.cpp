// The script of the README: a Campbell diagram in a few lines, and what happens with a stiffer yaw drive.
#include <cardan/hdf5.hpp>
#include <cardan/pictures.hpp>
#include <cardan/turbines.hpp>

#include <iostream>

int main() try {
    using namespace cardan;
    turbines::TurbineDescription machine = turbines::wt600_description();
    machine.yaw.rotation.stiffness *= 2;  // N m/rad

    const turbines::Turbine turbine = turbines::assemble(machine);
    const solvers::Campbell diagram =
        solvers::campbell(turbine.system(), turbine.rotor(), solvers::rpm_range(0, 33, 1));

    std::cout << solvers::table(diagram);
    solvers::write_hdf5(diagram, "stiff_yaw.h5");
    solvers::plot(diagram, "stiff_yaw.svg");
    return 0;
} catch (const cardan::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
