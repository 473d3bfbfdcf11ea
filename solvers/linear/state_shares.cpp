#include "solvers/linear/state_shares.hpp"

#include <limits>

namespace cardan::solvers {

namespace {

// An error of the inverse adds to a left vector parts of others: rounding times the lengths of both.
constexpr double largest_error = 1e-4;

bool is_pair(const RealEigen::Value& value) {
    return value.mu.imag() != 0;
}

}  // namespace

StateShares::StateShares(Eigen::Index rows, Eigen::Index states)
    : rows_(rows), states_(states), all_(states > 0 ? 2 * rows + states : 0) {
    if (states == 0) return;
    const Eigen::Index size = 2 * rows + states;
    of_states_.resize(states, size);
    left_.resize(size, size);
    shares_.reserve(static_cast<std::size_t>(size));
}

// The rates b of a vector follow from its displacements a: mu b = a + sigma mu a.
void StateShares::assemble(const RealEigen& eigen, const Vector& balance, double shift) {
    Matrix& V = all_.matrix();
    V.topRows(rows_ + states_) = eigen.vectors();
    const Eigen::Index rates = rows_ + states_;
    for (const RealEigen::Value& value : eigen.values()) {
        const Complex factor = 1.0 / value.mu + shift;
        const Eigen::Index j = value.column;
        for (Eigen::Index i = 0; i < rows_; ++i) {
            const Complex a(V(i, j), is_pair(value) ? V(i, j + 1) : 0.0);
            const Complex b = factor * a * (balance(i) / balance(rates + i));
            V(rates + i, j) = b.real();
            if (is_pair(value)) V(rates + i, j + 1) = b.imag();
        }
        auto own = V.middleCols(j, is_pair(value) ? 2 : 1);
        own /= own.norm();
    }
    of_states_ = V.middleRows(rows_, states_);
}

const std::vector<double>& StateShares::compute(const RealEigen& eigen, const Vector& balance, double shift) {
    assemble(eigen, balance, shift);
    all_.factorise();
    left_.setIdentity();
    all_.solve(left_);
    const double longest = left_.rowwise().norm().maxCoeff();
    shares_.clear();
    for (const RealEigen::Value& value : eigen.values()) {
        const Eigen::Index j = value.column;
        const auto y = left_.row(j).segment(rows_, states_);
        const auto v = of_states_.col(j);
        Complex states = y.dot(v.transpose());
        double length = left_.row(j).norm();
        if (is_pair(value)) {
            // y^H = (p - i q) / 2 with the rows p and q of the inverse, v = a + i b.
            const auto q = left_.row(j + 1).segment(rows_, states_);
            const auto b = of_states_.col(j + 1);
            states = Complex(states.real() + q.dot(b.transpose()), y.dot(b.transpose()) - q.dot(v.transpose())) / 2.0;
            length = std::hypot(length, left_.row(j + 1).norm());
        }
        const bool certain = std::numeric_limits<double>::epsilon() * longest * length < largest_error;
        shares_.push_back(certain ? std::abs(states) / (std::abs(states) + std::abs(1.0 - states))
                                  : std::numeric_limits<double>::quiet_NaN());
    }
    return shares_;
}

}  // namespace cardan::solvers
