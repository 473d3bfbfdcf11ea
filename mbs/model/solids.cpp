#include "mbs/model/solids.hpp"

#include "mbs/base/error.hpp"

#include <initializer_list>

namespace cardan {

namespace {

void check(const char* solid, double mass, std::initializer_list<double> lengths, const Vec3& place) {
    require_not_negative(solid, "mass [kg]", mass);
    for (const double length : lengths) require_not_negative(solid, "length [m]", length);
    if (!place.allFinite()) throw InputError(solid, "place [m]", place.transpose(), "finite");
}

// A body of revolution by its moments of inertia about its axis and across it, both for a mass of 1 and without what
// its length adds.
RigidInertia turned_solid(const char* solid, double mass, double radius, const Vec3& from, const Vec3& to, double along,
                          double across) {
    check(solid, mass, {radius}, from);
    check(solid, mass, {}, to);
    const Vec3 way = to - from;
    const double length = way.norm();
    if (!(length > 0)) throw InputError(solid, "distance of the ends [m]", length, "> 0");
    const Vec3 axis = way / length;
    const double whole = across + length * length / 12;
    return {mass, (from + to) / 2, mass * (whole * Mat3::Identity() + (along - whole) * axis * axis.transpose())};
}

}  // namespace

RigidInertia slender_bar(double mass, const Vec3& from, const Vec3& to) {
    check("slender bar", mass, {}, from);
    check("slender bar", mass, {}, to);
    const Vec3 way = to - from;
    return {mass, (from + to) / 2, mass / 12 * (way.squaredNorm() * Mat3::Identity() - way * way.transpose())};
}

RigidInertia solid_box(double mass, const Vec3& sides, const Vec3& centre) {
    check("solid box", mass, {sides.x(), sides.y(), sides.z()}, centre);
    const Vec3 squares = sides.cwiseAbs2();
    return {mass, centre, (mass / 12 * (Vec3::Constant(squares.sum()) - squares)).asDiagonal().toDenseMatrix()};
}

RigidInertia solid_cylinder(double mass, double radius, const Vec3& from, const Vec3& to) {
    const double square = radius * radius;
    return turned_solid("solid cylinder", mass, radius, from, to, square / 2, square / 4);
}

RigidInertia thin_tube(double mass, double radius, const Vec3& from, const Vec3& to) {
    const double square = radius * radius;
    return turned_solid("thin tube", mass, radius, from, to, square, square / 2);
}

RigidInertia solid_sphere(double mass, double radius, const Vec3& centre) {
    check("solid sphere", mass, {radius}, centre);
    return {mass, centre, 0.4 * mass * radius * radius * Mat3::Identity()};
}

}  // namespace cardan
