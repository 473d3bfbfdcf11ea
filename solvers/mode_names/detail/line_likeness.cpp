#include "solvers/mode_names/detail/line_likeness.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

constexpr int places_per_line = 40;  // in the middle of as many equal parts

// Distances of its points from the first, along the line, m.
std::vector<double> arc(const Campbell& diagram, const Polyline& line) {
    std::vector<double> s{0};
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        const auto position = [&](std::size_t k) { return entry(diagram.frame_positions, line.points[k].index); };
        s.push_back(s.back() + (position(i) - position(i - 1)).norm());
    }
    return s;
}

}  // namespace

LineLikeness::LineLikeness(const Campbell& there, const Campbell& here) {
    for (const Polyline& own : here.lines) {
        const auto other = std::ranges::find_if(
            there.lines, [&](const Polyline& line) { return line.part == own.part && line.blade == own.blade; });
        if (other == there.lines.end()) continue;
        const double length = arc(here, own).back();
        if (!(length > 0) || !(arc(there, *other).back() > 0)) continue;
        add_line(there, *other, length, places_there_);
        add_line(here, own, length, places_here_);
    }
}

void LineLikeness::add_line(const Campbell& diagram, const Polyline& line, double length, std::vector<Place>& places) {
    const std::vector<double> s = arc(diagram, line);
    std::size_t k = 0;
    for (int i = 0; i < places_per_line; ++i) {
        const double at = s.back() * (i + 0.5) / places_per_line;
        while (s[k + 1] < at) ++k;
        places.push_back({line.points[k].index, line.points[k + 1].index, (at - s[k]) / (s[k + 1] - s[k]),
                          std::sqrt(length / places_per_line), 0.01 * length});
    }
}

ComplexVector LineLikeness::weighted(const std::vector<Place>& places, const std::vector<FrameMotion>& motion) {
    ComplexVector all(6 * std::ssize(places));
    for (Eigen::Index i = 0; i < std::ssize(places); ++i) {
        const Place& p = entry(places, i);
        const Vec6T<Complex> m =
            (1 - p.part) * entry(motion, p.before).motion + p.part * entry(motion, p.behind).motion;
        all.segment(6 * i, 3) = p.weight * p.arm * m.head(3);
        all.segment(6 * i + 3, 3) = p.weight * m.tail(3);
    }
    return all;
}

Matrix LineLikeness::mac(const std::vector<const std::vector<FrameMotion>*>& there,
                         const std::vector<std::vector<FrameMotion>>& here) const {
    Matrix mac = Matrix::Zero(std::ssize(there), std::ssize(here));
    for (Eigen::Index j = 0; j < mac.cols(); ++j) {
        if (entry(here, j).empty()) continue;
        const ComplexVector b = weighted(places_here_, entry(here, j));
        for (Eigen::Index i = 0; i < mac.rows(); ++i) {
            const ComplexVector a = weighted(places_there_, *entry(there, i));
            const double size = a.squaredNorm() * b.squaredNorm();
            if (size > 0) mac(i, j) = std::norm(a.dot(b)) / size;
        }
    }
    return mac;
}

}  // namespace cardan::solvers
