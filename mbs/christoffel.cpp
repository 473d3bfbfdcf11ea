#include "mbs/christoffel.hpp"

#include "mbs/metric.hpp"

#include <algorithm>

namespace cardan {

Christoffel::Christoffel(const Model& model) : model_(&model) {
    std::size_t values = 0, deepest = 0;
    for (int m = 0; m < model.size(); ++m) {
        const std::size_t d = static_cast<std::size_t>(model.body(m).depth);
        value_offset_.push_back(values);
        path_offset_.push_back(paths_.size());
        values += d * d;
        deepest = std::max(deepest, d);
        for (int a = m; a >= 0; a = model.body(a).parent) paths_.push_back(a);
        std::reverse(paths_.end() - static_cast<std::ptrdiff_t>(d), paths_.end());
    }
    values_.assign(values, 0.0);
    for (auto* v : {&w_, &v_, &f_, &t_}) v->resize(deepest);
}

std::span<const double> Christoffel::table(int m) const {
    const std::size_t d = static_cast<std::size_t>(model_->body(m).depth);
    return {values_.data() + value_offset_[static_cast<std::size_t>(m)], d * d};
}

std::span<const int> Christoffel::path(int m) const {
    return {paths_.data() + path_offset_[static_cast<std::size_t>(m)], static_cast<std::size_t>(model_->body(m).depth)};
}

double Christoffel::operator()(int a, int b, int c) const {
    if (b > c) std::swap(b, c);
    const int m = std::max(a, c);
    if (!model_->precedes(a, m) || !model_->precedes(b, m) || !model_->precedes(c, m)) return 0;
    const auto at = [&](int row, int column) {
        const std::size_t d = static_cast<std::size_t>(model_->body(m).depth);
        return table(m)[static_cast<std::size_t>(model_->body(row).depth - 1) * d +
                        static_cast<std::size_t>(model_->body(column).depth - 1)];
    };
    return m == c ? at(a, b) : -at(c, b);
}

void Christoffel::contract(VectorIn qd, VectorOut h) const {
    h.setZero();
    for (int m = 0; m < model_->size(); ++m) {
        const std::span<const int> on_path = path(m);
        const std::size_t d = on_path.size();
        const std::span<const double> K = table(m);
        double reaction = 0;
        for (std::size_t i = 0; i < d; ++i) {
            const int a = on_path[i];
            double proximal = 0;  // sum over b < m; b = m enters once, b and c distinct twice
            for (std::size_t j = 0; j + 1 < d; ++j) proximal += K[i * d + j] * qd(on_path[j]);
            h(a) += (2 * proximal + K[i * d + d - 1] * qd(m)) * qd(m);
            if (a == m) continue;
            double below = 0;  // Gamma_mab = -K(a, b), b <= a < m
            for (std::size_t j = 0; j < i; ++j) below += K[i * d + j] * qd(on_path[j]);
            reaction -= (2 * below + K[i * d + i] * qd(a)) * qd(a);
        }
        h(m) += reaction;
    }
}

void Christoffel::coriolis(VectorIn qd, MatrixOut C) const {
    C.setZero();
    for (int m = 0; m < model_->size(); ++m) {
        const std::span<const int> on_path = path(m);
        const std::size_t d = on_path.size();
        const std::span<const double> K = table(m);
        for (std::size_t i = 0; i < d; ++i) {
            const int a = on_path[i];
            for (std::size_t j = 0; j < d; ++j) {
                const int b = on_path[j];
                C(a, m) += K[i * d + j] * qd(b);              // Gamma_abm qd^b
                if (b != m) C(a, b) += K[i * d + j] * qd(m);  // Gamma_amb qd^m
            }
            if (a == m) continue;
            for (std::size_t j = 0; j <= i; ++j) {
                const int b = on_path[j];
                C(m, a) -= K[i * d + j] * qd(b);  // Gamma_mba qd^b
                if (b != a) C(m, b) -= K[i * d + j] * qd(a);
            }
        }
    }
}

void christoffel_first_kind(const Kinematics& kin, Christoffel& gamma) {
    composites(kin);
    const Workspace& ws = kin.workspace();
    for (int m = 0; m < kin.model().size(); ++m) {
        const std::size_t i = static_cast<std::size_t>(m);
        const std::span<const int> path = gamma.path(m);
        const std::size_t d = path.size();
        for (std::size_t j = 0; j < d; ++j) {
            const PointTwist<double> twist = twist_at(kin, path[j], ws.C[i]);
            gamma.w_[j] = twist.w;
            gamma.v_[j] = twist.v;
        }
        // A prismatic b has w = 0, which makes f and t and so the whole column vanish: the factor (1 - s_b).
        for (std::size_t j = 0; j < d; ++j) {
            gamma.f_[j] = ws.M[i] * cross<double>(gamma.w_[j], gamma.v_[d - 1]);
            gamma.t_[j] = cross<double>(ws.P[i] * gamma.w_[j], gamma.w_[d - 1]);
        }
        double* K = gamma.values_.data() + gamma.value_offset_[i];
        for (std::size_t a = 0; a < d; ++a)
            for (std::size_t b = 0; b < d; ++b)
                *K++ = dot<double>(gamma.v_[a], gamma.f_[b]) + dot<double>(gamma.w_[a], gamma.t_[b]);
    }
}

}  // namespace cardan
