#include "mbs/base/decompositions.hpp"

namespace Eigen {
CARDAN_COMPLEX_DECOMPOSITIONS(template)
}
