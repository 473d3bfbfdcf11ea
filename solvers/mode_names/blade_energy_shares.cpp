// EnergyFractions of blades that differ.
#include "mbs/base/entry.hpp"
#include "solvers/linear/coordinate_rows.hpp"
#include "solvers/mode_names/detail/blade_likeness.hpp"
#include "solvers/mode_names/detail/component_modes.hpp"
#include "solvers/mode_names/detail/component_order.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cardan::solvers {

void EnergyFractions::add_blades(const Linearisation& lin, const Model& model, const RotorMap& rotor,
                                 const BladePart& part) {
    BladeBlock block{};
    block.first_component = static_cast<int>(components_.size());
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    const std::vector<double> angles = blade_angles(kin, rotor);
    const Mat3 hub = pose(kin, rotor.hub).R, axes = pose(kin, part.axes.axes).R;
    for (std::size_t k = 0; k < rotor.blades.size(); ++k) {
        std::vector<int> own;
        for (const int coordinate : rotor.blades[k])
            if (row_of(part.coordinates, coordinate) >= 0 && lin.coordinates[coordinate].part == part.axes.part)
                own.push_back(coordinate);
        block.rows.push_back(rows_of(part.coordinates, own));
        const Mat3 turned = hub * rot_z(angles[k]) * hub.transpose() * axes;
        add_modes(part, lin, own, coordinate_families(kin, part.axes, turned, own), block);
    }
    const Eigen::Index count = std::ssize(components_) - block.first_component;
    if (count == 0) return;
    for (Matrix& weights : block.weights) {
        const Eigen::Index known = weights.cols();
        weights.conservativeResize(Eigen::NoChange, count);
        weights.rightCols(count - known).setZero();
    }
    for (const std::vector<int>& rows : block.rows)
        if (!plain_) block.slots.push_back(entry(part.rows, rows.at(0)));
    for (const MultiBladeRow& slot : block.slots) harmonics_ = std::max(harmonics_, slot.harmonic);
    block.at_zero = multi_blade_block(block.slots);
    blade_blocks_.push_back(std::move(block));
}

// Component modes of one blade, under the names that others may have already. Where as many modes have other names (one
// that is as much edge as torsion in the first blade and a little more of the one in the next, because it is bent
// otherwise), they follow each other in frequency as those of the first do.
void EnergyFractions::add_modes(const BladePart& part, const Linearisation& lin, const std::vector<int>& own,
                                const std::vector<std::string>& families, BladeBlock& block) {
    Matrix& weights = block.weights.emplace_back(Matrix::Zero(std::ssize(own), 0));
    if (own.empty()) return;
    const Matrix K = lin.elastic(own, own);
    const ComponentModes modes = component_modes(K, lin.mass(own, own), part.axes.part);
    const std::vector<Component> first(components_.begin() + block.first_component, components_.end());
    std::vector<Component> named;
    std::map<std::string, int> count;
    for (Eigen::Index i = 0; i < modes.shapes.cols(); ++i) {
        const std::string family = family_of(modes.shapes.col(i), K, families);
        named.push_back({part.axes.part, family, ++count[family], modes.omega(i) / (2 * pi), true, false});
    }
    std::vector<int> columns(named.size());
    if (const auto order = component_order(first, named))
        for (std::size_t c = 0; c < first.size(); ++c) columns[(*order)[c]] = static_cast<int>(c);
    else
        for (std::size_t i = 0; i < named.size(); ++i) columns[i] = component_of(block, named[i]);
    for (Eigen::Index i = 0; i < std::ssize(named); ++i) {
        const int c = entry(columns, i);
        const Eigen::Index known = weights.cols(), wanted = std::max<Eigen::Index>(known, c + 1);
        weights.conservativeResize(Eigen::NoChange, wanted);
        weights.rightCols(wanted - known).setZero();
        weights.col(c) = K * modes.shapes.col(i);
    }
}

// Its column in the block.
int EnergyFractions::component_of(const BladeBlock& block, const Component& named) {
    const auto first = components_.begin() + block.first_component;
    const auto found = std::find_if(first, components_.end(), [&](const Component& c) {
        return c.family == named.family && c.ordinal == named.ordinal;
    });
    const int column = static_cast<int>(found - first);
    if (found == components_.end()) components_.push_back(named);
    return column;
}

// Energy amplitude of one blade, sum_j T_kj (w_k . z_j), at the azimuth of T; without slots w_k . x_k.
Complex EnergyFractions::blade_amplitude(const BladeBlock& block, Eigen::Index component, Eigen::Index blade,
                                         const Matrix& T, const ComplexVector& shape) {
    const Matrix& weights = entry(block.weights, blade);
    const auto worth = [&](const std::vector<int>& rows) {
        Complex sum = 0;
        for (Eigen::Index i = 0; i < weights.rows(); ++i) sum += weights(i, component) * shape(entry(rows, i));
        return sum;
    };
    if (block.slots.empty()) return worth(entry(block.rows, blade));
    Complex sum = 0;
    for (Eigen::Index j = 0; j < T.cols(); ++j) sum += T(blade, j) * worth(entry(block.rows, j));
    return sum;
}

// Energy amplitudes of the patterns, sum_k T_kl a_k.
EnergyFractions::Patterns EnergyFractions::patterns(const BladeBlock& block, Eigen::Index component, const Matrix& T,
                                                    const ComplexVector& shape) {
    Patterns out{};
    for (Eigen::Index k = 0; k < T.rows(); ++k) {
        const Complex own = blade_amplitude(block, component, k, T, shape);
        for (Eigen::Index l = 0; l < T.cols(); ++l) entry(out, l) += T(k, l) * own;
    }
    return out;
}

EnergyFraction EnergyFractions::pattern_share(const BladeBlock& block, const Patterns& amplitude,
                                              std::vector<WhirlShare> higher) {
    EnergyFraction share;
    share.higher = std::move(higher);
    share.higher.clear();
    for (std::size_t j = 0; j < block.slots.size(); ++j) {
        const MultiBladeRow& slot = block.slots[j];
        if (slot.kind == MultiBlade::collective) share.collective = std::norm(amplitude[j]);
        if (slot.kind == MultiBlade::differential) share.differential = std::norm(amplitude[j]);
        if (slot.kind != MultiBlade::cosine) continue;
        add_pair(slot.harmonic, amplitude[j], amplitude[j + 1], share);
    }
    return share;
}

EnergyFraction EnergyFractions::mean_share(const BladeBlock& block, Eigen::Index component,
                                           const ComplexVector& shape) {
    const auto blades = std::ssize(block.weights);
    Complex sum = 0;
    double all = 0;
    for (Eigen::Index k = 0; k < blades; ++k) {
        const Complex own = blade_amplitude(block, component, k, block.at_zero, shape);
        sum += own;
        all += std::norm(own);
    }
    EnergyFraction share;
    share.collective = std::norm(sum) / static_cast<double>(blades);
    share.differential = std::max(0.0, all - share.collective);
    return share;
}

// At azimuth 0. `higher` lends its memory.
EnergyFraction EnergyFractions::blade_share(const BladeBlock& block, Eigen::Index component, const Mode& mode,
                                            std::vector<WhirlShare> higher) {
    EnergyFraction share =
        block.slots.empty()
            ? mean_share(block, component, mode.shape)
            : pattern_share(block, patterns(block, component, block.at_zero, mode.shape), std::move(higher));
    share.component = static_cast<int>(block.first_component + component);
    return share;
}

// Where blades differ, amplitudes of patterns have harmonics of the azimuth beside those of the rows, since T occurs in
// them twice; the energy is that of all their harmonics.
EnergyFraction EnergyFractions::blade_share(const BladeBlock& block, Eigen::Index component,
                                            std::span<const Mode> harmonics, double rotor_speed) {
    EnergyFraction sum;
    sum.component = static_cast<int>(block.first_component + component);
    if (block.slots.empty()) {
        for (const Mode& one : harmonics) add(sum, mean_share(block, component, one.shape), false);
        return sum;
    }
    int outer = 0;
    for (const MultiBladeRow& slot : block.slots) outer = std::max(outer, 2 * slot.harmonic);
    const int count = static_cast<int>(harmonics.size()), all = count + 2 * outer;
    std::vector<Patterns> by_harmonic(static_cast<std::size_t>(all));
    for (int s = 0; s < all; ++s) {
        const double psi = 2 * pi * s / all;
        ComplexVector shape = ComplexVector::Zero(harmonics[0].shape.size());
        for (int h = 0; h < count; ++h) shape += std::polar(1.0, h * psi) * entry(harmonics, h).shape;
        const Patterns now = patterns(block, component, multi_blade_block(block.slots, psi), shape);
        for (int m = 0; m < all; ++m)
            for (std::size_t l = 0; l < block.slots.size(); ++l)
                entry(by_harmonic, m)[l] += std::polar(1.0 / all, -(m - outer) * psi) * now[l];
    }
    for (int m = 0; m < all; ++m) {
        const double frequency = harmonics[0].eigenvalue.imag() + (m - outer) * rotor_speed;
        add(sum, pattern_share(block, entry(by_harmonic, m), {}), frequency < 0);
    }
    return sum;
}

}  // namespace cardan::solvers
