#include "elements/turbulence/box_statistics.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace cardan {

namespace {

std::size_t grid_points(const BoxGrid& grid) {
    return static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);
}

std::vector<double> point_means(const TurbulenceBox& box, int component) {
    const std::vector<float>& values = entry(box.velocity, component);
    std::vector<double> out(grid_points(box.grid));
    for (int step = 0; step < box.grid.steps; ++step) {
        const float* plane = &values[box.index(step, 0, 0)];
        for (std::size_t p = 0; p < out.size(); ++p) out[p] += plane[p];
    }
    for (double& mean : out) mean /= box.grid.steps;
    return out;
}

// Over time, at every point.
std::vector<double> point_covariances(const TurbulenceBox& box, int a, int b, const std::vector<double>& means_a,
                                      const std::vector<double>& means_b) {
    std::vector<double> out(grid_points(box.grid));
    for (int step = 0; step < box.grid.steps; ++step) {
        const float* of_a = &entry(box.velocity, a)[box.index(step, 0, 0)];
        const float* of_b = &entry(box.velocity, b)[box.index(step, 0, 0)];
        for (std::size_t p = 0; p < out.size(); ++p) out[p] += (of_a[p] - means_a[p]) * (of_b[p] - means_b[p]);
    }
    for (double& covariance : out) covariance /= box.grid.steps;
    return out;
}

}  // namespace

int centre_row(const BoxGrid& grid) {
    return (grid.rows - 1) / 2;
}
int centre_column(const BoxGrid& grid) {
    return (grid.columns - 1) / 2;
}

RealisedTurbulence realised(const TurbulenceBox& box) {
    const std::size_t centre = box.index(0, centre_row(box.grid), centre_column(box.grid));
    std::array<std::vector<double>, 3> means;
    for (int k = 0; k < 3; ++k) entry(means, k) = point_means(box, k);
    RealisedTurbulence out;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b <= a; ++b) {
            const std::vector<double> all = point_covariances(box, a, b, entry(means, a), entry(means, b));
            double sum = 0;
            for (const double covariance : all) sum += covariance;
            out.covariance(a, b) = out.covariance(b, a) = sum / static_cast<double>(all.size());
            if (a != b) continue;
            out.centre[a] = std::sqrt(all[centre]);
            out.points[a] = std::sqrt(out.covariance(a, a));
        }
    return out;
}

std::vector<double> point_deviations(const TurbulenceBox& box, int component) {
    require_index("turbulence", "component", component, 3);
    const std::vector<double> means = point_means(box, component);
    std::vector<double> out = point_covariances(box, component, component, means, means);
    for (double& value : out) value = std::sqrt(value);
    return out;
}

void scale_to(TurbulenceBox& box, const Vec3& deviations, DeviationScaling scaling) {
    if (scaling == DeviationScaling::none) return;
    const std::size_t centre = box.index(0, centre_row(box.grid), centre_column(box.grid));
    for (int k = 0; k < 3; ++k) {
        std::vector<double> factors = point_deviations(box, k);
        if (scaling == DeviationScaling::centre) std::fill(factors.begin(), factors.end(), double{factors[centre]});
        for (double& factor : factors) {
            if (!(factor > 0))
                throw InputError("scaling of turbulence", text("standard deviation of component ", k, " [m/s]"), factor,
                                 "> 0; a box without turbulence cannot be scaled");
            factor = deviations[k] / factor;
        }
        for (int step = 0; step < box.grid.steps; ++step) {
            const std::span plane(&entry(box.velocity, k)[box.index(step, 0, 0)], factors.size());
            for (std::size_t p = 0; p < plane.size(); ++p) plane[p] = static_cast<float>(plane[p] * factors[p]);
        }
    }
}

}  // namespace cardan
