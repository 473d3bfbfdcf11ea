#include "mbs/base/detail/products.hpp"

#ifdef CARDAN_PRODUCTS
namespace Eigen::internal {
CARDAN_PRODUCTS(template)
}
#endif
