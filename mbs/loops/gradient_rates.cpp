#include "mbs/loops/gradient_rates.hpp"

#include "mbs/base/error.hpp"
#include "mbs/kernels/extent.hpp"

namespace cardan {

namespace {

constexpr double complex_step = 1e-30;
// Of differences of fourth order, in rad or over the extent of the tree: their error, h^4, and rounding, 1e-16 / h, are
// about alike.
constexpr double real_step = 1e-3;

// phi' and phi'' at a position, for rates and accelerations that do not change.
template <class S>
struct ConstraintRates {
    VectorT<S> first, second;

    ConstraintRates(const Model& model, const Loops& loops, WorkspaceT<S>& workspace, double time, const VectorT<S>& q,
                    const VectorT<S>& qd, const VectorT<S>& qdd)
        : first(loops.size()), second(loops.size()) {
        const KinematicsT<S> kin = kinematics<S>(model, q, workspace);
        MatrixT<S> G(loops.size(), model.size());
        loops.gradient<S>(kin, time, q, G);
        loops.bias<S>(kin, time, q, qd, second);
        first = G * qd;
        second += G * qdd;
        if constexpr (std::is_same_v<S, double>) {
            Vector own(loops.size());
            loops.time_rates(time, q, own);
            first += own;
        }
    }
};

}  // namespace

GradientRates::GradientRates(const Model& model, const Loops& loops)
    : model_(model), loops_(loops), complex_(model), real_(model) {}

void GradientRates::at(double time, VectorIn q, VectorIn qd, VectorIn qdd, Matrix& first, Matrix& second) {
    const Eigen::Index n = model_.size();
    constexpr const char* here = "rates of gradients";
    require_size(here, "q", q, n);
    require_size(here, "qd", qd, n);
    require_size(here, "qdd", qdd, n);
    first.setZero(loops_.size(), n);
    second.setZero(loops_.size(), n);
    const ComplexVector qd_c = qd.cast<Complex>(), qdd_c = qdd.cast<Complex>();
    ComplexVector q_c = q.cast<Complex>();
    Vector moved = q;
    const bool by_differences = !loops_.empty() && loops_.has_own_functions();
    double length = by_differences ? extent(kinematics(model_, q, real_)) : 0;
    if (!(length > 0)) length = 1;
    for (int a = 0; a < n; ++a) {
        if (!loops_.involves(a)) continue;
        if (!loops_.has_own_functions()) {
            q_c(a) += Complex(0, complex_step);
            const ConstraintRates<Complex> stepped(model_, loops_, complex_, time, q_c, qd_c, qdd_c);
            first.col(a) = stepped.first.imag() / complex_step;
            second.col(a) = stepped.second.imag() / complex_step;
            q_c(a) = q(a);
            continue;
        }
        const double h = real_step * (model_.body(a).revolute ? 1 : length);
        for (const auto& [step, weight] : {std::pair{1, 8.0}, {-1, -8.0}, {2, -1.0}, {-2, 1.0}}) {
            moved(a) = q(a) + step * h;
            const ConstraintRates<double> there(model_, loops_, real_, time, moved, qd, qdd);
            first.col(a) += weight / (12 * h) * there.first;
            second.col(a) += weight / (12 * h) * there.second;
        }
        moved(a) = q(a);
    }
}

}  // namespace cardan
