#include "examples/studies/machines/teetered_mixed.hpp"

#include "elements/machine_elements/joints.hpp"
#include "mbs/base/error.hpp"

#include <array>

namespace cardan::turbines {

namespace {

using Eigen::Index;

MixedBeam mixed(const BeamLine& line, int elements) {
    if (elements > 1000) throw InputError(line.name, "number of elements", elements, "1 ... 1000");
    return {line, elements};
}

// What this model has not: a platform, elastic drive train and main frame, pitch joints, blades that differ, damping of
// beams.
void check(const TurbineDescription& d) {
    d.check();
    const auto require = [&d](const char* what, bool as_here, const char* allowed) {
        if (!as_here) throw InputError(d.name, what, "otherwise", allowed);
    };
    require("platform", !d.platform, "none");
    require("number of blades", d.blades == 2 && d.individual_blades.empty(), "2, equal ones");
    const auto turns = [](const JointSupport& bearing) {
        return bearing.kind == JointSupport::Kind::free || bearing.kind == JointSupport::Kind::spring;
    };
    require("hub", d.hub.teeter && turns(d.hub.teeter->bearing), "with a teeter bearing, free or with a spring");
    require("yaw bearing", turns(d.yaw.rotation), "free or with a spring");
    require("drive train", d.drive_train.main_shaft.is_rigid() && d.drive_train.high_speed_shaft.is_rigid(), "rigid");
    require("pitch joints", d.blade.pitch.is_rigid() && d.blade.pitch_setting == 0, "none, pitch 0");
    require("nacelle", d.yaw.translation.is_rigid() && d.nacelle.tilt_bearing.is_rigid(), "turning in yaw alone");
}

// Rotation by an angle about a unit vector.
template <class S>
Mat3T<S> turn(const Vec3T<S>& axis, S angle) {
    const Mat3T<S> w = skew<S>(axis);
    return Mat3T<S>::Identity() + std::sin(angle) * w + (S(1) - std::cos(angle)) * w * w;
}

// Pose of a frame in its carrier; rotation: components in the frame to components in the carrier.
template <class S>
struct Seat {
    Mat3T<S> R;
    Vec3T<S> p;

    // (velocity of the origin, angular velocity) of a frame fixed to the carrier, in its own axes.
    Vec6T<S> carried(const Vec6T<S>& carrier) const {
        const Vec3T<S> v = carrier.template head<3>(), w = carrier.template tail<3>();
        Vec6T<S> own;
        own << R.transpose() * (v + cross<S>(w, p)), R.transpose() * w;
        return own;
    }
    // (force, moment about the frame's origin) as it acts on the carrier, in its axes and about its origin.
    Vec6T<S> handed_on(const Vec6T<S>& wrench) const {
        const Vec3T<S> force = R * wrench.template head<3>();
        Vec6T<S> on_carrier;
        on_carrier << force, R * wrench.template tail<3>() + cross<S>(p, force);
        return on_carrier;
    }
};

template <class S>
Seat<S> seat(const Placement& at) {
    return {at.R.cast<S>(), at.p.cast<S>()};
}

Mat6 momentum(const RigidInertia& body) {
    return momentum_matrix(body.mass, body.com, body.J);
}

}  // namespace

// Where nacelle, shaft and hub sit on what carries them, tower top axes first.
template <class S>
struct TeeteredMixed::Rotor {
    Seat<S> on_tower, on_nacelle, on_shaft;
    Vec3T<S> teeter_axis;  // hub axes

    Rotor(const TurbineDescription& d, S yaw, S teeter, double azimuth)
        : on_tower{turn<S>(Vec3T<S>::UnitZ(), yaw), Vec3T<S>::Zero()},
          on_nacelle(seat<S>({rot_y(d.nacelle.tilt) * rot_x(azimuth), {0, 0, d.nacelle.shaft_height}})),
          on_shaft(seat<S>({hub_axes(), {-d.nacelle.overhang, 0, 0}})),
          teeter_axis((rot_z(-d.hub.teeter->delta3) * Vec3::UnitY()).cast<S>()) {
        on_shaft.R = (on_shaft.R * turn<S>(teeter_axis, teeter)).eval();
    }
};

TeeteredMixed::TeeteredMixed(const TurbineDescription& description, int tower_elements, int blade_elements)
    : d_(description), blade_(mixed(description.blade.line, blade_elements)), tower_size_(0) {
    check(d_);
    (void)assemble(d_, teetered_paper_assembly(1));  // checks masses and springs
    if (!d_.tower.rigid) {
        tower_ = mixed(d_.tower.line, tower_elements);
        tower_size_ = tower_->unknowns();
    }
    const Placement root = blade_root(1);
    MixedSetting setting;
    setting.omega = root.R.transpose() * Vec3(0, 0, d_.rotor_speed);
    setting.root_position = root.R.transpose() * root.p;
    const Vector blade = mixed_steady_state(blade_, setting).x;
    steady_ = Vector::Zero(unknowns());
    for (int k : {1, 2}) steady_.segment(blade_unknowns(k), blade.size()) = blade;
    steady_(body_unknowns(shaft) + 3) = d_.rotor_speed;
    steady_(body_unknowns(hub) + 5) = d_.rotor_speed;
}

Placement TeeteredMixed::blade_root(int number) const {
    return Placement::translation({0, 0, -d_.hub.teeter->undersling}) *
           Placement::rotation(rot_z(pi * (number - 1)) * rot_y(-d_.blade.cone)) *
           Placement::translation({d_.hub.radius, 0, 0});
}

// From the tower top out the velocities, from the tips in the forces: `reaction` is what a body needs from its carrier,
// in its own axes, at its origin.
template <class S>
VectorT<S> TeeteredMixed::residual(const VectorT<S>& x, const VectorT<S>& xdot, double azimuth) const {
    VectorT<S> r = VectorT<S>::Zero(unknowns());
    const auto six = [](const VectorT<S>& v, Index first) { return Vec6T<S>(v.template segment<6>(first)); };
    const auto inertia_of = [&](const RigidInertia& body, int number) {
        return inertial_load<S>(momentum(body), six(x, body_unknowns(number)), six(xdot, body_unknowns(number)),
                                Vec3T<S>::Zero());
    };
    const Rotor<S> rotor(d_, x(yaw()), x(teeter()), azimuth);

    // The frame "tower top" on the end section of the tower: ground axes where the tower is straight.
    const Seat<S> upright{axis_rotation(Axis::y).transpose().cast<S>(), Vec3T<S>::Zero()};
    const Vec6T<S> top = tower_ ? upright.carried(six(x, tower_->tip() + MixedField::V)) : Vec6T<S>(Vec6T<S>::Zero());
    Vec6T<S> nacelle_motion = rotor.on_tower.carried(top);
    nacelle_motion(5) += xdot(yaw());
    Vec6T<S> shaft_motion = rotor.on_nacelle.carried(six(x, body_unknowns(nacelle)));
    shaft_motion(3) += d_.rotor_speed;
    Vec6T<S> hub_motion = rotor.on_shaft.carried(six(x, body_unknowns(shaft)));
    hub_motion.template tail<3>() += rotor.teeter_axis * xdot(teeter());
    r.template segment<6>(body_unknowns(nacelle)) = six(x, body_unknowns(nacelle)) - nacelle_motion;
    r.template segment<6>(body_unknowns(shaft)) = six(x, body_unknowns(shaft)) - shaft_motion;
    r.template segment<6>(body_unknowns(hub)) = six(x, body_unknowns(hub)) - hub_motion;

    Vec6T<S> reaction = inertia_of(d_.hub.inertia, hub);
    for (int k : {1, 2}) {
        const Seat<S> root = seat<S>(blade_root(k));
        const Vec6T<S> motion = root.carried(six(x, body_unknowns(hub)));
        const Index first = blade_unknowns(k), own = blade_.equations();
        const VectorT<S> xb = x.segment(first, blade_.unknowns()), xb_dot = xdot.segment(first, blade_.unknowns());
        MixedRootMotionT<S> carrier;
        carrier.v = motion.template head<3>();
        carrier.omega = motion.template tail<3>();
        r.segment(first, own) = blade_.residual<S>(xb, xb_dot, carrier);
        r.template segment<6>(first + own) = xb.template head<6>();                                     // clamped
        r.template segment<6>(first + own + 6) = xb.template segment<6>(blade_.tip() + MixedField::F);  // free
        reaction -= root.handed_on(six(xb, MixedField::F));
    }
    const Vec3T<S> at_teeter = reaction.template tail<3>();
    r(teeter()) = dot<S>(rotor.teeter_axis, at_teeter) + d_.hub.teeter->bearing.stiffness * x(teeter()) +
                  d_.hub.teeter->bearing.damping * xdot(teeter());
    reaction = inertia_of(d_.drive_train.shaft, shaft) + rotor.on_shaft.handed_on(reaction);
    reaction = inertia_of(d_.nacelle.inertia, nacelle) + rotor.on_nacelle.handed_on(reaction);
    r(yaw()) = reaction(5) + d_.yaw.rotation.stiffness * x(yaw()) + d_.yaw.rotation.damping * xdot(yaw());
    if (!tower_) return r;

    const Index own = tower_->equations();
    const VectorT<S> xt = x.head(tower_size_), xt_dot = xdot.head(tower_size_);
    r.head(own) = tower_->residual<S>(xt, xt_dot, {});
    r.template segment<6>(own) = xt.template head<6>();
    r.template segment<6>(own + 6) =
        six(xt, tower_->tip() + MixedField::F) + upright.handed_on(rotor.on_tower.handed_on(reaction));
    return r;
}

template Vector TeeteredMixed::residual(const Vector&, const Vector&, double) const;
template ComplexVector TeeteredMixed::residual(const ComplexVector&, const ComplexVector&, double) const;

Vector TeeteredMixed::unknown_scales() const {
    Vector scales(unknowns());
    if (tower_) scales.head(tower_size_) = tower_->unknown_scales();
    for (int k : {1, 2}) scales.segment(blade_unknowns(k), blade_.unknowns()) = blade_.unknown_scales();
    const auto& [length, force, time] = blade_.scales();
    for (int body : {nacelle, shaft, hub})
        scales.segment<6>(body_unknowns(body)) << Vec3::Constant(length / time), Vec3::Constant(1 / time);
    scales.tail<2>().setOnes();
    return scales;
}

Vector TeeteredMixed::equation_scales() const {
    Vector scales = unknown_scales();  // of the bodies' motions as they are
    const auto set = [&](const MixedBeam& beam, Index first) {
        const auto& [length, force, time] = beam.scales();
        scales.segment(first, beam.equations()) = beam.equation_scales();
        scales.segment<12>(first + beam.equations()) << Vec3::Constant(length), Vec3::Ones(), Vec3::Constant(force),
            Vec3::Constant(force * length);
    };
    if (tower_) set(*tower_, 0);
    for (int k : {1, 2}) set(blade_, blade_unknowns(k));
    scales.tail<2>().setConstant(blade_.scales().force * blade_.scales().length);
    return scales;
}

DescriptorPencil TeeteredMixed::pencil(double azimuth) const {
    constexpr double step = 1e-40;
    const Vector rows = equation_scales(), columns = unknown_scales();
    const Index n = unknowns();
    DescriptorPencil pencil{Matrix(n, n), Matrix(n, n)};
    const ComplexVector at = steady_.cast<Complex>(), rest = ComplexVector::Zero(n);
    for (Index i = 0; i < n; ++i) {
        ComplexVector x = at, xdot = rest;
        x(i) += Complex(0, step);
        xdot(i) += Complex(0, step);
        pencil.A.col(i) = residual<Complex>(x, rest, azimuth).imag().cwiseQuotient(rows) * (columns(i) / step);
        pencil.E.col(i) = residual<Complex>(at, xdot, azimuth).imag().cwiseQuotient(rows) * (columns(i) / step);
    }
    return pencil;
}

}  // namespace cardan::turbines
