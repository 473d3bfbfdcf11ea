// Anderson's acceleration against direct solutions.
#include "solvers/algebra/anderson.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/Dense>

using namespace cardan;
using namespace cardan::solvers;

TEST_CASE("Anderson: a linear iteration that diverges alone is solved in as many steps as it has unknowns and one",
          "[analytic]") {
    // x := G x + c with eigenvalues 3, -2, 0.9, 0.1.
    const Eigen::Vector4d values(3, -2, 0.9, 0.1), c(1, -2, 0.5, 4);
    Eigen::Matrix4d V;
    V << 1, 0.3, 0, 0.2, 0, 1, 0.5, 0, 0.4, 0, 1, 0.1, 0, 0.2, 0, 1;
    const Matrix G = V * values.asDiagonal() * V.inverse();
    const Vector solution = (Matrix::Identity(4, 4) - G).partialPivLu().solve(Vector(c));
    Anderson anderson(4, 4);
    Vector x = Vector::Zero(4), plain = x;
    for (int i = 0; i < 5; ++i) {
        x = anderson.next(x, G * x + c - x);
        plain = G * plain + c;
    }
    CHECK((x - solution).norm() < 1e-10 * solution.norm());
    CHECK((plain - solution).norm() > 10 * solution.norm());
}

TEST_CASE("Anderson: what is linear and holds before and after an iteration is kept", "[property]") {
    // The sum of the entries is 1 for x and for x + f.
    const Eigen::Vector3d rates(0.5, 0.8, 0.2);
    Anderson anderson(3, 2);
    Vector x = Eigen::Vector3d(0.2, 0.3, 0.5);
    for (int i = 0; i < 6; ++i) {
        Vector f = rates.cwiseProduct(x.array().sin().matrix()) - x / 2;
        f.array() -= f.mean();
        x = anderson.next(x, f);
        CHECK(x.sum() == Approx(1).epsilon(1e-12));
    }
}
