#include "elements/turbulence/detail/mann_waves.hpp"

#include "elements/turbulence/detail/mann_cells.hpp"
#include "elements/turbulence/detail/sheared_wave.hpp"
#include "elements/turbulence/random_numbers.hpp"
#include "mbs/base/entry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cardan::detail {

namespace {

// Behind the others come the negative ones, as transforms have them.
std::size_t wrapped(int index, int count) {
    return static_cast<std::size_t>(index < 0 ? index + count : index);
}

// Wave numbers times L below which the tensor is averaged over cells.
constexpr double averaged_kL = 6;

}  // namespace

MannLattice::MannLattice(const MannOptions& options)
    : parameters(options.parameters),
      seed(options.seed),
      grid(options.grid),
      domain(mann_domain(options)),
      dk1(2 * pi / (grid.steps * grid.time_step * options.speed)),
      dk2(2 * pi / domain.width),
      dk3(2 * pi / domain.height),
      last1((grid.steps - 1) / 2),
      last2((domain.columns - 1) / 2),
      last3((domain.rows - 1) / 2),
      amplitude(
          std::sqrt(parameters.dissipation * std::pow(parameters.length_scale, 17.0 / 3) * dk1 * dk2 * dk3 / (4 * pi))),
      averaged_below(options.eddies == LargeEddies::averaged ? std::pow(averaged_kL, 2) : 0),
      shear(parameters.gamma, std::pow(dk1 * parameters.length_scale, 2) / 2,
            16 * (Vec3(last1 * dk1, (last2 + 1) * dk2, (last3 + 1) * dk3) * parameters.length_scale).squaredNorm()) {}

Mat3 MannLattice::root(const Vec3& k) const {
    const double L_square = parameters.length_scale * parameters.length_scale, kL_square = k.squaredNorm() * L_square;
    if (kL_square < averaged_below)
        return amplitude * triangular_root(mean_over_cell(shear, parameters.length_scale, k, dk2, dk3));
    const ShearedWave wave(k, shear(kL_square));
    return amplitude * std::pow(1 + wave.k0_square * L_square, -17.0 / 12) * wave.root();
}

MannPlane::MannPlane(const MannLattice& lattice)
    : lattice_(&lattice),
      roots_(static_cast<std::size_t>(lattice.domain.rows), Mat3::Zero()),
      waves_(static_cast<std::size_t>(lattice.domain.rows) * static_cast<std::size_t>(lattice.domain.columns)),
      line_(static_cast<std::size_t>(lattice.domain.rows)),
      transformed_(static_cast<std::size_t>(std::max(lattice.domain.rows, lattice.domain.columns))),
      half_(static_cast<std::size_t>(lattice.grid.rows) * static_cast<std::size_t>(lattice.domain.columns)) {
    for (std::vector<Complex>& normals : normals_) normals.resize(line_.size());
}

std::size_t MannPlane::place(int index2, int index3) const {
    const MannDomain& domain = lattice_->domain;
    return wrapped(index2, domain.columns) * static_cast<std::size_t>(domain.rows) + wrapped(index3, domain.rows);
}

// Numbers belong to the indices of a wave number, which must not depend on how many there are.
void MannPlane::draw_normals(int index1, int index2) {
    const auto last3 = static_cast<std::size_t>(lattice_->last3);
    constexpr std::uint64_t negative = std::uint64_t{1} << 16;
    const std::uint64_t first =
        (index2 < 0 ? negative - static_cast<std::uint64_t>(-index2) : static_cast<std::uint64_t>(index2)) << 17;
    for (std::uint32_t component = 0; component < 3; ++component) {
        const NormalNumbers numbers(lattice_->seed, component, static_cast<std::uint32_t>(index1));
        const std::span all(normals_[component]);
        numbers.fill(first, all.first(last3 + 1));
        numbers.fill(first + negative, all.last(last3));  // of -1, -2 ... from the back
        std::reverse(all.end() - static_cast<std::ptrdiff_t>(last3), all.end());
    }
}

void MannPlane::draw_line(int index2, bool mirrored) {
    const double odd = mirrored ? -1 : 1;  // of what is odd in k_2
    std::array<Complex, 3>* line = &waves_[place(index2, 0)];
    for (std::size_t i = 0; i < roots_.size(); ++i) {
        const Mat3& A = roots_[i];
        const Complex n1 = normals_[0][i], n2 = normals_[1][i], n3 = normals_[2][i];
        line[i] = {odd * (A(0, 0) * n1 + A(0, 2) * n3) + A(0, 1) * n2,
                   odd * (A(1, 1) * n2) + A(1, 0) * n1 + A(1, 2) * n3,  //
                   odd * (A(2, 0) * n1 + A(2, 2) * n3) + A(2, 1) * n2};
    }
}

void MannPlane::draw(int index) {
    const MannLattice& l = *lattice_;
    const double k1 = index * l.dk1;
    covariance_.setZero();
    for (int index2 = 0; index2 <= l.last2; ++index2) {
        const double k2 = index2 * l.dk2;
        Mat3 sum = Mat3::Zero();
        for (int index3 = -l.last3; index3 <= l.last3; ++index3) {
            Mat3& A = roots_[wrapped(index3, l.domain.rows)];
            A = l.root({k1, k2, index3 * l.dk3});
            sum += A * A.transpose();
        }
        draw_normals(index, index2);
        draw_line(index2, false);
        if (index2 == 0) {
            covariance_ += sum;
            continue;
        }
        draw_normals(index, -index2);
        draw_line(-index2, true);
        covariance_ += sum;
        const Vec3 mirror(1, -1, 1);
        covariance_ += mirror.asDiagonal() * sum * mirror.asDiagonal();
    }
}

void MannPlane::transform(int component, std::span<float> re, std::span<float> im) {
    const MannDomain& domain = lattice_->domain;
    const auto rows = static_cast<std::size_t>(lattice_->grid.rows),
               columns = static_cast<std::size_t>(lattice_->grid.columns),
               waves = static_cast<std::size_t>(domain.columns);
    for (std::size_t index2 = 0; index2 < waves; ++index2) {
        if (index2 > static_cast<std::size_t>(lattice_->last2) &&
            index2 < waves - static_cast<std::size_t>(lattice_->last2))
            continue;  // stays zero
        const std::array<Complex, 3>* from = &waves_[index2 * line_.size()];
        for (std::size_t i = 0; i < line_.size(); ++i) line_[i] = entry(from[i], component);
        fourier_.inverse(line_.data(), domain.rows, transformed_.data());
        for (std::size_t row = 0; row < rows; ++row) half_[row * waves + index2] = transformed_[row];
    }
    for (std::size_t row = 0; row < rows; ++row) {
        fourier_.inverse(&half_[row * waves], domain.columns, transformed_.data());
        for (std::size_t column = 0; column < columns; ++column) {
            re[row * columns + column] = static_cast<float>(transformed_[column].real());
            im[row * columns + column] = static_cast<float>(transformed_[column].imag());
        }
    }
}

}  // namespace cardan::detail
