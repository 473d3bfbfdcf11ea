#include "solvers/linear_models/multi_blade_model.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/coleman.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_multi_blade_model = "multi-blade model";

// "blade 2 root moment y" -> "blade root moment y"; "" for other names.
std::string without_number(const Signal& signal) {
    const std::string stem = text("blade ", signal.blade);
    if (signal.blade == 0 || !signal.name.starts_with(stem)) return {};
    return "blade" + signal.name.substr(stem.size());
}

// Column by column: x_k over collective, cosine 1, sine 1 ... in the order of ColemanTransform.
Matrix blade_block(int blades, double psi) {
    Matrix block(blades, blades);
    for (int k = 0; k < blades; ++k) {
        const double psi_k = psi + 2 * pi * k / blades;
        block(k, 0) = 1;
        for (int j = 1; j < blades; ++j) {
            const int n = (j + 1) / 2;
            block(k, j) = j % 2 == 1 ? std::cos(n * psi_k) : std::sin(n * psi_k);
        }
        if (blades % 2 == 0) block(k, blades - 1) = k % 2 == 0 ? 1 : -1;
    }
    return block;
}

MultiBladeRow pattern(int place_in_set, int blades) {
    if (place_in_set == 0) return {MultiBlade::collective, 0, 0};
    if (blades % 2 == 0 && place_in_set == blades - 1) return {MultiBlade::differential, 0, 0};
    return {place_in_set % 2 == 1 ? MultiBlade::cosine : MultiBlade::sine, (place_in_set + 1) / 2, 0};
}

// Inputs or outputs that all blades have.
class BladeSets {
public:
    BladeSets(std::vector<Signal> signals, int blades) : blades_(blades), signals_(std::move(signals)) {
        std::map<std::string, std::vector<int>> by_name;
        std::vector<std::string> order;
        for (std::size_t i = 0; i < signals_.size(); ++i) {
            const std::string name = without_number(signals_[i]);
            if (name.empty() || signals_[i].blade > blades) continue;
            std::vector<int>& rows = by_name[name];
            if (rows.empty()) order.push_back(name);
            rows.resize(static_cast<std::size_t>(blades), -1);
            entry(rows, signals_[i].blade - 1) = static_cast<int>(i);
        }
        for (const std::string& name : order)
            if (std::ranges::none_of(by_name[name], [](int row) { return row < 0; })) add(name, by_name[name]);
    }

    const std::vector<Signal>& signals() const { return signals_; }
    const std::vector<std::string>& names() const { return names_; }
    Matrix matrix(double psi) const {
        const auto n = std::ssize(signals_);
        Matrix T = Matrix::Identity(n, n);
        const Matrix block = blade_block(blades_, psi);
        for (const std::vector<int>& rows : sets_) T(rows, rows) = block;
        return T;
    }

private:
    void add(const std::string& name, const std::vector<int>& rows) {
        names_.push_back(name);
        sets_.push_back(rows);
        for (int j = 0; j < blades_; ++j) {
            Signal& signal = entry(signals_, entry(rows, j));
            signal.name = text(name, " (", multi_blade_name(pattern(j, blades_)), ")");
            signal.alias.clear();
            signal.blade = 0;
        }
    }

    int blades_;
    std::vector<Signal> signals_;
    std::vector<std::string> names_;
    std::vector<std::vector<int>> sets_;
};

// For two blades the azimuthal average is not a valid model.
const RotorMap& with_three_blades(const RotorMap& rotor) {
    if (rotor.blades.size() < 3)
        throw InputError(rotor.machine, "number of blades", rotor.blades.size(),
                         "at least 3 for a constant model (two blades need Floquet's theory)");
    return rotor;
}

// V, V^-1 and dV/dt.
class States {
public:
    States(const LinearModel& model, const RotorMap& rotor)
        : coleman_(with_three_blades(rotor), model.coordinates, states_of(model)),
          rotor_speed_(model.rotor_speed),
          scale_(scales(rotor, coleman_.rows())),
          state_scale_(scales(rotor, coleman_.state_rows())) {}

    Matrix matrix(double psi) const { return block(psi, 0); }
    // Change with time.
    Matrix rate(double psi) const { return rotor_speed_ * block(psi, 1); }
    const std::vector<MultiBladeRow>& rows() const { return coleman_.rows(); }
    const std::vector<MultiBladeRow>& state_rows() const { return coleman_.state_rows(); }

private:
    static StateTable states_of(const LinearModel& model) {
        std::vector<StateInfo> states;
        states.reserve(static_cast<std::size_t>(model.first_order));
        for (std::size_t i = model.states.size() - static_cast<std::size_t>(model.first_order); i < model.states.size();
             ++i)
            states.push_back({.name = model.states[i].name,
                              .unit = model.states[i].units,
                              .scale = 1,
                              .blade = model.states[i].blade});
        return StateTable(std::move(states));
    }
    // From the orthonormal coordinates of ColemanTransform to those whose collective value is the mean.
    static Vector scales(const RotorMap& rotor, const std::vector<MultiBladeRow>& rows) {
        const double B = static_cast<double>(rotor.blades.size());
        Vector scale = Vector::Ones(std::ssize(rows));
        for (Index i = 0; i < scale.size(); ++i) {
            const MultiBlade kind = entry(rows, i).kind;
            if (kind == MultiBlade::none) continue;
            const bool whirls = kind == MultiBlade::cosine || kind == MultiBlade::sine;
            scale(i) = std::sqrt(whirls ? B / 2 : B);
        }
        return scale;
    }
    // q = T z, qd = rotor_speed T' z + T zd, or the derivative of this by psi.
    Matrix block(double psi, int derivative) const {
        const Index n = scale_.size(), m = state_scale_.size();
        const Matrix T = coleman_.matrix(psi, derivative) * scale_.asDiagonal();
        Matrix V = Matrix::Zero(2 * n + m, 2 * n + m);
        V.topLeftCorner(n, n) = T;
        V.block(n, n, n, n) = T;
        V.block(n, 0, n, n) = rotor_speed_ * coleman_.matrix(psi, derivative + 1) * scale_.asDiagonal();
        V.bottomRightCorner(m, m) = coleman_.state_matrix(psi, derivative) * state_scale_.asDiagonal();
        return V;
    }

    ColemanTransform coleman_;
    double rotor_speed_;
    Vector scale_, state_scale_;
};

std::vector<Signal> state_signals(const LinearModel& model, const RotorMap& rotor,
                                  const std::vector<MultiBladeRow>& rows, const std::vector<MultiBladeRow>& states) {
    std::vector<Signal> signals = model.states;
    const auto rename = [&](Signal& signal, const Signal& source, const MultiBladeRow& row) {
        const std::string name = without_number(source);
        const Signal first = source;
        signal = first;
        signal.name = text(name.empty() ? first.name : name, " (", multi_blade_name(row), ")");
        signal.long_name = text("multi-blade coordinate of '", first.name, "' and its like");
        signal.blade = 0;
    };
    // Named after blade 1, whose row is the collective one.
    const std::size_t from = 2 * rows.size();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i].kind == MultiBlade::none) continue;
        const auto collective = std::ranges::find_if(states, [&](const MultiBladeRow& other) {
            return other.kind == MultiBlade::collective && other.blade_coordinate == states[i].blade_coordinate;
        });
        rename(signals[from + i], model.states[from + static_cast<std::size_t>(collective - states.begin())],
               states[i]);
    }
    for (std::size_t i = 0; i < from; ++i) {
        const MultiBladeRow& row = rows[i % rows.size()];
        if (row.kind == MultiBlade::none) continue;
        // Named after blade 1.
        const int coordinate = entry(rotor.blades[0], row.blade_coordinate);
        const auto first = std::ranges::find(model.coordinates, coordinate) - model.coordinates.begin();
        rename(signals[i], entry(model.states, first + (i < rows.size() ? 0 : std::ssize(rows))), row);
    }
    return signals;
}

void check(const LinearModel& model, const RotorMap& rotor) {
    if (static_cast<std::size_t>(model.blades) != rotor.blades.size())
        throw InputError(in_multi_blade_model, "number of blades", model.blades,
                         text(rotor.blades.size(), ", as the rotor has"));
    if (model.samples.empty()) throw InputError(in_multi_blade_model, "number of azimuths", 0, "1 or more");
    if (model.rotor_speed != 0) check_azimuths(model.samples.size(), model.blades);
}

double remainder(const Matrix& difference, const Matrix& mean) {
    const double size = mean.norm();
    return size > 0 ? difference.norm() / size : difference.norm();
}

// By row, each relative to itself. Rows at rounding level relative to others in the same units are ignored.
double remainder_by_row(const Matrix& difference, const Matrix& mean, const std::vector<Signal>& outputs) {
    std::map<std::string, double> largest;
    for (Index i = 0; i < mean.rows(); ++i) {
        double& size = largest[entry(outputs, i).units];
        size = std::max(size, mean.row(i).norm());
    }
    double result = 0;
    for (Index i = 0; i < mean.rows(); ++i) {
        const double size = std::max(mean.row(i).norm(), 1e-6 * largest[entry(outputs, i).units]);
        if (size > 0) result = std::max(result, difference.row(i).norm() / size);
    }
    return result;
}

}  // namespace

Matrix multi_blade_states(const LinearModel& model, const RotorMap& rotor, double psi) {
    return States(model, rotor).matrix(psi);
}

namespace {

// Eigen must not solve an empty system: a model may have no inputs or no outputs.
Matrix solved(const Eigen::PartialPivLU<Matrix>& lu, const Matrix& right) {
    return right.size() > 0 ? Matrix(lu.solve(right)) : right;
}

}  // namespace

MultiBladeModel multi_blade(const LinearModel& model, const RotorMap& rotor) {
    check(model, rotor);
    const States states(model, rotor);
    const BladeSets inputs(model.inputs, model.blades), outputs(model.outputs, model.blades);
    std::vector<StateMatrices> all;
    for (const LinearSample& sample : model.samples) {
        const Matrix V = states.matrix(sample.azimuth), U = inputs.matrix(sample.azimuth);
        const auto V_inverse = V.partialPivLu();
        const auto Y_inverse = outputs.matrix(sample.azimuth).partialPivLu();
        StateMatrices z;
        z.A = V_inverse.solve(sample.A * V - states.rate(sample.azimuth));
        z.B = solved(V_inverse, sample.B * U);
        z.C = solved(Y_inverse, sample.C * V);
        z.D = solved(Y_inverse, sample.D * U);
        all.push_back(std::move(z));
    }
    MultiBladeModel result;
    result.machine = model.machine;
    result.description = model.description;
    result.rotor_speed = model.rotor_speed;
    result.states = state_signals(model, rotor, states.rows(), states.state_rows());
    result.inputs = inputs.signals();
    result.outputs = outputs.signals();
    result.input_sets = inputs.names();
    result.output_sets = outputs.names();
    for (Matrix StateMatrices::*m : {&StateMatrices::A, &StateMatrices::B, &StateMatrices::C, &StateMatrices::D}) {
        Matrix sum = Matrix::Zero((all[0].*m).rows(), (all[0].*m).cols());
        for (const StateMatrices& z : all) sum += z.*m;
        result.*m = sum / static_cast<double>(all.size());
    }
    for (const StateMatrices& z : all) {
        result.A_remainder = std::max(result.A_remainder, remainder(z.A - result.A, result.A));
        result.B_remainder = std::max(result.B_remainder, remainder(z.B - result.B, result.B));
        result.C_remainder = std::max(result.C_remainder, remainder_by_row(z.C - result.C, result.C, result.outputs));
        result.D_remainder = std::max(result.D_remainder, remainder_by_row(z.D - result.D, result.D, result.outputs));
    }
    return result;
}

// The transformed matrices repeat after 1/B of a revolution.
void check_azimuths(std::size_t azimuths, int blades) {
    if (azimuths < 3)
        throw InputError(in_multi_blade_model, "number of azimuths", azimuths, "3 or more of a rotor that turns");
    const int count = static_cast<int>(azimuths), different = count / std::gcd(count, blades);
    if (blades > 2 && different < 3)
        throw InputError(in_multi_blade_model, "number of azimuths", azimuths,
                         text("one at which the rotor of ", blades, " blades stands in 3 different ways (", blades + 1,
                              ", ", 3 * blades, ")"));
}

}  // namespace cardan::solvers
