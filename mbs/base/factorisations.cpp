#include "mbs/base/decompositions.hpp"

namespace Eigen {
CARDAN_FACTORISATIONS(template)
}

namespace cardan {

Matrix orthogonal_factor(const Matrix& A) {
    return A.householderQr().householderQ();
}

Matrix orthogonal_factor(const Eigen::ColPivHouseholderQR<Matrix>& qr) {
    return qr.householderQ();
}

double reciprocal_condition(const Eigen::PartialPivLU<Matrix>& lu) {
    return lu.rcond();
}

}  // namespace cardan
