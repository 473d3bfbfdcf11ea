#include "elements/aerodynamics/polar.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan {

namespace {

constexpr double slack = 1e-6;  // rad, of the ends of a table

}  // namespace

Polar::Polar(std::string name, std::vector<double> angles, std::vector<double> lift, std::vector<double> drag,
             std::vector<double> moment)
    : name_(std::move(name)),
      angles_(std::move(angles)),
      lift_(std::move(lift)),
      drag_(std::move(drag)),
      moment_(std::move(moment)) {
    const std::string here = text("polar of profile '", name_, "'");
    const std::size_t n = angles_.size();
    if (n < 2) throw InputError(here, "number of points", n, "at least 2");
    if (n > std::numeric_limits<std::uint16_t>::max()) throw InputError(here, "number of points", n, "at most 65535");
    for (const auto* column : {&lift_, &drag_, &moment_})
        if (column->size() != n)
            throw InputError(here, "values in a column", column->size(), text("as many as angles, ", n));
    for (std::size_t i = 0; i < n; ++i) {
        for (const auto* column : {&angles_, &lift_, &drag_, &moment_})
            if (!std::isfinite((*column)[i]))
                throw InputError(text(here, ", point ", i + 1), "value", (*column)[i], "finite");
        if (i > 0 && !(angles_[i] > angles_[i - 1]))
            throw InputError(text(here, ", point ", i + 1), "angle of attack [deg]", angles_[i] * units::to_degrees,
                             text("above that of the point before, ", angles_[i - 1] * units::to_degrees));
    }
    if (angles_.front() > -pi + slack || angles_.back() < pi - slack)
        throw InputError(here, "angles of attack [deg]",
                         text(angles_.front() * units::to_degrees, " ... ", angles_.back() * units::to_degrees),
                         "-180 ... 180");
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double from = -pi + 2 * pi * static_cast<double>(cell) / cells;
        const auto next = std::upper_bound(angles_.begin() + 1, angles_.end() - 1, from);
        first_[cell] = static_cast<std::uint16_t>(next - angles_.begin() - 1);
    }
}

Polar::Point Polar::at(double angle) const {
    const double x = std::remainder(angle, 2 * pi);
    const auto cell = std::min(static_cast<std::size_t>(std::max(0.0, (x + pi) / (2 * pi) * cells)), cells - 1);
    std::size_t i = first_[cell];
    while (i + 2 < angles_.size() && x >= angles_[i + 1]) ++i;
    const double width = angles_[i + 1] - angles_[i], t = (x - angles_[i]) / width;
    const auto line = [&](const std::vector<double>& y) {
        return std::pair((1 - t) * y[i] + t * y[i + 1], (y[i + 1] - y[i]) / width);
    };
    const auto [lift, lift_slope] = line(lift_);
    const auto [drag, drag_slope] = line(drag_);
    const auto [moment, moment_slope] = line(moment_);
    return {lift, drag, moment, lift_slope, drag_slope, moment_slope};
}

}  // namespace cardan
