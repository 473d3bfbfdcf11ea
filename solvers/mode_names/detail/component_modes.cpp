#include "solvers/mode_names/detail/component_modes.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <map>

namespace cardan::solvers {

// Which of the part's axes (base axes) each coordinate follows.
std::vector<std::string> coordinate_families(const Kinematics& kin, const PartAxes& part, const Mat3& axes,
                                             const std::vector<int>& own) {
    const Model& model = kin.model();
    std::vector<std::string> families;
    for (int a : own) {
        const Vec3 along = axes.transpose() * kin.axis(a);
        Eigen::Index axis = 0;
        along.cwiseAbs().maxCoeff(&axis);
        const auto& names = model.body(a).revolute ? part.rotation : part.translation;
        const std::string& name = entry(names, axis);
        families.push_back(name.empty() ? part.part : name);
    }
    return families;
}

// Joint axes at q = 0.
std::vector<std::string> coordinate_families(const Model& model, const PartAxes& part, const std::vector<int>& own) {
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    return coordinate_families(kin, part, pose(kin, part.axes).R, own);
}

std::string family_of(const Vector& v, const Matrix& K, const std::vector<std::string>& families) {
    std::map<std::string, double> energy;
    const Vector force = K * v;
    for (Eigen::Index i = 0; i < std::ssize(families); ++i) energy[entry(families, i)] += v(i) * force(i);
    return std::max_element(energy.begin(), energy.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

ComponentModes component_modes(const Matrix& K, const Matrix& M, const std::string& part) {
    using Solver = Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>;
    const auto check = [&](const Solver& solver) {
        if (solver.info() != Eigen::Success)
            throw NumericalError(text("component modes of part '", part, "' could not be computed"));
    };
    const Eigen::Index n = K.rows();
    if (Eigen::LLT<Matrix>(K).info() == Eigen::Success) {
        // Every coordinate has a spring: as flexibilities the low modes are exact however stiff the high ones are.
        const Solver solver(M, K);
        check(solver);
        return {solver.eigenvalues().reverse().cwiseSqrt().cwiseInverse(), solver.eigenvectors().rowwise().reverse()};
    }
    const Solver solver(K, M);
    check(solver);
    const Vector& squared = solver.eigenvalues();
    const Eigen::Index rigid = (squared.array() <= 1e-12 * squared.cwiseAbs().maxCoeff()).count();
    const Vector omega = squared.tail(n - rigid).cwiseSqrt();
    return {omega, solver.eigenvectors().rightCols(n - rigid) * omega.cwiseInverse().asDiagonal()};
}

namespace {

// A negative frequency reverses the sense of whirl. The whirl of a sum is the energy-weighted mean.
WhirlShare sum_of(const WhirlShare& a, WhirlShare b, bool reversed) {
    if (reversed) b.whirl = -b.whirl;
    const double size_a = a.cosine + a.sine, size_b = b.cosine + b.sine, size = size_a + size_b;
    return {a.cosine + b.cosine, a.sine + b.sine, size > 0 ? (size_a * a.whirl + size_b * b.whirl) / size : 0.0};
}

}  // namespace

void add(EnergyFraction& sum, const EnergyFraction& one, bool reversed) {
    sum.collective += one.collective;
    sum.differential += one.differential;
    const WhirlShare first = sum_of({sum.cosine, sum.sine, sum.whirl}, {one.cosine, one.sine, one.whirl}, reversed);
    sum.cosine = first.cosine, sum.sine = first.sine, sum.whirl = first.whirl;
    sum.higher.resize(one.higher.size());
    for (std::size_t n = 0; n < one.higher.size(); ++n) sum.higher[n] = sum_of(sum.higher[n], one.higher[n], reversed);
}

}  // namespace cardan::solvers
