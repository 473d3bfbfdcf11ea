// Contractions of the Christoffel symbols.
#include "mbs/base/entry.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/detail/added_mass.hpp"
#include "mbs/kernels/metric.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

namespace cardan {

void Christoffel::fill_contraction(VectorIn x, VectorIn y, VectorOut& h) const {
    require_size("Christoffel symbols", "x", x, model_->size());
    require_size("Christoffel symbols", "y", y, model_->size());
    require_size("Christoffel symbols", "h", h, model_->size());
    h.setZero();
    for (int m = 0; m < model_->size(); ++m) {
        const std::span<const int> on_path = path(m);
        const std::size_t d = on_path.size(), width = stride(m);
        const std::span<const double> K = table(m);
        double reaction = 0;
        for (std::size_t i = 0; i < d; ++i) {
            const int a = on_path[i];
            // Gamma_abm summed over b < a and over a <= b < m: the first sum serves Gamma_mba = -K(a, b) too.
            double x_below = 0, y_below = 0, x_above = 0, y_above = 0;
            for (std::size_t j = 0; j < i; ++j) {
                x_below += K[i * width + j] * x(on_path[j]);
                y_below += K[i * width + j] * y(on_path[j]);
            }
            for (std::size_t j = i; j + 1 < d; ++j) {
                x_above += K[i * width + j] * x(on_path[j]);
                y_above += K[i * width + j] * y(on_path[j]);
            }
            h(a) += (x_below + x_above) * y(m) + (y_below + y_above) * x(m) + K[i * width + d - 1] * x(m) * y(m);
            if (a != m) reaction -= x_below * y(a) + y_below * x(a) + K[i * width + i] * x(a) * y(a);
        }
        h(m) += reaction;
    }
}

void Christoffel::fill_along(VectorIn x, MatrixOut& X) const {
    require_size("Christoffel symbols", "x", x, model_->size());
    require_size("Christoffel symbols", "X", X, model_->size(), model_->size());
    X.setZero();
    for (int m = 0; m < model_->size(); ++m) {
        const std::span<const int> on_path = path(m);
        const std::size_t d = on_path.size(), width = stride(m);
        const std::span<const double> K = table(m);
        // Rows of the table: X_am = Gamma_amb x^b and X_ma = Gamma_mab x^b = -K(a, b) x^b, b <= a.
        for (std::size_t i = 0; i + 1 < d; ++i) {
            double below = 0, above = 0;
            for (std::size_t j = 0; j <= i; ++j) below += K[i * width + j] * x(on_path[j]);
            for (std::size_t j = i + 1; j < d; ++j) above += K[i * width + j] * x(on_path[j]);
            X(on_path[i], m) += below + above;
            X(m, on_path[i]) -= below;
        }
        // Columns: X_ab = Gamma_abm x^m and X_mb = Gamma_mba x^a = -K(a, b) x^a, b < a.
        for (std::size_t j = 0; j + 1 < d; ++j) {
            const int b = on_path[j];
            double beyond = 0;
            for (std::size_t i = 0; i + 1 < d; ++i) {
                X(on_path[i], b) += K[i * width + j] * x(m);
                if (i > j) beyond += K[i * width + j] * x(on_path[i]);
            }
            X(m, b) -= beyond;
        }
    }
}

namespace {

// What the table K_m(a, b) = v_a . M (w_b x v_m) + w_a . ((P w_b) x w_m) needs of the distal body m.
template <class S>
struct Distal {
    Distal(const KinematicsT<S>& kin, int m)
        : M(entry(kin.arrays().composite, m).M),
          C(entry(kin.arrays().composite, m).C.vector()),
          P(entry(kin.arrays().composite, m).P.matrix()),
          own(own_twist_at(kin, m, C)) {}

    // For a row b: K_m(a, b) = v_a . f + w_a . t.
    PointTwist<S> column(const PointTwist<S>& b) const { return {cross<S>(P * b.w, own.w), M * cross<S>(b.w, own.v)}; }
    // For a column a: K_m(a, b) = w_b . (v_m x M v_a + P (w_m x w_a)).
    Vec3T<S> row(const PointTwist<S>& a) const { return cross<S>(own.v, M * a.v) + P * cross<S>(own.w, a.w); }

    S M;
    Vec3T<S> C;
    Mat3T<S> P;
    PointTwist<S> own;
};

template <class S>
S product(const PointTwist<S>& a, const PointTwist<S>& wrench) {
    return dot<S>(a.v, wrench.v) + dot<S>(a.w, wrench.w);
}

// The same of added mass, K_m(a, b) = S_a . B S_b.
template <class S>
void add_added_mass_along(const KinematicsT<S>& kin, int s, MatrixOutT<S>& X) {
    const Model& model = kin.model();
    for (const auto& at : kin.arrays().entraining) {
        const int m = at.body;
        if (!model.precedes(s, m)) continue;
        const Vec3T<S> o = entry(kin.arrays().frame, m).o.vector();
        const Mat6T<S> B = coriolis_inertia<S>(at.I, twist_column(kin, m, o));
        const Vec6T<S> spin = twist_column(kin, s, o), column = B * spin, row = B.transpose() * spin;
        for (int a = own_parent(model, m); a >= 0; a = own_parent(model, a)) {
            const Vec6T<S> twist = twist_column(kin, a, o);
            if (m == s) {
                for (int b = s; b >= 0; b = own_parent(model, b))
                    X(a, b) += work<S>(twist, B * twist_column(kin, b, o));
                continue;
            }
            const S K_as = work<S>(twist, column);
            X(a, m) += K_as;
            X(m, a) -= a <= s ? work<S>(twist, row) : K_as;
        }
    }
}

}  // namespace

template <class S>
void christoffel_along(const KinematicsT<S>& kin, int s, MatrixOutT<S> X) {
    const Model& model = kin.model();
    require_index("Christoffel symbols", "coordinate", s, model.size());
    require_size("Christoffel symbols", "X", X, model.size(), model.size());
    composites(kin);
    X.setZero();
    const Distal<S> at_s(kin, s);
    for (int b = s; b >= 0; b = own_parent(model, b)) {  // Gamma_abs = K_s(a, b), zero for a = s
        const PointTwist<S> column = at_s.column(own_twist_at(kin, b, at_s.C));
        for (int a = own_parent(model, s); a >= 0; a = own_parent(model, a))
            X(a, b) = product(own_twist_at(kin, a, at_s.C), column);
    }
    for (int m = s + 1; m < model.body(s).subtree_end; ++m) {
        const Distal<S> at_m(kin, m);
        const PointTwist<S> spin = own_twist_at(kin, s, at_m.C), column = at_m.column(spin);
        const Vec3T<S> row = at_m.row(spin);
        for (int a = own_parent(model, m); a >= 0; a = own_parent(model, a)) {
            const PointTwist<S> t = own_twist_at(kin, a, at_m.C);
            const S K_as = product(t, column);
            X(a, m) = K_as;                                      // Gamma_ams = K_m(a, s)
            X(m, a) = a <= s ? S(-dot<S>(t.w, row)) : S(-K_as);  // Gamma_mas = -K_m(s, a) or -K_m(a, s)
        }
    }
    add_added_mass_along(kin, s, X);
}

void gyroscopic_matrix(const Kinematics& kin, int s, double omega, MatrixOut G) {
    christoffel_along<double>(kin, s, G);
    for (Eigen::Index b = 0; b < G.cols(); ++b) {
        for (Eigen::Index a = 0; a < b; ++a) {
            const double skew = omega * (G(a, b) - G(b, a));
            G(a, b) = skew;
            G(b, a) = -skew;
        }
        G(b, b) = 0;
    }
}

template void christoffel_along<double>(const KinematicsT<double>&, int, MatrixOutT<double>);
template void christoffel_along<Complex>(const KinematicsT<Complex>&, int, MatrixOutT<Complex>);

}  // namespace cardan
