#include "elements/cardan_beam/detail/static_shapes.hpp"

#include "mbs/base/decompositions.hpp"

namespace cardan {

namespace {

using Samples = PlanarElement::Samples;

}  // namespace

StaticShapes static_shapes(const PlanarElement& element, const HingePlaces& hinges) {
    const double d = hinges.second - hinges.first;
    const Samples &x = element.x(), &c = element.bending();
    const std::array<Samples, 2> N{(hinges.second - x) / d, (x - hinges.first) / d};
    constexpr std::array<double, 2> sigma{1, -1};
    const double sheared = element.integral(element.shear()) / (d * d);
    const Samples shear = element.running(element.shear()) / d;
    const auto flexibility = [&](std::size_t i, std::size_t j) {
        return element.integral(c * N[i] * N[j]) + sigma[i] * sigma[j] * sheared;
    };
    Eigen::Matrix2d F;
    F << flexibility(0, 0), flexibility(0, 1), flexibility(1, 0), flexibility(1, 1);
    std::array<Samples, 2> turn, psi;  // by hinge moments
    for (std::size_t i = 0; i < 2; ++i) {
        turn[i] = element.running(c * N[i]);
        psi[i] = element.running(turn[i]) + sigma[i] * shear;
    }
    const Eigen::Matrix2d K = F.inverse();
    return {K(1, 0) * psi[0] + K(1, 1) * psi[1], K(0, 0) * psi[0] + K(0, 1) * psi[1] - (x - hinges.first),
            K(1, 0) * turn[0] + K(1, 1) * turn[1], 1 - (K(0, 0) * turn[0] + K(0, 1) * turn[1])};
}

}  // namespace cardan
