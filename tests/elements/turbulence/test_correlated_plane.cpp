// The correlation that each method makes, computed from its factors: no sampling.
#include "elements/turbulence/detail/correlated_plane.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/numbers.hpp"

#include <cmath>

using namespace cardan;
using cardan::detail::CorrelatedPlane;
using cardan::detail::PlaneGrid;
using cardan::detail::PlaneMethod;
using cardan::testing::contains;
using cardan::testing::max_abs;

namespace {

Matrix exponential_correlation(const PlaneGrid& grid, double rate) {
    return Matrix::NullaryExpr(grid.points(), grid.points(), [&](Eigen::Index a, Eigen::Index b) {
        const auto i = static_cast<int>(a), j = static_cast<int>(b);
        const double z = (i / grid.columns - j / grid.columns) * grid.row_spacing,
                     y = (i % grid.columns - j % grid.columns) * grid.column_spacing;
        return std::exp(-rate * std::sqrt(y * y + z * z));
    });
}

const PlaneGrid plane_grids[] = {{5, 6, 20, 15}, {2, 2, 10, 10}, {2, 6, 10, 4}, {7, 3, 3, 30}};

}  // namespace

TEST_CASE("correlated plane: Cholesky's factor has the correlation of all pairs of points", "[analytic]") {
    for (const PlaneGrid& grid : plane_grids)
        for (const double rate : {0.004, 0.02, 0.1, 0.5}) {
            CorrelatedPlane plane(grid, 3);
            plane.prepare(rate, PlaneMethod::cholesky);
            CHECK(max_abs(plane.covariance() - exponential_correlation(grid, rate)) < 1e-13);
        }
}

TEST_CASE(
    "correlated plane: Fourier's correlation is that of Cholesky within the bound, and exact where no eigenvalue "
    "is negative",
    "[crosscheck]") {
    for (const PlaneGrid& grid : plane_grids)
        for (const double rate : {0.025, 0.06, 0.2, 1.0}) {
            CorrelatedPlane plane(grid, 3), twin(grid, 3);
            plane.prepare(rate, PlaneMethod::fourier);
            twin.prepare(rate, PlaneMethod::cholesky);
            const Matrix made = plane.covariance();
            CAPTURE(grid.rows, grid.columns, rate, plane.torus_rows(), plane.torus_columns());
            CHECK(max_abs(made - twin.covariance()) < CorrelatedPlane::largest_error());
            CHECK(max_abs(made.diagonal() - Vector::Ones(grid.points())) < 1e-13);
        }
    CorrelatedPlane plane(plane_grids[0], 3);
    plane.prepare(0.06, PlaneMethod::fourier);
    CHECK(max_abs(plane.covariance() - exponential_correlation(plane_grids[0], 0.06)) < 1e-14);
}

TEST_CASE("correlated plane: mirrored and turned, the grid has the same correlation", "[property]") {
    const PlaneGrid grid = plane_grids[0], turned{grid.columns, grid.rows, grid.column_spacing, grid.row_spacing};
    for (const double rate : {0.03, 0.15}) {
        CorrelatedPlane plane(grid, 3), other(turned, 3);
        plane.prepare(rate, PlaneMethod::fourier);
        other.prepare(rate, PlaneMethod::fourier);
        const Matrix C = plane.covariance(), D = other.covariance();
        double mirrored = 0, transposed = 0;
        const auto point = [&](int row, int column) { return row * grid.columns + column; };
        for (int i = 0; i < grid.points(); ++i)
            for (int j = 0; j < grid.points(); ++j) {
                const int ri = i / grid.columns, ci = i % grid.columns, rj = j / grid.columns, cj = j % grid.columns;
                const double c = C(i, j);
                const int last = grid.columns - 1, top = grid.rows - 1;
                mirrored = std::max({mirrored, std::abs(c - C(point(ri, last - ci), point(rj, last - cj))),
                                     std::abs(c - C(point(top - ri, ci), point(top - rj, cj)))});
                transposed = std::max(transposed, std::abs(c - D(ci * grid.rows + ri, cj * grid.rows + rj)));
            }
        CHECK(mirrored < 1e-13);
        CHECK(transposed < 1e-13);
    }
}

TEST_CASE("correlated plane: 40 000 draws correlate as the factors say", "[crosscheck][slow]") {
    const PlaneGrid grid{3, 4, 20, 15};
    constexpr int draws = 40000;
    for (const double rate : {0.01, 0.03, 0.2})
        for (const PlaneMethod method : {PlaneMethod::cholesky, PlaneMethod::fourier}) {
            CorrelatedPlane plane(grid, 3);
            plane.prepare(rate, method);
            std::vector<float> re(12), im(12);
            ComplexMatrix sum = ComplexMatrix::Zero(12, 12);
            ComplexVector z(12);
            for (int i = 0; i < draws; ++i) {
                plane.draw(NormalNumbers(1, 0, static_cast<std::uint32_t>(i)), 1, re, im);
                for (int p = 0; p < 12; ++p)
                    z(p) = Complex(re[static_cast<std::size_t>(p)], im[static_cast<std::size_t>(p)]);
                sum += z * z.adjoint();
            }
            const Matrix C = plane.covariance();
            double worst = 0;  // of 144 numbers, in standard errors
            for (int i = 0; i < 12; ++i)
                for (int j = 0; j <= i; ++j) {
                    const Complex difference = sum(i, j) / (1.0 * draws) - C(i, j);
                    worst =
                        std::max(worst, std::abs(difference.real()) / std::sqrt((1 + C(i, j) * C(i, j)) / 2 / draws));
                    if (i != j)
                        worst = std::max(worst,
                                         std::abs(difference.imag()) / std::sqrt((1 - C(i, j) * C(i, j)) / 2 / draws));
                }
            CAPTURE(rate, static_cast<int>(method));
            CHECK(worst < 4);  // one of 100 normal samples of 144 numbers exceeds it
        }
}

TEST_CASE("correlated plane: the cheapest method is taken", "[property]") {
    CorrelatedPlane small({2, 2, 10, 10}, 3), large({12, 12, 10, 10}, 3);
    small.prepare(0.02);
    CHECK(small.method() == PlaneMethod::cholesky);
    large.prepare(0.05);
    CHECK(large.method() == PlaneMethod::fourier);
    CHECK(large.torus_rows() >= 22);
    large.prepare(0.3);  // neighbours beyond the grid's end need not be as far away as the grid is wide
    CHECK(large.method() == PlaneMethod::fourier);
    CHECK(large.torus_rows() < 22);
    large.prepare(1.0);
    CHECK(large.method() == PlaneMethod::independent);
    CHECK(max_abs(large.covariance() - exponential_correlation({12, 12, 10, 10}, 1.0)) < CorrelatedPlane::neglected);
    large.prepare(1e-6);  // a torus would have to be 9000 km wide
    CHECK(large.method() == PlaneMethod::cholesky);
}

TEST_CASE("correlated plane: what has no factors is refused", "[property]") {
    CorrelatedPlane plane({3, 3, 1, 1}, 3);
    CHECK(contains(cardan::test::message_of([&] { plane.prepare(1e-6, PlaneMethod::fourier); }), "reaches too far"));
    CHECK(contains(cardan::test::message_of([&] { plane.prepare(0, PlaneMethod::cholesky); }),
                   "space them further apart"));
}
