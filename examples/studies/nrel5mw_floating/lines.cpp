#include "examples/studies/nrel5mw_floating/lines.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::floating {

namespace {

constexpr int max_multiple = 3;  // of the rotor's frequency: three blades

// |sign * motion + multiple * rotor|
struct Neighbour {
    double hz;
    int sign, multiple;
};

std::string nature(const Neighbour& line) {
    if (line.hz == 0) return "the mean";
    if (line.multiple == 0) return "another motion's";
    const std::string rotor = line.multiple == 1 ? "the rotor's" : text(line.multiple, " times the rotor's");
    return line.sign == 0 ? rotor : text(line.sign < 0 ? "the difference to " : "the sum with ", rotor);
}

bool same(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::max(a, b);
}

// What is of first order in the motions, and gravity's.
std::vector<Neighbour> first_order(const std::vector<double>& motions_hz, double rotor_hz) {
    std::vector<Neighbour> list;
    list.reserve((2 * max_multiple + 1) * (motions_hz.size() + 1));
    for (const double f : motions_hz) list.push_back({f, 1, 0});
    for (int n = 1; rotor_hz != 0 && n <= max_multiple; ++n) {
        list.push_back({n * rotor_hz, 0, n});
        for (const double f : motions_hz) {
            list.push_back({std::abs(n * rotor_hz - f), -1, n});
            list.push_back({n * rotor_hz + f, 1, n});
        }
    }
    return list;
}

}  // namespace

std::vector<double> distinct_frequencies(const std::vector<double>& hz) {
    std::vector<double> list;
    for (const double f : hz)
        if (std::ranges::none_of(list, [&](double known) { return same(known, f); })) list.push_back(f);
    return list;
}

Lines response_lines(const std::vector<double>& motions_hz, double rotor_hz, double window) {
    Lines lines{distinct_frequencies(motions_hz), 0};
    lines.own = lines.hz.size();
    const auto add_resolved = [&](double line) {
        const double apart = (1 - 1e-9) / window;  // from the mean, too
        if (line >= apart && std::ranges::none_of(lines.hz, [&](double f) { return std::abs(line - f) < apart; }))
            lines.hz.push_back(line);
    };
    for (const Neighbour& line : first_order(motions_hz, rotor_hz)) add_resolved(line.hz);
    const std::vector<double> own(lines.hz.begin(), lines.hz.begin() + static_cast<std::ptrdiff_t>(lines.own));
    for (const double a : own)
        for (const double b : own)
            for (int n = rotor_hz == 0 ? 0 : -max_multiple; n <= (rotor_hz == 0 ? 0 : max_multiple); ++n)
                for (const double second : {a + b, a - b}) add_resolved(std::abs(second + n * rotor_hz));
    return lines;
}

Resolution needed_resolution(const std::vector<double>& motions_hz, double rotor_hz) {
    Resolution worst;
    for (const double f : distinct_frequencies(motions_hz)) {
        std::vector<Neighbour> others = first_order(motions_hz, rotor_hz);
        others.push_back({0, 0, 0});
        for (const Neighbour& other : others)
            if (!same(f, other.hz) && 1 / std::abs(f - other.hz) > worst.window)
                worst = {1 / std::abs(f - other.hz), f, other.hz, nature(other)};
    }
    return worst;
}

LineFit::LineFit(const std::vector<double>& time, Lines lines) : lines_(std::move(lines)) {
    const auto rows = std::ssize(time);
    const auto columns = 1 + 2 * std::ssize(lines_.hz);
    if (rows <= columns)
        throw InputError("amplitudes", "samples in the stretch", rows,
                         text("more than ", columns, ", twice the lines"));
    basis_.resize(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i) {
        basis_(i, 0) = 1;
        for (Eigen::Index k = 1; k < columns; k += 2) {
            const double angle = 2 * pi * entry(lines_.hz, k / 2) * entry(time, i);
            basis_(i, k) = std::cos(angle);
            basis_(i, k + 1) = std::sin(angle);
        }
    }
    normal_ = basis_.transpose() * basis_;  // lines are at least a turn apart: well conditioned
}

LineFit::Amplitudes LineFit::operator()(const std::vector<double>& values) const {
    const Vector y = Eigen::Map<const Vector>(values.data(), basis_.rows());
    const Vector right = basis_.transpose() * y, c = normal_.llt().solve(right);
    Amplitudes found;
    for (std::size_t k = 0; k < lines_.own; ++k) {
        const auto at = static_cast<Eigen::Index>(1 + 2 * k);
        found.own.push_back(std::hypot(c(at), c(at + 1)));
    }
    found.rest = (y - basis_ * c).norm() / std::sqrt(static_cast<double>(y.size()));
    return found;
}

}  // namespace cardan::floating
