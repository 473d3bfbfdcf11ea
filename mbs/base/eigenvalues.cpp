#include "mbs/base/decompositions.hpp"

namespace Eigen {
CARDAN_EIGENVALUES(template)
}
