#include "elements/machine_elements/rotor_load.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

namespace {

// Terms of torque and thrust.
struct Scales {
    double still, moving, thrust;  // N m, N m per rad/s, N per rad/s

    Scales(const RotorCurve& c, double V) {
        const double l = c.tip_speed_ratio, R = c.radius, disc = c.air_density / 2 * pi * R * R;
        still = disc * R * c.power / l * V * 2 * V;
        moving = disc * R * c.power / l * V * R / l;
        thrust = disc * c.thrust / l * V * R;
    }
};

double angle(const CoordinateSum& sum, const Model& model, const Vector& q) {
    double total = 0;
    for (const auto& [body, factor] : sum) total += factor * q(model.index(body));
    return total;
}

}  // namespace

template <class S>
S RotorCurve::torque(double wind, S azimuth, S speed, S pitch) const {
    using std::cos, std::sin;
    const Scales scale(*this, wind);
    const S c = cos(pitch) * cos(pitch), g = 1.0 - tower_shadow / 2 * (1.0 + cos(double(blades) * (azimuth - pi)));
    return (scale.still * c - scale.moving * speed * (c + feather_braking * sin(pitch))) * g;
}

template <class S>
S RotorCurve::thrust_force(double wind, S azimuth, S speed, S pitch) const {
    using std::cos;
    const S g = 1.0 - tower_shadow / 2 * (1.0 + cos(double(blades) * (azimuth - pi)));
    return Scales(*this, wind).thrust * speed * cos(pitch) * cos(pitch) * g;
}

template double RotorCurve::torque<double>(double, double, double, double) const;
template Complex RotorCurve::torque<Complex>(double, Complex, Complex, Complex) const;
template double RotorCurve::thrust_force<double>(double, double, double, double) const;
template Complex RotorCurve::thrust_force<Complex>(double, Complex, Complex, Complex) const;

RotorCurve::Value RotorCurve::at(double wind, double azimuth, double speed, double pitch) const {
    const Scales scale(*this, wind);
    const double c = std::cos(pitch) * std::cos(pitch), dc = -std::sin(2 * pitch), s = std::sin(pitch);
    const double phase = blades * (azimuth - pi);
    const double g = 1 - tower_shadow / 2 * (1 + std::cos(phase)), dg = tower_shadow / 2 * blades * std::sin(phase);
    const double free = scale.still * c - scale.moving * speed * (c + feather_braking * s);
    Value v;
    v.torque = free * g;
    v.torque_by = {free * dg, -scale.moving * (c + feather_braking * s) * g,
                   (scale.still * dc - scale.moving * speed * (dc + feather_braking * std::cos(pitch))) * g};
    v.thrust = scale.thrust * speed * c * g;
    v.thrust_by = {scale.thrust * speed * c * dg, scale.thrust * c * g, scale.thrust * speed * dc * g};
    return v;
}

void RotorCurve::check(std::string_view where) const {
    require_positive(where, "radius [m]", radius);
    require_positive(where, "power coefficient", power);
    require_positive(where, "tip speed ratio", tip_speed_ratio);
    require_not_negative(where, "thrust coefficient", thrust);
    require_not_negative(where, "braking in feather", feather_braking);
    require_positive(where, "air density [kg/m^3]", air_density);
    if (!(tower_shadow >= 0 && tower_shadow <= 1)) throw InputError(where, "tower shadow", tower_shadow, "0 ... 1");
    if (blades < 1) throw InputError(where, "number of blades", blades, ">= 1");
}

RotorCurve::Value RotorLoad::value(const StateView& in) const {
    const Model& model = in.kinematics.model();
    const double psi = angle(azimuth, model, in.q), speed = angle(azimuth, model, in.qd),
                 feather = pitch_setting + angle(pitch, model, in.q);
    if (law) return law(in.time, psi, speed, feather);
    const double V = wind(in.time);
    if (!(V >= 0) || std::isinf(V))
        throw InputError(text(name, " at ", in.time, " s"), "wind speed [m/s]", V, "finite and >= 0");
    return curve.at(V, psi, speed, feather);
}

Wrench RotorLoad::wrench(const StateView& in) const {
    const RotorCurve::Value v = value(in);
    const Vec3 axis = pose(in.kinematics, hub).R.col(2);
    return {v.thrust * axis, v.torque * axis};
}

namespace {

// The change of the wrench as it stands, turned with the hub, upon axes that turn: as for any follower load.
void add_stiffness_of_axes(const RotorLoad& load, const StateView& in, const RotorCurve::Value& v, MatrixOut dQ_dq) {
    const Pose<double> hub = pose(in.kinematics, load.hub);
    const Vec3 force = v.thrust * hub.R.col(2), moment = v.torque * hub.R.col(2);
    const Model& model = in.kinematics.model();
    const int tip = model.frame(load.hub).body;
    for (int a = tip; a >= 0; a = model.body(a).parent)
        for (int b = tip; b >= 0; b = model.body(b).parent) {
            const PointTwist<double> ta = twist_at(in.kinematics, a, hub.p), tb = twist_at(in.kinematics, b, hub.p);
            const bool proximal = b <= a;
            dQ_dq(a, b) += force.dot(proximal ? cross<double>(tb.w, ta.v) : cross<double>(ta.w, tb.v)) +
                           cross<double>(tb.w, force).dot(ta.v) + cross<double>(tb.w, moment).dot(ta.w);
            if (proximal) dQ_dq(a, b) += moment.dot(cross<double>(tb.w, ta.w));
        }
}

void add_jacobian(const RotorLoad& load, const StateView& in, ElementJacobian& d) {
    const RotorCurve::Value v = load.value(in);
    add_stiffness_of_axes(load, in, v, d.Q_q);
    const Pose<double> hub = pose(in.kinematics, load.hub);
    const Vec3 axis = hub.R.col(2);
    const Model& model = in.kinematics.model();
    for (int a = model.frame(load.hub).body; a >= 0; a = model.body(a).parent) {
        const PointTwist<double> t = twist_at(in.kinematics, a, hub.p);
        const Vec3 by = axis.dot(t.v) * v.thrust_by + axis.dot(t.w) * v.torque_by;  // azimuth, speed, pitch
        for (const auto& [body, factor] : load.azimuth) {
            d.Q_q(a, model.index(body)) += factor * by(0);
            d.Q_qd(a, model.index(body)) += factor * by(1);
        }
        for (const auto& [body, factor] : load.pitch) d.Q_q(a, model.index(body)) += factor * by(2);
    }
}

}  // namespace

ForceElement rotor_load_force(const RotorLoad& load) {
    if (!load.law) load.curve.check(load.name);
    if (!load.law && !load.wind) throw InputError(load.name, "wind", "none", "a function of time");
    if (load.azimuth.empty()) throw InputError(load.name, "coordinates of the azimuth", "none", "at least one");
    if (!std::isfinite(load.pitch_setting))
        throw InputError(load.name, "pitch setting [rad]", load.pitch_setting, "finite");
    const auto shared = std::make_shared<const RotorLoad>(load);
    ForceElement force{.name = load.name, .points = {{load.hub}}};
    force.evaluate = [shared](const ElementView& in, ElementForces& out) {
        out.wrenches[0] = shared->wrench(in.system);
    };
    force.jacobian = [shared](const ElementView& in, ElementJacobian& d) { add_jacobian(*shared, in.system, d); };
    return force;
}

ChannelGroup rotor_load_channels(const RotorLoad& load) {
    ChannelGroup group;
    group.channels = {{.name = load.name + " torque",
                       .units = "N m",
                       .long_name = "prescribed torque on the hub about its axis",
                       .frame = "rotor axis"},
                      {.name = load.name + " thrust",
                       .units = "N",
                       .long_name = "prescribed thrust on the hub, downwind",
                       .frame = "rotor axis"},
                      {.name = load.name + " power", .units = "W", .long_name = "prescribed torque times rotor speed"}};
    if (load.wind)
        group.channels.push_back(
            {.name = "wind speed", .units = "m s-1", .long_name = "wind speed of the prescribed rotor load"});
    group.sample = [load](const DynamicView& in, double* values) {
        const RotorCurve::Value v = load.value(in);
        values[0] = v.torque;
        values[1] = v.thrust;
        values[2] = v.torque * angle(load.azimuth, in.kinematics.model(), in.qd);
        if (load.wind) values[3] = load.wind(in.time);
    };
    return group;
}

}  // namespace cardan
