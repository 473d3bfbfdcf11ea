#include "tests/peers/simbody_peer.hpp"

#include "mbs/base/entry.hpp"

#include <Simbody.h>

#include <algorithm>

namespace cardan::peers {

using namespace SimTK;

namespace {

MassProperties mass_properties(const PeerLink& link) {
    if (link.mass == 0 && !link.is_massless())
        throw PeerRefusal("Simbody keeps inertia per mass: a link cannot have moments of inertia and no mass");
    const Vec3 com(link.com[0], link.com[1], link.com[2]);
    const Inertia central(link.J[0], link.J[1], link.J[2], link.J[3], link.J[4], link.J[5]);
    return MassProperties(link.mass, com, central.shiftFromMassCenter(com, link.mass));
}

MobilizedBody attach(MobilizedBody& parent, const PeerLink& link) {
    const double* R = link.R;
    const Transform frame(Rotation(Mat33(R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]), true),
                          Vec3(link.p[0], link.p[1], link.p[2]));
    const Body::Rigid body(mass_properties(link));
    switch (link.joint) {
        case PeerJoint::revolute:
            return MobilizedBody::Pin(parent, frame, body, Transform());
        case PeerJoint::prismatic: {
            const Transform x_onto_z(Rotation(-Pi / 2, YAxis));  // Simbody's slider moves along x
            return MobilizedBody::Slider(parent, frame * x_onto_z, body, x_onto_z);
        }
        case PeerJoint::weld:
            break;
    }
    return MobilizedBody::Weld(parent, frame, body, Transform());
}

void copy(const double* from, Vector& to) {
    std::copy_n(from, to.size(), to.updContiguousScalarData());
}

void copy(const Vector& from, double* to) {
    std::copy_n(from.getContiguousScalarData(), from.size(), to);
}

}  // namespace

namespace {

struct Links {
    MultibodySystem system;
    SimbodyMatterSubsystem matter{system};
    std::vector<MobilizedBody> bodies;

    void add(const std::vector<PeerLink>& links, const std::vector<PeerPin>& pins) {
        for (const PeerLink& link : links) {
            MobilizedBody& parent = link.parent < 0 ? matter.updGround() : entry(bodies, link.parent);
            bodies.push_back(attach(parent, link));
        }
        const auto held = [&](int link) -> MobilizedBody& {
            return link < 0 ? matter.updGround() : entry(bodies, link);
        };
        for (const PeerPin& pin : pins)
            Constraint::Ball(held(pin.a), Vec3(pin.at_a[0], pin.at_a[1], pin.at_a[2]), held(pin.b),
                             Vec3(pin.at_b[0], pin.at_b[1], pin.at_b[2]));
    }
};

}  // namespace

struct SimbodyPeer::Impl : Links {
    Vec3 gravity;
    State state;
    Vector given, result;
    Vector_<SpatialVec> weights;  // per body, the ground among them
    Vector_<SpatialVec> body_accelerations;
    Matrix g;

    void set(const double* q, const double* qd, Stage stage) {
        copy(q, state.updQ());
        if (qd != nullptr) copy(qd, state.updU());
        system.realize(state, stage);
    }
    using Accelerate = void (SimbodyMatterSubsystem::*)(const State&, const Vector&, const Vector_<SpatialVec>&,
                                                        Vector&, Vector_<SpatialVec>&) const;
    void accelerate(Accelerate solve, const double* q, const double* qd, const double* Q, double* qdd) {
        set(q, qd, Stage::Dynamics);
        copy(Q, given);
        (matter.*solve)(state, given, weigh(), result, body_accelerations);
        copy(result, qdd);
    }
    // Forces of gravity; they stay zero without.
    const Vector_<SpatialVec>& weigh() {
        if (gravity.normSqr() == 0) return weights;
        weights = SpatialVec(Vec3(0), Vec3(0));
        for (const MobilizedBody& body : bodies)
            matter.addInStationForce(state, body.getMobilizedBodyIndex(), body.getBodyMassCenterStation(state),
                                     body.getBodyMass(state) * gravity, weights);
        return weights;
    }
};

SimbodyPeer::SimbodyPeer(const std::vector<PeerLink>& links, std::array<double, 3> gravity,
                         const std::vector<PeerPin>& pins)
    : impl_(new Impl) {
    Impl& s = *impl_;
    s.gravity = Vec3(gravity[0], gravity[1], gravity[2]);
    s.add(links, pins);
    s.state = s.system.realizeTopology();
    s.system.realizeModel(s.state);
    int n = 0;
    for (const MobilizedBody& body : s.bodies) {
        if (body.getNumU(s.state) == 0) continue;
        if (body.getFirstUIndex(s.state) != n) throw PeerRefusal("Simbody numbers the coordinates in another order");
        ++n;
    }
    s.given.resize(n);
    s.result.resize(n);
    s.g.resize(n, n);
    s.weights.resize(s.matter.getNumBodies());
    s.weights = SpatialVec(Vec3(0), Vec3(0));
}

SimbodyPeer::~SimbodyPeer() = default;

void SimbodyPeer::metric(const double* q, double* g) {
    Impl& s = *impl_;
    s.set(q, nullptr, Stage::Position);
    s.matter.calcM(s.state, s.g);
    std::copy_n(s.g.getContiguousScalarData(), s.g.nelt(), g);
}

void SimbodyPeer::inverse_dynamics(const double* q, const double* qd, const double* qdd, double* tau) {
    Impl& s = *impl_;
    s.set(q, qd, Stage::Velocity);
    copy(qdd, s.given);
    s.matter.calcResidualForceIgnoringConstraints(s.state, Vector(), s.weigh(), s.given, s.result);
    copy(s.result, tau);
}

void SimbodyPeer::forward_dynamics(const double* q, const double* qd, const double* Q, double* qdd) {
    impl_->accelerate(&SimbodyMatterSubsystem::calcAccelerationIgnoringConstraints, q, qd, Q, qdd);
}

void SimbodyPeer::closed_dynamics(const double* q, const double* qd, const double* Q, double* qdd) {
    impl_->accelerate(&SimbodyMatterSubsystem::calcAcceleration, q, qd, Q, qdd);
}

struct SimbodyMotion::Impl : Links {
    GeneralForceSubsystem forces{system};
};

SimbodyMotion::SimbodyMotion(const std::vector<PeerLink>& links, std::array<double, 3> gravity,
                             const std::vector<PeerPin>& pins)
    : impl_(new Impl) {
    impl_->add(links, pins);
    Force::UniformGravity(impl_->forces, impl_->matter, Vec3(gravity[0], gravity[1], gravity[2]));
    impl_->system.realizeTopology();
}

SimbodyMotion::~SimbodyMotion() = default;

int SimbodyMotion::advance(double* q, double* qd, double duration, double accuracy) {
    State start = impl_->system.getDefaultState();
    impl_->system.realizeModel(start);
    copy(q, start.updQ());
    copy(qd, start.updU());
    RungeKuttaMersonIntegrator method(impl_->system);
    method.setAccuracy(accuracy);
    TimeStepper motion(impl_->system, method);
    try {
        motion.initialize(start);
        motion.stepTo(duration);
    } catch (const std::exception&) {
        return -1;
    }
    copy(method.getState().getQ(), q);
    copy(method.getState().getU(), qd);
    return method.getNumStepsTaken();
}

}  // namespace cardan::peers
