#include "solvers/signals/envelope.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

void check(std::span<const double> x, std::span<const double> y, std::size_t columns) {
    constexpr const char* place = "envelope of a curve";
    if (columns == 0) throw InputError(place, "number of columns", columns, ">= 1");
    if (x.size() != y.size()) throw InputError(place, "number of values", y.size(), text(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!std::isfinite(x[i]) || (i > 0 && x[i] < x[i - 1]))
            throw InputError(place, text("x of point ", i), x[i], "finite and rising");
}

// Points first ... last - 1 are one column.
void add_column(std::span<const double> x, std::span<const double> y, std::size_t first, std::size_t last,
                ThinnedCurve& curve) {
    std::array<std::size_t, 4> keep{};  // first, smallest, largest, last
    bool any = false, gap = false;
    for (std::size_t i = first; i < last; ++i) {
        if (!std::isfinite(y[i])) {
            gap = true;
            continue;
        }
        if (!any) keep = {i, i, i, i};
        any = true;
        if (y[i] < y[keep[1]]) keep[1] = i;
        if (y[i] > y[keep[2]]) keep[2] = i;
        keep[3] = i;
    }
    if (any) {
        std::sort(keep.begin(), keep.end());
        for (std::size_t k = 0; k < keep.size(); ++k) {
            if (k > 0 && keep[k] == keep[k - 1]) continue;
            curve.x.push_back(x[keep[k]]);
            curve.y.push_back(y[keep[k]]);
        }
    }
    const bool open = !curve.y.empty() && std::isfinite(curve.y.back());
    if (!gap || !open) return;
    curve.x.push_back(x[last - 1]);
    curve.y.push_back(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

ThinnedCurve min_max_envelope(std::span<const double> x, std::span<const double> y, std::size_t columns) {
    check(x, y, columns);
    if (x.size() <= 4 * columns) return {{x.begin(), x.end()}, {y.begin(), y.end()}};
    ThinnedCurve curve;
    const double per_x = static_cast<double>(columns) / (x.back() - x.front());
    const auto column = [&](std::size_t i) { return std::floor((x[i] - x.front()) * per_x); };
    for (std::size_t first = 0, last = 0; first < x.size(); first = last) {
        const double here = column(first);
        while (last < x.size() && !(column(last) > here)) ++last;
        add_column(x, y, first, last, curve);
    }
    return curve;
}

}  // namespace cardan::solvers
