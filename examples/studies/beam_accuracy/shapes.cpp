#include "examples/studies/beam_accuracy/shapes.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"

namespace cardan::accuracy {

namespace {

using Row = Eigen::Matrix<Real, 1, 4>;

struct CubicRows {
    Row w, dw, s, ds;
};

CubicRows cubic(Real xi, Real h, Real phi) {
    const Real x2 = xi * xi, x3 = x2 * xi, c = 1 / (1 + phi);
    CubicRows f;
    f.w << 2 * x3 - 3 * x2 - phi * xi + 1 + phi, h * (x3 - (2 + phi / 2) * x2 + (1 + phi / 2) * xi),
        -(2 * x3 - 3 * x2 - phi * xi), h * (x3 - (1 - phi / 2) * x2 - phi / 2 * xi);
    f.dw << (6 * x2 - 6 * xi - phi) / h, 3 * x2 - (4 + phi) * xi + 1 + phi / 2, -(6 * x2 - 6 * xi - phi) / h,
        3 * x2 - (2 - phi) * xi - phi / 2;
    f.s << 6 * (x2 - xi) / h, 3 * x2 - (4 + phi) * xi + 1 + phi, -6 * (x2 - xi) / h, 3 * x2 - (2 - phi) * xi;
    f.ds << 6 * (2 * xi - 1) / (h * h), (6 * xi - 4 - phi) / h, -6 * (2 * xi - 1) / (h * h), (6 * xi - 2 + phi) / h;
    f.w *= c, f.dw *= c, f.s *= c, f.ds *= c;
    return f;
}

// Displacements of the element that moves with its inboard end as a rigid body, and the unknowns of its outboard end.
Field inboard(Real t) {
    Field rigid = Field::Zero();
    rigid(0, 0) = rigid(1, 4) = 1, rigid(0, 1) = rigid(1, 5) = t;
    return rigid;
}
Field inboard_slope() {
    Field rigid = Field::Zero();
    rigid(0, 1) = rigid(1, 5) = 1;
    return rigid;
}
Field outboard(int kind) {
    Field end = Field::Zero();
    end(0, 2 + kind) = end(1, 6 + kind) = 1;
    return end;
}

}  // namespace

std::vector<GaussPoint> gauss_points(double a, double b, const std::vector<double>& breaks) {
    std::vector<double> ends{a};
    for (double x : breaks)
        if (x > a && x < b) ends.push_back(x);
    ends.push_back(b);
    std::vector<GaussPoint> result;
    const GaussRule& rule = gauss_rule();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double middle = (ends[i] + ends[i + 1]) / 2, half = (ends[i + 1] - ends[i]) / 2;
        for (std::size_t k = 0; k < rule.node.size(); ++k)
            result.push_back({middle + half * rule.node[k], half * rule.weight[k]});
    }
    return result;
}

Block2 bending_stiffness(const BeamSection& section, Plane plane) {
    const Eigen::Matrix2d C = section.compliance.block<2, 2>(4, 4);
    Eigen::Matrix2d D = Eigen::Matrix2d::Zero();
    if (plane == Plane::flap) D(0, 0) = 1 / C(0, 0);
    if (plane == Plane::edge) D(1, 1) = 1 / C(1, 1);
    if (plane == Plane::both) D = C.inverse();
    D(0, 1) = -D(0, 1), D(1, 0) = -D(1, 0);  // the flap rotation w' turns about -y
    return D.cast<Real>();
}

ElementShapes::ElementShapes(const BeamLine& line, Plane plane, Shapes shapes, double a, double b)
    : line_(&line), plane_(plane), shapes_(shapes), a_(a), b_(b) {
    const Real h = Real(b) - Real(a);
    if (shapes == Shapes::cubic) {
        Vec6 mean = Vec6::Zero();
        for (const GaussPoint& p : gauss_points(a, b, line.breaks))
            mean += p.weight * line.section(p.x).compliance.diagonal();
        const auto ratio = [h](Real shear, Real bend) { return bend > 0 ? 12 * shear / (bend * h * h) : Real(0); };
        phi_flap_ = ratio(mean(2), mean(4)), phi_edge_ = ratio(mean(1), mean(5));
        return;
    }
    const Moments m = moments(b);
    Eigen::Matrix<Real, 4, 4> ends;
    ends << h * m.zeroth - m.first, h * m.first - m.second, m.zeroth, m.first;
    Eigen::Matrix<Real, 4, 8> wanted;
    wanted << outboard(0) - inboard(h), outboard(1) - inboard_slope();
    line_moment_ = ends.fullPivLu().solve(wanted);
}

Block2 ElementShapes::compliance(double x) const {
    Block2 D = bending_stiffness(line_->section(x), plane_);
    for (int i = 0; i < 2; ++i)
        if (D(i, i) == 0) D(i, i) = 1;  // ignored
    return D.inverse();
}

ElementShapes::Moments ElementShapes::moments(double x) const {
    Moments m;
    for (const GaussPoint& p : gauss_points(a_, x, line_->breaks)) {
        const Block2 C = Real(p.weight) * compliance(p.x);
        const Real t = Real(p.x) - Real(a_);
        m.zeroth += C, m.first += t * C, m.second += t * t * C;
    }
    return m;
}

ElementField ElementShapes::static_field(double x) const {
    const Real t = Real(x) - Real(a_);
    const Moments m = moments(x);
    const Field m0 = line_moment_.topRows<2>(), m1 = line_moment_.bottomRows<2>();
    const Block2 C = compliance(x);
    ElementField f;
    f.w = inboard(t) + (t * m.zeroth - m.first) * m0 + (t * m.first - m.second) * m1;
    f.dw = f.s = inboard_slope() + m.zeroth * m0 + m.first * m1;
    f.ds = C * (m0 + t * m1);
    return f;
}

ElementField ElementShapes::at(double x) const {
    if (shapes_ == Shapes::statics) return static_field(x);
    const Real h = Real(b_) - Real(a_), xi = (Real(x) - Real(a_)) / h;
    const CubicRows flap = cubic(xi, h, phi_flap_), edge = cubic(xi, h, phi_edge_);
    const auto both = [](const Row& f, const Row& e) {
        Field field = Field::Zero();
        field.block<1, 4>(0, 0) = f, field.block<1, 4>(1, 4) = e;
        return field;
    };
    return {both(flap.w, edge.w), both(flap.dw, edge.dw), both(flap.s, edge.s), both(flap.ds, edge.ds)};
}

}  // namespace cardan::accuracy
