#include "elements/aerodynamics/tower.hpp"

#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan {

namespace {

constexpr double bak_shift = 0.1;  // of the radius, downwind

// The place as the flow around the cylinder takes it, and the strength of the source.
struct CylinderFlow {
    Vec3 place;
    double wind, source;  // |n|; C_d / (2 pi)
};
CylinderFlow cylinder_flow(TowerInfluence influence, const Vec3& wind, const Vec3& place, double drag) {
    const double w = wind.norm();
    if (influence != TowerInfluence::bak || w == 0) return {place, w, 0};
    return {place + bak_shift / w * wind, w, drag / (2 * pi)};
}

constexpr double largest_deficit = 0.5;  // of the wind [AeroDyn]

// A place in the wake: along the wind and, not negative, across, directions of both.
struct WakePlace {
    double x = 0, y = 0;
    Vec3 along = Vec3::Zero(), across = Vec3::Zero();

    WakePlace(const Vec3& wind, const Vec3& place) {
        const double w = wind.norm();
        if (w == 0) return;
        along = wind / w;
        x = place.dot(along);
        across = place - x * along;
        y = across.norm();
        if (y > 0) across /= y;
    }
};

// D, and its derivatives.
struct WakeDeficit {
    double value = 0, by_x = 0, by_y = 0, by_drag = 0, by_turbulence = 0;
};

// With r' = (x, y)/r, a = pi y/(2 sqrt(r)): da = a dy/y - a/2 dr/r.
WakeDeficit powles_deficit(double x, double y, double drag) {
    const double r = std::hypot(x, y), width = std::sqrt(r);
    if (!(y < width)) return {};
    const double a = pi / 2 * y / width, c = std::cos(a), by_a = -2 * drag / width * c * std::sin(a),
                 value = drag / width * c * c, by_r = -(value + by_a * a) / (2 * r);
    return {value, by_r * x / r, by_r * y / r + by_a * pi / (2 * width), c * c / width, 0};
}

// Of Gauss, sigma = I x: d(D sigma)/D = (y/sigma)^2 d(sigma)/sigma - y dy/sigma^2.
WakeDeficit eames_deficit(double x, double y, double drag, double turbulence) {
    const double sigma = turbulence * x, q = y / sigma, bell = std::exp(-q * q / 2);
    if (!(bell > 0)) return {};
    const double by_drag = bell / (std::sqrt(2 * pi) * sigma), value = drag * by_drag,
                 by_sigma = value * (q * q - 1) / sigma;
    return {value, by_sigma * turbulence, -value * q / sigma, by_drag, by_sigma * x};
}

WakeDeficit wake_deficit(TowerShadow shadow, const WakePlace& at, double drag, double turbulence) {
    if (!(at.x > 0)) return {};
    const WakeDeficit out =
        shadow == TowerShadow::powles ? powles_deficit(at.x, at.y, drag) : eames_deficit(at.x, at.y, drag, turbulence);
    if (out.value >= largest_deficit) return {.value = largest_deficit};
    return out;
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
    if ((shadow == TowerShadow::eames || !turbulence.empty()) && turbulence.size() != rows)
        throw InputError(here, "number of turbulence intensities", turbulence.size(),
                         text(rows, ", that of the heights"));
    if (rows == 1) throw InputError(here, "number of rows", rows, "at least 2, or none");
    if (rows == 0 && asks_for_influence())
        throw InputError(here, "number of rows", rows, "at least 2 for the tower's influence on the wind");
    if (!std::isfinite(foot)) throw InputError(here, "height of the foot [m]", foot, "finite");
    for (std::size_t i = 0; i < rows; ++i) {
        const std::string row = text(here, ", row ", i + 1);
        if (!std::isfinite(height[i]) || (i > 0 && !(height[i] > height[i - 1])))
            throw InputError(row, "height [m]", height[i], "finite, ascending");
        require_positive(row, "diameter [m]", diameter[i]);
        require_not_negative(row, "drag coefficient", drag[i]);
        if (!turbulence.empty() && !(turbulence[i] > 0 && turbulence[i] < 1))
            throw InputError(row, "turbulence intensity", turbulence[i], "more than 0, less than 1");
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

Vec3 tower_influence(TowerInfluence influence, const Vec3& wind, const Vec3& place, double drag) {
    if (influence == TowerInfluence::none) return Vec3::Zero();
    const CylinderFlow flow = cylinder_flow(influence, wind, place, drag);
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
TowerInfluenceSlopes tower_influence_slopes(TowerInfluence influence, const Vec3& wind, const Vec3& place,
                                            double drag) {
    TowerInfluenceSlopes out;
    if (influence == TowerInfluence::none) return out;
    const CylinderFlow flow = cylinder_flow(influence, wind, place, drag);
    const Vec3& x = flow.place;
    const double s = x.squaredNorm(), m = wind.dot(x), w = flow.wind;
    const Mat3 one = Mat3::Identity(), xx = x * x.transpose(), reflected = one / s - 2 / (s * s) * xx;
    out.by_wind = reflected;
    out.by_place = -2 / (s * s) * (wind * x.transpose() + x * wind.transpose() + m * one) + 8 * m / (s * s * s) * xx +
                   flow.source * w * reflected;
    if (influence != TowerInfluence::bak || w == 0) return out;
    const Vec3 a = wind / w;
    out.by_wind += flow.source / s * x * a.transpose() + bak_shift / w * out.by_place * (one - a * a.transpose());
    out.by_drag = w / (2 * pi * s) * x;
    return out;
}

Vec3 tower_shadow(TowerShadow shadow, const Vec3& wind, const Vec3& place, double drag, double turbulence) {
    if (shadow == TowerShadow::none) return Vec3::Zero();
    return -wake_deficit(shadow, WakePlace(wind, place), drag, turbulence).value * wind;
}

// With the directions t along the wind and e across, n = w t, X = x t + y e:
//
//     dx = t . dX + y e . dn/w,    dy = e . dX - x e . dn/w.
TowerInfluenceSlopes tower_shadow_slopes(TowerShadow shadow, const Vec3& wind, const Vec3& place, double drag,
                                         double turbulence) {
    TowerInfluenceSlopes out;
    if (shadow == TowerShadow::none) return out;
    const WakePlace at(wind, place);
    const WakeDeficit D = wake_deficit(shadow, at, drag, turbulence);
    out.by_wind = -D.value * Mat3::Identity() - (D.by_x * at.y - D.by_y * at.x) * at.along * at.across.transpose();
    out.by_place = -wind * (D.by_x * at.along + D.by_y * at.across).transpose();
    out.by_drag = -D.by_drag * wind;
    out.by_turbulence = -D.by_turbulence * wind;
    return out;
}

TowerInfluenceSlopes& TowerInfluenceSlopes::operator+=(const TowerInfluenceSlopes& other) {
    by_wind += other.by_wind;
    by_place += other.by_place;
    by_drag += other.by_drag;
    by_turbulence += other.by_turbulence;
    return *this;
}

}  // namespace cardan
