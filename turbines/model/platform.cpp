#include "turbines/model/platform.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/summary.hpp"
#include "mbs/system/system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr std::array coordinate_names{"surge", "sway", "heave", "roll", "pitch", "yaw"};

// Rows and columns over the roots of the diagonal: entries of translations and rotations differ by many decades.
Matrix to_unit_diagonal(const Matrix& A) {
    const Vector scale = A.diagonal().unaryExpr([](double d) { return d != 0 ? 1 / std::sqrt(std::abs(d)) : 1.0; });
    return scale.asDiagonal() * A * scale.asDiagonal();
}

double lowest_scaled_eigenvalue(const Matrix& A) {
    return Eigen::SelfAdjointEigenSolver<Matrix>(to_unit_diagonal(A), Eigen::EigenvaluesOnly).eigenvalues()(0);
}

void require_symmetric(const std::string& where, const char* quantity, const Mat6& A) {
    if (!A.allFinite()) throw InputError(where, quantity, text("\n", A, "\n"), "finite");
    const Matrix unit = to_unit_diagonal(A);
    Eigen::Index i = 0, j = 0;
    if ((unit - unit.transpose()).cwiseAbs().maxCoeff(&i, &j) <= 1e-9 * std::max(1.0, unit.cwiseAbs().maxCoeff()))
        return;
    if (i > j) std::swap(i, j);
    throw InputError(where,
                     text(quantity, ", ", coordinate_names.at(static_cast<std::size_t>(i)), " by ",
                          coordinate_names.at(static_cast<std::size_t>(j))),
                     A(i, j), text("symmetric; the opposite entry is ", A(j, i)));
}

void require_semidefinite(const std::string& where, const char* quantity, const Mat6& A) {
    require_symmetric(where, quantity, A);
    for (std::size_t i = 0; i < coordinate_names.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        if (A(k, k) < 0) throw InputError(where, text(quantity, ", ", coordinate_names.at(i)), A(k, k), ">= 0");
    }
    const double lowest = lowest_scaled_eigenvalue(A);
    if (lowest < -1e-9)
        throw InputError(where, text("lowest eigenvalue (unit diagonal) of the ", quantity), lowest, ">= 0");
}

// A = sum d l l^T with l(k) = 1: as many armatures as A has ranks, each over the coordinates that it couples.
void add_added_mass(Tree& tree, const MovingBase& base, Mat6 A) {
    const Vec6 size = A.diagonal();
    for (Eigen::Index k = 0; k < 6; ++k) {
        const double d = A(k, k);
        if (d <= 1e-12 * size(k)) continue;
        Armature armature;
        armature.name = text("added mass ", coordinate_names.at(static_cast<std::size_t>(k)));
        armature.inertia = d;
        const Vec6 column = A.col(k);
        for (Eigen::Index i = k; i < 6; ++i)
            if (column(i) != 0)
                armature.spin.emplace_back(base.coordinates.at(static_cast<std::size_t>(i)), column(i) / d);
        tree.add_armature(armature);
        A -= column * column.transpose() / d;
    }
}

std::vector<Eigen::Index> free_coordinates(const Tree& tree, const MovingBase& base) {
    std::vector<Eigen::Index> free;
    for (std::size_t i = 0; i < 6; ++i) {
        const auto body = static_cast<std::size_t>(base.coordinates.at(i).index);
        if (tree.bodies()[body].spec.coordinate.role == CoordinateRole::free)
            free.push_back(static_cast<Eigen::Index>(i));
    }
    return free;
}

// Of weights and dead loads with everything where it is undisplaced.
Mat6 stiffness_of_constant_forces(const ForceSet& forces, const Tree& tree, const MovingBase& base) {
    ForceSet constant;
    constant.set_gravity(forces.gravity());
    for (const FrameLoad& load : forces.loads()) constant.add_wrench(load);
    const System system(tree, constant);
    const DynamicState still = at_rest(system.model.size());
    Workspace workspace(system.model);
    ForceDerivatives derivatives;
    system.forces.derivatives({still, kinematics(system.model, still.q, workspace)}, derivatives);
    std::vector<int> at;
    for (const BodyId body : base.coordinates) at.push_back(system.model.index(body));
    const Matrix K = derivatives.gravity(at, at) + derivatives.loads(at, at);
    const double rounding = 1e-12 * K.cwiseAbs().maxCoeff();
    return ((K + K.transpose()) / 2).unaryExpr([&](double k) { return std::abs(k) > rounding ? k : 0.0; });
}

// Q = -K x; not elastic.
ForceElement linear_load(std::string name, const MovingBase& base, const Mat6& K) {
    ForceElement load{.name = std::move(name)};
    load.coordinates.assign(base.coordinates.begin(), base.coordinates.end());
    load.evaluate = [K](const ElementView& in, ElementForces& out) { out.Q = -K * in.q; };
    load.jacobian = [K](const ElementView&, ElementJacobian& d) { d.Q_q = -K; };
    load.potential = [K](const ElementView& in) { return in.q.dot(K * in.q) / 2; };
    return load;
}

void tell_balance(const ForceSet& forces, const Tree& tree, const PlatformDescription& platform,
                  std::vector<std::string>& warnings) {
    double mass = 0;
    for (const PartMass& part : masses_by_part(tree)) mass += part.mass;
    const double weight = -mass * forces.gravity().z(), lift = platform.buoyancy + platform.mooring_preload.z();
    if (lift == 0 || std::abs(lift - weight) <= 0.01 * std::max(std::abs(weight), std::abs(lift))) return;
    warnings.push_back(text(platform.name, ": a weight of ", weight, " N on a lift of ", lift,
                            " N (buoyancy and mooring lines): it heaves until the stiffness carries the rest"));
}

void add_dead_load(ForceSet& forces, Tree& tree, const MovingBase& base, const std::string& name, const Vec3& at,
                   const Vec3& force) {
    if (force.isZero(0)) return;
    const FrameId frame = at.isZero(0) ? base.frame : tree.add_frame(base.frame, Placement::translation(at), name);
    forces.add_wrench({name, frame, {force, Vec3::Zero()}, WrenchAxes::base});
}

}  // namespace

void PlatformDescription::check(const std::string& machine) const {
    const std::string where = machine.empty() ? name : text(machine, ", ", name);
    inertia.check(where);
    const auto finite = [&](const char* quantity, const Vec3& v) {
        if (!v.allFinite()) throw InputError(where, quantity, text(v.transpose()), "finite");
    };
    finite("foot of the tower [m]", tower_base);
    finite("centre of buoyancy [m]", buoyancy_centre);
    finite("pull of the mooring lines [N]", mooring_preload);
    require_not_negative(where, "buoyancy [N]", buoyancy);
    require_semidefinite(where, "added mass", added_mass);
    require_semidefinite(where, "damping", damping);
    require_symmetric(where, "hydrostatic stiffness", hydrostatic_stiffness);
    require_symmetric(where, "stiffness of the mooring", mooring_stiffness);
    coordinates.check(where);
}

PlatformFrames add_platform(Tree& tree, const PlatformDescription& platform) {
    platform.check();
    const MovingBase base = add_moving_base(tree, Tree::base(), "platform", platform.coordinates);
    PlatformFrames frames{base, base.frame, {base.frame}};
    const auto at = [&](const Vec3& p, const char* name) {
        return tree.add_frame(base.frame, Placement::translation(p), name);
    };
    if (!platform.inertia.is_massless()) tree.weld(base.frame, platform.inertia, "platform");
    if (!platform.inertia.com.isZero(0))
        frames.line.insert(frames.line.begin(), at(platform.inertia.com, "platform mass centre"));
    if (!platform.tower_base.isZero(0)) {
        frames.tower_base = at(platform.tower_base, "platform top");
        frames.line.push_back(frames.tower_base);
    }
    add_added_mass(tree, base, platform.added_mass);
    return frames;
}

void add_water_forces(ForceSet& forces, Tree& tree, const MovingBase& base, const PlatformDescription& platform,
                      std::vector<std::string>& warnings) {
    add_dead_load(forces, tree, base, "buoyancy", platform.buoyancy_centre, {0, 0, platform.buoyancy});
    add_dead_load(forces, tree, base, "mooring pull", Vec3::Zero(), platform.mooring_preload);
    const std::vector<BodyId> all(base.coordinates.begin(), base.coordinates.end());
    if (!platform.damping.isZero(0)) forces.add_law({"platform damping", all, Mat6::Zero(), platform.damping});
    tell_balance(forces, tree, platform, warnings);

    const Mat6 water = platform.hydrostatic_stiffness + platform.mooring_stiffness;
    if (water.isZero(0) && platform.buoyancy == 0) return;
    const std::vector<Eigen::Index> free = free_coordinates(tree, base);
    Mat6 elastic = Mat6::Zero();
    if (!free.empty()) {
        const Mat6 whole = water + stiffness_of_constant_forces(forces, tree, base);
        const Matrix K = whole(free, free);
        if (const double lowest = lowest_scaled_eigenvalue(K); lowest < -1e-9)
            throw InputError(platform.name,
                             "lowest eigenvalue (unit diagonal) of the stiffness with water, mooring, weights", lowest,
                             ">= 0, or it capsizes; weights are there only if gravity is set");
        elastic(free, free) = K;
        std::vector<BodyId> bodies;
        bodies.reserve(free.size());
        for (const Eigen::Index i : free) bodies.push_back(base.coordinates.at(static_cast<std::size_t>(i)));
        forces.add_law({"platform stiffness", bodies, K});
    }
    if (const Mat6 rest = water - elastic; !rest.isZero(0))
        forces.add_element(linear_load("platform, weights and buoyancy in that stiffness", base, rest));
}

namespace {

// Integral of z^power times the area of the cross-section over the depth, z = -depth; exact (three Gauss points).
double area_moment(std::span<const HullStation> hull, int power) {
    const double root = std::sqrt(0.6);
    const std::array<std::pair<double, double>, 3> points{{{-root, 5.0 / 18}, {0, 8.0 / 18}, {root, 5.0 / 18}}};
    double sum = 0;
    for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
        const HullStation &a = hull[i], &b = hull[i + 1];
        for (const auto& [x, weight] : points) {
            const double t = (1 + x) / 2, diameter = a.diameter + t * (b.diameter - a.diameter),
                         z = -(a.depth + t * (b.depth - a.depth));
            sum += weight * (b.depth - a.depth) * std::pow(z, power) * pi / 4 * diameter * diameter;
        }
    }
    return sum;
}

void check_hull(std::span<const HullStation> hull) {
    if (hull.size() < 2) throw InputError("hull", "number of stations", hull.size(), ">= 2");
    for (std::size_t i = 0; i < hull.size(); ++i) {
        require_not_negative("hull", text("depth of station ", i + 1, " [m]"), hull[i].depth);
        require_not_negative("hull", text("diameter of station ", i + 1, " [m]"), hull[i].diameter);
        if (i > 0 && !(hull[i].depth > hull[i - 1].depth))
            throw InputError("hull", text("depth of station ", i + 1, " [m]"), hull[i].depth, "rising");
    }
}

}  // namespace

double displaced_volume(std::span<const HullStation> hull) {
    check_hull(hull);
    return area_moment(hull, 0);
}

Mat6 strip_theory_added_mass(std::span<const HullStation> hull, double coefficient, double end_coefficient,
                             double density) {
    check_hull(hull);
    require_not_negative("hull", "coefficient of added mass", coefficient);
    require_not_negative("hull", "coefficient of added mass of the end", end_coefficient);
    require_not_negative("hull", "density of the water [kg/m^3]", density);
    const double a = density * coefficient, moment = a * area_moment(hull, 1), second = a * area_moment(hull, 2);
    Mat6 A = Mat6::Zero();
    A(0, 0) = A(1, 1) = a * area_moment(hull, 0);
    A(2, 2) = density * end_coefficient * pi / 12 * std::pow(hull.back().diameter, 3);
    A(0, 4) = A(4, 0) = moment;
    A(1, 3) = A(3, 1) = -moment;
    A(3, 3) = A(4, 4) = second;
    return A;
}

}  // namespace cardan::turbines
