#include "examples/studies/beams/assumed_modes_basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan {

namespace {

using Index = Eigen::Index;
constexpr int highest = 12;  // degree

// P_0 ... P_highest.   [Abramowitz and Stegun 1964, 22.7.10]
std::array<double, highest + 1> legendre(double x) {
    std::array<double, highest + 1> P{1, x};
    for (std::size_t k = 1; k < highest; ++k) {
        const auto d = static_cast<double>(k);
        P[k + 1] = ((2 * d + 1) * x * P[k] - d * P[k - 1]) / (d + 1);
    }
    return P;
}

// The integral of P_n from -1 is (P_{n+1} - P_{n-1}) / (2n + 1); scaled so that that of its square is of order one.
double scale(int n) {
    return std::sqrt(n + 0.5);
}

}  // namespace

AssumedModesBasis AssumedModesBasis::paper2018(double length) {
    return {.breaks = {0, length}, .bending = 5, .torsion = 3, .extension = 0, .sines = true};
}

void ShapeValues::add(Index at, double f, double d, double dd) {
    column.push_back(at);
    value.push_back(f);
    slope.push_back(d);
    curvature.push_back(dd);
}

ShapeFunctions::ShapeFunctions(Kind kind, std::vector<double> breaks, int terms)
    : kind_(kind), breaks_(std::move(breaks)), terms_(terms) {}

Index ShapeFunctions::size() const {
    return kind_ == Kind::sines ? terms_ : terms_ * (std::ssize(breaks_) - 1);
}

ShapeValues ShapeFunctions::at(double x) const {
    if (kind_ == Kind::sines) return sines(x);
    ShapeValues out;
    if (terms_ == 0) return out;
    const auto right = std::lower_bound(breaks_.begin() + 1, breaks_.end() - 1, x);
    const double half = (*right - *(right - 1)) / 2, xi = (x - *(right - 1)) / half - 1;
    const Index piece = right - breaks_.begin() - 1;
    if (kind_ == Kind::clamped)
        clamped(piece, xi, half, out);
    else
        continuous(piece, xi, half, out);
    return out;
}

ShapeValues ShapeFunctions::sines(double x) const {
    ShapeValues out;
    for (int j = 0; j < terms_; ++j) {
        const double k = (j + 0.5) * pi / breaks_.back(), s = std::sin(k * x), c = std::cos(k * x);
        out.add(j, s, k * c, -k * k * s);
    }
    return out;
}

// Columns of a piece: value and slope at its right end, then polynomials of degree 4, 5 ... that vanish with their
// slopes at both ends: Legendre polynomials integrated twice.
void ShapeFunctions::clamped(Index piece, double xi, double half, ShapeValues& out) const {
    const double h = half, l = 1 - xi, r = 1 + xi;
    if (piece > 0) {
        out.add((piece - 1) * terms_, l * l * (1 + r) / 4, -3 * l * r / 4 / h, 3 * xi / 2 / (h * h));
        out.add((piece - 1) * terms_ + 1, h * l * l * r / 4, -l * (1 + 3 * xi) / 4, (3 * xi - 1) / 2 / h);
    }
    out.add(piece * terms_, r * r * (1 + l) / 4, 3 * l * r / 4 / h, -3 * xi / 2 / (h * h));
    out.add(piece * terms_ + 1, -h * r * r * l / 4, -r * (1 - 3 * xi) / 4, (3 * xi + 1) / 2 / h);
    const auto P = legendre(xi);
    for (int term = 2; term < terms_; ++term) {
        const auto n = static_cast<std::size_t>(term);
        const double d = term, c = scale(term);
        const double once = (P[n + 1] - P[n - 1]) / (2 * d + 1);
        const double twice = ((P[n + 2] - P[n]) / (2 * d + 3) - (P[n] - P[n - 2]) / (2 * d - 1)) / (2 * d + 1);
        out.add(piece * terms_ + term, c * twice * h, c * once, c * P[n] / h);
    }
}

// Value at the right end, then polynomials of degree 2, 3 ... that vanish at both ends.
void ShapeFunctions::continuous(Index piece, double xi, double half, ShapeValues& out) const {
    if (piece > 0) out.add((piece - 1) * terms_, (1 - xi) / 2, -1 / (2 * half), 0);
    out.add(piece * terms_, (1 + xi) / 2, 1 / (2 * half), 0);
    const auto P = legendre(xi);
    for (int term = 1; term < terms_; ++term) {
        const auto n = static_cast<std::size_t>(term);
        const double c = scale(term);
        // The second derivative of a continuous function is not asked for.
        out.add(piece * terms_ + term, c * (P[n + 1] - P[n - 1]) / (2.0 * term + 1), c * P[n] / half, 0);
    }
}

}  // namespace cardan
