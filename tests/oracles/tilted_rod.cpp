#include "tests/oracles/tilted_rod.hpp"

#include <cmath>

namespace cardan::oracles {

namespace {

// Gamma and kappa of g, and their derivatives D.
Vec6 tilted_strains(const Vec6& g, double c, Mat6& D) {
    const double ay = -c * g(2), az = c * g(1), cy = std::cos(ay), sy = std::sin(ay);
    const double cz = std::cos(az), sz = std::sin(az);
    const Vec3 d(cy * cz, sz, -sy * cz), d_ay(-sy * cz, 0, -cy * cz), d_az(-cy * sz, cz, sy * sz);
    const Vec3 e3(sy, 0, cy), e3_ay(cy, 0, -sy);
    const double arm = 1 / c + g(0);
    D.setZero();
    D.col(0).head<3>() = d;
    D.col(1).head<3>() = arm * c * d_az;
    D.col(2).head<3>() = -arm * c * d_ay;
    D.col(1).tail<3>() = c * g(3) * d_az;
    D.col(2).tail<3>() = -c * (g(3) * d_ay + g(5) * e3_ay);
    D.col(3).tail<3>() = d;
    D(4, 4) = 1;
    D.col(5).tail<3>() = e3;
    Vec6 strain;
    strain << (1 - 1 / c) * Vec3::UnitX() + arm * d - Vec3::UnitX(), g(3) * d + g(4) * Vec3::UnitY() + g(5) * e3;
    return strain;
}

}  // namespace

CosseratRod limit_of_elements(CosseratRod rod, double delta) {
    rod.strain = [law = rod.strain, c = 1 / (1 - 2 * delta)](double s, const Vec6& forces) {
        Vec6 g = law(s, forces);
        Mat6 D;
        for (int i = 0; i < 40; ++i) {
            tilted_strains(g, c, D);
            const Vec6 next = law(s, Vec6(D.transpose() * forces));
            const double change = (next - g).norm();
            g = next;
            if (change < 1e-16) break;
        }
        return tilted_strains(g, c, D);
    };
    return rod;
}

}  // namespace cardan::oracles
