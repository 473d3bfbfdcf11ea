#include "elements/electric/inductance.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

CurveOf cosine(double pole_pairs, double phase) {
    return [pole_pairs, phase](double q) {
        const double c = std::cos(pole_pairs * q + phase), s = std::sin(pole_pairs * q + phase);
        return Curve{c, -pole_pairs * s, -pole_pairs * pole_pairs * c};
    };
}

InductanceMetric::InductanceMetric(Inductance inductance, std::vector<BodyId> coordinates)
    : inductance_(std::move(inductance)), coordinates_(std::move(coordinates)) {
    const Eigen::Index n = inductance_.windings();
    for (const InductanceTerm& term : inductance_.terms) {
        if (term.shape.rows() != n || term.shape.cols() != n)
            throw InputError("inductance", "rows of a term", term.shape.rows(), text(n, ", one for each winding"));
        if (std::ranges::find(coordinates_, term.coordinate) == coordinates_.end())
            throw InputError("inductance: a term depends on a coordinate that is not among those of the metric");
    }
}

Eigen::Index InductanceMetric::size() const {
    return std::ssize(coordinates_) + inductance_.windings();
}

Matrix InductanceMetric::metric(const Vector& q) const {
    Matrix G = Matrix::Zero(size(), size());
    const Eigen::Index m = inductance_.windings();
    G.bottomRightCorner(m, m) = inductance_.constant;
    for (const InductanceTerm& term : inductance_.terms) {
        const Eigen::Index at = std::ranges::find(coordinates_, term.coordinate) - coordinates_.begin();
        G.bottomRightCorner(m, m) += term.factor(q(at)).value * term.shape;
    }
    return G;
}

Matrix InductanceMetric::derivative(const Vector& q, Eigen::Index c) const {
    Matrix dG = Matrix::Zero(size(), size());
    const Eigen::Index m = inductance_.windings();
    for (const InductanceTerm& term : inductance_.terms)
        if (std::ranges::find(coordinates_, term.coordinate) - coordinates_.begin() == c)
            dG.bottomRightCorner(m, m) += term.factor(q(c)).slope * term.shape;
    return dG;
}

double InductanceMetric::christoffel(const Vector& q, Eigen::Index c, Eigen::Index a, Eigen::Index b) const {
    return (derivative(q, a)(c, b) + derivative(q, b)(c, a) - derivative(q, c)(a, b)) / 2;
}

Vector InductanceMetric::forces(const Vector& q, const Vector& v) const {
    Vector F = Vector::Zero(size());
    for (Eigen::Index c = 0; c < size(); ++c)
        for (Eigen::Index a = 0; a < size(); ++a)
            for (Eigen::Index b = 0; b < size(); ++b) F(c) -= christoffel(q, c, a, b) * v(a) * v(b);
    return F;
}

}  // namespace cardan
