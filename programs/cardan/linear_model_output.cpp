#include "programs/cardan/linear_model_output.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/control/lin_file.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/matlab/state_space.hpp"

#include <algorithm>
#include <cstdio>

namespace cardan::program {

namespace {

// The branch of a diagram whose eigenvalue at the last point is nearest to a pole, and nearly equal; null: none.
const solvers::Branch* branch_of(const solvers::Campbell& diagram, const Complex& pole) {
    const solvers::Branch* best = nullptr;
    double nearest = 1e-3 * std::abs(pole);
    for (const solvers::Branch& branch : diagram.branches) {
        const solvers::CampbellMode* mode = diagram.mode(branch, diagram.points.size() - 1);
        if (mode == nullptr) continue;
        const double distance = std::abs(mode->mode.eigenvalue - pole);
        if (distance < nearest) best = &branch, nearest = distance;
    }
    return best;
}

}  // namespace

void print_modes(const solvers::ConstantModel& model, const std::optional<solvers::Campbell>& diagram,
                 double max_frequency) {
    std::printf("modes of A%s\n", diagram ? " and of the Campbell diagram" : "");
    std::printf("  natural Hz  damping %%%s\n", diagram ? "    natural Hz  damping %" : "");
    for (const Complex& pole : model.poles()) {
        const double hertz = std::abs(pole) / (2 * pi), damping = -100 * pole.real() / std::abs(pole);
        if (pole.imag() <= 1e-3 || hertz > max_frequency) continue;
        std::printf("%12.6f %10.4f", hertz, damping);
        if (const solvers::Branch* branch = diagram ? branch_of(*diagram, pole) : nullptr) {
            const std::size_t last = diagram->points.size() - 1;
            std::printf("  %12.6f %10.4f  %s%s", diagram->natural_hz(*branch, last),
                        100 * diagram->damping_ratio(*branch, last), branch->name.c_str(),
                        branch->doubtful[last] ? " ?" : "");
        }
        std::printf("\n");
    }
}

void print(const solvers::ConstantModel& fixed, const solvers::BalancedModel& small, double max_frequency) {
    const auto print = [](const std::vector<solvers::Signal>& signals, const Vector& error) {
        for (Eigen::Index i = 0; i < error.size(); ++i)
            std::printf("  %-34s %8.2f %%\n", entry(signals, i).name.c_str(), 100 * error(i));
    };
    std::printf("\nbalanced model: order %d and %d states that are not stable\n", small.order, small.kept_as_is);
    std::printf("largest error up to %g Hz, of the largest response to the same input (each output by its own size)\n",
                max_frequency);
    print(fixed.inputs, small.input_error);
    std::printf("and of the largest response of the same output (each input by its own size)\n");
    print(fixed.outputs, small.output_error);
    std::printf("Hankel singular values:");
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(small.hankel.size(), small.order + 4); ++i)
        std::printf("%s%s %.3e", i % 8 == 0 ? "\n " : "", i == small.order ? " |" : "", small.hankel(i));
    std::printf("\n");
}

void introduce(const solvers::LinearModel& model, double rpm, const solvers::MultiBladeModel* fixed) {
    std::printf("%s at %g rpm: %zu states, %zu inputs, %zu outputs, %zu azimuths\n", model.machine.c_str(), rpm,
                model.states.size(), model.inputs.size(), model.outputs.size(), model.samples.size());
    if (fixed)
        std::printf("periodic remainder of the multi-blade matrices, relative: A %.1e, B %.1e, C %.1e, D %.1e\n",
                    fixed->A_remainder, fixed->B_remainder, fixed->C_remainder, fixed->D_remainder);
    std::printf("estimated error of C and D, relative: %.1e\n\n", model.output_error.maxCoeff());
}

void write_files(const solvers::LinearModel& model, const std::vector<solvers::NamedModel>& constant,
                 const std::string& prefix, bool lin) {
    solvers::write_hdf5(model, constant, prefix + ".h5");
    solvers::write_mat(model, constant, prefix + ".mat");
    std::printf("\nfiles: %s.h5, .mat", prefix.c_str());
    if (lin) {
        const auto files = solvers::write_lin(model, prefix);
        std::printf(", %s ... %zu files", files.front().string().c_str(), files.size());
    }
    std::printf("\n");
}

}  // namespace cardan::program
