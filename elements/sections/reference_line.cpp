#include "elements/sections/reference_line.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"

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

// Slopes of the cubic spline with continuous curvature; the two pieces at either end are one cubic (not-a-knot), so
// that the ends are as exact as the rest, O(h^4). [de Boor, A Practical Guide to Splines, ch. IV]
std::vector<Vec3> spline_slopes(const std::vector<double>& t, const std::vector<Vec3>& points) {
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
    const Matrix slopes = A.partialPivLu().solve(b);
    std::vector<Vec3> out;
    for (Eigen::Index i = 0; i < n; ++i) out.emplace_back(slopes.row(i).transpose());
    return out;
}

}  // namespace

// A spline's pieces are cubic Hermite polynomials, with values and slopes at the knots.
Vec3 ReferenceLine::position(double t) const {
    if (own_position_) return own_position_(t);
    const auto [left, right, part] = place_among(knots_, t);
    const Vec3 &a = points_[left], &b = points_[right];
    const double h = knots_[right] - knots_[left], from = t - knots_[left];
    if (slopes_.empty()) return a + (b - a) * from / h;
    const double rest = 1 - part;
    return rest * rest * (a * (1 + 2 * part) + slopes_[left] * from) +
           part * part * (b * (3 - 2 * part) + h * slopes_[right] * (part - 1));
}

Vec3 ReferenceLine::derivative(double t) const {
    if (own_derivative_) return own_derivative_(t);
    const auto [left, right, part] = place_among(knots_, t);
    const Vec3 &a = points_[left], &b = points_[right];
    const double h = knots_[right] - knots_[left], from = t - knots_[left];
    if (slopes_.empty()) return (b - a) / h;
    if (t >= knots_.back()) return slopes_.back();
    const Vec3 first = (b - a - slopes_[left] * h) / (h * h), second = (slopes_[right] - slopes_[left]) / (2 * h);
    return slopes_[left] + 2 * (3 * first - 2 * second) * from + 3 * (2 * (second - first) / h) * from * from;
}

double ReferenceLine::arc(double from, double to) const {
    return integrate(from, to, {}, 0.0, [&](double t) { return derivative(t).norm(); });
}

void ReferenceLine::divide(const std::vector<double>& knots, int cells_per_piece) {
    const Vec3 start = derivative(knots.front()).normalized();
    Cell cell{knots.front(), 0, shortest_rotation(Vec3::UnitX(), start, "reference line, start")};
    cells_.push_back(cell);
    stations_.push_back(0);
    for (std::size_t k = 1; k < knots.size(); ++k) {
        for (int i = 1; i <= cells_per_piece; ++i) {
            const double t = knots[k - 1] + (knots[k] - knots[k - 1]) * i / cells_per_piece;
            const Vec3 tangent = derivative(t).normalized(), step = position(t) - position(cell.t);
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
        t -= miss / derivative(t).norm();
        if (std::abs(miss) < 1e-14 * length()) break;
    }
    const Vec3 p = position(t);
    return {carried(a.R, p - position(a.t), derivative(t).normalized()), p};
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
    line.own_position_ = std::move(position);
    line.own_derivative_ = std::move(derivative);
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
    line.knots_ = knots;
    line.points_ = points;
    if (shape == LineShape::spline) {
        line.slopes_ = spline_slopes(knots, points);
        line.divide(knots, 16);
        return line;
    }
    // Arc length is the parameter; one cell per piece, with the frame turned at the kinks by the shortest way.
    line.stations_ = knots;
    Mat3 R = Mat3::Identity();
    for (std::size_t j = 0; j < points.size(); ++j) {
        const Vec3 tangent = line.derivative(knots[j]);
        R = shortest_rotation(R.col(0), tangent, text("reference line, point ", j + 1)) * R;
        line.cells_.push_back({knots[j], knots[j], R});
    }
    return line;
}

ReferenceLine ReferenceLine::scaled(double factor) const {
    ReferenceLine line = *this;
    if (own_position_) {
        line.own_position_ = [own = own_position_, factor](double t) { return Vec3(factor * own(t)); };
        line.own_derivative_ = [own = own_derivative_, factor](double t) { return Vec3(factor * own(t)); };
    }
    for (Vec3& p : line.points_) p *= factor;
    for (double& t : line.knots_) t *= factor;
    for (double& s : line.stations_) s *= factor;
    for (Cell& cell : line.cells_) {
        cell.s *= factor;
        if (!own_position_) cell.t *= factor;
    }
    return line;
}

}  // namespace cardan
