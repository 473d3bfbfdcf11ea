#include "elements/cardan_beam/damping.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"

namespace cardan {

BeamDamping BeamDamping::ratio_at(double ratio, double frequency_hz) {
    if (!(ratio >= 0 && std::isfinite(ratio) && frequency_hz > 0 && std::isfinite(frequency_hz)))
        throw InputError("beam damping", "ratio at frequency [Hz]", text(ratio, " at ", frequency_hz),
                         "finite, ratio >= 0, frequency > 0");
    return rayleigh(0, ratio / (pi * frequency_hz));
}

BeamDamping BeamDamping::rayleigh(double alpha, double beta) {
    BeamDamping damping;
    damping.mass_proportional = alpha;
    damping.time_constants.fill(beta);
    return damping;
}

BeamDamping BeamDamping::of_modes(ModalRatios ratios) {
    BeamDamping damping;
    damping.modal = std::move(ratios);
    return damping;
}

void BeamDamping::check(const std::string& where) const {
    for (double tau : time_constants) require_not_negative(where, "damping time constant [s]", tau);
    require_not_negative(where, "mass-proportional damping [1/s]", mass_proportional);
    const std::vector<double>* lists[] = {&modal.all, &modal.bending_y, &modal.bending_z, &modal.torsion,
                                          &modal.extension};
    for (const std::vector<double>* list : lists)
        for (double ratio : *list)
            if (!(ratio >= 0 && ratio < 1))
                throw InputError(where, "modal damping ratio", ratio, "0 <= ratio < 1 (given in percent?)");
    ModalRatios by_direction = modal;
    by_direction.all.clear();
    if (!modal.all.empty() && !by_direction.empty())
        throw InputError(text(where, ": modal damping is given for all modes and by direction; allowed: one of them"));
}

Mat6 dissipation(const BeamSection& section, const std::array<double, 6>& time_constants) {
    const Mat3 R = rot_x(section.beta).transpose();
    Mat6 X = Mat6::Zero();
    X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = R;
    const Mat6 S = X * section.compliance * X.transpose();
    Vec6 scale, root;
    for (Eigen::Index i = 0; i < 6; ++i) {
        scale(i) = S(i, i) > 0 ? std::sqrt(S(i, i)) : 1.0;
        root(i) = std::sqrt(entry(time_constants, i));
    }
    const Vec6 inverse = scale.cwiseInverse();
    const Mat6 unit = inverse.asDiagonal() * S * inverse.asDiagonal();
    // Rigid directions have no stiffness: the generalised inverse leaves out strains that follow from others (shear due
    // to twist about an offset shear centre). Torsion and bending are taken first, so they keep their own coefficient.
    std::vector<Eigen::Index> kept;
    for (const Eigen::Index i : {3, 4, 5, 1, 2, 0}) {
        double left = unit(i, i);  // what does not follow from those kept
        if (!kept.empty()) {
            const Vector beside = unit(kept, i);
            left -= beside.cwiseProduct(Matrix(unit(kept, kept)).llt().solve(beside)).sum();
        }
        if (left > 1e-12) kept.push_back(i);
    }
    Mat6 K = Mat6::Zero();
    const auto n = std::ssize(kept);
    const Matrix K_kept = Matrix(unit(kept, kept)).llt().solve(Matrix::Identity(n, n));
    K(kept, kept) = K_kept;
    const Mat6 half = unit * root.asDiagonal();
    const Mat6 G = scale.asDiagonal() * Mat6(half * K * half.transpose()) * scale.asDiagonal();
    return X.transpose() * G * X;
}

namespace {

// Ratio of the nth mode (from 0) of a list; beyond its end proportional to the frequency.
class RatioList {
public:
    explicit RatioList(const std::vector<double>& ratios) : ratios_(&ratios) {}
    double next(double omega) {
        if (ratios_->empty()) return 0;
        if (used_ < ratios_->size()) {
            last_omega_ = omega;
            return (*ratios_)[used_++];
        }
        return ratios_->back() * omega / last_omega_;
    }

private:
    const std::vector<double>* ratios_;
    std::size_t used_ = 0;
    double last_omega_ = 1;
};

}  // namespace

Matrix component_damping(MatrixIn M, MatrixIn K, const std::vector<int>& direction, const BeamDamping& damping) {
    Matrix D = damping.mass_proportional * M;
    if (damping.modal.empty()) return D;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(K, M);
    if (solver.info() != Eigen::Success)
        throw NumericalError("modal damping: the modes of the clamped beam could not be computed");
    RatioList all(damping.modal.all);
    std::array<RatioList, 4> lists{RatioList(damping.modal.extension), RatioList(damping.modal.torsion),
                                   RatioList(damping.modal.bending_y), RatioList(damping.modal.bending_z)};
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        const Vector phi = solver.eigenvectors().col(i);
        const double omega = std::sqrt(std::max(solver.eigenvalues()(i), 0.0));
        std::array<double, 4> energy{};
        const Vector force = K * phi;
        for (Eigen::Index a = 0; a < phi.size(); ++a) entry(energy, entry(direction, a)) += phi(a) * force(a);
        const auto max = std::max_element(energy.begin(), energy.end()) - energy.begin();
        const double ratio = damping.modal.all.empty() ? entry(lists, max).next(omega) : all.next(omega);
        const Vector momentum = M * phi;
        D += 2 * ratio * omega * momentum * momentum.transpose();
    }
    return (D + D.transpose()) / 2;
}

}  // namespace cardan
