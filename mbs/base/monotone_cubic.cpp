#include "mbs/base/monotone_cubic.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

void check(const std::vector<double>& x, const std::vector<double>& y, const MonotoneCubic::Names& names) {
    const auto& [table, x_name, y_name, x_unit, y_unit] = names;
    const std::size_t n = x.size();
    if (n < 2) throw InputError(table, text("number of ", x_name, "s"), n, ">= 2");
    if (y.size() != n)
        throw InputError(table, text("number of ", y_name, "s"), y.size(), text(n, ", one per ", x_name));
    for (std::size_t i = 0; i < n; ++i) {
        const std::string at = text(x_name, " ", i + 1, x_unit);
        if (!std::isfinite(x[i])) throw InputError(table, at, x[i], "finite");
        if (!std::isfinite(y[i])) throw InputError(table, text(y_name, " ", i + 1, y_unit), y[i], "finite");
        if (i > 0 && !(x[i] > x[i - 1])) throw InputError(table, at, x[i], text("> ", x[i - 1], ", the one before"));
    }
}

}  // namespace

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y, Ends ends, const Names& names)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0.0) {
    check(x_, y_, names);
    const std::size_t last = intervals();
    for (std::size_t i = 1; i < last; ++i) {
        const double s = secant(i - 1), r = secant(i), h = width(i - 1), k = width(i);
        if (s * r > 0) slope_[i] = 3 * (h + k) / ((2 * k + h) / s + (k + 2 * h) / r);
    }
    if (ends == Ends::level) return;
    slope_[0] = last == 1 ? secant(0) : end_slope(0, 1);
    slope_[last] = last == 1 ? secant(0) : end_slope(last - 1, last - 2);
}

double MonotoneCubic::end_slope(std::size_t near, std::size_t far) const {
    const double h = width(near), k = width(far), s = secant(near), r = secant(far);
    const double d = ((2 * h + k) * s - h * r) / (h + k);
    if (d * s <= 0) return 0;
    if (s * r <= 0 && std::abs(d) > 3 * std::abs(s)) return 3 * s;
    return d;
}

MonotoneCubic::Value MonotoneCubic::at(double x, double inside) const {
    const std::size_t last = intervals();
    if (inside < x_[0]) return {y_[0] + slope_[0] * (x - x_[0]), slope_[0], 0};
    if (inside >= x_[last]) return {y_[last] + slope_[last] * (x - x_[last]), slope_[last], 0};
    const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), inside) - x_.begin()) - 1;
    const double h = width(i), u = x - x_[i], s = secant(i), a = slope_[i], b = slope_[i + 1];
    const double c2 = (3 * s - 2 * a - b) / h, c3 = (a + b - 2 * s) / (h * h);
    return {y_[i] + u * (a + u * (c2 + u * c3)), a + u * (2 * c2 + 3 * u * c3), 2 * c2 + 6 * u * c3};
}

}  // namespace cardan
