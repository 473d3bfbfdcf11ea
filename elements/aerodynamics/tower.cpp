#include "elements/aerodynamics/tower.hpp"

#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan {

namespace {

constexpr double bak_shift = 0.1;  // of the radius, downwind

// The place as the flow around the cylinder takes it, and the strength of the source.
struct DamFlow {
    Vec3 place;
    double wind, source;  // |n|; C_d / (2 pi)
};
DamFlow dam_flow(TowerDam dam, const Vec3& wind, const Vec3& place, double drag) {
    const double w = wind.norm();
    if (dam != TowerDam::bak || w == 0) return {place, w, 0};
    return {place + bak_shift / w * wind, w, drag / (2 * pi)};
}

void require_finite(const char* where, const char* quantity, const Vec3& values) {
    for (const double value : values)
        if (!std::isfinite(value)) throw InputError(where, quantity, value, "finite");
}

}  // namespace

void AeroTower::check() const {
    constexpr const char* here = "air on the tower";
    const std::size_t rows = height.size();
    for (const auto& [name, size] :
         {std::pair("number of diameters", diameter.size()), {"number of drags", drag.size()}})
        if (size != rows) throw InputError(here, name, size, text(rows, ", that of the heights"));
    if (rows == 1) throw InputError(here, "number of rows", rows, "at least 2, or none");
    if (rows == 0 && dam != TowerDam::none) throw InputError(here, "number of rows", rows, "at least 2 for a dam");
    if (!std::isfinite(foot)) throw InputError(here, "height of the foot [m]", foot, "finite");
    for (std::size_t i = 0; i < rows; ++i) {
        const std::string row = text(here, ", row ", i + 1);
        if (!std::isfinite(height[i]) || (i > 0 && !(height[i] > height[i - 1])))
            throw InputError(row, "height [m]", height[i], "finite, ascending");
        require_positive(row, "diameter [m]", diameter[i]);
        require_not_negative(row, "drag coefficient", drag[i]);
    }
}

void AeroNacelle::check() const {
    constexpr const char* here = "air on the nacelle";
    for (int i = 0; i < 3; ++i) {
        require_not_negative(here, "area [m^2]", area(i));
        require_not_negative(here, "drag coefficient", drag(i));
    }
    require_finite(here, "centre of the drag [m]", centre);
}

Vec3 tower_dam(TowerDam dam, const Vec3& wind, const Vec3& place, double drag) {
    if (dam == TowerDam::none) return Vec3::Zero();
    const DamFlow flow = dam_flow(dam, wind, place, drag);
    const Vec3& x = flow.place;
    const double s = x.squaredNorm();
    return wind / s + (flow.source * flow.wind / s - 2 * wind.dot(x) / (s * s)) * x;
}

// With s = x^2, m = n . x, a = n/w, k = C_d/(2 pi), for fixed x and fixed n:
//
//     d/dn = I/s - 2 x x'/s^2 + k x a'/s,
//     d/dx = -2 (n x' + x n' + m I)/s^2 + 8 m x x'/s^3 + k w (I/s - 2 x x'/s^2),
//
// and x changes with n by 0.1 (I - a a')/w.
TowerDamSlopes tower_dam_slopes(TowerDam dam, const Vec3& wind, const Vec3& place, double drag) {
    TowerDamSlopes out{Mat3::Zero(), Mat3::Zero(), Vec3::Zero()};
    if (dam == TowerDam::none) return out;
    const DamFlow flow = dam_flow(dam, wind, place, drag);
    const Vec3& x = flow.place;
    const double s = x.squaredNorm(), m = wind.dot(x), w = flow.wind;
    const Mat3 one = Mat3::Identity(), xx = x * x.transpose(), reflected = one / s - 2 / (s * s) * xx;
    out.by_wind = reflected;
    out.by_place = -2 / (s * s) * (wind * x.transpose() + x * wind.transpose() + m * one) + 8 * m / (s * s * s) * xx +
                   flow.source * w * reflected;
    if (dam != TowerDam::bak || w == 0) return out;
    const Vec3 a = wind / w;
    out.by_wind += flow.source / s * x * a.transpose() + bak_shift / w * out.by_place * (one - a * a.transpose());
    out.by_drag = w / (2 * pi * s) * x;
    return out;
}

}  // namespace cardan
