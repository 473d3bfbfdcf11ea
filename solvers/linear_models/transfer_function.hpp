/// @file
/// Transfer functions at many frequencies.
#pragma once

#include "solvers/linear_models/linear_model.hpp"

namespace cardan::solvers {

/// G(s) = C (s - A)^-1 B + D for one model and many s, with A in Hessenberg form [Laub, Efficient multivariable
/// frequency response computations, IEEE Transactions on Automatic Control 26 (1981)].
///
/// Cost for n states: 10/3 n^3 once, n^2 / 2 complex per frequency and n^2 / 2 more per input.
/// Plain twin: ConstantModel::transfer()
class TransferFunction {
public:
    explicit TransferFunction(const StateMatrices& model);
    /// @throws NumericalError if s is exactly a pole; close to a pole accuracy is limited by rounding
    ComplexMatrix at(Complex s);

private:
    Matrix T_, B_, C_, D_;  // T transposed: its rows one after the other
    ComplexMatrix rows_;    // of s - A, transposed likewise, while they are eliminated
    ComplexMatrix x_;       // of each input
};

}  // namespace cardan::solvers
