#include "elements/cardan_beam/detail/planar_element.hpp"

#include "mbs/base/entry.hpp"

namespace cardan {

namespace {

constexpr Eigen::Index points_per_piece = 12;

// Pieces between the inner breaks, at least about four: running integrals are less accurate than full ones.
std::vector<double> pieces(double length, const std::vector<double>& breaks) {
    constexpr std::size_t min = 4;
    std::vector<double> ends{0};
    for (double b : breaks)
        if (b > ends.back() + 1e-9 * length && b < length * (1 - 1e-9)) ends.push_back(b);
    ends.push_back(length);
    const std::size_t smooth = ends.size() - 1, parts = std::max<std::size_t>(1, (min + smooth - 1) / smooth);
    std::vector<double> all{0};
    for (std::size_t i = 0; i < smooth; ++i)
        for (std::size_t k = 1; k <= parts; ++k)
            all.push_back(ends[i] + (ends[i + 1] - ends[i]) * static_cast<double>(k) / static_cast<double>(parts));
    return all;
}

double mean_compliance(const BeamSection& s, Eigen::Index first, PlaneMean mean) {
    const Eigen::Matrix2d c = s.compliance.block<2, 2>(first, first);
    if (mean == PlaneMean::arithmetic) return c.trace() / 2;
    return std::sqrt(std::max(0.0, c(0, 0) * c(1, 1) - c(0, 1) * c(1, 0)));
}

std::vector<double> breaks_inside(const ElementLine& element) {
    std::vector<double> inside;
    for (double b : element.line().breaks)
        if (b > element.start() && b < element.end()) inside.push_back(b - element.start());
    return inside;
}

}  // namespace

PlanarElement::PlanarElement(double length, std::vector<double> breaks, std::function<PlanarSection(double)> sections)
    : length_(length), breaks_(std::move(breaks)), sections_(std::move(sections)) {
    const std::vector<double> ends = pieces(length_, breaks_);
    const GaussRule& rule = gauss_rule();
    const auto n = std::ssize(ends) - 1;
    half_.resize(n);
    for (Samples* s : {&x_, &weight_, &mass_, &bending_, &shear_}) s->resize(n * points_per_piece);
    for (Eigen::Index i = 0, at = 0; i < n; ++i) {
        const double from = entry(ends, i), to = entry(ends, i + 1);
        half_(i) = (to - from) / 2;
        for (std::size_t k = 0; k < rule.node.size(); ++k, ++at) {
            x_(at) = (from + to) / 2 + half_(i) * rule.node.at(k);
            weight_(at) = half_(i) * rule.weight.at(k);
            const PlanarSection s = sections_(x_(at));
            mass_(at) = s.mass;
            bending_(at) = s.bending;
            shear_(at) = s.shear;
        }
    }
}

PlanarElement::PlanarElement(const ElementLine& element, PlaneMean mean)
    : PlanarElement(element.end() - element.start(), breaks_inside(element), [&element, mean](double x) {
          const BeamSection s = element.line().section(element.start() + x);
          return PlanarSection{s.mass, mean_compliance(s, 4, mean), mean_compliance(s, 1, mean)};
      }) {}

PlanarElement::Samples PlanarElement::running(const Samples& f) const {
    Samples sum(f.size());
    double before = 0;
    for (Eigen::Index i = 0; i < half_.size(); ++i) {
        const auto piece = Eigen::seqN(i * points_per_piece, points_per_piece);
        sum(piece) = before + half_(i) * (running_gauss_rule() * f(piece).matrix()).array();
        before += (weight_(piece) * f(piece)).sum();
    }
    return sum;
}

Vec3 PlanarElement::mass_moments(double from, double to) const {
    return integrate(from, to, breaks_, Vec3(Vec3::Zero()),
                     [&](double x) { return Vec3(sections_(x).mass * Vec3(1, x, x * x)); });
}

}  // namespace cardan
