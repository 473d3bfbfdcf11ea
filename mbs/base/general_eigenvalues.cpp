#include "mbs/base/decompositions.hpp"

namespace Eigen {
CARDAN_GENERAL_EIGENVALUES(template)
}
