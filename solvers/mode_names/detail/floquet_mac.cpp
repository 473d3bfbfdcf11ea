#include "solvers/mode_names/detail/floquet_mac.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Multiples of the rotor speed by which the principal frequency of a mode may jump where it is locked.
constexpr int most_shift = 8;

// A motion: shapes of its harmonics by column and what the matrices make of them.
struct ModalMotion {
    ModalMotion(const CampbellMode& mode, const SecondOrderSystem& weights)
        : exponent(mode.mode.eigenvalue), rigid(mode.kind() == FloquetKind::rigid), elastic(mode.row < 0) {
        if (mode.floquet) {
            shapes = mode.floquet->harmonics;
            first = mode.floquet->first_harmonic;
            frequency = 2 * pi / mode.floquet->period;
        } else {
            shapes = mode.mode.shape;
        }
        force = weights.K_elastic * shapes;
        momentum = weights.M * shapes;
    }
    int count() const { return static_cast<int>(shapes.cols()); }
    Complex eigenvalue(int column) const { return exponent + Complex(0, frequency * (first + column)); }
    ModalMotion conjugate() const {
        ModalMotion other = *this;
        other.exponent = std::conj(exponent);
        for (ComplexMatrix* m : {&other.shapes, &other.force, &other.momentum})
            *m = m->conjugate().rowwise().reverse().eval();
        other.first = -(first + count() - 1);
        return other;
    }

    Complex exponent;
    bool rigid, elastic;
    int first = 0;
    double frequency = 0;  // of the period, rad/s
    ComplexMatrix shapes, force, momentum;
};

// Column by column, of x's `from` and `count` further.
Complex product(const ModalMotion& x, const ModalMotion& y, int shift, bool by_shape, int from, int count) {
    Complex sum = 0;
    for (int i = from; i < from + count; ++i) {
        const int j = x.first + i + shift - y.first;
        if (j < 0 || j >= y.count()) continue;
        const Complex kinetic = x.shapes.col(i).dot(y.momentum.col(j));
        sum += by_shape ? kinetic
                        : x.shapes.col(i).dot(y.force.col(j)) + std::conj(x.eigenvalue(i)) * y.eigenvalue(j) * kinetic;
    }
    return sum;
}

Complex product(const ModalMotion& x, const ModalMotion& y, int shift, bool by_shape) {
    return product(x, y, shift, by_shape, 0, x.count());
}

struct Likeness {
    double mac = 0, score = 0;
};

Likeness likeness(const ModalMotion& x, const ModalMotion& y) {
    const bool by_shape = x.rigid || y.rigid;
    if (by_shape && (x.elastic || y.elastic)) return {};
    const double size = product(x, x, 0, by_shape).real() * product(y, y, 0, by_shape).real();
    if (!(size > 0)) return {};
    const double in_place = std::norm(product(x, y, 0, by_shape)) / size,
                 principal = std::norm(product(x, y, 0, by_shape, -x.first, 1)) / size;
    double shifted = 0;
    for (int shift = 1; shift <= most_shift; ++shift)
        for (const int s : {-shift, shift}) shifted = std::max(shifted, std::norm(product(x, y, s, by_shape)) / size);
    const Likeness found{std::min(1.0, std::max(in_place, shifted)),
                         std::min(1.0, std::max({in_place, principal, shifted / 4}))};
    // A vibration may turn into a motion of a coordinate, but is not linked to one that merely remains unassigned.
    return x.elastic != y.elastic && found.score < 0.5 ? Likeness{} : found;
}

Likeness best(const Likeness& a, const Likeness& b) {
    return {std::max(a.mac, b.mac), std::max(a.score, b.score)};
}

}  // namespace

PeriodicMac periodic_mac(const SecondOrderSystem& weights, const std::vector<const CampbellMode*>& before,
                         const std::vector<CampbellMode>& now) {
    std::vector<ModalMotion> rows, columns;
    for (const CampbellMode* mode : before) rows.emplace_back(*mode, weights);
    for (const CampbellMode& mode : now) columns.emplace_back(mode, weights);
    const auto m = std::ssize(rows), n = std::ssize(columns);
    PeriodicMac result{Matrix(m, n), Matrix(m, n)};
    for (Index j = 0; j < n; ++j) {
        const ModalMotion &y = entry(columns, j), conjugate = y.conjugate();
        const double low = 1.5 * y.frequency;
        for (Index i = 0; i < m; ++i) {
            const ModalMotion& x = entry(rows, i);
            Likeness one = likeness(x, y);
            if (y.exponent.imag() < low && x.exponent.imag() < low) one = best(one, likeness(x, conjugate));
            result.mac(i, j) = one.mac;
            result.score(i, j) = one.score;
        }
    }
    return result;
}

}  // namespace cardan::solvers
