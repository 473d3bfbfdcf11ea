#include "tests/oracles/column_with_head.hpp"

#include "tests/oracles/root_finding.hpp"

#include <Eigen/Core>

namespace cardan::oracles {

namespace {

// Rows: w, w', EI w'', (EI w'')'; two solutions side by side, and what is above x: int_x^L mu in column 2 of row 0.
using State = Eigen::Matrix<double, 4, 3>;

}  // namespace

double ColumnWithHead::determinant(double omega, int steps) const {
    const double squared = omega * omega;
    double line_mass = 0;  // of the column, by the same rule as below
    const auto walk = [&](State y, const auto& slope) {
        for (std::size_t i = 1; i < breaks.size(); ++i) {
            const double h = (breaks[i] - breaks[i - 1]) / steps;
            for (int k = 0; k < steps; ++k) {
                const double x = breaks[i - 1] + k * h;
                const State a = slope(x, y), b = slope(x + h / 2, State(y + h / 2 * a)),
                            c = slope(x + h / 2, State(y + h / 2 * b)), d = slope(x + h, State(y + h * c));
                y += h / 6 * (a + 2 * b + 2 * c + d);
            }
        }
        return y;
    };
    line_mass = walk(State::Zero(), [&](double x, const State&) {
        State s = State::Zero();
        s(0, 2) = mass_per_length(x);
        return s;
    })(0, 2);
    State start = State::Zero();
    start(2, 0) = start(3, 1) = 1;
    start(0, 2) = line_mass;
    const State top = walk(start, [&](double x, const State& y) {
        const double mu = mass_per_length(x), N = gravity * (head_mass + y(0, 2));
        State s = State::Zero();
        for (Eigen::Index j : {0, 1}) {
            const double curvature = y(2, j) / bending_stiffness(x);
            s(0, j) = y(1, j);
            s(1, j) = curvature;
            s(2, j) = y(3, j);
            s(3, j) = squared * mu * y(0, j) - N * curvature + gravity * mu * y(1, j);  // N' = -g mu
        }
        s(0, 2) = -mu;
        return s;
    });
    const double N = gravity * head_mass;
    const auto moment = [&](Eigen::Index j) {
        const double arm = top(0, j) + head_height * top(1, j);
        return top(2, j) - N * head_height * top(1, j) -
               squared * (head_mass * head_height * arm + head_inertia * top(1, j));
    };
    const auto force = [&](Eigen::Index j) {
        return top(3, j) + N * top(1, j) + squared * head_mass * (top(0, j) + head_height * top(1, j));
    };
    return moment(0) * force(1) - moment(1) * force(0);
}

std::vector<double> ColumnWithHead::frequencies(int count, double spacing, int steps) const {
    return first_zeros([&](double omega) { return determinant(omega, steps); }, spacing / 100, spacing, count);
}

}  // namespace cardan::oracles
