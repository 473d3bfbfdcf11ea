// Nacelle, shaft and hub of the two-bladed teetered machine with all motions of the tower top: the linearised equations
// of the assembled machine against Kane's, which are Appendix A of Lee, Hodges and Patil (2002) without its slips.
#include "solvers/linear/linearise.hpp"
#include "tests/oracles/teetered_head.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"

using namespace cardan;
using oracles::TeeteredHead;

namespace {

// Everything off its place that the appendix has a letter for.
turbines::TurbineDescription offset_machine() {
    turbines::TurbineDescription d = turbines::teetered_description();
    testing::change_section(d.tower.line, [](EngineeringSection& s) {
        s.mass = 1e-8;  // the appendix has none, the torsion of the tower needs some
        s.j_flap = s.j_edge = 1e-7;
        s.EA = 1e10;
    });
    d.nacelle.inertia.com = {-0.4, 0, 0};
    d.nacelle.inertia.J = Vec3(7000, 9000, 16599).asDiagonal();
    d.drive_train.shaft.mass = 800;
    d.drive_train.shaft.com = {0.6, 0, 0};
    d.drive_train.shaft.J = Vec3(120, 300, 300).asDiagonal();
    d.hub.inertia.mass = 700;
    d.hub.inertia.com = {0, 0, 0.35};
    d.hub.teeter->undersling = 0.5;
    d.yaw.rotation = {3e5, 2e3};
    d.hub.teeter->bearing = {4e4, 700};
    return d;
}

// Likewise for Kane's equations: blades as rigid bodies are part of the hub, so they hand no forces to it.
TeeteredHead head_of(const turbines::TurbineDescription& d, double rotor_speed) {
    TeeteredHead head;
    head.c_n = -d.nacelle.inertia.com.x();
    head.c_s = -d.drive_train.shaft.com.x();
    head.d_n2 = -d.nacelle.overhang;
    head.m_y = d.nacelle.inertia.mass;
    head.m_s = d.drive_train.shaft.mass;
    head.I_y = {d.nacelle.inertia.J(1, 1), d.nacelle.inertia.J(0, 0), d.nacelle.inertia.J(2, 2)};
    head.I_s_long = d.drive_train.shaft.J(0, 0);
    head.I_s_lat = d.drive_train.shaft.J(1, 1);
    head.K_y = d.yaw.rotation.stiffness;
    head.C_y = d.yaw.rotation.damping;
    head.K_h = d.hub.teeter->bearing.stiffness;
    head.C_h = d.hub.teeter->bearing.damping;
    head.Omega = rotor_speed;

    const EngineeringSection s = testing::section_of(d.blade.line);
    const double length = 2 * d.blade.line.length, blades = length * s.mass, a = d.hub.radius,
                 b = a + d.blade.line.length;
    const RigidInertia& hub = d.hub.inertia;
    head.m_h = hub.mass + blades;
    const double centre = (hub.mass * hub.com.z() - blades * d.hub.teeter->undersling) / head.m_h;
    const double apart =
        hub.mass * std::pow(hub.com.z() - centre, 2) + blades * std::pow(d.hub.teeter->undersling + centre, 2);
    const double slender = 2 * s.mass * (b * b * b - a * a * a) / 3;
    head.c_h = -centre;
    head.I_h = {hub.J(1, 1) + slender + length * s.j_flap + apart, hub.J(2, 2) + slender + length * s.j_edge,
                hub.J(0, 0) + length * (s.j_flap + s.j_edge) + apart};
    return head;
}

}  // namespace

TEST_CASE("teetered machine: yaw, teeter and six motions of the tower top move by Kane's equations", "[analytic]") {
    const double speed = 6.02;
    const turbines::TurbineDescription d = offset_machine();
    turbines::AssemblyOptions assembly = turbines::teetered_paper_assembly(1);
    assembly.tower_beam->extension = true;
    const turbines::Turbine machine = turbines::assemble(d, assembly);
    const Model& model = machine.system().model;
    std::vector<int> rigid = model.coordinates().of_part("tower");
    REQUIRE(rigid.size() == 6);
    rigid.push_back(model.index("yaw"));
    rigid.push_back(model.index("teeter"));
    const TeeteredHead head = head_of(d, speed);

    for (const double psi : {0.0, 0.5, 1.9, 3.6}) {
        DynamicState at = at_rest(model.size());
        at.q(machine.rotor().spin) = psi;
        at.qd(machine.rotor().spin) = speed;
        const solvers::Linearisation linear = solvers::linearise(machine.system(), at);

        // U = B q', paper's axes: n1 = -y, n2 = x, n3 = z.
        Workspace workspace(model);
        Matrix jacobian(6, model.size());
        frame_jacobian(kinematics(model, at.q, workspace), model.frame("tower top"), jacobian);
        const Mat3 axes = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
        const double c = std::cos(psi), s = std::sin(psi);
        Matrix B = Matrix::Zero(8, 8), turning = Matrix::Zero(8, 8);
        B.block(2, 0, 3, 6) = axes * jacobian.topRows(3)(Eigen::all, std::vector<int>(rigid.begin(), rigid.end() - 2));
        B.block(5, 0, 3, 6) =
            axes * jacobian.bottomRows(3)(Eigen::all, std::vector<int>(rigid.begin(), rigid.end() - 2));
        B.row(0) = B.row(4);
        B(0, 6) = 1;
        B.row(1) = c * B.row(2) - s * B.row(0);
        B(1, 7) = 1;
        turning.row(1) = speed * (-s * B.row(2) - c * B.row(0));

        const auto terms = head.linearised(psi);
        const Matrix by_rate = terms.middleCols<8>(TeeteredHead::Ud), by_speed = terms.middleCols<8>(TeeteredHead::U);
        Matrix angles = Matrix::Zero(8, 8);
        angles.col(6) = terms.col(TeeteredHead::q_y);
        angles.col(7) = -terms.col(TeeteredHead::q_h);
        const Matrix M = -B.transpose() * by_rate * B, C = -B.transpose() * (by_speed * B + by_rate * turning),
                     K = -B.transpose() * angles;

        Matrix stiffness = linear.inertial(rigid, rigid);
        for (Eigen::Index i : {6, 7}) stiffness(i, i) += linear.elastic(rigid, rigid)(i, i);
        CAPTURE(psi);
        CHECK(head.at_rest(psi).isZero(1e-12));
        CHECK((linear.mass(rigid, rigid) - M).cwiseAbs().maxCoeff() < 1e-10 * M.cwiseAbs().maxCoeff());
        CHECK((linear.velocity()(rigid, rigid) - C).cwiseAbs().maxCoeff() < 1e-10 * C.cwiseAbs().maxCoeff());
        CHECK((stiffness - K).cwiseAbs().maxCoeff() < 1e-10 * K.cwiseAbs().maxCoeff());
    }
}
