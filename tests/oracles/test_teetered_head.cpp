// Appendix A of D. Lee, D. H. Hodges and M. J. Patil, Wind Energy 5 (2002): the linearised equations of nacelle, shaft
// and hub, term by term.
#include "mbs/base/decompositions.hpp"
#include "tests/oracles/teetered_head.hpp"
#include "tests/oracles/teetered_rotor.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <vector>

using cardan::oracles::RigidTeeteredRotor;
using cardan::oracles::TeeteredHead;

namespace {

// Nothing is zero, nothing alike.
TeeteredHead some_head() {
    TeeteredHead head;
    head.c_n = 0.31;
    head.c_s = 0.47;
    head.c_h = 0.23;
    head.d_n2 = 2.1;
    head.d_h1 = 0.37;
    head.d_h2 = 1.7;
    head.m_y = 61;
    head.m_s = 13;
    head.m_h = 29;
    head.I_y = {3.1, 4.7, 7.3};
    head.I_s_lat = 1.9;
    head.I_s_long = 2.3;
    head.I_h = {5.3, 8.9, 6.1};
    head.K_y = 17;
    head.C_y = 1.1;
    head.K_h = 23;
    head.C_h = 0.7;
    head.Omega = 1.3;
    head.F_u = 211;
    head.F_d = 173;
    return head;
}

struct Correction {
    int equation;  // 1 ... 8
    int column;    // of TeeteredHead::linearised(); columns: what does not vanish at rest
    double right;
};

// What is wrong in the text at hand (read by machine: some may be slips of that), and how it must read.
std::vector<Correction> corrections(const TeeteredHead& h, const TeeteredHead::Printed& print, double psi) {
    const double s = std::sin(psi), c = std::cos(psi), W = h.Omega, axial = h.F_d - h.F_u;
    const double offset = h.c_h * h.m_h * (h.c_h - 1.5 * h.d_n2);
    const double spin = W * (h.I_h(1) - h.I_h(0) - h.I_h(2) - 2 * h.c_h * h.m_h * (h.c_h - h.d_n2));
    const double carried = h.m_s * h.c_s * h.c_s + h.m_y * h.c_n * h.c_n;
    const auto as_printed = [&](int equation, int column) { return print.terms(equation - 1, column); };
    enum { U1 = TeeteredHead::U, U2, U3, U5 = U1 + 4, Ud1 = TeeteredHead::Ud, Ud3 = Ud1 + 2 };
    return {
        // Brackets and signs lost: yaw, rates U1 and U1'; the steady forces have got into the bracket of U1'.
        {1, U1, -h.C_y - h.C_h * s * s + 2 * W * (h.I_h(2) + offset) * s * c},
        {1, Ud1,
         -(h.I_s_lat + h.I_y(2) + carried + h.I_h(2) * c * c -
           h.m_h * (2 * h.c_h * h.d_n2 * c * c - h.d_n2 * h.d_n2 - h.c_h * h.c_h * c * c))},
        {1, TeeteredHead::columns, h.d_n2 * axial * s},
        // Nod, U2 and U3': the bracket closes too early.
        {3, U2, h.C_h * c - spin * s},
        {3, Ud3,
         -(h.I_s_lat + h.I_y(0) + carried + h.I_h(2) * s * s +
           h.m_h * (h.d_n2 * h.d_n2 + h.c_h * (h.c_h - 2 * h.d_n2) * s * s))},
        {3, TeeteredHead::columns, -h.d_n2 * axial * c},
        // The teeter damper: against the sign of the teeter spring, and with U2 in place of the teeter rate, which is
        // q_h' = U3 cos psi - U1 sin psi - U2.
        {1, U2, -h.C_h * s - spin * c},
        {1, U3, as_printed(1, U3) + h.C_h * s * c},
        {2, U1, as_printed(2, U1) - h.C_h * s},
        {2, U2, -h.C_h},
        {2, U3, as_printed(2, U3) + h.C_h * c},
        {3, U1, as_printed(3, U1) + h.C_h * s * c},
        {3, U3, as_printed(3, U3) - h.C_h * c * c},
        // The yaw damper: its rate is U1 - U5, and it acts on the tower too.
        {1, U5, h.C_y},
        {5, U1, h.C_y},
        {5, U5, -h.C_y},
    };
}

}  // namespace

TEST_CASE("teetered head: Appendix A of the paper is Kane's equations linearised, but for slips and dampers",
          "[oracles][published]") {
    const TeeteredHead head = some_head();
    for (const double psi : {0.3, 1.1, 2.9, 4.4}) {
        const auto right = head.linearised(psi);
        const Eigen::Matrix<double, 8, 1> right_at_rest = head.at_rest(psi);
        const TeeteredHead::Printed print = head.printed(psi);
        CHECK((print.terms.array() != 0).count() == 88);
        Eigen::MatrixXd mended(8, TeeteredHead::columns + 1), exact(8, TeeteredHead::columns + 1);
        mended << print.terms, print.at_rest;
        exact << right, right_at_rest;
        for (const Correction& by : corrections(head, print, psi)) {
            CAPTURE(by.equation, by.column);
            CHECK(std::abs(mended(by.equation - 1, by.column) - by.right) > 1e-3);
            mended(by.equation - 1, by.column) = by.right;
        }
        for (Eigen::Index i = 0; i < 8; ++i)
            for (Eigen::Index j = 0; j <= TeeteredHead::columns; ++j) {
                CAPTURE(psi, i, j);
                CHECK(mended(i, j) == Approx(exact(i, j)).epsilon(1e-12).margin(1e-11));
            }
    }
}

TEST_CASE("teetered head: on a rigid tower it is the rotor of Lagrange's equations", "[oracles][crosscheck]") {
    TeeteredHead head = some_head();
    head.c_h = head.C_y = head.C_h = 0;
    head.F_u = head.F_d = 0;
    const RigidTeeteredRotor rotor{.spanwise = head.I_h(2),
                                   .teeter = head.I_h(0),
                                   .shaft = head.I_h(1),
                                   .yaw = head.I_y(2) + head.I_s_lat + head.m_y * head.c_n * head.c_n +
                                          head.m_s * head.c_s * head.c_s + head.m_h * head.d_n2 * head.d_n2,
                                   .yaw_stiffness = head.K_y,
                                   .teeter_stiffness = head.K_h,
                                   .rotor_speed = head.Omega};
    for (const double psi : {0.0, 0.7, 2.0}) {
        const double s = std::sin(psi), c = std::cos(psi);
        const auto terms = head.linearised(psi);
        // x = (y, b, y', b') with b = -q_h, U1 = y', U2 = b' - y' sin psi.
        Eigen::Matrix2d rates, M, C, K, turning;
        rates << 1, 0, -s, 1;
        turning << 0, 0, -head.Omega * c, 0;
        const Eigen::Matrix2d by_speed = terms.block<2, 2>(0, TeeteredHead::U),
                              by_rate = terms.block<2, 2>(0, TeeteredHead::Ud);
        M = by_rate * rates;
        C = by_speed * rates + by_rate * turning;
        K << terms.block<2, 1>(0, TeeteredHead::q_y), -terms.block<2, 1>(0, TeeteredHead::q_h);
        Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
        A.topRightCorner<2, 2>().setIdentity();
        A.bottomLeftCorner<2, 2>() = -M.inverse() * K;
        A.bottomRightCorner<2, 2>() = -M.inverse() * C;
        CHECK((A - rotor.state_matrix(psi)).cwiseAbs().maxCoeff() < 1e-12 * A.cwiseAbs().maxCoeff());
    }
}
