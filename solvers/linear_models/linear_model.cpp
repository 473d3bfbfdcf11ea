#include "solvers/linear_models/linear_model.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/azimuth_series.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr std::array<Matrix StateMatrices::*, 4> state_matrices{&StateMatrices::A, &StateMatrices::B, &StateMatrices::C,
                                                                &StateMatrices::D};

// Sum of weight(i) times the matrices of item i.
template <class Items>
StateMatrices weighted(const Items& items, const Vector& weight) {
    StateMatrices sum;
    for (Matrix StateMatrices::*m : state_matrices) {
        sum.*m = Matrix::Zero((items[0].*m).rows(), (items[0].*m).cols());
        for (Eigen::Index i = 0; i < std::ssize(items); ++i) sum.*m += weight(i) * (entry(items, i).*m);
    }
    return sum;
}

}  // namespace

std::vector<StateMatrices> fourier_coefficients(const LinearModel& model, int harmonics) {
    const auto count = static_cast<int>(model.samples.size()), max = (count - 1) / 2;
    if (count == 0) throw InputError(in_linear_model, "number of azimuths", count, ">= 1");
    if (harmonics > max)
        throw InputError(in_linear_model, "harmonics", harmonics, text("at most ", max, " from ", count, " azimuths"));
    if (harmonics < 0) harmonics = max;
    Matrix weights(count, 2 * harmonics + 1);
    for (int s = 0; s < count; ++s)
        weights.row(s) = fourier_weights(entry(model.samples, s).azimuth, harmonics, count).transpose();
    std::vector<StateMatrices> coefficients;
    for (Eigen::Index j = 0; j < weights.cols(); ++j)
        coefficients.push_back(weighted(model.samples, Vector(weights.col(j))));
    return coefficients;
}

StateMatrices evaluate(const std::vector<StateMatrices>& coefficients, double psi) {
    if (coefficients.size() % 2 == 0)
        throw InputError(in_linear_model, "number of Fourier coefficients", coefficients.size(), "odd");
    return weighted(coefficients, fourier_basis(psi, static_cast<int>(coefficients.size() / 2)));
}

ComplexMatrix ConstantModel::transfer(Complex s) const {
    ComplexMatrix direct = D.cast<Complex>();
    if (A.rows() == 0) return direct;
    ComplexMatrix pencil = -A.cast<Complex>();
    pencil.diagonal().array() += s;
    const ComplexMatrix x = pencil.partialPivLu().solve(B.cast<Complex>());
    if (!x.allFinite()) throw NumericalError(text(in_linear_model, ": the transfer function has a pole at ", s));
    return C.cast<Complex>() * x + direct;
}

std::vector<Complex> ConstantModel::poles() const {
    if (A.rows() == 0) return {};
    const Eigen::EigenSolver<Matrix> solver(A, false);
    if (solver.info() != Eigen::Success)
        throw NumericalError(text(in_linear_model, ": the eigenvalue iteration fails"));
    std::vector<Complex> found(solver.eigenvalues().begin(), solver.eigenvalues().end());
    // Magnitudes of a pair may differ in the last digit: exact conjugates are compared by their imaginary parts.
    std::sort(found.begin(), found.end(), [](const Complex& a, const Complex& b) {
        const double size_a = std::hypot(a.real(), a.imag()), size_b = std::hypot(b.real(), b.imag());
        return size_a != size_b ? size_a < size_b : a.imag() > b.imag();
    });
    return found;
}

void check_names(const std::vector<NamedModel>& models, const char* file, std::set<std::string> taken) {
    for (const NamedModel& named : models) {
        const auto good = [](char c) { return is_letter(c) || is_digit(c) || c == '_'; };
        if (named.name.empty() || named.name.size() > 63 || !is_letter(named.name[0]) ||
            !std::ranges::all_of(named.name, good) || !taken.insert(named.name).second)
            throw InputError(file, "name of a model", text("'", named.name, "'"),
                             "letters, digits and '_' after a letter, at most 63, each once");
    }
}

ConstantModel at_sample(const LinearModel& model, std::size_t sample) {
    if (sample >= model.samples.size())
        throw InputError(in_linear_model, "number of the azimuth", sample, text("below ", model.samples.size()));
    ConstantModel frozen;
    static_cast<StateMatrices&>(frozen) = model.samples[sample];
    frozen.machine = model.machine;
    frozen.description = model.description;
    frozen.rotor_speed = model.rotor_speed;
    frozen.states = model.states;
    frozen.inputs = model.inputs;
    frozen.outputs = model.outputs;
    return frozen;
}

std::size_t index_of(const std::vector<Signal>& signals, std::string_view name) {
    for (std::size_t i = 0; i < signals.size(); ++i)
        if (signals[i].name == name || (!name.empty() && signals[i].alias == name)) return i;
    std::string names;
    for (const Signal& signal : signals) names += text(names.empty() ? "" : ", ", "'", signal.name, "'");
    throw InputError(in_linear_model, "name of a signal", text("'", name, "'"), text("one of ", names));
}

}  // namespace cardan::solvers
