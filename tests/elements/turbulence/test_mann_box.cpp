// Boxes of Mann's turbulence: what the steps of a box are, statistics over seeds, options.
#include "elements/turbulence/box_statistics.hpp"
#include "elements/turbulence/detail/mann_waves.hpp"
#include "elements/turbulence/mann_box.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace cardan::testing::mann_box_tests {

namespace {

MannOptions small_box(int steps = 64) {
    MannOptions out;
    out.grid = {.steps = steps, .rows = 5, .columns = 4, .time_step = 0.5, .row_spacing = 5, .column_spacing = 6};
    out.speed = 9;
    out.parameters = {3.9, 20, 0.4};
    out.width = 8 * 6;
    out.height = 10 * 5;
    return out;
}

// u(x) = 2 Re sum over k_1 > 0 of waves exp(i k.x).
Vec3 direct_sum(const MannOptions& options, double x, double y, double z) {
    const detail::MannLattice lattice(options);
    detail::MannPlane plane(lattice);
    Vec3 sum = Vec3::Zero();
    for (int i = 1; i <= lattice.last1; ++i) {
        plane.draw(i);
        for (int j = -lattice.last2; j <= lattice.last2; ++j)
            for (int k = -lattice.last3; k <= lattice.last3; ++k) {
                const Complex wave = std::polar(2.0, i * lattice.dk1 * x + j * lattice.dk2 * y + k * lattice.dk3 * z);
                for (int c = 0; c < 3; ++c) sum(c) += (plane.wave(j, k)[static_cast<std::size_t>(c)] * wave).real();
            }
    }
    return sum;
}

Vec3 of_box(const TurbulenceBox& box, int step, int row, int column) {
    const std::size_t at = box.index(step, row, column);
    return {box.velocity[0][at], box.velocity[1][at], box.velocity[2][at]};
}

bool same(const TurbulenceBox& a, const TurbulenceBox& b) {
    return a.velocity == b.velocity;
}

// sum_s u(s) exp(-2 pi i line s/N)/N
Complex line_of(const TurbulenceBox& box, std::size_t component, int line, int row, int column) {
    Complex sum = 0;
    for (int s = 0; s < box.grid.steps; ++s)
        sum +=
            std::polar<double>(box.velocity[component][box.index(s, row, column)], -2 * pi * line * s / box.grid.steps);
    return sum / static_cast<double>(box.grid.steps);
}

// Mean of what seeds give, and how far from it the expectation may be: 3 standard errors.
struct OverSeeds {
    double sum = 0, squares = 0;
    int count = 0;

    void add(double value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    double mean() const { return sum / count; }
    double error() const { return 3 * std::sqrt((squares / count - mean() * mean()) / (count - 1)); }
};

}  // namespace

TEST_CASE("Mann's box: its steps are the sum of its waves, the last plane first", "[crosscheck]") {
    for (const int steps : {48, 45}) {  // with and without a line at half the sampling rate
        const MannOptions options = small_box(steps);
        const MannBox box = mann_box(options);
        const double spacing = options.speed * options.grid.time_step;
        for (const auto& [step, row, column] :
             {std::array{0, 0, 0}, std::array{7, 4, 3}, std::array{steps - 1, 2, 1}, std::array{20, 3, 0}}) {
            CAPTURE(steps, step, row, column);
            const Vec3 right = direct_sum(options, (steps - 1 - step) * spacing, column * 6, row * 5);
            CHECK(max_abs(of_box(box, step, row, column) - right) < 1e-6);
        }
        MannOptions mirrored = options;
        mirrored.order = PlaneOrder::first_first;
        const MannBox other = mann_box(mirrored);
        for (int step = 0; step < steps; ++step)
            CHECK(of_box(other, step, 1, 2) == of_box(box, steps - 1 - step, 1, 2));
    }
}

// Sums over all lines of k_1 of the lattice's own wave numbers are the expectation. Bands of lines, so that there are
// fewer numbers than would make 3 standard errors rare. The upper point leads: the cross-spectrum over time, of the
// lower point with the upper one, has a positive phase, opposite to that over the distance downwind.
TEST_CASE("Mann's box: spectra and phases of many seeds are those of its wave numbers", "[property]") {
    MannOptions options = small_box(64);
    const detail::MannLattice lattice(options);
    detail::MannPlane plane(lattice);
    constexpr int bands = 4, seeds = 60;
    constexpr std::array<int, bands + 1> first{1, 3, 7, 15, 32};
    std::array<Mat3, bands> expected;
    std::array<Complex, bands> upward;  // F_uu between rows 3 apart
    for (std::size_t band = 0; band < bands; ++band) {
        expected[band].setZero();
        for (int line = first[band]; line < first[band + 1]; ++line) {
            plane.draw(line);
            expected[band] += plane.covariance();
            for (int j = -lattice.last2; j <= lattice.last2; ++j)
                for (int k = -lattice.last3; k <= lattice.last3; ++k) {
                    const Mat3 A = lattice.root(Vec3(line * lattice.dk1, std::abs(j) * lattice.dk2, k * lattice.dk3));
                    upward[band] += std::polar(A.row(0).squaredNorm(), 3 * k * lattice.dk3 * options.grid.row_spacing);
                }
        }
    }
    std::array<std::array<OverSeeds, 6>, bands> spectra;  // uu, vv, ww, uw, uv, vw
    std::array<OverSeeds, bands> real, imaginary;
    for (int seed = 1; seed <= seeds; ++seed) {
        options.seed = static_cast<std::uint64_t>(seed);
        const MannBox box = mann_box(options);
        for (std::size_t band = 0; band < bands; ++band) {
            std::array<double, 6> sums{};
            Complex cross = 0;
            for (int line = first[band]; line < first[band + 1]; ++line)
                for (const int column : {0, 3}) {
                    const Complex u = line_of(box, 0, line, 0, column), v = line_of(box, 1, line, 0, column),
                                  w = line_of(box, 2, line, 0, column), above = line_of(box, 0, line, 3, column);
                    const std::array<double, 6> all{std::norm(u),
                                                    std::norm(v),
                                                    std::norm(w),
                                                    (std::conj(u) * w).real(),
                                                    (std::conj(u) * v).real(),
                                                    (std::conj(v) * w).real()};
                    for (std::size_t i = 0; i < all.size(); ++i) sums[i] += all[i] / 2;
                    cross += std::conj(u) * above / 2.0;
                }
            for (std::size_t i = 0; i < sums.size(); ++i) spectra[band][i].add(sums[i]);
            real[band].add(cross.real());
            imaginary[band].add(cross.imag());
        }
    }
    for (std::size_t band = 0; band < bands; ++band) {
        const Mat3& right = expected[band];
        const std::array<double, 6> values{right(0, 0), right(1, 1), right(2, 2), right(0, 2), 0, 0};
        for (std::size_t i = 0; i < values.size(); ++i) {
            CAPTURE(band, i);
            CHECK(std::abs(spectra[band][i].mean() - values[i]) < spectra[band][i].error());
        }
        CHECK(std::abs(real[band].mean() - upward[band].real()) < real[band].error());
        CHECK(std::abs(imaginary[band].mean() + upward[band].imag()) < imaginary[band].error());
    }
    CHECK(upward[1].imag() < 0);
    CHECK(imaginary[1].mean() > imaginary[1].error());
}

TEST_CASE("Mann's box: the expected variances are those of its waves, and no point has a mean", "[property]") {
    const MannOptions options = small_box();
    const MannBox box = mann_box(options);
    const detail::MannLattice lattice(options);
    detail::MannPlane plane(lattice);
    Mat3 sum = Mat3::Zero();
    for (int i = 1; i <= lattice.last1; ++i) {
        plane.draw(i);
        sum += 2 * plane.covariance();
    }
    CHECK(max_abs(box.expected - sum) < 1e-12 * sum.trace());
    for (int c = 0; c < 3; ++c) {
        double mean = 0;
        for (int step = 0; step < 64; ++step) mean += of_box(box, step, 2, 3)(c) / 64;
        CHECK(std::abs(mean) < 1e-6);
    }
}

TEST_CASE("Mann's box: the same for the same seed and for any number of threads", "[property]") {
    MannOptions options = small_box();
    const MannBox box = mann_box(options);
    CHECK(same(mann_box(options), box));
    for (const int threads : {3, 0}) {
        options.threads = threads;
        const MannBox other = mann_box(options);
        CHECK(same(other, box));
        CHECK(other.expected == box.expected);
    }
    options.seed = std::uint64_t{1} << 40;
    CHECK(!same(mann_box(options), box));
}

TEST_CASE("Mann's box: scaled by one factor", "[property]") {
    MannOptions options = small_box();
    const MannBox plain = mann_box(options);
    options.sigma = 1.7;
    for (const MannScaling scaling : {MannScaling::expected, MannScaling::centre, MannScaling::points}) {
        options.scaling = scaling;
        const MannBox box = mann_box(options);
        const RealisedTurbulence is = realised(box);
        const double sigma = scaling == MannScaling::expected ? std::sqrt(box.expected(0, 0))
                             : scaling == MannScaling::centre ? is.centre[0]
                                                              : is.points[0];
        CHECK(sigma == Approx(1.7).epsilon(1e-6));
        CHECK(max_abs(of_box(box, 5, 1, 2) - box.factor * of_box(plain, 5, 1, 2)) < 1e-6);
        CHECK(max_abs(box.expected - box.factor * box.factor * plain.expected) < 1e-12);
    }
}

TEST_CASE("Mann's box: domain by default, twice the grid and 8 L at least, fast to transform", "[property]") {
    MannOptions options;
    options.grid = {.steps = 600, .rows = 31, .columns = 15, .time_step = 1, .row_spacing = 5, .column_spacing = 5};
    options.speed = 10;
    const MannDomain domain = mann_domain(options);
    CHECK(domain.rows == 60);
    CHECK(domain.height == 300);
    CHECK(domain.columns == 54);  // 268.8 m
    CHECK(domain.width == 270);
    options.width = 15 * 5;
    CHECK(mann_domain(options).columns == 16);
}

TEST_CASE("Mann's box: may be cancelled, and says how far it is", "[property]") {
    MannOptions options = small_box();
    int last = 0, total = 0;
    options.progress = [&](int done, int all) {
        CHECK(done >= last);
        last = done;
        total = all;
    };
    CHECK(mann_box(options).grid.steps == 64);
    CHECK(last == total);
    options.progress = {};
    int calls = 0;
    options.cancelled = [&] { return ++calls == 4; };
    const MannBox box = mann_box(options);
    CHECK(box.grid.steps == 0);
    CHECK(box.velocity[0].empty());
    CHECK(calls == 4);
}

TEST_CASE("Mann's box: options that are refused", "[property]") {
    const auto refused = [](auto change, std::initializer_list<std::string> parts) {
        MannOptions options = small_box();
        change(options);
        check_refused([&] { (void)mann_box(options); }, parts);
    };
    refused([](MannOptions& o) { o.grid.steps = 2; }, {"steps = 2", "3 to"});
    refused([](MannOptions& o) { o.grid.steps = 1009; }, {"steps = 1009", "prime factor", "1024 is fast"});
    refused([](MannOptions& o) { o.grid.rows = 1; }, {"rows = 1", "2 to"});
    refused([](MannOptions& o) { o.grid.columns = 100000; }, {"columns = 100000"});
    refused([](MannOptions& o) { o.grid.time_step = 0; }, {"time step", "> 0"});
    refused([](MannOptions& o) { o.grid.row_spacing = -1; }, {"row spacing"});
    refused([](MannOptions& o) { o.grid.column_spacing = not_a_number; }, {"column spacing"});
    refused([](MannOptions& o) { o.speed = 0; }, {"speed"});
    refused([](MannOptions& o) { o.parameters.gamma = -1; }, {"gamma"});
    refused([](MannOptions& o) { o.width = 20; }, {"period of the width [m] = 20", "24"});
    refused([](MannOptions& o) { o.height = infinite; }, {"points over the period of the height", "coarser"});
    refused(
        [](MannOptions& o) {
            o.width = 0;
            o.parameters.length_scale = 1e6;
        },
        {"points over the period of the width", "shorter period"});
    refused([](MannOptions& o) { o.scaling = MannScaling::centre; }, {"standard deviation to scale to", "> 0"});
    refused([](MannOptions& o) { o.threads = -1; }, {"threads = -1", "0 (one per processor)"});
}

}  // namespace cardan::testing::mann_box_tests
