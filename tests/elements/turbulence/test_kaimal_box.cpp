// Boxes of Kaimal turbulence: spectra, coherence and variances over many seeds against the model; the same box again.
#include "elements/turbulence/kaimal_box.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <vector>

using namespace cardan;
using namespace cardan::testing;

namespace {

const Kaimal class_b = kaimal_turbulence(14, 2.254, 90);
const BoxGrid grid_12{.steps = 64, .rows = 3, .columns = 4, .time_step = 0.5, .row_spacing = 20, .column_spacing = 15};

Kaimal incoherent() {
    Kaimal out = class_b;
    out.transverse = TransverseCoherence::none;
    return out;
}

// Amplitudes of a box at its points, by the sum that defines them: 1/N sum x_t exp(-2 pi i k t/N), over their standard
// deviation by the model.
class Amplitudes {
public:
    Amplitudes(const Kaimal& of, const TurbulenceBox& box) : grid_(box.grid) {
        const int n = grid_.steps, points = grid_.rows * grid_.columns;
        std::vector<Complex> wave(static_cast<std::size_t>(n));
        for (int t = 0; t < n; ++t) wave[static_cast<std::size_t>(t)] = std::polar(1.0 / n, -2 * pi * t / n);
        for (int k = 0; k < 3; ++k) {
            ComplexMatrix& out = components_[static_cast<std::size_t>(k)] = ComplexMatrix::Zero(points, n / 2 + 1);
            const float* value = box.velocity[static_cast<std::size_t>(k)].data();
            for (int line = 1; line <= n / 2; ++line) {
                const double f = line / grid_.duration(), size = std::sqrt(of.spectrum(k, f) / (2 * grid_.duration()));
                for (int point = 0; point < points; ++point) {
                    Complex sum = 0;
                    for (int t = 0, angle = 0; t < n; ++t, angle = (angle + line) % n)
                        sum += static_cast<double>(value[t * points + point]) * wave[static_cast<std::size_t>(angle)];
                    out(point, line) = sum / size;
                }
            }
        }
    }
    Complex at(int component, int line, int row, int column) const {
        return components_[static_cast<std::size_t>(component)](row * grid_.columns + column, line);
    }

private:
    BoxGrid grid_;
    std::array<ComplexMatrix, 3> components_;
};

std::vector<Amplitudes> kaimal_boxes(const Kaimal& of, Synthesis synthesis, int seeds, std::uint64_t first = 1) {
    std::vector<Amplitudes> out;
    for (int i = 0; i < seeds; ++i)
        out.emplace_back(
            of, kaimal_box(of, grid_12, {.seed = first + static_cast<std::uint64_t>(i), .synthesis = synthesis}));
    return out;
}

struct Band {
    int first, last;
};
constexpr Band bands[] = {{1, 2}, {3, 6}, {7, 15}, {16, 31}};  // to 0.0625, 0.19, 0.47, 0.97 Hz

struct GridPoint {
    int row, column;
};

// Mean of z_a conj(z_b) over a band, all seeds and all components that have this coherence. Standard errors of the real
// and the imaginary part are by the fourth moments of normal numbers; one normal sample in a hundred of the 160 numbers
// below has one beyond four of them, and one in three has one beyond three.
template <class Product, class Expected>
void check_band(const std::vector<Amplitudes>& boxes, Band band, const Product& product, const Expected& coherence,
                int components = 3) {
    Complex sum = 0;
    double expected = 0, real = 0, imaginary = 0;
    int count = 0;
    for (int line = band.first; line <= band.last; ++line) {
        const double g = coherence(line / grid_12.duration());
        for (const Amplitudes& box : boxes)
            for (int k = 0; k < components; ++k, ++count) {
                sum += product(box, k, line);
                expected += g;
                real += (1 + g * g) / 2;
                imaginary += (1 - g * g) / 2;
            }
    }
    CAPTURE(band.first, band.last, sum / static_cast<double>(count), expected / count);
    CHECK(std::abs(sum.real() - expected) < 4 * std::sqrt(real));
    CHECK(std::abs(sum.imag()) <= 4 * std::sqrt(imaginary) + 1e-6 * count);
}

template <class Expected>
void check_pair(const std::vector<Amplitudes>& boxes, GridPoint a, GridPoint b, const Expected& coherence) {
    CAPTURE(a.row, a.column, b.row, b.column);
    for (const Band band : bands)
        check_band(
            boxes, band,
            [&](const Amplitudes& box, int k, int line) {
                return box.at(k, line, a.row, a.column) * std::conj(box.at(k, line, b.row, b.column));
            },
            coherence);
}

void check_statistics(Synthesis synthesis, int seeds, std::uint64_t first) {
    const std::vector<Amplitudes> boxes = kaimal_boxes(class_b, synthesis, seeds, first);
    check_pair(boxes, {1, 2}, {1, 2}, [](double) { return 1.0; });
    check_pair(boxes, {0, 1}, {0, 2}, [](double f) { return class_b.coherence(f, 15); });
    check_pair(boxes, {0, 3}, {2, 3}, [](double f) { return class_b.coherence(f, 40); });
    check_pair(boxes, {2, 0}, {0, 2}, [](double f) { return class_b.coherence(f, 50); });
    const auto none = [](double) { return 0.0; };
    for (const Band band : bands)  // u with v, v with w, w with u
        check_band(
            boxes, band,
            [](const Amplitudes& box, int k, int line) {
                return box.at(k, line, 1, 1) * std::conj(box.at((k + 1) % 3, line, 1, 1));
            },
            none);
    check_band(
        boxes, {3, 30},
        [](const Amplitudes& box, int k, int line) {
            return box.at(k, line, 1, 1) * std::conj(box.at(k, line + 1, 1, 1));
        },
        none);
}

}  // namespace

TEST_CASE("Kaimal box: spectra and coherence over 400 seeds are the model's", "[analytic]") {
    SECTION("by Cholesky") {
        check_statistics(Synthesis::cholesky, 400, 1);
    }
    SECTION("by Fourier transforms") {
        check_statistics(Synthesis::fourier, 400, 1);
    }
}

TEST_CASE("Kaimal box: spectra and coherence over 2000 seeds are the model's", "[analytic][slow]") {
    SECTION("by Cholesky") {
        check_statistics(Synthesis::cholesky, 2000, 1);
    }
    SECTION("by Fourier transforms") {
        check_statistics(Synthesis::fourier, 2000, 1);
    }
}

TEST_CASE("Kaimal box: v and w of different points are independent where they are asked to be", "[analytic]") {
    const std::vector<Amplitudes> boxes = kaimal_boxes(incoherent(), Synthesis::automatic, 40, 1);
    const auto product = [](int component) {
        return [component](const Amplitudes& box, int, int line) {
            return box.at(component, line, 1, 1) * std::conj(box.at(component, line, 1, 2));
        };
    };
    for (const Band band : bands) {
        check_band(
            boxes, band, product(0), [](double f) { return class_b.coherence(f, 15); }, 1);
        check_band(
            boxes, band, product(1), [](double) { return 0.0; }, 1);
        check_band(
            boxes, band, product(2), [](double) { return 0.0; }, 1);
    }
}

TEST_CASE("Kaimal box: variances are those of the lines, the last of which is real", "[analytic]") {
    // Of one line of normal amplitude the variance scatters by itself, of the real one by the root of 2 of it.
    constexpr int seeds = 40;
    const BoxGrid of{.steps = 600, .rows = 2, .columns = 2, .time_step = 0.2, .row_spacing = 60, .column_spacing = 60};
    Vec3 sum = Vec3::Zero(), last = Vec3::Zero();
    for (int i = 0; i < seeds; ++i) {
        const TurbulenceBox box = kaimal_box(class_b, of, {.seed = static_cast<std::uint64_t>(i)});
        const RealisedTurbulence is = realised(box);
        sum += is.centre.cwiseAbs2();
        for (int k = 0; k < 3; ++k) {
            double alternating = 0;
            for (int t = 0; t < of.steps; ++t)
                alternating += (t % 2 == 0 ? 1 : -1) * box.velocity[static_cast<std::size_t>(k)][box.index(t, 0, 0)];
            last[k] += std::pow(alternating / of.steps, 2);
        }
    }
    for (int k = 0; k < 3; ++k) {
        double scatter = 0;
        for (int line = 1; line <= 300; ++line)
            scatter += std::pow(class_b.spectrum(k, line / 120.0) / 120, 2) * (line == 300 ? 2 : 1);
        CAPTURE(k, sum[k] / seeds);
        CHECK(std::abs(sum[k] / seeds - class_b.variance_of_lines(k, 600, 0.2)) < 3 * std::sqrt(scatter / seeds));
        const double expected = class_b.spectrum(k, 2.5) / 120;
        CHECK(std::abs(last[k] / seeds - expected) < 3 * expected * std::sqrt(2.0 / seeds));
    }
}

TEST_CASE("Kaimal box: every point has a mean of zero, for even and odd numbers of steps", "[property]") {
    for (const int steps : {2, 3, 45, 64}) {
        BoxGrid of = grid_12;
        of.steps = steps;
        const TurbulenceBox box = kaimal_box(class_b, of);
        for (const auto& values : box.velocity)
            for (int point = 0; point < 12; ++point) {
                double sum = 0;
                for (int t = 0; t < steps; ++t) sum += values[static_cast<std::size_t>(12 * t + point)];
                CHECK(std::abs(sum / steps) < 1e-6);
            }
    }
}

TEST_CASE("Kaimal box: an odd number of steps holds its lines", "[analytic]") {
    BoxGrid of = grid_12;
    of.steps = 45;
    Vec3 sum = Vec3::Zero();
    constexpr int seeds = 40;
    for (int i = 0; i < seeds; ++i)
        sum += realised(kaimal_box(class_b, of, {.seed = static_cast<std::uint64_t>(i)})).centre.cwiseAbs2();
    for (int k = 0; k < 3; ++k) {
        double scatter = 0;
        for (int line = 1; line <= 22; ++line)
            scatter += std::pow(class_b.spectrum(k, line / of.duration()) / of.duration(), 2);
        CHECK(std::abs(sum[k] / seeds - class_b.variance_of_lines(k, 45, 0.5)) < 3 * std::sqrt(scatter / seeds));
    }
}

TEST_CASE("Kaimal box: the same seed makes the same box, with any number of threads to the last bit", "[property]") {
    const BoxGrid of{.steps = 128, .rows = 7, .columns = 9, .time_step = 0.25, .row_spacing = 8, .column_spacing = 6};
    for (const Kaimal& with : {class_b, incoherent()}) {
        const TurbulenceBox box = kaimal_box(with, of, {.seed = 3});
        for (const int threads : {1, 2, 3, 0}) {
            const TurbulenceBox again = kaimal_box(with, of, {.seed = 3, .threads = threads});
            for (std::size_t k = 0; k < 3; ++k) CHECK((again.velocity[k] == box.velocity[k]));
        }
        const TurbulenceBox other = kaimal_box(with, of, {.seed = 4});
        CHECK_FALSE((other.velocity[0] == box.velocity[0]));
    }
}

TEST_CASE("Kaimal box: deviations are scaled to those asked for", "[property]") {
    const TurbulenceBox box = kaimal_box(class_b, grid_12),
                        scaled_box = kaimal_box(class_b, grid_12, {.scaling = DeviationScaling::centre});
    CHECK(max_abs(realised(scaled_box).centre - class_b.deviation) < 1e-6);
    const double factor = class_b.deviation[0] / realised(box).centre[0];
    for (std::size_t i = 0; i < box.velocity[0].size(); i += 37)
        CHECK(scaled_box.velocity[0][i] == Approx(factor * box.velocity[0][i]).epsilon(1e-6));
    const TurbulenceBox points = kaimal_box(class_b, grid_12, {.scaling = DeviationScaling::points});
    for (const double deviation : point_deviations(points, 2)) CHECK(deviation == Approx(1.127).epsilon(1e-6));
}

TEST_CASE("Kaimal box: progress is told and the work can be cancelled", "[property]") {
    int last = 0, all = 0, calls = 0;
    const TurbulenceBox box = kaimal_box(class_b, grid_12, {.progress = [&](int done, int total) {
                                             CHECK(done > last);
                                             last = done;
                                             all = total;
                                         }});
    CHECK(last == all);
    CHECK(box.grid == grid_12);
    const TurbulenceBox none = kaimal_box(class_b, grid_12, {.cancelled = [&] { return ++calls == 3; }});
    CHECK(calls == 3);
    CHECK(none.grid.steps == 0);
    CHECK(none.velocity[0].empty());
    const auto refuse = [](int, int) { throw Error("enough"); };
    for (const int threads : {1, 3})
        CHECK_THROWS_WITH(kaimal_box(class_b, grid_12, {.threads = threads, .progress = refuse}), "enough");
    // Whichever thread does the last piece.
    last = 0;
    static_cast<void>(kaimal_box(class_b, grid_12, {.threads = 3, .progress = [&](int done, int) { last = done; }}));
    CHECK(last == all);
}

TEST_CASE("Kaimal box: what is out of range is refused with its limit", "[property]") {
    const auto with = [](auto change) {
        BoxGrid of = grid_12;
        change(of);
        return refusal([&] { kaimal_box(class_b, of); });
    };
    const auto check = [](const std::string& message, const std::string& part) {
        CAPTURE(message);
        CHECK(message.find(part) != std::string::npos);
    };
    check(with([](BoxGrid& of) { of.rows = 1; }), "rows = 1; allowed: 2 ... 1024");
    check(with([](BoxGrid& of) { of.columns = 100000; }), "columns = 100000");
    check(with([](BoxGrid& of) { of.steps = -3; }), "steps = -3");
    check(with([](BoxGrid& of) { of.steps = 2 * 101; }), "such as 203");
    check(with([](BoxGrid& of) { of.time_step = 0; }), "time step [s] = 0");
    check(with([](BoxGrid& of) { of.row_spacing = not_a_number; }), "spacing of the rows [m] = nan");
    check(with([](BoxGrid& of) { of.column_spacing = -5; }), "spacing of the columns [m] = -5");
    check_refused([] { kaimal_box(class_b, grid_12, {.threads = -1}); }, {"threads", "-1"});
    check_refused([] { kaimal_box(Kaimal{}, grid_12); }, {"mean speed"});
}

TEST_CASE("Kaimal box: values of a seed stay as they are", "[regression]") {
    for (const Synthesis synthesis : {Synthesis::cholesky, Synthesis::fourier}) {
        const TurbulenceBox box = kaimal_box(class_b, grid_12, {.seed = 2026, .synthesis = synthesis});
        const std::vector<double> expected = synthesis == Synthesis::cholesky
                                                 ? std::vector{1.70278513, -1.59232008, -0.855336249}
                                                 : std::vector{-0.256808281, -0.0101837115, -0.0676817819};
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(box.velocity[k][box.index(17 + static_cast<int>(k), 2, 1)] ==
                  Approx(expected[k]).margin(1e-6 * class_b.deviation[static_cast<Eigen::Index>(k)]));
    }
    CHECK(description(class_b, {.seed = 5}) ==
          "Cardan: Kaimal, V 14 m/s, sigma 2.254 1.8032 1.127 m/s, L 340.2 113.4 27.72 m, Lc 340.2 m, seed 5");
}
