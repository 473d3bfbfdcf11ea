#include "mbs/kernels/extent.hpp"

#include <algorithm>

namespace cardan {

double extent(const Kinematics& kin) {
    double largest = 0;
    const Vec3 first = kin.model().size() > 0 ? kin.origin(0) : Vec3(Vec3::Zero());
    for (int k = 0; k < kin.model().size(); ++k)
        largest = std::max({largest, (kin.origin(k) - first).norm(), (kin.centre_of_mass(k) - first).norm()});
    return largest;
}

}  // namespace cardan
