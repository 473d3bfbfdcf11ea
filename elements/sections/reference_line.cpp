#include "elements/sections/reference_line.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"

#include <array>
#include <boost/math/interpolators/cubic_hermite.hpp>

namespace cardan {

Mat3 shortest_rotation(const Vec3& a, const Vec3& b, const std::string& where) {
    const double c = a.dot(b);
    if (c < -1 + 1e-12) throw InputError(where, "turn of the reference line [deg]", 180, "less than 180");
    const Mat3 w = skew<double>(cross<double>(a, b));
    return Mat3::Identity() + w + w * w / (1 + c);
}

namespace {

// Reflects v at the plane across d.
Vec3 reflected(const Vec3& v, const Vec3& d) {
    return v - 2 * d.dot(v) / d.squaredNorm() * d;
}

// Frame carried from one place of a curve to a near one by two reflections (Wang, Juettler, Zheng and Liu 2008): turns
// about the tangent by O(h^4) per unit length only.
Mat3 carried(const Mat3& R, const Vec3& step, const Vec3& tangent) {
    if (step.squaredNorm() == 0) return R;
    const Vec3 across = reflected(R.col(1), step), along = reflected(R.col(0), step);
    const Vec3 d = tangent - along;
    const Vec3 y = d.squaredNorm() > 0 ? reflected(across, d) : across;
    const Vec3 straight = (y - y.dot(tangent) * tangent).normalized();
    return (Mat3() << tangent, straight, cross<double>(tangent, straight)).finished();
}

using Spline = boost::math::interpolators::cubic_hermite<std::vector<double>>;

// Slopes of the cubic spline with continuous curvature; the two pieces at either end are one cubic (not-a-knot), so
// that the ends are as exact as the rest, O(h^4). [de Boor, A Practical Guide to Splines, ch. IV]
Matrix spline_slopes(const std::vector<double>& t, const std::vector<Vec3>& points) {
    const auto n = std::ssize(t);
    const auto h = [&t](Eigen::Index i) { return entry(t, i + 1) - entry(t, i); };
    const auto slope = [&](Eigen::Index i) {
        return Eigen::RowVector3d((entry(points, i + 1) - entry(points, i)).transpose() / h(i));
    };
    Matrix A = Matrix::Zero(n, n), b(n, 3);
    for (Eigen::Index i = 1; i < n - 1; ++i) {
        A.row(i).segment<3>(i - 1) << h(i), 2 * (h(i - 1) + h(i)), h(i - 1);
        b.row(i) = 3 * (h(i) * slope(i - 1) + h(i - 1) * slope(i));
    }
    const auto end = [&](Eigen::Index row, Eigen::Index next, Eigen::Index first, Eigen::Index second) {
        const double a = h(first), c = h(second);
        A(row, row) = c;
        A(row, next) = a + c;
        b.row(row) = ((3 * a + 2 * c) * c * slope(first) + a * a * slope(second)) / (a + c);
    };
    end(0, 1, 0, 1);
    end(n - 1, n - 2, n - 2, n - 3);
    return A.partialPivLu().solve(b);
}

}  // namespace

double ReferenceLine::arc(double from, double to) const {
    return integrate(from, to, {}, 0.0, [&](double t) { return derivative_(t).norm(); });
}

void ReferenceLine::divide(const std::vector<double>& knots, int cells_per_piece) {
    const Vec3 start = derivative_(knots.front()).normalized();
    Cell cell{knots.front(), 0, shortest_rotation(Vec3::UnitX(), start, "reference line, start")};
    cells_.push_back(cell);
    stations_.push_back(0);
    for (std::size_t k = 1; k < knots.size(); ++k) {
        for (int i = 1; i <= cells_per_piece; ++i) {
            const double t = knots[k - 1] + (knots[k] - knots[k - 1]) * i / cells_per_piece;
            const Vec3 tangent = derivative_(t).normalized(), step = position_(t) - position_(cell.t);
            const double s = cell.s + arc(cell.t, t);
            if (!(s > cell.s) || std::isinf(s) || !step.allFinite())
                throw InputError("reference line", text("length up to t = ", t, " [m]"), s, "finite and increasing");
            cell = {t, s, carried(cell.R, step, tangent)};
            cells_.push_back(cell);
        }
        stations_.push_back(cell.s);
    }
}

Placement ReferenceLine::pose(double s) const {
    const auto next = std::upper_bound(cells_.begin() + 1, cells_.end() - 1, s,
                                       [](double value, const Cell& cell) { return value < cell.s; });
    const Cell &a = *(next - 1), &b = *next;
    double t = a.t + (b.t - a.t) * (s - a.s) / (b.s - a.s);
    for (int iteration = 0; iteration < 20; ++iteration) {
        const double miss = a.s + (t >= a.t ? arc(a.t, t) : -arc(t, a.t)) - s;
        t -= miss / derivative_(t).norm();
        if (std::abs(miss) < 1e-14 * length()) break;
    }
    const Vec3 p = position_(t);
    return {carried(a.R, p - position_(a.t), derivative_(t).normalized()), p};
}

ReferenceLine ReferenceLine::curve(std::function<Vec3(double)> position, std::function<Vec3(double)> derivative,
                                   double first, double last) {
    if (!position || !derivative) throw InputError("reference line: position and derivative must be given");
    if (!(last > first)) throw InputError("reference line", "end of the parameter", last, text("> ", first));
    for (double t : {first, last})
        if (!position(t).allFinite() || !(derivative(t).norm() > 0))
            throw InputError("reference line", "position and derivative at an end",
                             text(position(t).transpose(), "; ", derivative(t).transpose()), "finite, not zero");
    ReferenceLine line;
    line.position_ = std::move(position);
    line.derivative_ = std::move(derivative);
    line.divide({first, last}, 128);
    return line;
}

namespace {

void check_points(const std::vector<Vec3>& points, std::size_t min) {
    if (points.size() < min)
        throw InputError("reference line", "number of points", points.size(), text("at least ", min));
    double length = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double before = length;
        if (i > 0) length += (points[i] - points[i - 1]).norm();
        if (!points[i].allFinite() || !std::isfinite(length) || (i > 0 && length == before))
            throw InputError("reference line", text("point ", i + 1, " [m]"), points[i].transpose(),
                             "finite, apart from the point before it, which the length up to there must show");
    }
}

}  // namespace

ReferenceLine ReferenceLine::through(const std::vector<Vec3>& points, LineShape shape) {
    check_points(points, shape == LineShape::spline ? 4 : 2);
    std::vector<double> knots{0};
    for (std::size_t i = 1; i < points.size(); ++i) knots.push_back(knots.back() + (points[i] - points[i - 1]).norm());
    ReferenceLine line;
    if (shape == LineShape::spline) {
        const Matrix slopes = spline_slopes(knots, points);
        std::array<std::shared_ptr<Spline>, 3> c;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            std::vector<double> t = knots, values, rates(slopes.col(axis).begin(), slopes.col(axis).end());
            for (const Vec3& p : points) values.push_back(p(axis));
            entry(c, axis) = std::make_shared<Spline>(std::move(t), std::move(values), std::move(rates));
        }
        // Rounding may put a parameter outside of the table.
        const auto inside = [last = knots.back()](double t) { return std::clamp(t, 0.0, last); };
        line.position_ = [c, inside](double t) {
            return Vec3((*c[0])(inside(t)), (*c[1])(inside(t)), (*c[2])(inside(t)));
        };
        line.derivative_ = [c, inside](double t) {
            return Vec3(c[0]->prime(inside(t)), c[1]->prime(inside(t)), c[2]->prime(inside(t)));
        };
        line.divide(knots, 16);
        return line;
    }
    const auto piece = [knots](double t) { return place_among(knots, t).right; };
    line.position_ = [points, knots, piece](double t) {
        const std::size_t j = piece(t);
        return Vec3(points[j - 1] + (points[j] - points[j - 1]) * (t - knots[j - 1]) / (knots[j] - knots[j - 1]));
    };
    line.derivative_ = [points, knots, piece](double t) {
        const std::size_t j = piece(t);
        return Vec3((points[j] - points[j - 1]) / (knots[j] - knots[j - 1]));
    };
    // Arc length is the parameter; one cell per piece, with the frame turned at the kinks by the shortest way.
    line.stations_ = knots;
    Mat3 R = Mat3::Identity();
    for (std::size_t j = 0; j < points.size(); ++j) {
        const Vec3 tangent = line.derivative_(knots[j]);
        R = shortest_rotation(R.col(0), tangent, text("reference line, point ", j + 1)) * R;
        line.cells_.push_back({knots[j], knots[j], R});
    }
    return line;
}

BeamLine along(const BeamLine& sections, const ReferenceLine& line) {
    sections.check();
    if (std::abs(sections.length - line.length()) > 1e-6 * line.length())
        throw InputError(sections.name, "length of the sections [m]", sections.length,
                         text(line.length(), ", the length of the reference line"));
    BeamLine curved = sections;
    for (double s : line.stations())
        if (s > 0 && s < sections.length) curved.breaks.push_back(s);
    std::sort(curved.breaks.begin(), curved.breaks.end());
    const double tolerance = 1e-9 * sections.length;
    const auto last = std::unique(curved.breaks.begin(), curved.breaks.end(),
                                  [tolerance](double a, double b) { return b - a < tolerance; });
    curved.breaks.erase(last, curved.breaks.end());
    curved.axis = [line](double s) { return line.pose(s); };
    return curved;
}

}  // namespace cardan
