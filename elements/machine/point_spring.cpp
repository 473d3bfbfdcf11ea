#include "elements/machine/point_spring.hpp"

#include "mbs/base/borrowed.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/path_twists.hpp"
#include "mbs/loops/path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

// The line from a to b at a state.
struct Line {
    Vec3 end, direction;  // of b; from a to it
    double length;
};

Line line_of(const PointSpring& spring, const Kinematics& kin) {
    const Vec3 a = pose(kin, spring.a).p, b = pose(kin, spring.b).p;
    const double length = (b - a).norm();
    return {b, length > 0 ? Vec3((b - a) / length) : Vec3::Zero(), length};
}

// dL/dq of the coordinates between the two bodies, and d(dL/dt)/dq.
struct PathLine {
    std::vector<PathStep> path;
    std::vector<PointTwist<double>> twists;  // signed
    std::vector<double> gradient, rate_gradient;
};

// L_cd = n . (w_c x v_d) + (v_c . v_d - (n . v_c)(n . v_d)) / L for c before d.
double second(const PathLine& at, const Line& line, std::size_t c, std::size_t d) {
    if (line.length == 0) return 0;
    const PointTwist<double>&before = at.twists[std::min(c, d)], &behind = at.twists[std::max(c, d)];
    return line.direction.dot(before.w.cross(behind.v)) +
           (before.v.dot(behind.v) - at.gradient[c] * at.gradient[d]) / line.length;
}

void walk(const PointSpring& spring, const Kinematics& kin, const Line& line, PathLine& out) {
    const Model& model = kin.model();
    path_between(model, model.frame(spring.a).body, model.frame(spring.b).body, out.path);
    out.twists.clear();
    out.gradient.clear();
    for (const PathStep& step : out.path) {
        PointTwist<double> twist = own_twist_at(kin, step.coordinate, line.end);
        twist.w *= step.sign;
        twist.v *= step.sign;
        out.twists.push_back(twist);
        out.gradient.push_back(line.direction.dot(twist.v));
    }
}

double rate(const PathLine& at, const Vector& qd) {
    double sum = 0;
    for (std::size_t c = 0; c < at.path.size(); ++c) sum += at.gradient[c] * qd(at.path[c].coordinate);
    return sum;
}

bool slack(const PointSpring& spring, double length) {
    return spring.cable && length <= spring.length;
}

double tension(const PointSpring& spring, double length, double speed) {
    if (slack(spring, length)) return 0;
    const double T = spring.stiffness * (length - spring.length) + spring.damping * speed;
    return spring.cable ? std::max(T, 0.0) : T;
}

void add_derivatives(const PointSpring& spring, const FieldInput& at, MatrixOut& by_q, MatrixOut& by_qd) {
    const Line line = line_of(spring, at.kinematics);
    if (slack(spring, line.length)) return;
    Borrowed<PathLine> path;
    walk(spring, at.kinematics, line, *path);
    const std::size_t m = path->path.size();
    const double T = tension(spring, line.length, rate(*path, at.qd));
    if (spring.cable && T == 0) return;
    path->rate_gradient.assign(m, 0);
    for (std::size_t c = 0; c < m; ++c)
        for (std::size_t d = 0; d < m; ++d)
            path->rate_gradient[c] += second(*path, line, c, d) * at.qd(path->path[d].coordinate);
    for (std::size_t c = 0; c < m; ++c)
        for (std::size_t d = 0; d < m; ++d) {
            const int i = path->path[c].coordinate, j = path->path[d].coordinate;
            const double g = path->gradient[c];
            by_q(i, j) -= spring.stiffness * g * path->gradient[d] + T * second(*path, line, c, d) +
                          spring.damping * g * path->rate_gradient[d];
            by_qd(i, j) -= spring.damping * g * path->gradient[d];
        }
}

}  // namespace

void add_point_spring(ForceSet& forces, PointSpring spring) {
    const std::string where = text("spring '", spring.name, "'");
    require_not_negative(where, "stiffness [N/m]", spring.stiffness);
    require_not_negative(where, "damping [N s/m]", spring.damping);
    require_not_negative(where, "length [m]", spring.length);
    if (spring.stiffness == 0 && spring.damping == 0)
        throw InputError(where, "stiffness and damping", 0, "one of them > 0");
    if (spring.a == spring.b) throw InputError(where, "frames", "one and the same", "two");
    WrenchField field;
    field.name = spring.name;
    field.points = {{spring.a}, {spring.b}};
    field.elastic = true;
    field.wrenches = [spring](const FieldInput& at, std::span<Wrench> out) {
        const Line line = line_of(spring, at.kinematics);
        double speed = 0;
        if (spring.damping > 0) {
            Borrowed<PathLine> path;
            walk(spring, at.kinematics, line, *path);
            speed = rate(*path, at.qd);
        }
        const Vec3 pull = tension(spring, line.length, speed) * line.direction;
        out[0] = {pull, Vec3::Zero()};
        out[1] = {-pull, Vec3::Zero()};
    };
    field.jacobian = [spring](const FieldInput& at, MatrixOut by_q, MatrixOut by_qd) {
        add_derivatives(spring, at, by_q, by_qd);
    };
    field.energy = [spring](const FieldInput& at) {
        const double length = line_of(spring, at.kinematics).length;
        return slack(spring, length) ? 0 : spring.stiffness * std::pow(length - spring.length, 2) / 2;
    };
    forces.add_field(std::move(field));
}

}  // namespace cardan
