/// @file
/// Vectors of the integrators. For sources only: it includes SUNDIALS.
#pragma once

#include "solvers/algebra/detail/sundials_memory.hpp"

namespace cardan::solvers {

/// A serial vector of zeros whose sums, products with scalars and norms use whole registers, as do those of the vectors
/// that are cloned from it. Those of Debian's SUNDIALS go number by number and, sum by sum, several times through
/// memory; they were a sixth of the time of an integration.
/// @throws NumericalError without memory
SundialsVector make_sundials_vector(sunindextype size, SUNContext context);

}  // namespace cardan::solvers
