#include "turbines/reference_turbines/nrel5mw_shapes.hpp"

namespace cardan::turbines {

const std::array<ModePolynomial, 4> elastodyn_tower_polynomials{
    {{0.7004, 2.1963, -5.6202, 6.2275, -2.5040},
     {-70.5319, -63.7623, 289.7370, -176.5130, 22.0706},
     {1.3850, -1.7684, 3.0871, -2.2395, 0.5357},
     {-121.2100, 184.4150, -224.9040, 298.5360, -135.8380}}};
const std::array<ModePolynomial, 3> elastodyn_blade_polynomials{{{0.0622, 1.7254, -3.2452, 4.7131, -2.2555},
                                                                 {-0.5809, 1.2067, -15.5349, 29.7347, -13.8255},
                                                                 {0.3627, 2.5337, -3.5772, 2.3760, -0.6952}}};

namespace {

// The polynomial or one of its first two derivatives by x/L.
double value(const ModePolynomial& p, double s, int derivative) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const int n = static_cast<int>(i) + 2;
        double term = p.at(i) * std::pow(s, n - derivative);
        for (int k = 0; k < derivative; ++k) term *= n - k;
        sum += term;
    }
    return sum;
}

// Rotations at two hinges (fractions of the length) that add a slope and a displacement at the end of an element.
std::array<double, 2> two_hinges(const Hinges& hinges, double length, double slope, double displacement) {
    const double second =
        (slope * length * (1 - hinges.first) - displacement) / (length * (hinges.second - hinges.first));
    return {slope - second, second};
}

Matrix side_by_side(const std::vector<Vector>& columns) {
    Matrix all(columns[0].size(), static_cast<Eigen::Index>(columns.size()));
    for (Eigen::Index k = 0; k < all.cols(); ++k) all.col(k) = columns[static_cast<std::size_t>(k)];
    return all;
}

}  // namespace

Vector hinge_rotations_along(const CardanBeam& beam, const std::function<Deflection(double x)>& deflection) {
    std::vector<double> q;
    for (const CardanBeam::Element& e : beam.elements) {
        const Deflection a = deflection(e.start), b = deflection(e.start + e.length);
        const auto about_z = two_hinges(e.hinges, e.length, b.v_slope - a.v_slope, b.v - a.v - a.v_slope * e.length),
                   lowers_z = two_hinges(e.hinges, e.length, b.w_slope - a.w_slope, b.w - a.w - a.w_slope * e.length);
        for (const ElementCoordinate kind : e.kinds) {
            double value = 0;
            if (kind == ElementCoordinate::az1) value = about_z[0];
            if (kind == ElementCoordinate::az2) value = about_z[1];
            if (kind == ElementCoordinate::ay1) value = -lowers_z[0];  // a positive rotation about y lowers z outboard
            if (kind == ElementCoordinate::ay2) value = -lowers_z[1];
            q.push_back(value);
        }
    }
    return Eigen::Map<const Vector>(q.data(), static_cast<Eigen::Index>(q.size()));
}

Matrix elastodyn_tower_shapes(const CardanBeam& tower) {
    std::vector<Vector> columns;
    for (std::size_t k = 0; k < 4; ++k)
        columns.push_back(hinge_rotations_along(tower, [&](double x) {
            const double L = tower.line.length;
            const double d = value(elastodyn_tower_polynomials.at(k), x / L, 0),
                         slope = value(elastodyn_tower_polynomials.at(k), x / L, 1) / L;
            return k < 2 ? Deflection{d, 0, slope, 0} : Deflection{0, d, 0, slope};  // beam axes: y downwind
        }));
    return side_by_side(columns);
}

Matrix elastodyn_blade_shapes(const CardanBeam& blade) {
    constexpr int steps = 4000;
    const double L = blade.line.length, h = L / steps;
    std::vector<Vector> columns;
    for (std::size_t k = 0; k < 3; ++k) {
        // Curvature turned into blade axes and integrated twice by the trapezoidal rule.
        std::vector<Deflection> path(steps + 1);
        double last_v = 0, last_w = 0;
        for (int i = 0; i <= steps; ++i) {
            const double x = std::min(h * i, L), beta = blade.line.section(x).beta;
            const double curvature = value(elastodyn_blade_polynomials.at(k), x / L, 2) / (L * L);
            const double c = curvature * std::cos(beta), s = curvature * std::sin(beta);
            const double v = k < 2 ? -s : c, w = k < 2 ? c : s;
            if (i > 0) {
                const Deflection& a = path[static_cast<std::size_t>(i - 1)];
                Deflection& b = path[static_cast<std::size_t>(i)];
                b.v_slope = a.v_slope + h / 2 * (last_v + v), b.w_slope = a.w_slope + h / 2 * (last_w + w);
                b.v = a.v + h / 2 * (a.v_slope + b.v_slope), b.w = a.w + h / 2 * (a.w_slope + b.w_slope);
            }
            last_v = v, last_w = w;
        }
        columns.push_back(hinge_rotations_along(blade, [&](double x) {
            const double at = std::min(x / h, steps - 1e-9);
            const auto i = static_cast<std::size_t>(at);
            const double t = at - static_cast<double>(i);
            const Deflection &a = path[i], &b = path[i + 1];
            return Deflection{a.v + t * (b.v - a.v), a.w + t * (b.w - a.w), a.v_slope + t * (b.v_slope - a.v_slope),
                              a.w_slope + t * (b.w_slope - a.w_slope)};
        }));
    }
    return side_by_side(columns);
}

}  // namespace cardan::turbines
