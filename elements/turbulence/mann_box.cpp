#include "elements/turbulence/mann_box.hpp"

#include "elements/turbulence/box_statistics.hpp"
#include "elements/turbulence/detail/mann_waves.hpp"
#include "elements/turbulence/detail/workers.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace cardan {

namespace {

constexpr const char* mann_box_name = "Mann's turbulence";

void check_mann_grid(const BoxGrid& grid) {
    constexpr int most_steps = 1 << 28, most_across = 1 << 14;
    if (grid.steps < 3 || grid.steps > most_steps)
        throw InputError(mann_box_name, "steps", grid.steps, text("3 to ", most_steps));
    if (const int factor = detail::largest_factor(grid.steps); factor > detail::max_factor)
        throw InputError(mann_box_name, "steps", grid.steps,
                         text("no prime factor above ", detail::max_factor, ", here ", factor,
                              ", which takes long to transform; ", detail::fast_length(grid.steps), " is fast"));
    if (grid.rows < 2 || grid.rows > most_across)
        throw InputError(mann_box_name, "rows", grid.rows, text("2 to ", most_across));
    if (grid.columns < 2 || grid.columns > most_across)
        throw InputError(mann_box_name, "columns", grid.columns, text("2 to ", most_across));
    require_positive(mann_box_name, "time step [s]", grid.time_step);
    require_positive(mann_box_name, "row spacing [m]", grid.row_spacing);
    require_positive(mann_box_name, "column spacing [m]", grid.column_spacing);
}

// Points of a period.
int points_across(const char* what, double period, int points, double spacing, double length_scale) {
    constexpr int most = 1 << 15;
    if (period != 0 && !(period >= points * spacing))
        throw InputError(mann_box_name, text("period of the ", what, " [m]"), period,
                         text("0 (automatic), or the grid and one spacing at least, ", points * spacing));
    const double wanted = period != 0 ? period : std::max(2 * (points - 1) * spacing, 8 * length_scale);
    const double count = std::ceil(wanted / spacing * (1 - 1e-9));
    if (!(count <= most))
        throw InputError(mann_box_name, text("points over the period of the ", what), count,
                         text("up to ", most, "; a coarser grid or a shorter period has fewer"));
    return detail::fast_length(std::max(points, static_cast<int>(count)));
}

void check_mann_options(const MannOptions& options) {
    options.parameters.check();
    check_mann_grid(options.grid);
    require_positive(mann_box_name, "speed [m/s]", options.speed);
    if (options.scaling != MannScaling::none)
        require_positive(mann_box_name, "standard deviation to scale to [m/s]", options.sigma);
    constexpr int limit = 1024;
    if (options.threads < 0 || options.threads > limit)
        throw InputError(mann_box_name, "threads", options.threads, text("0 (one per processor) to ", limit));
}

// Points of a component that are transformed in time together: a line of the memory's cache.
constexpr int chunk_points = 16;

// The waves of one component over time at some points. Before, steps 2(j - 1) and 2(j - 1) + 1 hold the real and
// imaginary parts of the waves of k_1 = j dk_1 (MannPlane::transform()); two points go into one complex transform, u +
// i v.
class TimeTransform {
public:
    TimeTransform(int steps, PlaneOrder order)
        : steps_(steps), order_(order), waves_(chunk_points / 2 * length()), series_(length()) {}

    void operator()(std::vector<float>& velocity, std::size_t points, std::size_t first) {
        const std::size_t count = std::min<std::size_t>(chunk_points, points - first), N = length();
        float* const values = velocity.data() + first;
        std::fill(waves_.begin(), waves_.end(), Complex(0));
        for (std::size_t j = 1; 2 * j < N; ++j) {
            const float *re = values + 2 * (j - 1) * points, *im = re + points;
            for (std::size_t p = 0; p < count; ++p) {
                Complex* const pair = &waves_[p / 2 * N];
                const Complex wave(re[p], im[p]), turn = p % 2 == 0 ? Complex(1, 0) : Complex(0, 1);
                pair[j] += turn * wave;
                pair[N - j] += turn * std::conj(wave);
            }
        }
        for (std::size_t p = 0; p < count; p += 2) {
            fourier_.inverse(&waves_[p / 2 * N], steps_, series_.data());
            for (std::size_t plane = 0; plane < N; ++plane) {
                float* const out = values + (order_ == PlaneOrder::last_first ? N - 1 - plane : plane) * points + p;
                out[0] = static_cast<float>(series_[plane].real());
                if (p + 1 < count) out[1] = static_cast<float>(series_[plane].imag());
            }
        }
    }

private:
    std::size_t length() const { return static_cast<std::size_t>(steps_); }

    int steps_;
    PlaneOrder order_;
    std::vector<Complex> waves_, series_;
    detail::Fourier fourier_;
};

double mann_factor(const MannOptions& options, const MannBox& box) {
    switch (options.scaling) {
        case MannScaling::none:
            break;
        case MannScaling::expected:
            return options.sigma / std::sqrt(box.expected(0, 0));
        case MannScaling::centre:
            return options.sigma / realised(box).centre[0];
        case MannScaling::points:
            return options.sigma / realised(box).points[0];
    }
    return 1;
}

MannBox make_mann_box(const MannOptions& options) {
    const detail::MannLattice lattice(options);
    const std::size_t points =
        static_cast<std::size_t>(options.grid.rows) * static_cast<std::size_t>(options.grid.columns);
    const int threads = detail::thread_count(options.threads);
    MannBox box;
    box.grid = options.grid;
    box.speed = options.speed;
    box.domain = lattice.domain;
    std::vector<Mat3> covariances(static_cast<std::size_t>(lattice.last1));
    for (std::vector<float>& component : box.velocity)
        component.resize(static_cast<std::size_t>(options.grid.steps) * points);

    // Planes, then points: a share of the progress each that is about what they cost.
    const int chunks = static_cast<int>((points + chunk_points - 1) / chunk_points), planes = lattice.last1;
    const int all = planes + planes / 4;
    const auto go_on = [&](int done, int total, int before, int share) {
        if (options.progress) options.progress(before + static_cast<int>(std::int64_t{share} * done / total), all);
        return !options.cancelled || !options.cancelled();
    };
    const auto make_planes = [&] {
        return [&, plane = detail::MannPlane(lattice)](int i) mutable {
            plane.draw(i + 1);
            for (int component = 0; component < 3; ++component) {
                const std::span values(entry(box.velocity, component));
                const std::size_t at = 2 * static_cast<std::size_t>(i) * points;
                plane.transform(component, values.subspan(at, points), values.subspan(at + points, points));
            }
            entry(covariances, i) = 2 * plane.covariance();  // of k_1 and -k_1
        };
    };
    const auto make_points = [&] {
        return [&, transform = TimeTransform(options.grid.steps, options.order)](int i) mutable {
            transform(entry(box.velocity, i / chunks), points, static_cast<std::size_t>(i % chunks) * chunk_points);
        };
    };
    if (!detail::share_out(planes, threads, make_planes, [&](int done) { return go_on(done, planes, 0, planes); }) ||
        !detail::share_out(3 * chunks, threads, make_points,
                           [&](int done) { return go_on(done, 3 * chunks, planes, all - planes); })) {
        box.grid.steps = 0;
        box.velocity = {};
        return box;
    }
    for (const Mat3& covariance : covariances) box.expected += covariance;
    box.factor = mann_factor(options, box);
    if (box.factor != 1)
        for (std::vector<float>& component : box.velocity)
            for (float& value : component) value = static_cast<float>(box.factor * value);
    box.expected *= box.factor * box.factor;
    return box;
}

}  // namespace

MannDomain mann_domain(const MannOptions& options) {
    check_mann_options(options);
    const BoxGrid& grid = options.grid;
    const double L = options.parameters.length_scale;
    MannDomain out;
    out.columns = points_across("width", options.width, grid.columns, grid.column_spacing, L);
    out.rows = points_across("height", options.height, grid.rows, grid.row_spacing, L);
    out.width = out.columns * grid.column_spacing;
    out.height = out.rows * grid.row_spacing;
    return out;
}

MannBox mann_box(const MannOptions& options) {
    return with_memory(
        [&] {
            const BoxGrid& grid = options.grid;
            return text("a box of ", grid.steps, " steps of ", grid.rows, " x ", grid.columns, " points");
        },
        [&] { return make_mann_box(options); });
}

}  // namespace cardan
