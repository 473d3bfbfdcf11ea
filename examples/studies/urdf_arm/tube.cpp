#include "examples/studies/urdf_arm/tube.hpp"

#include "elements/sections/tube.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace arm {

using namespace cardan;

double Tube::area() const {
    return pi * wall * (outer - wall);
}

double Tube::second() const {
    const double inner = outer - 2 * wall;
    return pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
}

BeamLine Tube::line() const {
    return tube({.length = length,
                 .diameter_base = outer,
                 .diameter_top = outer,
                 .wall_thickness = {wall},
                 .E = E,
                 .G = G,
                 .density = density,
                 .shear_factor = shear_factor},
                "forearm");
}

namespace {

// d/dx (w, theta, M, V) of a Timoshenko beam that vibrates with omega:
//   w' = theta + V/GA,  theta' = M/EI,  M' = -V - omega^2 rho I theta,  V' = -omega^2 rho A w.
// exp(A L) by its series on a small part of the length.
Eigen::Matrix4d transfer_matrix(const Tube& t, double omega) {
    constexpr int halvings = 12, terms = 12;
    const double ww = omega * omega;
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 1) = 1, A(0, 3) = 1 / (t.shear_factor * t.G * t.area());
    A(1, 2) = 1 / (t.E * t.second());
    A(2, 1) = -ww * t.density * t.second(), A(2, 3) = -1;
    A(3, 0) = -ww * t.density * t.area();
    A *= t.length / (1 << halvings);
    Eigen::Matrix4d sum = Eigen::Matrix4d::Identity(), term = sum;
    for (int k = 1; k <= terms; ++k) sum += term = (term * A / k).eval();
    for (int i = 0; i < halvings; ++i) sum = (sum * sum).eval();
    return sum;
}

// At the root w = theta = 0. At the tip M and V move the body: with a = w + c theta at its centre
//   V = omega^2 m a,   M - c V = omega^2 J theta.
double residual(const Tube& t, const TipBody& b, double omega) {
    const Eigen::Matrix<double, 4, 2> tip = transfer_matrix(t, omega).rightCols<2>();
    const double ww = omega * omega;
    Eigen::Matrix2d conditions;
    conditions.row(0) = tip.row(3) - ww * b.mass * (tip.row(0) + b.centre * tip.row(1));
    conditions.row(1) = tip.row(2) - b.centre * tip.row(3) - ww * b.inertia * tip.row(1);
    return conditions.determinant();
}

const Tree::Frame& frame(const Tree& tree, std::string_view name) {
    return entry(tree.frames(), tree.frame(name).index);
}

int own_frame(const Tree& tree, int body) {
    return body < 0 ? 0 : entry(tree.bodies(), body).frame.index;
}

// The frame that a frame was placed on; -1 of the base.
int carrier(const Tree& tree, int index) {
    const Tree::Frame& f = entry(tree.frames(), index);
    if (index == 0) return -1;
    if (index == own_frame(tree, f.body)) return entry(tree.bodies(), f.body).spec.inboard.index;
    return f.parent >= 0 ? f.parent : own_frame(tree, f.body);
}

// The link that an inertia belongs to: the frame with the name of its part, else the body itself.
int link_of(const Tree& tree, const Tree::Piece& piece) {
    for (std::size_t i = 0; i < tree.frames().size(); ++i)
        if (tree.frames()[i].name == piece.part && tree.frames()[i].body == piece.body) return static_cast<int>(i);
    return own_frame(tree, piece.body);
}

void check_ends(const Tree& rigid, const Tube& tube) {
    const Tree::Frame &root = frame(rigid, "forearm_root"), &tip = frame(rigid, "forearm_tip");
    const Placement line = root.in_body.inverse() * tip.in_body;
    if (root.body != tip.body || !(line.p - Vec3(tube.length, 0, 0)).isZero(1e-9) || !line.R.isIdentity(1e-9))
        throw InputError("frame 'forearm_tip'", "place in 'forearm_root'", line.p.transpose(),
                         text(tube.length, " 0 0, with the same axes"));
    if (rigid.frame("forearm_tip").index < rigid.frame("forearm_root").index)
        throw InputError("frame 'forearm_tip': its joint must come after that of 'forearm_root' in the file");
}

}  // namespace

double clamped_frequency(const Tube& tube, const TipBody& body) {
    const double start = residual(tube, body, 0);
    double low = 0, high = 1;
    while (residual(tube, body, high) * start > 0 && high < 1e7) low = high, high *= 1.02;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (residual(tube, body, middle) * start > 0 ? low : high) = middle;
    }
    return low / (2 * pi);
}

FlexibleArm flexible_arm(const Tree& rigid, const Tube& tube, int elements) {
    check_ends(rigid, tube);
    FlexibleArm out;
    const std::vector<Tree::Frame>& frames = rigid.frames();
    std::vector<FrameId> to(frames.size(), Tree::base());
    for (int i = 1; i < static_cast<int>(frames.size()); ++i) {
        const Tree::Frame& f = entry(frames, i);
        FrameId& at = entry(to, i);
        const int on = carrier(rigid, i);
        if (i == own_frame(rigid, f.body)) {
            BodySpec spec = entry(rigid.bodies(), f.body).spec;
            spec.inboard = entry(to, on);
            spec.inertia = {};
            out.drives.push_back(out.tree.add_body(spec));
            at = out.tree.frame_of(out.drives.back());
        } else if (f.name == "forearm_tip") {
            at = out.tree.add_frame(out.beam.tip(), {}, f.name);
        } else {
            at = out.tree.add_frame(entry(to, on), entry(frames, on).in_body.inverse() * f.in_body, f.name);
        }
        if (f.name == "forearm_root")
            out.beam =
                add_cardan_beam(out.tree, out.forces, at, tube.line(), "forearm", {"forearm"}, {.elements = elements});
    }
    for (const Tree::Piece& piece : rigid.pieces()) {
        if (piece.part == "forearm_tube") continue;
        const int link = link_of(rigid, piece);
        const bool own = link == own_frame(rigid, piece.body);
        out.tree.weld(entry(to, link), own ? piece.inertia : piece.inertia.in(entry(frames, link).in_body.inverse()),
                      piece.part);
    }
    return out;
}

RigidInertia carried_by_tip(const Tree& rigid) {
    std::vector<Placement> pose;  // of every body at q = 0
    for (const Tree::Body& body : rigid.bodies())
        pose.push_back(body.parent < 0 ? body.in_parent : entry(pose, body.parent) * body.in_parent);
    const int tip = rigid.frame("forearm_tip").index;
    const Tree::Frame& at = frame(rigid, "forearm_tip");
    const Placement base_in_tip = (entry(pose, at.body) * at.in_body).inverse();
    RigidInertia sum;
    for (const Tree::Piece& piece : rigid.pieces()) {
        int link = link_of(rigid, piece);
        while (link >= 0 && link != tip) link = carrier(rigid, link);
        if (link == tip) sum = sum + piece.inertia.in(base_in_tip * entry(pose, piece.body));
    }
    return sum;
}

RigidInertia tube_in_file(const Tree& rigid) {
    RigidInertia sum;
    for (const Tree::Piece& piece : rigid.pieces())
        if (piece.part == "forearm_tube") sum = sum + piece.inertia.in(frame(rigid, "forearm_tube").in_body.inverse());
    return sum;
}

}  // namespace arm
