// A six-axis arm read from URDF of which one link, the tube of the forearm, is made a flexible beam.
//
// Problem: the drives are springs (brakes closed) that hold the arm in a pose; the forearm of arm6.urdf is replaced by
// a cardanic joint beam of a few elements, everything else stays. Small vibrations g x'' + K x = 0 of the arm with the
// beam are set beside those of the rigid arm.
// References: (1) with a tube made a million times stiffer the rigid arm comes back; (2) with the drives locked at
// q = 0 the forearm is a clamped tube with a rigid body (wrist and tool) at its tip, of which the Timoshenko beam has
// an exact transfer matrix; (3) the arm with the beam, written as URDF and read again, has the same metric.
#include "examples/studies/urdf_arm/tube.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/metric.hpp"
#include "programs/shared/named_values.hpp"
#include "programs/shared/program.hpp"
#include "solvers/linear/modes.hpp"

#include <iomanip>
#include <iostream>

using namespace cardan;

namespace {

struct Arguments {
    std::string file = CARDAN_EXAMPLE_DATA "/arm6.urdf", write;
    std::vector<std::string> q, stiffness;
    int elements = 4, modes = 8;
    double youngs_factor = 1;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Natural frequencies of a six-axis arm from URDF with a flexible forearm, beside those of the rigid arm,\n"
        "and checks against the stiff limit, an exact beam and the round trip through URDF.");
    app.footer("Exit code: 0; 1 error; 2 wrong usage; 3 a check fails.");
    app.add_option("--file", a.file,
                   "URDF with the links forearm_tube, forearm_root and forearm_tip, 0.8 m apart along x");
    app.add_option("--elements", a.elements, "beam elements of the forearm, at most 200");
    app.add_option("--q", a.q, "pose: COORDINATE=VALUE, rad; several (default: 0)").one_word();
    app.add_option("--stiffness", a.stiffness,
                   "drives: VALUE for all or COORDINATE=VALUE for one, N m/rad; several (default: 500000)")
        .one_word();
    app.add_option("--youngs-factor", a.youngs_factor, "on the elastic constants of the tube");
    app.add_option("--modes", a.modes, "number of modes printed").positive();
    app.add_option("--write", a.write, "write the arm with the beam as URDF to this file");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    require_positive("--youngs-factor", "value", a.youngs_factor);
    return -1;
}

arm::Tube tube_of(double stiffer) {
    arm::Tube tube;
    tube.E *= stiffer;
    tube.G *= stiffer;
    return tube;
}

// The pose and the springs of the drives, in the order of the bodies of the rigid arm.
struct Drives {
    Vector q, stiffness;
};
Drives drives_of(const Arguments& a, const Tree& rigid) {
    const Model model(rigid);
    const Eigen::Index n = model.size();
    const Vector q = program::named_values("--q", a.q, model.coordinates(), Vector::Zero(n), false);
    const Vector k =
        program::named_values("--stiffness", a.stiffness, model.coordinates(), Vector::Constant(n, 5e5), true);
    Drives drives{q, k};
    for (int i = 0; i < n; ++i)
        drives.q(i) = q(model.index(BodyId{i})), drives.stiffness(i) = k(model.index(BodyId{i}));
    return drives;
}

// An arm held in its pose: the matrices of its small vibrations.
struct Held {
    Held(const Tree& tree, ForceSet forces, const std::vector<BodyId>& bodies, const Drives& drives)
        : system(tree, with_drives(std::move(forces), bodies, drives)) {
        const Eigen::Index n = system.model.size();
        Vector q = Vector::Zero(n);
        for (Eigen::Index i = 0; i < std::ssize(bodies); ++i) {
            at.push_back(system.model.index(entry(bodies, i)));
            q(at.back()) = drives.q(i);
        }
        linear = solvers::linearise(system, at_rest(q));
    }
    static ForceSet with_drives(ForceSet forces, const std::vector<BodyId>& bodies, const Drives& drives) {
        for (Eigen::Index i = 0; i < std::ssize(bodies); ++i)
            forces.add_spring(text("drive ", i + 1), entry(bodies, i), drives.stiffness(i), 0, drives.q(i));
        return forces;
    }
    std::vector<double> frequencies() const {
        std::vector<int> all(static_cast<std::size_t>(system.model.size()));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
        return frequencies(all);
    }
    std::vector<double> frequencies(const std::vector<int>& coordinates) const {
        std::vector<double> hz;
        for (const solvers::Mode& mode : solvers::modes(solvers::restrict_to(linear, coordinates)))
            if (mode.oscillates()) hz.push_back(mode.natural_hz());
        return hz;
    }

    System system;
    std::vector<int> at;  ///< coordinates of the drives
    solvers::Linearisation linear;
};

std::vector<BodyId> bodies_of(const Tree& tree) {
    std::vector<BodyId> ids(tree.bodies().size());
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i].index = static_cast<int>(i);
    return ids;
}

Held held(const arm::FlexibleArm& flexible, const Drives& drives) {
    return {flexible.tree, flexible.forces, flexible.drives, drives};
}

struct Checks {
    int off = 0;
    void row(const std::string& what, double value, double reference, double tolerance) {
        const double error = std::abs(value / reference - 1);
        const bool holds = error <= tolerance;
        std::cout << "  " << std::left << std::setw(58) << what << std::right << std::setprecision(8) << std::setw(13)
                  << value << std::setw(13) << reference << std::setprecision(2) << std::setw(10) << error
                  << std::setw(10) << tolerance << (holds ? "   ok" : "   OFF") << "\n";
        off += !holds;
    }
};

// Bending of the forearm alone, drives locked at q = 0, in the plane of the arm (turning about y) and across it.
void check_clamped(Checks& checks, const Tree& rigid, const arm::Tube& tube, int elements) {
    const RigidInertia body = arm::carried_by_tip(rigid);
    if (!(body.com - body.com.x() * Vec3::UnitX()).isZero(1e-9) ||
        !(body.J - Mat3(body.J.diagonal().asDiagonal())).isZero(1e-9))
        throw InputError("what the tip carries", "centre of mass [m]", body.com.transpose(),
                         "on the axis of the tube, with principal axes along it");
    const Eigen::Index n = std::ssize(rigid.bodies());
    for (const char* axis : {"y", "z"}) {
        const double J = axis[0] == 'y' ? body.J(1, 1) : body.J(2, 2);
        const double exact = arm::clamped_frequency(tube, {body.mass, body.com.x(), J});
        double coarse = 0;
        for (const int count : {elements, 2 * elements}) {
            const arm::FlexibleArm flexible = arm::flexible_arm(rigid, tube, count);
            const Held arm = held(flexible, {Vector::Zero(n), Vector::Ones(n)});
            std::vector<int> bending;
            for (int i = 0; i < arm.system.model.size(); ++i)
                if (arm.system.model.coordinates()[i].name.find(text("bending ", axis)) != std::string::npos)
                    bending.push_back(i);
            const double hz = arm.frequencies(bending).at(0), error = std::abs(hz / exact - 1);
            // The element is of second order. Its flexibility is exact, so only the tube's own mass is in error.
            checks.row(text("forearm clamped, bending about ", axis, ", ", count, " elements, Hz"), hz, exact,
                       0.001 / (count * count));
            if (count == elements)
                coarse = error;
            else if (error > 1e-7)
                std::cout << "    observed order " << std::setprecision(3) << std::log2(coarse / error) << "\n";
        }
    }
}

double metric_difference(const Matrix& a, const Matrix& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

int run(const Arguments& a) {
    program::stop_at_once();
    if (a.elements > 200) throw InputError("--elements", "number of elements", a.elements, "at most 200");
    const UrdfModel robot = read_urdf(a.file);
    for (const std::string& note : robot.notes) std::cout << "note: " << note << "\n";
    const Drives drives = drives_of(a, robot.tree);
    const arm::Tube tube = tube_of(a.youngs_factor);
    const arm::FlexibleArm flexible = arm::flexible_arm(robot.tree, tube, a.elements);
    const Held rigid(robot.tree, {}, bodies_of(robot.tree), drives), soft = held(flexible, drives);

    std::cout << "\n"
              << robot.robot_name << ": " << rigid.system.model.size() << " drives, "
              << soft.system.model.size() - rigid.system.model.size() << " coordinates of the forearm (" << a.elements
              << " elements)\n\nnatural frequencies, Hz\n  mode        rigid     flexible      change\n";
    const std::vector<double> f_rigid = rigid.frequencies(), f_soft = soft.frequencies();
    for (std::size_t i = 0; i < f_soft.size() && i < static_cast<std::size_t>(a.modes); ++i) {
        std::cout << std::fixed << std::setprecision(4) << std::setw(6) << i + 1 << std::setw(13);
        if (i < f_rigid.size())
            std::cout << f_rigid[i] << std::setw(13) << f_soft[i] << std::setprecision(2) << std::setw(10)
                      << 100 * (f_soft[i] / f_rigid[i] - 1) << " %\n";
        else
            std::cout << "-" << std::setw(13) << f_soft[i] << "           -\n";
    }
    std::cout << std::defaultfloat
              << "\nchecks                                                          computed    reference     error   "
                 "allowed\n";

    Checks checks;
    checks.row("mass of the tube: section and file, kg", tube.mass(), arm::tube_in_file(robot.tree).mass, 1e-9);
    const Matrix of_drives = soft.linear.mass(soft.at, soft.at), of_rigid = rigid.linear.mass(rigid.at, rigid.at);
    checks.row("metric of the drives, straight beam: 1 + difference", 1 + metric_difference(of_drives, of_rigid), 1,
               1e-9);
    const Held stiff = held(arm::flexible_arm(robot.tree, tube_of(1e6), a.elements), drives);
    const std::vector<double> f_stiff = stiff.frequencies();
    for (std::size_t i = 0; i < f_rigid.size(); ++i)
        checks.row(text("tube a million times stiffer, mode ", i + 1, ", Hz"), f_stiff.at(i), f_rigid[i], 1e-5);
    check_clamped(checks, robot.tree, tube, a.elements);
    const UrdfModel again = parse_urdf(to_urdf(flexible.tree), "the arm with the beam");
    Drives pose{soft.linear.at.q, Vector::Zero(soft.linear.at.q.size())};
    for (const BodyId body : bodies_of(flexible.tree))
        pose.q(body.index) = soft.linear.at.q(soft.system.model.index(body));
    const Held back(again.tree, {}, bodies_of(again.tree), pose);
    checks.row("through URDF and back, metric: 1 + difference",
               1 + metric_difference(back.linear.mass, soft.linear.mass), 1, 1e-12);

    if (!a.write.empty()) {
        write_urdf(a.write, flexible.tree, {robot.robot_name + "_flexible", robot.joints});
        std::cout << "\nwritten: " << a.write << "\n";
    }
    std::cout << "\n" << (checks.off == 0 ? "all checks hold" : text("checks that FAILED: ", checks.off)) << "\n";
    if (!std::cout.flush()) throw FileError("standard output", "the table could not be written");
    return checks.off == 0 ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("urdf_arm", argc, argv, parse, run);
}
