// Uses the installed headers and libraries as a stranger would: a description is changed, modes are computed, a file
// and a picture are written.
#include <cardan/batch.hpp>
#include <cardan/hdf5.hpp>
#include <cardan/matlab.hpp>
#include <cardan/mbs.hpp>
#include <cardan/pictures.hpp>
#include <cardan/solvers.hpp>
#include <cardan/turbines.hpp>

#include <cmath>
#include <iostream>

int main() try {
    using namespace cardan;
    turbines::AssemblyOptions assembly = turbines::wt600_paper_assembly();
    assembly.structural_damping = assembly.joint_damping = false;
    const turbines::Turbine turbine = turbines::wt600(assembly);
    const solvers::Campbell diagram =
        solvers::campbell(turbine.system(), turbine.rotor(), solvers::rpm_range(0, 27, 27));
    solvers::write_hdf5(diagram, "consumer.h5");
    solvers::plot(diagram, "consumer.svg");
    const solvers::LinearModel linear =
        solvers::state_space(turbine.system(), turbine.rotor(), diagram.points[0].at, {}, {});
    solvers::write_mat(linear, {}, "consumer.mat");
    const double tower = diagram.natural_hz(diagram.branch("1st tower fore-aft"), 1);
    std::cout << "cardan " << version() << ": 1st tower fore-aft at 27 rpm " << tower << " Hz\n";
    // Many states at rest on all processors: no forces.
    Batch batch(turbine.system().model);
    const Matrix zero = Matrix::Zero(batch.model().size(), 5);
    Matrix tau = Matrix::Ones(zero.rows(), zero.cols());
    inverse_dynamics_batch(batch, zero, zero, zero, tau);
    if (!tau.isZero(0)) return 1;
    // Alignment and inlined types agree with the library's if the number does (docs/wt600.md).
    return std::abs(tower - 0.70787) < 1e-5 ? 0 : 1;
} catch (const cardan::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
