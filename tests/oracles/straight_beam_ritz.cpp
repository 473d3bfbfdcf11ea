#include "tests/oracles/straight_beam_ritz.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/hierarchical_basis.hpp"

#include <cmath>
#include <stdexcept>

namespace cardan::oracles {

StraightBeamRitz::StraightBeamRitz(const StraightBeam& beam, int degree) {
    const PiecewiseGaussGrid grid(beam.breaks, degree + 6);
    const HierarchicalBasis basis(grid, degree);
    const Eigen::VectorXd& w = grid.weights();
    const Eigen::VectorXd ei = grid.points().unaryExpr(beam.bending_stiffness);
    const Eigen::VectorXd mu = grid.points().unaryExpr(beam.mass_per_length);

    // Unknowns: [w(0) of a free root |] slopes; a clamped root drops the one function with a slope at x = 0.
    const bool is_free = beam.root == StraightBeam::Root::free;
    const Eigen::Index dropped = beam.root == StraightBeam::Root::clamped ? 1 : 0;
    const Eigen::Index slopes = basis.size() - dropped;
    const Eigen::Index offset = is_free ? 1 : 0;
    Eigen::MatrixXd theta = Eigen::MatrixXd::Zero(grid.size(), slopes + offset);
    Eigen::MatrixXd curvature = theta;
    theta.rightCols(slopes) = basis.value.rightCols(slopes);
    curvature.rightCols(slopes) = basis.derivative.rightCols(slopes);
    Eigen::MatrixXd deflection = grid.running_integral() * theta;
    if (is_free) deflection.col(0).setOnes();

    const double omega2 = beam.rotor_speed * beam.rotor_speed;
    const Eigen::VectorXd pull = omega2 * mu.array() * (beam.hub_radius + grid.points().array());
    const Eigen::VectorXd tension = grid.integral_to_the_right(pull);

    mass_ = deflection.transpose() * w.cwiseProduct(mu).asDiagonal() * deflection;
    foreshortening_ = theta.transpose() * w.asDiagonal() * theta;
    stiffness_ = curvature.transpose() * w.cwiseProduct(ei).asDiagonal() * curvature;
    stiffness_ += theta.transpose() * w.cwiseProduct(tension).asDiagonal() * theta;
    if (beam.plane == StraightBeam::Plane::lag) stiffness_ -= omega2 * mass_;

    // Shift of the size of the first frequency squared: keeps stiffness + shift * mass definite with rigid-body modes.
    const double length = beam.breaks[beam.breaks.size() - 1] - beam.breaks[0];
    shift_ = omega2 + w.dot(ei) / (w.dot(mu) * std::pow(length, 4));
}

Eigen::VectorXd StraightBeamRitz::frequencies(int count) const {
    if (count > mass_.rows()) throw std::invalid_argument("StraightBeamRitz: more modes asked for than unknowns");
    // M x = nu (K + shift M) x, nu = 1 / (omega^2 + shift): the low modes are the large, well-conditioned nu.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(mass_, stiffness_ + shift_ * mass_,
                                                                           Eigen::EigenvaluesOnly);
    if (solver.info() != Eigen::Success) throw std::runtime_error("StraightBeamRitz: eigenvalues not found");
    const Eigen::ArrayXd omega2 = solver.eigenvalues().tail(count).reverse().array().inverse() - shift_;
    return omega2.max(0.0).sqrt();
}

double StraightBeamRitz::critical_tip_load() const {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(foreshortening_, stiffness_,
                                                                           Eigen::EigenvaluesOnly);
    if (solver.info() != Eigen::Success) throw std::runtime_error("StraightBeamRitz: buckling load not found");
    return 1.0 / solver.eigenvalues().maxCoeff();
}

}  // namespace cardan::oracles
