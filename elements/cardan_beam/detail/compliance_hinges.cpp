#include "elements/cardan_beam/detail/compliance_hinges.hpp"

#include "elements/cardan_beam/joint_stiffness.hpp"

namespace cardan {

namespace {

constexpr double min_distance = 0.05;  // of the length

using Samples = PlanarElement::Samples;

// Compliance as a distribution along the element: integral one, compliance in 1/m.
Samples density(const PlanarElement& element) {
    const Samples scaled = element.bending() / element.bending().maxCoeff();  // against overflow
    return scaled / element.integral(scaled);
}

bool rigid(const PlanarElement& element) {
    return !(element.bending().maxCoeff() > 0);
}

HingePlaces symmetric(const PlanarElement& element) {
    return {delta_gauss * element.length(), (1 - delta_gauss) * element.length()};
}

// Moves both points apart about their middle, then into the element.
HingePlaces apart(HingePlaces h, double L) {
    if (h.second - h.first >= min_distance * L) return h;
    const double middle = std::clamp((h.first + h.second) / 2, min_distance / 2 * L, (1 - min_distance / 2) * L);
    return {middle - min_distance / 2 * L, middle + min_distance / 2 * L};
}

// Zeros of z^2 - (third / second) z - second about the mean, with central moments: the orthogonal polynomial.
HingePlaces gauss_points(const PlanarElement& element) {
    const Samples c = density(element);
    const double L = element.length(), mean = element.integral(c * element.x());
    const Samples z = (element.x() - mean) / L;
    const double second = element.integral(c * z.square()), third = element.integral(c * z.cube());
    if (!(second > 0)) return apart({mean, mean}, L);
    const double skew = third / second, root = std::sqrt(skew * skew / 4 + second);
    const double far = skew / 2 + (skew < 0 ? -root : root), near = -second / far;  // no cancellation
    return apart({mean + std::min(far, near) * L, mean + std::max(far, near) * L}, L);
}

}  // namespace

HingePlaces compliance_gauss_points(const PlanarElement& element) {
    return rigid(element) ? symmetric(element) : gauss_points(element);
}

HingePlaces mean_difference_points(const PlanarElement& element) {
    if (rigid(element)) return symmetric(element);
    const Samples c = density(element);
    const double L = element.length(), linear = element.integral(c * element.x());
    const Samples A = element.running(c), B = element.running(c * element.x()) / linear;
    const auto mean = [&](const Samples& f) { return element.integral(f) / L; };
    const double a = mean(A), a2 = mean(A.square()), b = mean(B), g = mean(A * B);
    const double last = (a * g - a2 * b) / (a + g - a2 - b);  // share of the length beyond the second hinge
    const double between = (a - last) * (a - last) / (a2 - last);
    const HingePlaces h{(1 - last - between) * L, (1 - last) * L};
    const bool sound = h.first >= 0 && h.second <= L && h.second - h.first > min_distance * L;
    return sound ? h : gauss_points(element);
}

}  // namespace cardan
