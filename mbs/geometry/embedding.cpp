#include "mbs/geometry/embedding.hpp"

#include "mbs/base/error.hpp"
#include "mbs/kernels/composites.hpp"
#include "mbs/kernels/registers/kernel_arrays.hpp"

namespace cardan {

namespace {

// int y x z dV from the moments B = int y z^T dV.
Vec3 axial(const Mat3& B) {
    return {B(1, 2) - B(2, 1), B(2, 0) - B(0, 2), B(0, 1) - B(1, 0)};
}

constexpr const char* in_embedding = "embedding";

void require_field(const char* what, const VelocityField& field, std::size_t n) {
    require_count(in_embedding, what, field.w.size(), n);
    require_count(in_embedding, what, field.v.size(), n);
}
void require_field(const char* what, const AccelerationField& field, std::size_t n) {
    require_count(in_embedding, what, field.a.size(), n);
    require_count(in_embedding, what, field.A.size(), n);
    require_size(in_embedding, what, field.beta, static_cast<Eigen::Index>(n));
}

}  // namespace

Embedding::Embedding(const Model& model) : model_(&model) {
    if (!model.added_masses().empty())
        throw InputError("embedding", "bodies with added mass", model.added_masses().size(),
                         "0: their metric is not that of mass points");
    const std::size_t n = static_cast<std::size_t>(model.size());
    binet_.resize(n);
    for (auto* v : {&alpha_, &F_, &N_, &X_, &places_.e, &places_.o, &places_.r}) v->resize(n);
}

VelocityField Embedding::velocity_field() const {
    return {std::vector<Vec3>(binet_.size()), std::vector<Vec3>(binet_.size())};
}

AccelerationField Embedding::acceleration_field() const {
    return {std::vector<Vec3>(binet_.size()), std::vector<Mat3>(binet_.size()), Vector::Zero(model_->size())};
}

void Embedding::update(const Kinematics& kin) {
    require_model(in_embedding, "kinematics", kin.model().serial(), model_->serial());
    body_inertias(kin);
    const KernelArrays& arrays = kin.arrays();
    for (std::size_t i = 0; i < binet_.size(); ++i) {
        binet_[i] = cardan::binet(arrays.J[i]).matrix();
        places_.e[i] = arrays.frame[i].E[2].vector();
        places_.o[i] = arrays.frame[i].o.vector();
        places_.r[i] = arrays.frame[i].r.vector();
    }
}

void Embedding::first(VectorIn x, VelocityField& out) const {
    require_size(in_embedding, "x", x, model_->size());
    require_field("velocity field", out, binet_.size());
    for (int k = 0; k < model_->size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        if (body.parent < 0) {
            out.w[i].setZero();
            out.v[i].setZero();
        } else {
            const std::size_t p = static_cast<std::size_t>(body.parent);
            out.w[i] = out.w[p];
            out.v[i] = out.v[p] + cross<double>(out.w[p], places_.o[i] - places_.o[p]);
        }
        (body.revolute ? out.w[i] : out.v[i]) += places_.e[i] * x(k);
    }
}

// alpha = d_y w^x in w^x x s, whose derivative along y is alpha x s + w^x x (w^y x s): A = alpha^ + w^x^ w^y^.
void Embedding::second(VectorIn x, const VelocityField& dx, VectorIn y, const VelocityField& dy, VectorIn beta,
                       AccelerationField& out) {
    require_size(in_embedding, "x", x, model_->size());
    require_size(in_embedding, "y", y, model_->size());
    require_size(in_embedding, "beta", beta, model_->size());
    require_field("velocity field dx", dx, binet_.size());
    require_field("velocity field dy", dy, binet_.size());
    require_field("acceleration field", out, binet_.size());
    out.beta = beta;
    for (int k = 0; k < model_->size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        if (body.parent < 0) {
            alpha_[i].setZero();
            out.a[i].setZero();
        } else {
            const std::size_t p = static_cast<std::size_t>(body.parent);
            alpha_[i] = alpha_[p];
            out.a[i] = out.a[p] + out.A[p] * (places_.o[i] - places_.o[p]);
        }
        // w x e is that of the parent, for w of the body differs by a multiple of e only.
        const Vec3 e_y = cross<double>(dy.w[i], places_.e[i]);
        if (body.revolute)
            alpha_[i] += e_y * x(k) - places_.e[i] * beta(k);
        else
            out.a[i] += cross<double>(dx.w[i], places_.e[i]) * y(k) + e_y * x(k) - places_.e[i] * beta(k);
        out.A[i] = skew<double>(dx.w[i]) * skew<double>(dy.w[i]) + skew<double>(alpha_[i]);
    }
}

double Embedding::inner(const AccelerationField& F, const AccelerationField& G) const {
    require_field("acceleration field F", F, binet_.size());
    require_field("acceleration field G", G, binet_.size());
    double sum = 0;
    for (int k = 0; k < model_->size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Vec3 c = places_.r[i] - places_.o[i];
        const Vec3 at_F = F.a[i] + F.A[i] * c, at_G = G.a[i] + G.A[i] * c;
        const Mat3 AP = F.A[i] * binet_[i];
        sum += model_->body(k).inertia.mass * dot<double>(at_F, at_G) + AP.cwiseProduct(G.A[i]).sum();
    }
    for (const Model::Spin& armature : model_->armatures()) {
        double f = 0, g = 0;
        for (const auto& [a, s] : armature.spin) {
            f += s * F.beta(a);
            g += s * G.beta(a);
        }
        sum += armature.inertia * f * g;
    }
    return sum;
}

// F = int rho F dV and N = int rho (x - o) x F dV of every body by itself.
void Embedding::loads(const AccelerationField& field) {
    require_field("acceleration field", field, binet_.size());
    for (int k = 0; k < model_->size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Vec3 c = places_.r[i] - places_.o[i];
        F_[i] = model_->body(k).inertia.mass * (field.a[i] + field.A[i] * c);
        N_[i] = axial(binet_[i] * field.A[i].transpose()) + cross<double>(c, F_[i]);
    }
}

void Embedding::pull(const AccelerationField& field, VectorOut out) {
    require_size(in_embedding, "out", out, model_->size());
    loads(field);
    for (int k = model_->size() - 1; k >= 0; --k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        out(k) = dot<double>(places_.e[i], body.revolute ? N_[i] : F_[i]);
        if (body.parent < 0) continue;
        const std::size_t p = static_cast<std::size_t>(body.parent);
        F_[p] += F_[i];
        N_[p] += N_[i] + cross<double>(places_.o[i] - places_.o[p], F_[i]);
    }
}

// r_a changes along z by e' x (x - o_a) + e x (v - v_o) or, prismatic, by e', with e' = w^z x e. X is the sum of
// int rho (v - v_o) x F dV.
void Embedding::pull_second(const VelocityField& dz, const AccelerationField& field, VectorOut out) {
    require_field("velocity field dz", dz, binet_.size());
    require_size(in_embedding, "out", out, model_->size());
    loads(field);
    for (int k = 0; k < model_->size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Mat3 PA = binet_[i] * field.A[i].transpose();
        X_[i] = axial(skew<double>(dz.w[i]) * PA) +
                cross<double>(cross<double>(dz.w[i], places_.r[i] - places_.o[i]), F_[i]);
    }
    for (int k = model_->size() - 1; k >= 0; --k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        const Vec3 turned = cross<double>(dz.w[i], places_.e[i]);
        out(k) =
            body.revolute ? dot<double>(turned, N_[i]) + dot<double>(places_.e[i], X_[i]) : dot<double>(turned, F_[i]);
        if (body.parent < 0) continue;
        const std::size_t p = static_cast<std::size_t>(body.parent);
        F_[p] += F_[i];
        N_[p] += N_[i] + cross<double>(places_.o[i] - places_.o[p], F_[i]);
        X_[p] += X_[i] + cross<double>(dz.v[i] - dz.v[p], F_[i]);
    }
}

}  // namespace cardan
