/// @file
/// Reduction of linear models with constant matrices: modal and balanced truncation.
#pragma once

#include "solvers/linear_models/linear_model.hpp"

namespace cardan::solvers {

/// Treatment of the static gain of the truncated part.
enum class StaticGain : std::uint8_t {
    free,  ///< it is lost
    kept   ///< the gain at frequency zero is preserved (for a model with poles at zero: that of the truncated part)
};

struct ModalOptions {
    /// Modes with natural frequency |lambda| / 2 pi up to this value are kept, Hz; those at zero (a free rotor) always.
    double max_frequency_hz = 0;
    /// Further modes: the pole nearest to each of these and its conjugate, 1/s.
    std::vector<Complex> keep = {};
    StaticGain static_gain = StaticGain::free;
};

/// The part of a model in the invariant subspace of some modes, with the static gain of the others added to D if
/// wanted. The eigenvalues of the new A are poles of the model to working precision.
/// @throws InputError for a frequency or poles that are not finite, if nothing is kept, or for a model without states,
/// with inconsistent sizes or entries that are not finite; NumericalError if the eigenvalue iteration fails
ConstantModel modal_truncation(const ConstantModel& model, const ModalOptions& options);

struct BalancedOptions {
    int order = 0;            ///< of the stable part; 0: by `error` or `tolerance`
    double tolerance = 1e-3;  ///< Hankel singular values below this times the largest are left out
    /// Positive: chooses the smallest order (by bisection) at which the error of every input and output stays below
    /// this value up to `max_frequency_hz`: the largest |G - G_r| of the row or column, relative to the largest |G| of
    /// the same row or column, where G is the stable part. The sizes below are then only the initial scaling: it is
    /// iterated until every input and every output has a largest response of one, so that none is neglected. Modes
    /// above twice (else four, eight times) the largest frequency are truncated first if the error can still be
    /// reached; their static gain is kept.
    double error = 0;
    double max_frequency_hz = 0;  ///< positive: errors are measured up to here, however the order is chosen
    double stability_margin = 0;  ///< poles with real part above minus this are kept as they are, 1/s; 0: 1e-4
    /// Inputs and outputs are divided by these before balancing (a significant magnitude of each, in its units); empty:
    /// ones. The error bound is that of the scaled model.
    Vector input_size = {}, output_size = {};
    /// kept: the truncated part responds statically (singular perturbation); same bound.
    StaticGain static_gain = StaticGain::free;
};

struct BalancedModel : ConstantModel {
    Vector hankel;       ///< Hankel singular values of the stable part, descending
    int kept_as_is = 0;  ///< states that are not stable
    int order = 0;       ///< of the stable part, after reduction
    /// Largest singular value of G - G_r at any frequency (scaled): twice the sum of the truncated Hankel values.
    double error_bound = 0;
    /// Errors reached for every input and every output, with BalancedOptions::max_frequency_hz.
    Vector input_error = {}, output_error = {};
};

/// Balanced truncation of the stable part by the square-root method.          [Moore 1981; Glover 1984; Laub et al.
/// 1987; singular perturbation: Liu and Anderson 1989]
/// States with Hankel values below 1e-10 of the largest are at rounding level and are truncated even if `order` asks
/// for them.
/// @throws InputError for sizes, order, tolerance, error or frequency out of range, and for models as
/// modal_truncation(); NumericalError if an iteration fails or no order reaches the error
BalancedModel balanced_truncation(const ConstantModel& model, const BalancedOptions& options = {});

/// Solution of A X + X A^T + Q = 0 for stable A, by the Schur form of (A - sigma)^-1.   [after Bartels and Stewart
/// 1972]
/// @param Q  symmetric
/// @param sigma  positive, of the magnitude of the eigenvalues that matter most, which are then the most accurate; 0:
///               chosen automatically
/// @throws InputError for inconsistent sizes; NumericalError if A is not stable
Matrix lyapunov(const Matrix& A, const Matrix& Q, double sigma = 0);

}  // namespace cardan::solvers
