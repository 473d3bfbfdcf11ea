// What is in a URDF file: masses, coordinates, Denavit-Hartenberg parameters, metric, and natural modes about a pose.
//
// Problem: a robot stands still in a pose q0 and every coordinate is held there by a spring, the drive with its brake
// closed; no gravity. Small vibrations obey
//     g(q0) x'' + D x' + K x = 0,   K = diag(stiffness), D = diag(damping of the file),
// with the metric g. Natural frequencies are |lambda| / (2 pi) of its eigenvalues.
// Reference: docs/urdf.md; the tests hold metric and poses against hand calculation.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/metric.hpp"
#include "mbs/model/summary.hpp"
#include "mbs/urdf/urdf.hpp"
#include "programs/shared/named_values.hpp"
#include "programs/shared/program.hpp"
#include "solvers/linear/modes.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>

using namespace cardan;

namespace {

struct Arguments {
    std::string file, write;
    std::vector<std::string> q, stiffness;
    int modes = 12;
    bool undamped = false;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Prints what a URDF file holds: notes, masses, coordinates and limits, Denavit-Hartenberg parameters, the\n"
        "metric at a pose, and the natural modes about that pose with a spring on every coordinate.");
    app.footer("Exit code: 0; 1 error; 2 wrong usage.");
    app.add_option("FILE", a.file, "URDF file").required();
    app.add_option("--q", a.q, "pose: COORDINATE=VALUE, rad or m; several (default: 0)").one_word();
    app.add_option("--stiffness", a.stiffness,
                   "springs: VALUE for all or COORDINATE=VALUE for one, N m/rad or N/m; several (default: 100000)")
        .one_word();
    app.add_option("--modes", a.modes, "number of modes printed").positive();
    app.add_flag("--undamped", a.undamped, "without the viscous damping of the file");
    app.add_option("--write", a.write, "write the tree as URDF to this file");
    return app.parse(argc, argv);
}

std::string limit(double value) {
    return std::isfinite(value) ? text(value) : "-";
}

void print_coordinates(const UrdfModel& model, const Model& sorted, const Vector& q) {
    std::cout << "\ncoordinate                      unit  q            lower      upper      speed      effort     "
                 "damping    friction\n";
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
        const UrdfJoint& j = model.joints[i];
        const int at = sorted.index(BodyId{static_cast<int>(i)});
        std::cout << "  " << std::left << std::setw(30) << j.coordinate << std::setw(6) << sorted.coordinates()[at].unit
                  << std::setw(13) << q(at);
        for (const double value : {j.lower, j.upper, j.velocity, j.effort, j.damping, j.friction})
            std::cout << std::setw(11) << limit(value);
        std::cout << std::right << "\n";
    }
}

void print_dh(const Tree& tree) {
    std::cout << "\nDenavit-Hartenberg parameters (Khalil and Kleinfinger), deg and m\n"
                 "  body                          on                              kind           gamma          b"
                 "      alpha          d     theta0         r0\n";
    for (const Tree::Body& body : tree.bodies()) {
        const DhParameters dh = dh_parameters(body.in_parent);
        const std::string parent = body.parent < 0 ? "base" : entry(tree.bodies(), body.parent).spec.name;
        std::cout << "  " << std::left << std::setw(30) << body.spec.name << std::setw(32) << parent << std::setw(10)
                  << (body.spec.joint == JointKind::revolute ? "revolute" : "prismatic") << std::right << std::fixed
                  << std::setprecision(4);
        for (const double value : {dh.gamma * units::to_degrees, dh.b, dh.alpha * units::to_degrees, dh.d,
                                   dh.theta0 * units::to_degrees, dh.r0})
            std::cout << std::setw(11) << value + 0.0;
        std::cout << std::defaultfloat << std::setprecision(6) << "\n";
    }
}

void print_metric(const Matrix& g, const CoordinateTable& table) {
    constexpr Eigen::Index widest = 12;
    const bool all = g.rows() <= widest;
    std::cout << "\nmetric at q, kg m^2, kg m, kg" << (all ? "" : " (diagonal; the matrix is too wide to print)")
              << "\n";
    for (Eigen::Index i = 0; i < g.rows(); ++i) {
        std::cout << "  " << std::left << std::setw(30) << table[static_cast<int>(i)].name << std::right;
        for (Eigen::Index j = all ? 0 : i; j <= (all ? g.cols() - 1 : i); ++j)
            std::cout << std::setw(12) << std::setprecision(5) << g(i, j);
        std::cout << std::setprecision(6) << "\n";
    }
}

void print_modes(const solvers::SecondOrderSystem& system, const CoordinateTable& table, int count) {
    const std::vector<solvers::Mode> modes = solvers::modes(system);
    std::cout << "\nnatural modes about q\n        Hz     damping, % of critical   elastic energy\n";
    int shown = 0;
    for (const solvers::Mode& mode : modes) {
        if (!mode.oscillates() || ++shown > count) break;
        const Vector energy = solvers::energy_by_row(system, mode);
        std::cout << std::fixed << std::setw(12) << std::setprecision(4) << mode.natural_hz() << std::setw(14)
                  << 100 * mode.damping_ratio() << "              ";
        std::vector<int> order(static_cast<std::size_t>(energy.size()));
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return energy(a) > energy(b); });
        for (std::size_t k = 0; k < order.size() && k < 3 && energy(order[k]) > 0.01; ++k)
            std::cout << (k ? ", " : "") << std::setprecision(0) << 100 * energy(order[k]) << " % "
                      << table[entry(system.coordinates, order[k])].name;
        std::cout << std::defaultfloat << std::setprecision(6) << "\n";
    }
    const long oscillating = static_cast<long>(
        std::count_if(modes.begin(), modes.end(), [](const solvers::Mode& m) { return m.oscillates(); }));
    const long others = static_cast<long>(modes.size()) - oscillating;
    const long free = static_cast<long>(system.M.rows()) - oscillating - others / 2;
    if (shown == 0) std::cout << "  none oscillates\n";
    if (others > 0) std::cout << "  " << others << " aperiodic eigenvalues are not shown\n";
    if (free > 0) std::cout << "  " << free << " rigid-body modes (coordinates without a spring) are left out\n";
    if (shown > count) std::cout << "  further modes: --modes\n";
}

int run(const Arguments& a) {
    program::stop_at_once();
    const UrdfModel robot = read_urdf(a.file);
    std::cout << "robot '" << robot.robot_name << "' from " << a.file << "\n";
    for (const std::string& note : robot.notes) std::cout << "note: " << note << "\n";
    std::cout << "\n" << summary(robot.tree);
    if (!a.write.empty()) {
        write_urdf(a.write, robot.tree, {robot.robot_name, robot.joints});
        std::cout << "\nwritten: " << a.write << "\n";
    }
    if (robot.tree.bodies().empty()) return 0;

    const Model model(robot.tree);
    const CoordinateTable& table = model.coordinates();
    const Vector zero = Vector::Zero(model.size());
    const Vector q = program::named_values("--q", a.q, table, zero, false);
    const Vector stiffness =
        program::named_values("--stiffness", a.stiffness, table, Vector::Constant(model.size(), 1e5), true);
    print_coordinates(robot, model, q);
    print_dh(robot.tree);

    ForceSet forces = a.undamped ? ForceSet() : joint_damping(robot.tree, robot.joints);
    for (int i = 0; i < model.size(); ++i) {
        const int at = model.index(BodyId{i});
        forces.add_spring(table[at].name + " spring", BodyId{i}, stiffness(at), 0, q(at));
    }
    const System system(robot.tree, forces);
    const solvers::Linearisation linear = solvers::linearise(system, at_rest(q));
    print_metric(linear.mass, table);
    std::vector<int> all(static_cast<std::size_t>(model.size()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    print_modes(solvers::restrict_to(linear, all), table, a.modes);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("urdf_inspect", argc, argv, parse, run);
}
