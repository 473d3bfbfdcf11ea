#include "mbs/decompositions.hpp"

namespace Eigen {
CARDAN_DECOMPOSITIONS(template)
}
