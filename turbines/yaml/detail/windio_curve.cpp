#include "turbines/yaml/detail/windio_curve.hpp"

#include "mbs/base/error.hpp"
#include "turbines/readers/detail/matrix_blade.hpp"

#include <algorithm>

namespace cardan::turbines {

std::vector<double> increasing_grid(const YamlNode& node, std::size_t values) {
    std::vector<double> grid = node.numbers();
    if (grid.size() < 2 || grid.size() != values)
        node.fail(text(grid.size(), " places for ", values, " values; allowed: as many, at least 2"));
    for (std::size_t i = 1; i < grid.size(); ++i)
        if (!(grid[i] > grid[i - 1])) node.fail(text(grid[i], " after ", grid[i - 1], "; allowed: larger"));
    if (grid.front() < 0 || grid.back() > 1 + 1e-9) node.fail("places beyond 0 ... 1");
    return grid;
}

double WindioCurve::at(double place) const {
    return interpolated(grid, values, place);
}

WindioCurve whole_curve(const YamlNode& node) {
    WindioCurve curve;
    curve.values = node["values"].numbers();
    curve.grid = increasing_grid(node["grid"], curve.values.size());
    if (curve.grid.front() > 1e-9 || curve.grid.back() < 1 - 1e-9)
        node["grid"].fail(text("places ", curve.grid.front(), " ... ", curve.grid.back(), "; allowed: 0 ... 1"));
    return curve;
}

std::vector<double> united(std::vector<double> a, const std::vector<double>& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::sort(a.begin(), a.end());
    a.erase(std::unique(a.begin(), a.end(), [](double x, double y) { return y - x < 1e-9; }), a.end());
    return a;
}

}  // namespace cardan::turbines
