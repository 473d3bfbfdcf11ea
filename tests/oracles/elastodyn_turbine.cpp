#include "tests/oracles/elastodyn_turbine.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/jet.hpp"

#include <algorithm>
#include <numbers>

namespace cardan::oracles {

namespace {

using std::numbers::pi;
constexpr int local = 8, all = 14;  // tower 4, shaft, three shapes of one blade; of three
using J = Jet<local + 1>;           // the last variable is the azimuth
using V = std::array<J, 3>;
using Local = Eigen::Matrix<double, local, 1>;
using Block = Eigen::Matrix<double, local, local>;
using Full = Eigen::Matrix<double, all, all>;
using Column = Eigen::Matrix<double, all, 1>;

V operator+(const V& a, const V& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
V operator*(const J& s, const V& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
V cross(const V& a, const V& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
    std::size_t i = 1;
    while (i + 1 < x.size() && at > x[i]) ++i;
    return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
}

double polynomial(const ElastodynTurbine::Polynomial& p, double s, int derivative) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const int n = static_cast<int>(i) + 2;
        double term = p.at(i) * std::pow(s, n - derivative);
        for (int k = 0; k < derivative; ++k) term *= n - k;
        sum += term;
    }
    return sum;
}

// A lump of a beam: deflection, slope and drawing-in by the shapes.
struct Lump {
    double mass, x;
    Eigen::MatrixXd shape, slope;  // two directions across, one column per shape
    Eigen::MatrixXd drawn_in;      // int slope^T slope dx
};

struct Beam {
    std::vector<Lump> lumps;
    Eigen::MatrixXd stiffness;
};

Beam blade_of(const ElastodynTurbine::Blade& b) {
    const double L = b.x.back(), h = L / b.elements;
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(2, 3), sum = slope, drawn = Eigen::MatrixXd::Zero(3, 3);
    Beam beam{{}, drawn};
    for (int k = 0; k < b.elements; ++k) {
        const double x = (k + 0.5) * h, angle = interpolated(b.x, b.twist, x);
        Eigen::MatrixXd curvature(2, 3);  // downwind, towards the trailing edge
        Eigen::Vector3d own;
        for (int s = 0; s < 3; ++s) {
            own(s) = polynomial(b.shapes.at(static_cast<std::size_t>(s)), x / L, 2) / (L * L);
            const double c = std::cos(angle), d = std::sin(angle);
            curvature.col(s) = own(s) * (s < 2 ? Eigen::Vector2d(c, -d) : Eigen::Vector2d(d, c));
        }
        const Eigen::MatrixXd here = slope + h / 2 * curvature;
        const Eigen::MatrixXd square = here.transpose() * here;
        beam.lumps.push_back({interpolated(b.x, b.mass, x) * h, x, sum + h / 2 * here, here, drawn + h / 2 * square});
        slope += h * curvature;
        sum += h * here;
        drawn += h * square;
        const Eigen::Vector2d flap = own.head<2>();
        beam.stiffness.topLeftCorner(2, 2) += interpolated(b.x, b.EI_flap, x) * h * flap * flap.transpose();
        beam.stiffness(2, 2) += interpolated(b.x, b.EI_edge, x) * h * own(2) * own(2);
    }
    return beam;
}

// The last lump is the top, without mass. Directions: downwind, lateral.
Beam tower_of(const ElastodynTurbine::Tower& t) {
    const double H = t.height.back(), h = H / t.elements;
    Eigen::MatrixXd drawn = Eigen::MatrixXd::Zero(4, 4);
    Beam beam{{}, drawn};
    const auto at = [&](double x, int derivative) {
        Eigen::MatrixXd value = Eigen::MatrixXd::Zero(2, 4);
        for (int s = 0; s < 4; ++s)
            value(s / 2, s) =
                polynomial(t.shapes.at(static_cast<std::size_t>(s)), x / H, derivative) / std::pow(H, derivative);
        return value;
    };
    for (int k = 0; k < t.elements; ++k) {
        const double x = (k + 0.5) * h;
        const Eigen::MatrixXd slope = at(x, 1), curvature = at(x, 2);
        const Eigen::MatrixXd square = slope.transpose() * slope;
        beam.lumps.push_back({interpolated(t.height, t.mass, x) * h, x, at(x, 0), slope, drawn + h / 2 * square});
        drawn += h * square;
        beam.stiffness += interpolated(t.height, t.EI, x) * h * curvature.transpose() * curvature;
    }
    beam.lumps.push_back({0, H, at(H, 0), at(H, 1), drawn});
    return beam;
}

struct Machine {
    const ElastodynTurbine& data;
    Beam tower = tower_of(data.tower), blade = blade_of(data.blade);

    static J linear(const Eigen::RowVectorXd& row, const J* q) {
        J sum;
        for (Eigen::Index i = 0; i < row.size(); ++i) sum = sum + row(i) * q[i];
        return sum;
    }
    static J quadratic(const Eigen::MatrixXd& A, const J* q) {
        J sum;
        for (Eigen::Index i = 0; i < A.rows(); ++i) sum = sum + q[i] * linear(A.row(i), q);
        return sum;
    }
    V on_tower(const Lump& l, const J* q) const {
        return {linear(l.shape.row(0), q), linear(l.shape.row(1), q), l.x - 0.5 * quadratic(l.drawn_in, q)};
    }

    // Vectors of the head turn with the slope of the tower top, to second order.
    V turned(const V& a, const J* q) const {
        const Lump& top = tower.lumps.back();
        const V theta{-linear(top.slope.row(1), q), linear(top.slope.row(0), q), J(0)};
        const V once = cross(theta, a);
        return a + once + 0.5 * cross(theta, once);
    }

    struct Axes {
        V origin, shaft, radial, lateral;
    };
    // A point of a blade at psi + phase, in the head; then turned.
    Axes rotor(const J* q, double phase) const {
        const V shaft{std::cos(data.tilt), 0, -std::sin(data.tilt)}, up{std::sin(data.tilt), 0, std::cos(data.tilt)},
            side{0, 1, 0};
        const J angle = q[local] + q[4] + phase;
        const J c = cos(angle), s = sin(angle);
        // The rotor turns clockwise seen from upwind: up goes to -side.
        const V radial = c * up + (-s) * side, lateral = s * up + c * side;
        V apex = J(-data.overhang) * shaft;
        apex[2] = apex[2] + data.shaft_height;
        return {on_tower(tower.lumps.back(), q) + turned(apex, q), turned(shaft, q), turned(radial, q),
                turned(lateral, q)};
    }

    // Calls add(mass, position) for every point of tower, nacelle and hub, or of one blade.
    template <class Add>
    void fixed_points(const J* q, const Add& add) const {
        for (const Lump& l : tower.lumps)
            if (l.mass > 0) add(l.mass, on_tower(l, q));
        const V top = on_tower(tower.lumps.back(), q);
        const V centre{data.nacelle_x, 0, data.nacelle_z};
        add(data.nacelle_mass, top + turned(centre, q));
        const V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
        about_third(data.nacelle_inertia, top + turned(centre, q), turned(x, q), turned(y, q), turned(z, q), add);
        const Axes r = rotor(q, 0);
        add(data.hub_mass, r.origin);
        about_third(data.hub_inertia, r.origin, r.radial, r.lateral, r.shaft, add);
    }
    // An inertia about one axis alone: points on three axes, those on the third with negative mass; 2 J + 2 J - 2 J.
    template <class Add>
    static void about_third(double inertia, const V& at, const V& x, const V& y, const V& z, const Add& add) {
        for (const double side : {-1.0, 1.0}) {
            add(inertia / 4, at + J(side) * x);
            add(inertia / 4, at + J(side) * y);
            add(-inertia / 4, at + J(side) * z);
        }
        add(-inertia / 2, at);
    }
    template <class Add>
    void blade_points(const J* q, double phase, const Add& add) const {
        const Axes r = rotor(q, phase);
        const J c = std::cos(data.blade.cone), s = std::sin(data.blade.cone);
        const V along = c * r.radial + s * r.shaft, flap = c * r.shaft + (-s) * r.radial;
        for (const Lump& l : blade.lumps) {
            const J out = linear(l.shape.row(0), q + 5), in = linear(l.shape.row(1), q + 5),
                    far = data.blade.root_radius + l.x - 0.5 * quadratic(l.drawn_in, q + 5);
            add(l.mass, r.origin + far * along + out * flap + in * r.lateral);
        }
    }

    struct State {
        Local q, v, a;
    };
    struct Inertial {
        Local force = Local::Zero();  // sum m r_a . (r'' - g)
        Block M = Block::Zero(), C = Block::Zero();
    };
    Inertial inertial(const State& s, double psi, double speed, int of_blade) const {
        std::array<J, local + 1> q;
        for (int i = 0; i < local; ++i) q.at(static_cast<std::size_t>(i)) = J::variable(s.q(i), i);
        q[local] = J::variable(psi, local);
        Eigen::Matrix<double, local + 1, 1> rate;
        rate << s.v, speed;
        Inertial sum;
        const auto add = [&](double mass, const V& r) {
            for (int c = 0; c < 3; ++c) {
                const J& x = r.at(static_cast<std::size_t>(c));
                const Local to = x.gradient.template head<local>();
                const Local coupled = (x.hessian * rate).template head<local>();
                const double acceleration = to.dot(s.a) + rate.dot(x.hessian * rate) + (c == 2 ? data.gravity : 0.0);
                sum.force += mass * acceleration * to;
                sum.M += mass * to * to.transpose();
                sum.C += 2 * mass * to * coupled.transpose();
            }
        };
        if (of_blade < 0)
            fixed_points(q.data(), add);
        else
            blade_points(q.data(), 2 * pi * of_blade / 3, add);
        return sum;
    }

    // Rows of the whole that a part has.
    static int row(int i, int of_blade) { return i < 5 ? i : 5 + 3 * std::max(of_blade, 0) + i - 5; }
    static Local part(const Column& x, int of_blade) {
        Local y;
        for (int i = 0; i < local; ++i) y(i) = x(row(i, of_blade));
        return y;
    }

    struct Linear {
        Column residual = Column::Zero();
        Full M = Full::Zero(), C = Full::Zero(), K = Full::Zero();
    };
    Linear linear_at(const Column& q, const Column& v, const Column& a, double psi, double speed) const {
        Linear sum;
        sum.K.topLeftCorner(4, 4) = tower.stiffness;
        sum.K(4, 4) = data.shaft_stiffness;
        for (int k = 0; k < 3; ++k) sum.K.block(5 + 3 * k, 5 + 3 * k, 3, 3) = blade.stiffness;
        sum.residual = sum.K * q;
        for (int k = -1; k < 3; ++k) {
            State s{part(q, k), part(v, k), part(a, k)};
            const Inertial here = inertial(s, psi, speed, k);
            Block K;  // by central differences, which are good to 1e-8 for these functions
            for (int j = 0; j < local; ++j) {
                const double step = j == 4 ? 1e-4 : 1e-3, at = s.q(j);
                s.q(j) = at + step;
                const Local after = inertial(s, psi, speed, k).force;
                s.q(j) = at - step;
                K.col(j) = (after - inertial(s, psi, speed, k).force) / (2 * step);
                s.q(j) = at;
            }
            const int count = k < 0 ? 5 : local;
            for (int i = 0; i < count; ++i) {
                sum.residual(row(i, k)) += here.force(i);
                for (int j = 0; j < count; ++j) {
                    sum.M(row(i, k), row(j, k)) += here.M(i, j);
                    sum.C(row(i, k), row(j, k)) += here.C(i, j);
                    sum.K(row(i, k), row(j, k)) += K(i, j);
                }
            }
        }
        return sum;
    }
};

// q = T z and its derivatives by the azimuth.
Full multi_blade(double psi, int derivative) {
    Full T = Full::Zero();
    if (derivative == 0) T.topLeftCorner(5, 5).setIdentity();
    for (int k = 0; k < 3; ++k) {
        const double at = psi + 2 * pi * k / 3 + derivative * pi / 2;
        for (int s = 0; s < 3; ++s) {
            if (derivative == 0) T(5 + 3 * k + s, 5 + s) = 1;
            T(5 + 3 * k + s, 8 + s) = std::cos(at);
            T(5 + 3 * k + s, 11 + s) = std::sin(at);
        }
    }
    return T;
}

Machine::Linear mean(const Machine& machine, const Column& z, double speed, int azimuths) {
    Machine::Linear sum;
    const int count = speed == 0 ? 1 : azimuths;
    for (int i = 0; i < count; ++i) {
        const double psi = 2 * pi * i / count;
        const Full T = multi_blade(psi, 0), T1 = speed * multi_blade(psi, 1), T2 = speed * speed * multi_blade(psi, 2);
        const Machine::Linear here = machine.linear_at(T * z, T1 * z, T2 * z, psi, speed);
        sum.residual += T.transpose() * here.residual / count;
        sum.M += T.transpose() * here.M * T / count;
        sum.C += T.transpose() * (2 * here.M * T1 + here.C * T) / count;
        sum.K += T.transpose() * (here.M * T2 + here.C * T1 + here.K * T) / count;
    }
    return sum;
}

}  // namespace

ElastodynTurbine::Modes ElastodynTurbine::modes(double rotor_speed, int azimuths) const {
    const Machine machine{*this};
    Column z = Column::Zero();  // the steady state is constant in multi-blade coordinates but for small 3 per rev
    Machine::Linear system = mean(machine, z, rotor_speed, azimuths);
    for (int i = 0; i < 2; ++i) {
        z -= Eigen::MatrixXd(system.K).completeOrthogonalDecomposition().solve(Eigen::VectorXd(system.residual));
        system = mean(machine, z, rotor_speed, azimuths);
    }
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * all, 2 * all);
    const Eigen::PartialPivLU<Eigen::MatrixXd> M(system.M);
    A.topRightCorner(all, all).setIdentity();
    A.bottomLeftCorner(all, all) = -M.solve(system.K);
    A.bottomRightCorner(all, all) = -M.solve(system.C);
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
    std::vector<std::pair<double, Eigen::Index>> found;
    for (Eigen::Index i = 0; i < 2 * all; ++i)
        if (solver.eigenvalues()(i).imag() > 0) found.emplace_back(std::abs(solver.eigenvalues()(i)) / (2 * pi), i);
    std::sort(found.begin(), found.end());
    Modes result{Eigen::VectorXd(found.size()), Eigen::MatrixXd(all, found.size())};
    for (std::size_t i = 0; i < found.size(); ++i) {
        result.hz(static_cast<Eigen::Index>(i)) = found[i].first;
        result.shapes.col(static_cast<Eigen::Index>(i)) =
            solver.eigenvectors().col(found[i].second).head(all).cwiseAbs();
    }
    return result;
}

}  // namespace cardan::oracles
