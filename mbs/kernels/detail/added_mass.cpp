#include "mbs/kernels/detail/added_mass.hpp"

namespace cardan {

template <class S>
void gather_added_mass(const KinematicsT<S>& kin) {
    KernelArraysT<S>& ws = kin.arrays();
    for (auto& at : ws.entraining) {
        at.I.setZero();
        if (at.own >= 0) at.I = own_added_mass(kin, entry(kin.model().added_masses(), at.own));
    }
    for (std::size_t i = ws.entraining.size(); i-- > 0;) {
        const auto& own = ws.entraining[i];
        if (own.parent < 0) continue;
        auto& parent = entry(ws.entraining, own.parent);
        const Packed3<S> arm = entry(ws.frame, own.body).o - entry(ws.frame, parent.body).o;
        const Mat6T<S> X = twist_shift<S>(arm.vector());
        parent.I += X.transpose() * own.I * X;
    }
}

template void gather_added_mass<double>(const KinematicsT<double>&);
template void gather_added_mass<Complex>(const KinematicsT<Complex>&);

}  // namespace cardan
