#include "mbs/base/decompositions.hpp"

namespace Eigen {
CARDAN_FACTORISATIONS(template)
}
