#include "elements/turbulence/kaimal_box.hpp"

#include "elements/turbulence/detail/correlated_plane.hpp"
#include "elements/turbulence/detail/workers.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

namespace cardan {

namespace {

using detail::CorrelatedPlane;
using detail::PlaneMethod;

constexpr int most_threads = 1024;

void check_kaimal_grid(const BoxGrid& grid) {
    constexpr auto where = "grid of a turbulence box";
    constexpr int most_points = 1 << 10, most_steps = 1 << 26;
    for (const auto& [name, number, most] : {std::tuple("rows", grid.rows, most_points),
                                             {"columns", grid.columns, most_points},
                                             {"steps", grid.steps, most_steps}})
        if (number < 2 || number > most) throw InputError(where, name, number, text("2 ... ", most));
    require_positive(where, "time step [s]", grid.time_step);
    require_positive(where, "spacing of the rows [m]", grid.row_spacing);
    require_positive(where, "spacing of the columns [m]", grid.column_spacing);
    if (detail::largest_factor(grid.steps) > detail::max_factor) {
        int next = grid.steps + 1;
        while (detail::largest_factor(next) > detail::max_factor) ++next;
        throw InputError(where, "steps", grid.steps,
                         text("numbers without a prime factor above ", detail::max_factor, ", such as ", next));
    }
}

// The box while it is made: until the transform over time, the planes 2k - 1 and 2k are the real and imaginary parts of
// the amplitudes at line k, and the last one is the real line at half the sampling rate, if there is one. Plane 0 is
// empty.
class KaimalMaker {
public:
    KaimalMaker(const Kaimal& model, const KaimalOptions& options, TurbulenceBox& box)
        : model_(model),
          options_(options),
          box_(box),
          points_(static_cast<std::size_t>(box.grid.rows) * static_cast<std::size_t>(box.grid.columns)),
          blocks_(static_cast<int>((points_ + block - 1) / block)) {}

    bool run() {
        const int lines = box_.grid.steps / 2, series = 3 * blocks_;
        return share([this] { return Planes(*this); }, lines, 0, lines + series) &&
               share([this] { return Times(*this); }, series, lines, lines + series);
    }

private:
    static constexpr std::size_t block = 16;  // points whose numbers share a cache line

    // Amplitudes of lines.
    class Planes {
    public:
        explicit Planes(const KaimalMaker& maker)
            : maker_(&maker),
              plane_(std::make_unique<CorrelatedPlane>(
                  detail::PlaneGrid{maker.box_.grid.rows, maker.box_.grid.columns, maker.box_.grid.row_spacing,
                                    maker.box_.grid.column_spacing},
                  maker.coherent_components())),
              unused_(maker.points_) {}

        void operator()(int index) {
            const int line = index + 1;
            const BoxGrid& grid = maker_->box_.grid;
            const double f = line / grid.duration();
            const bool real = 2 * line == grid.steps;
            prepare(maker_->model_.decay_rate(f));
            for (int k = 0; k < 3; ++k) {
                if (k == maker_->coherent_components()) plane_->prepare(HUGE_VAL, PlaneMethod::independent);
                // Two of a line and its conjugate; the real line is one, and the real part of z has half the variance.
                const double size = std::sqrt((real ? 2.0 : 0.5) * maker_->model_.spectrum(k, f) / grid.duration());
                const NormalNumbers numbers(maker_->options_.seed, static_cast<std::uint32_t>(k),
                                            static_cast<std::uint32_t>(line));
                plane_->draw(numbers, size, maker_->plane(k, 2 * line - 1),
                             real ? std::span(unused_) : maker_->plane(k, 2 * line));
            }
        }

    private:
        void prepare(double rate) {
            if (maker_->options_.synthesis == Synthesis::automatic) return plane_->prepare(rate);
            plane_->prepare(
                rate, maker_->options_.synthesis == Synthesis::cholesky ? PlaneMethod::cholesky : PlaneMethod::fourier);
        }

        const KaimalMaker* maker_;
        std::unique_ptr<CorrelatedPlane> plane_;
        std::vector<float> unused_;
    };

    // Transforms over time, two points at once: as the real and the imaginary part of one series.
    class Times {
    public:
        explicit Times(const KaimalMaker& maker)
            : maker_(&maker),
              fourier_(std::make_unique<detail::Fourier>()),
              lines_(static_cast<std::size_t>(maker.box_.grid.steps)),
              series_(lines_.size()),
              values_(lines_.size() * block) {}

        void operator()(int index) {
            const int component = index / maker_->blocks_;
            const std::size_t first = static_cast<std::size_t>(index % maker_->blocks_) * block,
                              count = std::min(block, maker_->points_ - first), steps = lines_.size();
            std::fill(values_.begin(), values_.end(), 0.0F);
            for (std::size_t t = 0; t < steps; ++t) {
                const auto from = maker_->plane(component, static_cast<int>(t)).subspan(first, count);
                std::copy(from.begin(), from.end(), &values_[t * block]);
            }
            for (std::size_t p = 0; p < count; p += 2) transform(p);
            for (std::size_t t = 0; t < steps; ++t)
                std::copy_n(&values_[t * block], count,
                            maker_->plane(component, static_cast<int>(t)).subspan(first).begin());
        }

    private:
        void transform(std::size_t p) {
            const std::size_t steps = lines_.size();
            const auto value = [&](std::size_t t, std::size_t point) -> float& { return values_[t * block + point]; };
            const Complex i(0, 1);
            lines_[0] = 0;
            for (std::size_t k = 1; 2 * k < steps; ++k) {
                const Complex a(value(2 * k - 1, p), value(2 * k, p)), b(value(2 * k - 1, p + 1), value(2 * k, p + 1));
                lines_[k] = a + i * b;
                lines_[steps - k] = std::conj(a) + i * std::conj(b);
            }
            if (steps % 2 == 0) lines_[steps / 2] = {value(steps - 1, p), value(steps - 1, p + 1)};
            fourier_->inverse(lines_.data(), static_cast<int>(steps), series_.data());
            for (std::size_t t = 0; t < steps; ++t) {
                value(t, p) = static_cast<float>(series_[t].real());
                value(t, p + 1) = static_cast<float>(series_[t].imag());
            }
        }

        const KaimalMaker* maker_;
        std::unique_ptr<detail::Fourier> fourier_;
        std::vector<Complex> lines_, series_;
        std::vector<float> values_;  // [step][point of the block]
    };

    int coherent_components() const { return model_.transverse == TransverseCoherence::as_u ? 3 : 1; }
    std::span<float> plane(int component, int step) const {
        return {&entry(box_.velocity, component)[box_.index(step, 0, 0)], points_};
    }

    template <class MakeWork>
    bool share(const MakeWork& make_work, int count, int before, int total) const {
        return detail::share_out(count, detail::thread_count(options_.threads), make_work, [&](int done) {
            if (options_.progress) options_.progress(before + done, total);
            return !options_.cancelled || !options_.cancelled();
        });
    }

    const Kaimal& model_;
    const KaimalOptions& options_;
    TurbulenceBox& box_;
    std::size_t points_;
    int blocks_;
};

}  // namespace

TurbulenceBox kaimal_box(const Kaimal& model, const BoxGrid& grid, const KaimalOptions& options) {
    model.check();
    check_kaimal_grid(grid);
    if (options.threads < 0 || options.threads > most_threads)
        throw InputError("turbulence", "number of threads", options.threads,
                         text("0 (all processors) to ", most_threads));
    TurbulenceBox box{.grid = grid, .speed = model.speed, .velocity = {}};
    with_memory(
        [&] {
            return text("turbulence of ", grid.steps, " steps at ", grid.rows, " x ", grid.columns,
                        " points; take fewer of them");
        },
        [&] {
            for (auto& values : box.velocity) values.resize(box.index(grid.steps, 0, 0));
        });
    if (!KaimalMaker(model, options, box).run()) return {};
    scale_to(box, model.deviation, options.scaling);
    return box;
}

std::string description(const Kaimal& model, const KaimalOptions& options) {
    return text("Cardan: Kaimal, V ", model.speed, " m/s, sigma ", model.deviation[0], " ", model.deviation[1], " ",
                model.deviation[2], " m/s, L ", model.length[0], " ", model.length[1], " ", model.length[2], " m, Lc ",
                model.coherence_length, " m", model.transverse == TransverseCoherence::none ? ", v w incoherent" : "",
                ", seed ", options.seed);
}

}  // namespace cardan
