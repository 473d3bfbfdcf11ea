// The waves a box of Mann's turbulence is made of, without sampling.
#include "elements/turbulence/detail/mann_cells.hpp"
#include "elements/turbulence/detail/mann_waves.hpp"
#include "elements/turbulence/mann_spectra.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace cardan::testing::mann_wave_tests {

namespace {

using detail::MannLattice;
using detail::MannPlane;

MannOptions small_box(LargeEddies eddies) {
    MannOptions out;
    out.grid = {.steps = 64, .rows = 5, .columns = 4, .time_step = 0.5, .row_spacing = 5, .column_spacing = 6};
    out.speed = 9;
    out.parameters = {3.9, 20, 0.4};
    out.width = 8 * 6;
    out.height = 10 * 5;
    out.eddies = eddies;
    return out;
}

// Sums over k_2 and k_3 of A A^T exp(i(k_2 dy + k_3 dz)) per k_1, for several distances (dy, dz).
std::vector<Mat3T<Complex>> line_sums(const MannLattice& lattice, int index1,
                                      const std::vector<std::array<double, 2>>& distances) {
    std::vector<Mat3T<Complex>> sums(distances.size(), Mat3T<Complex>::Zero());
    const Vec3 mirror(1, -1, 1);
    for (int index2 = 0; index2 <= lattice.last2; ++index2)
        for (int index3 = -lattice.last3; index3 <= lattice.last3; ++index3) {
            const Vec3 k(index1 * lattice.dk1, index2 * lattice.dk2, index3 * lattice.dk3);
            const Mat3 A = lattice.root(k), one = A * A.transpose() / lattice.dk1;
            const Mat3 other = mirror.asDiagonal() * one * mirror.asDiagonal();
            for (std::size_t i = 0; i < sums.size(); ++i) {
                const double phase2 = k(1) * distances[i][0], phase3 = k(2) * distances[i][1];
                sums[i] += one * std::polar(1.0, phase2 + phase3);
                if (index2 > 0) sums[i] += other * std::polar(1.0, phase3 - phase2);
            }
        }
    return sums;
}

}  // namespace

TEST_CASE("Mann's shear: the table of a box is the function", "[property]") {
    const detail::ShearTable table(3.9, 1e-4, 1e4);
    for (double x = 1e-4; x < 1e4; x *= 1.0371) CHECK(table(x) == Approx(mann_shear(std::sqrt(x), 3.9)).epsilon(1e-9));
}

TEST_CASE("waves of Mann's box: A A^T is the tensor times the cell, exactly", "[property]") {
    const MannLattice lattice(small_box(LargeEddies::pointwise));
    const double cell = lattice.dk1 * lattice.dk2 * lattice.dk3;
    for (const int index1 : {1, 4, 31}) {
        Mat3 sum = Mat3::Zero();
        for (int index2 = -lattice.last2; index2 <= lattice.last2; ++index2)
            for (int index3 = -lattice.last3; index3 <= lattice.last3; ++index3) {
                const Vec3 k(index1 * lattice.dk1, index2 * lattice.dk2, index3 * lattice.dk3);
                const Mat3 right = cell * mann_tensor(lattice.parameters, k), A = lattice.root(k);
                CHECK(max_abs(A * A.transpose() - right) < 1e-8 * right.trace());
                sum += right;
            }
        MannPlane plane(lattice);
        plane.draw(index1);
        CHECK(max_abs(plane.covariance() - sum) < 1e-8 * sum.trace());
    }
}

TEST_CASE("waves of Mann's box: no divergence where the tensor is taken pointwise, and of small eddies in any case",
          "[property]") {
    for (const LargeEddies eddies : {LargeEddies::pointwise, LargeEddies::averaged}) {
        const MannLattice lattice(small_box(eddies));
        MannPlane plane(lattice);
        for (const int index1 : {1, 31}) {
            plane.draw(index1);
            for (int index2 = -lattice.last2; index2 <= lattice.last2; ++index2)
                for (int index3 = -lattice.last3; index3 <= lattice.last3; ++index3) {
                    const Vec3 k(index1 * lattice.dk1, index2 * lattice.dk2, index3 * lattice.dk3);
                    if (eddies == LargeEddies::averaged && k.norm() * lattice.parameters.length_scale < 6) continue;
                    const std::array<Complex, 3>& u = plane.wave(index2, index3);
                    const double size = std::sqrt(std::norm(u[0]) + std::norm(u[1]) + std::norm(u[2]));
                    CHECK(std::abs(k(0) * u[0] + k(1) * u[1] + k(2) * u[2]) < 1e-9 * k.norm() * size);
                }
        }
    }
}

TEST_CASE("waves of Mann's box: means of the tensor over cells, by midpoints", "[crosscheck]") {
    const double L = 30, dk = 2 * pi / (8 * L);
    const detail::ShearTable shear(3.9, 1e-4, 1e4);
    const auto midpoints = [&](const Vec3& k, int n) {
        Mat3 sum = Mat3::Zero();
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                sum += mann_tensor({3.9, L, 1}, k + dk * Vec3(0, (i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5));
        return Mat3(sum / (n * n) * 4 * pi * std::pow(L, -17.0 / 3));
    };
    for (const double k1L : {0.1, 1.0})
        for (const Vec3& index : {Vec3(0, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0), Vec3(0, 2, 1)}) {
            const Vec3 k = index * dk + Vec3(k1L / L, 0, 0);
            const Mat3 right = (4 * midpoints(k, 80) - midpoints(k, 40)) / 3;  // extrapolated to no spacing
            const Mat3 mean = detail::mean_over_cell(shear, L, k, dk, dk);
            CAPTURE(k1L, index.transpose());
            CHECK(max_abs(mean - right) < 1e-5 * right.trace());
            const Mat3 A = detail::triangular_root(mean);
            CHECK(max_abs(A * A.transpose() - mean) < 1e-14 * mean.trace());
        }
}

// 12 points on L across. 0.7 %: what lies beyond half the sampling rate, by the isotropic tail; more at k_1 L = 4. The
// coherence of eddies larger than the domain is that of its cells.
TEST_CASE("waves of Mann's box: sums are the spectra, and nearly the cross-spectra, if cells are averaged",
          "[crosscheck]") {
    const double L = 33.6;
    MannOptions options;
    options.grid = {
        .steps = 2048, .rows = 49, .columns = 49, .time_step = 0.4, .row_spacing = L / 12, .column_spacing = L / 12};
    options.speed = 10;
    options.parameters = {3.9, L, 1};
    const std::vector<std::array<double, 2>> distances{{0, 0}, {0, L}, {0, 2 * L}, {L, 0}, {2 * L, 0}};
    struct Line {
        int index1;
        double spectrum, coherence;
    };
    const MannLattice lattice(options);
    CHECK(lattice.domain.width == Approx(8 * L));
    for (const Line& line : {Line{4, 0.004, 0.27}, Line{40, 0.007, 0.02}, Line{160, 0.042, 0.002}}) {
        const double k1 = line.index1 * lattice.dk1;
        const Mat3 F = mann_spectrum(options.parameters, k1);
        const std::vector<Mat3T<Complex>> sums = line_sums(lattice, line.index1, distances);
        CAPTURE(k1 * L);
        for (int c = 0; c < 3; ++c) CHECK(std::abs(sums[0](c, c) / F(c, c) - 1.0) < line.spectrum);
        CHECK(std::abs(sums[0](0, 2) - F(0, 2)) < line.spectrum * std::sqrt(F(0, 0) * F(2, 2)));
        for (std::size_t i = 1; i < distances.size(); ++i) {
            const Mat3T<Complex> right = mann_cross_spectrum(options.parameters, k1, distances[i][0], distances[i][1]);
            for (int c = 0; c < 3; ++c)
                CHECK(std::abs(sums[i](c, c) / sums[0](c, c) - right(c, c) / F(c, c)) < line.coherence);
        }
    }
    // Without means, of the large eddies much of u is not there, and w is there several times.
    options.eddies = LargeEddies::pointwise;
    const Mat3T<Complex> sum = line_sums(MannLattice(options), 4, {{0, 0}}).front();
    const Mat3 F = mann_spectrum(options.parameters, 4 * lattice.dk1);
    CHECK(sum(0, 0).real() < 0.7 * F(0, 0));
    CHECK(sum(2, 2).real() > 2 * F(2, 2));
}

TEST_CASE("waves of Mann's box: a finer grid in the same domain has the same large eddies", "[property]") {
    MannOptions options = small_box(LargeEddies::averaged);
    const MannLattice coarse(options);
    options.grid.row_spacing /= 2;
    options.grid.rows *= 2;
    options.grid.time_step /= 2;
    options.grid.steps *= 2;
    const MannLattice fine(options);
    MannPlane plane(coarse), finer(fine);
    plane.draw(3);
    finer.draw(3);
    for (int index2 = -coarse.last2; index2 <= coarse.last2; ++index2)
        for (int index3 = -coarse.last3; index3 <= coarse.last3; ++index3)
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(std::abs(plane.wave(index2, index3)[c] - finer.wave(index2, index3)[c]) < 1e-12);
}

}  // namespace cardan::testing::mann_wave_tests
