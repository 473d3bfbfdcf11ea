#include "turbines/readers/detail/matrix_blade.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"

#include <algorithm>
#include <optional>

namespace cardan::turbines {

namespace {

// Angle about the tangent from the carried axes to BeamDyn's axes without twist; z is the latter's first axis.
double turn(const std::optional<ReferenceLine>& line, double s) {
    if (!line) return 0;
    const Mat3 R = line->pose(s).R;
    const Vec3 z = Vec3(-R(2, 0), 0, R(0, 0)).normalized();
    return std::atan2(-z.dot(R.col(1)), z.dot(R.col(2)));
}

// Both lists, without places of the second that are as good as one of the first.
std::vector<double> merged(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr double tolerance = 1e-6;
    std::vector<double> all = a;
    for (double at : b)
        if (std::none_of(a.begin(), a.end(), [&](double other) { return std::abs(at - other) < tolerance; }))
            all.push_back(at);
    std::sort(all.begin(), all.end());
    return all;
}

void check(const std::string& name, const MatrixBlade& blade, std::size_t twists) {
    if (blade.points.size() < 2) throw InputError(name, "number of points", blade.points.size(), "at least 2");
    check_stations(name + ", stations of the matrices", blade.eta, blade.matrices.size());
    if (blade.eta.front() != 0 || std::abs(blade.eta.back() - 1) > 1e-9)
        throw InputError(name, "stations of the matrices", text(blade.eta.front(), " ... ", blade.eta.back()),
                         "0 ... 1");
    if (blade.twist.size() != twists)
        throw InputError(name, "number of twist angles", blade.twist.size(), text(twists));
}

}  // namespace

double interpolated(const std::vector<double>& places, const std::vector<double>& values, double at) {
    return place_among(places, std::clamp(at, places.front(), places.back())).of(values);
}

BeamTable matrix_blade_table(const std::string& name, const MatrixBlade& blade) {
    check(name, blade, blade.twist_at.empty() ? blade.points.size() : blade.twist_at.size());
    BeamTable table;
    table.name = name;
    std::vector<Vec3> points;
    std::vector<double> s;  // of the points
    for (const Vec3& p : blade.points) {
        points.emplace_back(beamdyn_axes() * p);
        s.push_back(p(2));
    }
    const bool straight =
        std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p(1) == 0 && p(2) == 0; });
    std::optional<ReferenceLine> line;
    if (!straight) {
        table.shape = points.size() < 4 ? LineShape::polyline : LineShape::spline;
        line = ReferenceLine::through(points, table.shape);
        s = line->stations();
        table.points = std::move(points);
    }
    const double length = s.back();
    std::vector<double> eta = blade.eta, twist_at = blade.twist_at;
    eta.back() = 1;
    if (twist_at.empty())
        for (double place : s) twist_at.push_back(place / length);
    check_stations(name + ", twist", twist_at, blade.twist.size());
    for (double at : merged(eta, twist_at)) {
        table.stations.push_back(at * length);
        table.matrices.push_back(rotated(interpolated(blade.matrices, place_among(eta, at)), beamdyn_axes()));
        table.beta.push_back(turn(line, at * length) - interpolated(twist_at, blade.twist, at));
    }
    return table;
}

}  // namespace cardan::turbines
