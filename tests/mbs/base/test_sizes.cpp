// Every public function of the kernels, called with vectors, matrices, indices and models that do not fit: an error
// that names the argument, and nothing written anywhere.
#include "mbs/batch/batch.hpp"
#include "mbs/geometry/change_of_chart.hpp"
#include "mbs/geometry/curvature.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/lagrange.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "mbs/system/joint_loads.hpp"
#include "tests/support/doors.hpp"
#include "tests/support/random_tree.hpp"

#include <limits>

using namespace cardan;
using namespace cardan::testing;

namespace {

// A system of n coordinates with everything that a kernel can be given, all of the right size.
struct Fixture {
    explicit Fixture(unsigned seed = 3)
        : random(seed),
          tree(random_tree(random, {.bodies = 7, .armatures = true})),
          system(tree, random_forces(random, tree)) {
        REQUIRE(factor.factorise(kin).ok());
        REQUIRE(curvature.update(kin).ok());
        embedding.update(kin);
        system.forces.derivatives({{.q = x, .qd = x}, kin}, of_forces);
    }

    Random random;
    Tree tree;
    System system;
    const Model& model = system.model;
    int n = model.size();
    Vector x = random_state(random, n), y = Vector::Zero(n), z = Vector::Zero(n);
    Matrix A = Matrix::Zero(n, n), B = A, J = Matrix::Zero(6, n);
    Workspace workspace{model}, elsewhere{model};  // what is accepted must not make `kin` stale
    Kinematics kin = kinematics(model, x, workspace);
    BranchMatrix P{model}, R{model};
    Christoffel gamma{model};
    MetricFactor factor{model};
    ForwardDynamics forward{model};
    ForwardDynamicsDerivatives derivatives{model};
    Curvature curvature{model};
    Embedding embedding{model};
    VelocityField field = embedding.velocity_field();
    AccelerationField acceleration = embedding.acceleration_field();
    ForceDerivatives of_forces;
    Batch batch{model, 1};
};

std::vector<Door> doors_of_vectors(Fixture& f, Vector& bad) {
    Forces& forces = f.system.forces;
    Vector &x = f.x, &y = f.y, &z = f.z;
    const auto& kin = f.kin;
    return {
        {"kinematics q", [&] { kinematics(f.model, bad, f.elsewhere); }},
        {"inverse dynamics qd", [&] { inverse_dynamics<double>(kin, bad, x, y); }},
        {"inverse dynamics qdd", [&] { inverse_dynamics<double>(kin, x, bad, y); }},
        {"inverse dynamics tau", [&] { inverse_dynamics<double>(kin, x, x, bad); }},
        {"inertial forces qd", [&] { inertial_forces<double>(kin, bad, y); }},
        {"inertial forces h", [&] { inertial_forces<double>(kin, x, bad); }},
        {"kinetic energy", [&] { kinetic_energy(kin, bad); }},
        {"forward dynamics qd", [&] { f.forward.solve(kin, bad, x, y, z); }},
        {"forward dynamics Q", [&] { f.forward.solve(kin, x, bad, y, z); }},
        {"forward dynamics qdd", [&] { f.forward.solve(kin, x, x, bad, z); }},
        {"forward dynamics actuator", [&] { f.forward.solve(kin, x, x, y, bad); }},
        {"forces q",
         [&] {
             forces.generalised_forces({{.q = bad, .qd = x}, kin}, y);
         }},
        {"forces qd",
         [&] {
             forces.generalised_forces({{.q = x, .qd = bad}, kin}, y);
         }},
        {"forces Q",
         [&] {
             forces.generalised_forces({{.q = x, .qd = x}, kin}, bad);
         }},
        {"elements q", [&] { forces.generalised_forces_of_laws<double>(kin, bad, x, y); }},
        {"elements Q", [&] { forces.generalised_forces_of_laws<double>(kin, x, x, bad); }},
        {"force derivatives q",
         [&] {
             forces.derivatives({{.q = bad, .qd = x}, kin}, f.of_forces);
         }},
        {"force derivatives qd",
         [&] {
             forces.derivatives({{.q = x, .qd = bad}, kin}, f.of_forces);
         }},
        {"potential energy q",
         [&] {
             forces.potential_energy({{.q = bad, .qd = x}, kin});
         }},
        {"report qd",
         [&] {
             forces.report({{.q = x, .qd = bad}, kin});
         }},
        {"dissipation", [&] { forces.dissipation(bad); }},
        {"branch matrix x", [&] { f.P.multiply(bad, y); }},
        {"branch matrix y", [&] { f.P.multiply(x, bad); }},
        {"contraction qd", [&] { f.gamma.contract(bad, y); }},
        {"contraction h", [&] { f.gamma.contract(x, bad); }},
        {"contraction y", [&] { f.gamma.contract(x, bad, y); }},
        {"along", [&] { f.gamma.along(bad, f.A); }},
        {"coriolis", [&] { f.gamma.coriolis(bad, f.A); }},
        {"derivatives qd", [&] { inverse_dynamics_derivatives(kin, bad, x, f.A, f.B); }},
        {"derivatives qdd", [&] { inverse_dynamics_derivatives(kin, x, bad, f.A, f.B); }},
        {"branch derivatives qd", [&] { inverse_dynamics_derivatives(kin, bad, x, f.P, f.R); }},
        {"forward derivatives qd", [&] { f.derivatives.compute(kin, bad, x).ok(); }},
        {"forward derivatives qdd", [&] { f.derivatives.compute(kin, x, bad).ok(); }},
        {"factor solve", [&] { f.factor.solve(bad); }},
        {"factor L", [&] { f.factor.multiply_L(bad); }},
        {"factor LT", [&] { f.factor.multiply_LT(bad); }},
        {"factor 1/L", [&] { f.factor.solve_L(bad); }},
        {"factor 1/LT", [&] { f.factor.solve_LT(bad); }},
        {"curvature christoffel x", [&] { f.curvature.christoffel(bad, x, y); }},
        {"curvature christoffel h", [&] { f.curvature.christoffel(x, x, bad); }},
        {"covariant derivative qd", [&] { f.curvature.covariant_derivative(bad, x, x, y); }},
        {"covariant derivative V", [&] { f.curvature.covariant_derivative(x, bad, x, y); }},
        {"covariant derivative Vdot", [&] { f.curvature.covariant_derivative(x, x, bad, y); }},
        {"covariant derivative DV", [&] { f.curvature.covariant_derivative(x, x, x, bad); }},
        {"geodesic qd", [&] { f.curvature.geodesic(bad, y); }},
        {"geodesic qdd", [&] { f.curvature.geodesic(x, bad); }},
        {"curvature y", [&] { f.curvature.contract(bad, x, x, y); }},
        {"curvature w", [&] { f.curvature.contract(x, x, bad, y); }},
        {"curvature out", [&] { f.curvature.contract(x, x, x, bad); }},
        {"curvature force", [&] { f.curvature.force(x, bad, y); }},
        {"deviation", [&] { f.curvature.deviation(x, x, bad); }},
        {"curvature matrix", [&] { f.curvature.matrix(bad, f.A); }},
        {"riemann", [&] { f.curvature.riemann(x, x, x, bad); }},
        {"sectional x", [&] { f.curvature.sectional(bad, x); }},
        {"sectional y", [&] { f.curvature.sectional(x, bad); }},
        {"embedding first", [&] { f.embedding.first(bad, f.field); }},
        {"embedding second x", [&] { f.embedding.second(bad, f.field, x, f.field, x, f.acceleration); }},
        {"embedding second y", [&] { f.embedding.second(x, f.field, bad, f.field, x, f.acceleration); }},
        {"embedding second beta", [&] { f.embedding.second(x, f.field, x, f.field, bad, f.acceleration); }},
        {"embedding pull", [&] { f.embedding.pull(f.acceleration, bad); }},
        {"embedding pull second", [&] { f.embedding.pull_second(f.field, f.acceleration, bad); }},
        {"joint loads qd",
         [&] {
             joint_loads({{.q = x, .qd = bad}, kin}, forces, x);
         }},
        {"joint loads qdd",
         [&] {
             joint_loads({{.q = x, .qd = x}, kin}, forces, bad);
         }},
        {"singular pivot", [&] { singular_pivot(f.A, bad); }},
    };
}

std::vector<Door> doors_of_matrices(Fixture& f, Matrix& bad) {
    const auto& kin = f.kin;
    const Vector& x = f.x;
    return {
        {"metric", [&] { metric<double>(kin, bad); }},
        {"armatures", [&] { add_armatures<double>(f.model, bad); }},
        {"branch matrix", [&] { f.P.write(bad); }},
        {"along", [&] { f.gamma.along(x, bad); }},
        {"coriolis", [&] { f.gamma.coriolis(x, bad); }},
        {"christoffel along", [&] { christoffel_along<double>(kin, 1, bad); }},
        {"gyroscopic matrix", [&] { gyroscopic_matrix(kin, 1, 2.0, bad); }},
        {"derivatives by q", [&] { inverse_dynamics_derivatives(kin, x, x, bad, f.A); }},
        {"derivatives by qd", [&] { inverse_dynamics_derivatives(kin, x, x, f.A, bad); }},
        {"factorise", [&] { f.factor.factorise(bad).ok(); }},
        {"curvature matrix", [&] { f.curvature.matrix(x, bad); }},
        {"inverse dynamics of a batch", [&] { inverse_dynamics_batch(f.batch, bad, bad, bad, f.B); }},
        {"metrics of a batch", [&] { metric_batch(f.batch, f.A, bad); }},
    };
}

std::vector<Door> doors_of_indices(Fixture& f, int bad) {
    const auto& kin = f.kin;
    const std::vector<lagrange::BodyLoad> loads(static_cast<std::size_t>(f.n));
    return {
        {"body", [&f, bad] { f.model.body(bad); }},
        {"coordinate", [&f, bad] { f.model.coordinates()[bad]; }},
        {"rotation", [&kin, bad] { kin.rotation(bad); }},
        {"origin", [&kin, bad] { kin.origin(bad); }},
        {"axis", [&kin, bad] { kin.axis(bad); }},
        {"centre of mass", [&kin, bad] { kin.centre_of_mass(bad); }},
        {"twist", [&kin, bad] { twist_at<double>(kin, bad, Vec3::Zero()); }},
        {"basis functions of a body", [&kin, bad] { basis_functions(kin, bad, 0); }},
        {"basis functions of a coordinate", [&kin, bad] { basis_functions(kin, 0, bad); }},
        {"branch matrix row", [&f, bad] { f.P.row(bad); }},
        {"branch matrix column", [&f, bad] { f.P.column(bad); }},
        {"branch matrix (a, .)", [&f, bad] { f.P(bad, 0); }},
        {"branch matrix (., b)", [&f, bad] { f.P(0, bad); }},
        {"add (a, .)", [&f, bad] { f.P.add(bad, 0, 1.0); }},
        {"add (., b)", [&f, bad] { f.P.add(0, bad, 1.0); }},
        {"table", [&f, bad] { f.gamma.table(bad); }},
        {"path", [&f, bad] { f.gamma.path(bad); }},
        {"Gamma a", [&f, bad] { f.gamma(bad, 0, 0); }},
        {"Gamma b", [&f, bad] { f.gamma(0, bad, 0); }},
        {"Gamma c", [&f, bad] { f.gamma(0, 0, bad); }},
        {"christoffel along", [&f, bad] { christoffel_along<double>(f.kin, bad, f.A); }},
        {"gyroscopic matrix", [&f, bad] { gyroscopic_matrix(f.kin, bad, 1.0, f.A); }},
        {"factor path", [&f, bad] { f.factor.path(bad); }},
        {"factor row", [&f, bad] { f.factor.row(bad); }},
        {"factor (a, .)", [&f, bad] { f.factor(bad, 0); }},
        {"factor (., b)", [&f, bad] { f.factor(0, bad); }},
        {"factor driven", [&f, bad] { f.factor.is_driven(bad); }},
        {"forward dynamics driven", [&f, bad] { f.forward.is_driven(bad); }},
        {"sum of the metric", [&kin, bad] { lagrange::metric(kin, 0, bad); }},
        {"sum of Gamma", [&kin, bad] { lagrange::christoffel_first_kind(kin, bad, 0, 0); }},
        {"sum of forces", [&kin, bad, loads] { lagrange::generalised_force(kin, loads, bad); }},
        {"quality of a chart", [&f, bad] { chart_quality(f.model, f.x, f.model.frames().back().name, {bad}); }},
        {"Binet's tensor", [&f, bad] { f.embedding.binet(bad); }},
        {"body of the tree", [&f, bad] { f.model.index(BodyId{bad}); }},
        {"frame of a body", [&f, bad] { f.tree.frame_of(BodyId{bad}); }},
    };
}

}  // namespace

TEST_CASE("sizes: vectors of any other size are refused by every function that takes one", "[property]") {
    Fixture f;
    for (const int size : {0, 1, f.n - 1, f.n + 1, 40 * f.n}) {
        Vector bad = Vector::Zero(size);
        check_all_refused(doors_of_vectors(f, bad), text(" = ", size, ";"));
        CHECK(bad == Vector::Zero(size));
    }
    Vector right = f.x;
    for (const Door& door : doors_of_vectors(f, right)) {
        CAPTURE(door.name);
        CHECK(refusal(door.knock) == "(accepted)");
    }
}

TEST_CASE("sizes: matrices of any other shape are refused by every function that takes one", "[property]") {
    Fixture f;
    const int n = f.n;
    for (const auto& [rows, cols] : std::vector<std::pair<int, int>>{{0, 0}, {n, n - 1}, {n + 1, n}, {1, n * n}}) {
        Matrix bad = Matrix::Zero(rows, cols);
        check_all_refused(doors_of_matrices(f, bad), "; allowed: ");
        CHECK(bad == Matrix::Zero(rows, cols));
        check_refused([&] { frame_jacobian<double>(f.kin, FrameId{1}, bad); },
                      {"frame Jacobian", text("= ", rows, " x ", cols), text("6 x ", n)});
    }
}

TEST_CASE("sizes: indices out of range are refused by every function that takes one", "[property]") {
    Fixture f;
    for (const int bad : {-1, f.n, f.n + 1, 1 << 20, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
        check_all_refused(doors_of_indices(f, bad), text(bad));
    const int frames = static_cast<int>(f.model.frames().size());
    for (const int bad : {-1, frames, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
        check_all_refused({{"frame", [&] { f.model.frame(FrameId{bad}); }},
                           {"pose", [&] { pose(f.kin, FrameId{bad}); }},
                           {"Jacobian", [&] { frame_jacobian<double>(f.kin, FrameId{bad}, f.J); }},
                           {"load",
                            [&] {
                                f.system.forces.at_frame({"", FrameId{bad}, {}, WrenchAxes::frame}, f.kin);
                            }}},
                          text("frame = ", bad));
}

TEST_CASE("sizes: what was made for another model is refused, also where the sizes agree", "[property]") {
    Fixture f;
    const System other(f.tree, random_forces(f.random, f.tree));  // the same bodies in another model
    Workspace workspace(other.model);
    const Kinematics kin = kinematics(other.model, f.x, workspace);
    check_all_refused({{"workspace", [&] { kinematics(f.model, f.x, workspace); }},
                       {"metric", [&] { metric(kin, f.P); }},
                       {"derivatives", [&] { inverse_dynamics_derivatives(kin, f.x, f.x, f.P, f.R); }},
                       {"Christoffel symbols", [&] { christoffel_first_kind(kin, f.gamma); }},
                       {"factor", [&] { f.factor.factorise(kin).ok(); }},
                       {"factor of a matrix", [&] { f.factor.factorise(BranchMatrix(other.model)).ok(); }},
                       {"forward dynamics", [&] { f.forward.solve(kin, f.x, f.x, f.y, f.z); }},
                       {"forward derivatives", [&] { f.derivatives.compute(kin, f.x, f.x).ok(); }},
                       {"curvature", [&] { f.curvature.update(kin).ok(); }},
                       {"embedding", [&] { f.embedding.update(kin); }},
                       {"forces",
                        [&] {
                            f.system.forces.generalised_forces({{.q = f.x, .qd = f.x}, kin}, f.y);
                        }},
                       {"joint loads",
                        [&] {
                            joint_loads({{.q = f.x, .qd = f.x}, kin}, f.system.forces, f.x);
                        }}},
                      "belongs to another model");
    // A copy counts as the same: systems may be copied and moved with what was made for them.
    const System copy = f.system;
    Workspace of_copy(copy.model);
    const Kinematics at_copy = kinematics(copy.model, f.x, of_copy);
    CHECK(refusal([&] { f.system.forces.generalised_forces({{.q = f.x, .qd = f.x}, at_copy}, f.y); }) == "(accepted)");
}

TEST_CASE("sizes: fields, loads and derivatives of forces of another size are refused", "[property]") {
    Fixture f;
    VelocityField field = f.field;
    field.v.pop_back();
    AccelerationField acceleration = f.acceleration;
    acceleration.A.pop_back();
    ForceDerivatives of_forces = f.of_forces;
    of_forces.loads.resize(f.n, f.n - 1);
    const std::vector<lagrange::BodyLoad> loads(static_cast<std::size_t>(f.n - 1));
    check_all_refused({{"first", [&] { f.embedding.first(f.x, field); }},
                       {"second dx", [&] { f.embedding.second(f.x, field, f.x, f.field, f.x, f.acceleration); }},
                       {"second dy", [&] { f.embedding.second(f.x, f.field, f.x, field, f.x, f.acceleration); }},
                       {"second out", [&] { f.embedding.second(f.x, f.field, f.x, f.field, f.x, acceleration); }},
                       {"inner", [&] { f.embedding.inner(f.acceleration, acceleration); }},
                       {"pull", [&] { f.embedding.pull(acceleration, f.y); }},
                       {"pull second", [&] { f.embedding.pull_second(field, f.acceleration, f.y); }},
                       {"derivatives of forces", [&] { f.derivatives.compute(f.kin, f.x, f.x, &of_forces).ok(); }},
                       {"loads", [&] { lagrange::generalised_force(f.kin, loads, 0); }}},
                      "size of ");
}

TEST_CASE("sizes: a branch matrix takes no entry between branches", "[property]") {
    Tree tree;
    for (const char* name : {"left", "right"})
        tree.add_body({.name = name, .inertia = {.mass = 1, .J = Mat3::Identity()}});
    const Model model(tree);
    BranchMatrix P(model);
    check_refused([&] { P.add(0, 1, 2.0); }, {"branch matrix", "(0, 1)", "on one path"});
    CHECK(P(0, 1) == 0);
}

TEST_CASE("bad input: an empty function and a gravity that is not finite", "[property]") {
    Fixture f;
    check_refused([&] { f.batch.for_each(3, {}); }, {"batch", "function", "empty"});
    check_refused([&] { f.system.forces.with_gravity(Vec3(0, 0, std::nan(""))); }, {"gravity", "nan", "finite"});
}
