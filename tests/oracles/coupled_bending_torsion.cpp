#include "tests/oracles/coupled_bending_torsion.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/root_finding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace cardan::oracles {

double CoupledBendingTorsion::boundary_determinant(double omega) const {
    // x in units of the length, so that the roots k^2 are dimensionless.
    const double w2 = omega * omega;
    const double l2 = length * length;
    const double ei = bending_stiffness / (l2 * l2);
    const double ri = rotary_inertia * w2 / l2;
    const double gj = torsion_stiffness / l2;
    const double mass = mass_per_length * w2;
    const double coupling = mass * mass_centre_offset;
    const double polar = (polar_inertia + mass_per_length * mass_centre_offset * mass_centre_offset) * w2;

    // (ei k^4 + ri k^2 - mass)(gj k^2 + polar) + coupling^2 = 0. At k^2 = 0 the left side is negative, so one root is
    // positive; it is negative for k^2 -> -infinity and positive in between (at -polar/gj): the other two are negative.
    const auto characteristic = [&](double k2) {
        return ((ei * k2 + ri) * k2 - mass) * (gj * k2 + polar) + coupling * coupling;
    };
    const double far = 10.0 * (1.0 + std::sqrt(mass / ei) + ri / ei + polar / gj);
    const std::array<double, 3> roots{bisect(characteristic, -far, -polar / gj),
                                      bisect(characteristic, -polar / gj, 0.0), bisect(characteristic, 0.0, far)};

    Eigen::Matrix<double, 6, 6> m;
    int column = 0;
    for (const double k2 : roots) {
        const double k = std::sqrt(std::abs(k2));
        const double c = k2 > 0.0 ? std::cosh(k) : std::cos(k);
        const double s = k2 > 0.0 ? std::sinh(k) / k : std::sin(k) / k;
        const double twist = ((ei * k2 + ri) * k2 - mass) / coupling;  // phi / w
        const double shear = ei * k2 + ri;
        // w = C(x): w' = k2 S, w'' = k2 C, w''' = k2^2 S.   w = k2 S(x): w' = k2 C, w'' = k2^2 S, w''' = k2^2 C.
        m.col(column) << 1.0, 0.0, twist, k2 * c, shear * k2 * s, twist * k2 * s;
        m.col(column + 1) << 0.0, k2, 0.0, k2 * k2 * s, shear * k2 * c, twist * k2 * c;
        m.col(column).normalize();
        m.col(column + 1).normalize();
        column += 2;
    }
    return Eigen::MatrixXd(m).partialPivLu().determinant();
}

std::vector<double> CoupledBendingTorsion::frequencies(int count, double step) const {
    if (mass_centre_offset == 0.0) {
        throw std::invalid_argument("CoupledBendingTorsion: without an offset bending and torsion are not coupled");
    }
    return first_zeros([&](double omega) { return boundary_determinant(omega); }, step, step, count);
}

}  // namespace cardan::oracles
