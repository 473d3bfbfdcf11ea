// Turbulence for a machine: grids around rotors, winds of the standard, what is made beside what is asked for.
#include "elements/turbulence/box_spectra.hpp"
#include "elements/turbulence/mann_spectra.hpp"
#include "elements/turbulence/turbulence_request.hpp"
#include "elements/wind/wind.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>

namespace cardan::testing::turbulence_request_tests {

namespace {

// 20 s of a machine at 90 m with a rotor of 126 m.
TurbulenceRequest small_request(TurbulenceModel model, std::uint64_t seed = 3) {
    TurbulenceRequest out = iec_turbulence(IecTurbulence::ntm, iec_class("IB"), 90, 12);
    out.model = model;
    out.grid = rotor_grid(90, 126, {.rows = 5, .columns = 7, .duration = 20, .time_step = 0.25});
    out.seed = seed;
    return out;
}

}  // namespace

TEST_CASE("rotor grid: it holds the rotor with a tenth of its diameter to spare, above the ground", "[property]") {
    const BoxGrid grid = rotor_grid(90, 126);
    CHECK(grid.rows == 31);
    CHECK(grid.columns == 31);
    CHECK(grid.width() == Approx(1.2 * 126).epsilon(1e-14));
    CHECK(grid.height() == Approx(1.2 * 126).epsilon(1e-14));
    CHECK(grid.lowest == Approx(90 - 0.6 * 126).epsilon(1e-14));
    CHECK(grid.steps == 12000);
    CHECK(grid.duration() == Approx(600).epsilon(1e-14));
    // The tips pass 4 m above the ground: a quarter of that stays free.
    const BoxGrid low = rotor_grid(54, 100, {.rows = 4, .columns = 5, .duration = 10, .time_step = 0.3});
    CHECK(low.lowest == Approx(1).epsilon(1e-12));
    CHECK(low.lowest + low.height() == Approx(107).epsilon(1e-12));
    CHECK(low.width() == Approx(120).epsilon(1e-12));
    CHECK(low.steps == 34);  // even, not shorter
    // 2 x 103 steps have a prime factor above 100.
    CHECK(rotor_grid(90, 126, {.duration = 206, .time_step = 1}).steps == 208);
    const BoxGrid own = rotor_grid(90, 126, {.rows = 3, .width = 130, .height = 160});
    CHECK(own.width() == Approx(130));
    CHECK(own.row_spacing == Approx(80));
}

TEST_CASE("IEC turbulence: speed, deviation and shear of the standard's winds", "[published]") {
    const IecClass wind_class = iec_class("IB");
    const TurbulenceRequest ntm = iec_turbulence(IecTurbulence::ntm, wind_class, 90, 14),
                            etm = iec_turbulence(IecTurbulence::etm, wind_class, 90, 10),
                            ewm1 = iec_turbulence(IecTurbulence::ewm1, wind_class, 90),
                            ewm50 = iec_turbulence(IecTurbulence::ewm50, wind_class, 90);
    CHECK(ntm.deviation == Approx(0.14 * (0.75 * 14 + 5.6)).epsilon(1e-14));
    CHECK(ntm.exponent == 0.2);
    CHECK(std::abs(etm.deviation - 2.96128) < 1e-9);  // as TurbSim has it
    CHECK(ewm50.speed == 50);
    CHECK(ewm1.speed == 40);
    CHECK(ewm50.deviation == Approx(5.5).epsilon(1e-14));
    CHECK(ewm50.exponent == 0.11);
    for (const IecTurbulence kind : {IecTurbulence::ntm, IecTurbulence::etm, IecTurbulence::ewm1, IecTurbulence::ewm50})
        CHECK(std::string(name_of(kind)).size() >= 3);
}

TEST_CASE("turbulence targets: their spectra hold their deviations, sigma_1 of u in both", "[analytic]") {
    for (const TurbulenceModel model : {TurbulenceModel::kaimal, TurbulenceModel::mann}) {
        const TurbulenceRequest request = small_request(model);
        const TurbulenceTarget target = target_of(request);
        CAPTURE(name_of(model));
        CHECK(target.deviations()[0] == Approx(request.deviation).epsilon(1e-5));
        // Trapezoidal rule over ln f.
        Vec3 sum = Vec3::Zero();
        const double ratio = std::pow(10, 0.05);
        for (double f = 1e-6; f < 1e4; f *= ratio) sum += target.spectra(f) * f * std::log(ratio);
        for (int c = 0; c < 3; ++c) CHECK(std::sqrt(sum[c]) == Approx(target.deviations()[c]).epsilon(2e-3));
        CHECK(target.coherence(0, 0.01, 1e-6) == Approx(1).epsilon(1e-4));
        CHECK(target.coherence(0, 0.01, 20) > target.coherence(0, 0.01, 40));
    }
    // IEC 61400-1, C.2: the standard's ratios of deviations and the coherence at 0 Hz, exp(-12 0.12 d/(8.1 42 m)).
    TurbulenceRequest request = small_request(TurbulenceModel::kaimal);
    CHECK((target_of(request).deviations() - request.deviation * Vec3(1, 0.8, 0.5)).norm() < 1e-14);
    CHECK(target_of(request).coherence(2, 1e-9, 63) == Approx(std::exp(-12 * 0.12 * 63 / (8.1 * 42))).epsilon(1e-6));
    request.transverse = TransverseCoherence::none;
    CHECK(target_of(request).coherence(2, 0.01, 63) == 0);
    CHECK(target_of(request).coherence(0, 0.01, 63) > 0);
}

TEST_CASE("made turbulence: scaled it has its deviation at the hub, and the same request makes the same",
          "[property]") {
    for (const TurbulenceModel model : {TurbulenceModel::kaimal, TurbulenceModel::mann}) {
        TurbulenceRequest request = small_request(model);
        request.scaled = true;
        const MadeTurbulence made = make_turbulence(request), again = make_turbulence(request);
        CAPTURE(made.note);
        CHECK(made.realised.centre[0] == Approx(request.deviation).epsilon(1e-5));
        CHECK(made.box.velocity == again.box.velocity);
        CHECK(made.mean.speed == 12);
        CHECK(made.mean.exponent == 0.2);
        request.threads = 2;
        CHECK(make_turbulence(request).box.velocity == made.box.velocity);
        request.seed = 4;
        CHECK(make_turbulence(request).box.velocity != made.box.velocity);
        request.cancelled = [] { return true; };
        CHECK(make_turbulence(request).box.grid.steps == 0);
    }
}

TEST_CASE("made turbulence: over seeds the deviations are those expected", "[property]") {
    for (const TurbulenceModel model : {TurbulenceModel::kaimal, TurbulenceModel::mann}) {
        constexpr int seeds = 20;
        std::vector<Vec3> variances;
        Vec3 mean = Vec3::Zero(), expected = Vec3::Zero();
        for (int seed = 1; seed <= seeds; ++seed) {
            const MadeTurbulence made = make_turbulence(small_request(model, static_cast<std::uint64_t>(seed)));
            variances.emplace_back(made.realised.points.cwiseAbs2());
            mean += variances.back() / seeds;
            expected = made.expected;
        }
        Vec3 spread = Vec3::Zero();
        for (const Vec3& one : variances) spread += (one - mean).cwiseAbs2() / (seeds - 1);
        for (int c = 0; c < 3; ++c) {
            CAPTURE(name_of(model), c);
            CHECK(std::abs(mean[c] - expected[c] * expected[c]) < 3 * std::sqrt(spread[c] / seeds));
        }
    }
}

TEST_CASE("made turbulence: as a wind in memory it is the mean and the box, also below the grid", "[property]") {
    const MadeTurbulence made = make_turbulence(small_request(TurbulenceModel::kaimal));
    const Wind wind(wind_box_of(made), made.mean);
    const BoxGrid& grid = made.box.grid;
    const double y = 2 * grid.column_spacing - grid.width() / 2, z = grid.lowest + 3 * grid.row_spacing;
    const Vec3 there = wind.at(5 * 0.25).at({0, y, z});
    for (std::size_t c = 0; c < 3; ++c) {
        const double turbulence = static_cast<double>(made.box.velocity[c][made.box.index(5, 3, 2)]);
        const double mean = c == 0 ? 12 * std::pow(z / 90, 0.2) : 0;
        CHECK(there[static_cast<int>(c)] == Approx(mean + turbulence).epsilon(1e-6));
    }
    // A wave length downwind it is the same; at 5 m that of the lowest row.
    CHECK((wind.at(1.25 + 20).at({0, y, z}) - there).norm() < 1e-12);
    CHECK((wind.at(1.25 + 3).at({36, y, z}) - there).norm() < 1e-9);
    CHECK(wind.at(0).at({0, 0, 5}).x() ==
          Approx(12 * std::pow(5 / 90.0, 0.2) + static_cast<double>(made.box.velocity[0][made.box.index(0, 0, 3)]))
              .epsilon(1e-6));
    // The box's own spectra are those of the realised deviation.
    const double variance = power_spectrum(spectrum_lines(series_at(*wind.box(), 0, 2, 3))).variance();
    CHECK(variance == Approx(made.realised.centre[0] * made.realised.centre[0]).epsilon(1e-6));
}

TEST_CASE("notes of made turbulence: the request comes back, and other notes give none", "[property]") {
    TurbulenceRequest request = small_request(TurbulenceModel::mann, 123456789);
    request.scaled = true;
    request.order = PlaneOrder::first_first;
    request.speed = 11.4 / 3;
    const std::string note = make_turbulence(request).note;
    CHECK(note.size() <= 200);
    const auto found = request_of_note(note);
    REQUIRE(found);
    CHECK(found->model == TurbulenceModel::mann);
    CHECK(found->speed == request.speed);
    CHECK(found->deviation == request.deviation);
    CHECK(found->hub_height == 90);
    CHECK(found->exponent == 0.2);
    CHECK(found->seed == 123456789);
    CHECK(found->scaled);
    CHECK(found->order == PlaneOrder::first_first);
    request = small_request(TurbulenceModel::kaimal);
    request.transverse = TransverseCoherence::none;
    CHECK(request_of_note(make_turbulence(request).note)->transverse == TransverseCoherence::none);
    for (const char* other : {"", "TurbSim, V 12 m/s", "Cardan: ", "Cardan: gauss, V 12 m/s",
                              "Cardan: kaimal, V 12 m/s", "Cardan: kaimal, V x m/s, hub 90 m, sigma_1 2 m/s",
                              "Cardan: kaimal, seed -1", "Cardan: kaimal, V 12 m/s, hub 90 m, sigma_1 2 m/s, colour 3"})
        CHECK(!request_of_note(other));
}

TEST_CASE("turbulence requests: bad input is refused with limit", "[property]") {
    const IecClass wind_class;
    check_refused([] { rotor_grid(0, 1); }, {"hub height [m] = 0"});
    check_refused([] { rotor_grid(50, 100); }, {"rotor diameter [m] = 100", "below 100, twice the hub height"});
    check_refused([] { rotor_grid(90, 126, {.rows = 1}); }, {"rows = 1", "at least 2"});
    check_refused([] { rotor_grid(90, 126, {.width = 120}); }, {"width [m] = 120", "at least 126"});
    check_refused([] { rotor_grid(90, 126, {.height = 180}); }, {"height [m] = 180", "below 180"});
    check_refused([] { rotor_grid(90, 126, {.duration = 0}); }, {"duration [s] = 0"});
    check_refused([] { rotor_grid(90, 126, {.time_step = -1}); }, {"time step [s] = -1"});
    check_refused([] { rotor_grid(90, 126, {.duration = 1e9, .time_step = 1e-3}); }, {"1e+12", "at most 67108864"});
    check_refused([&] { iec_turbulence(IecTurbulence::ntm, wind_class, 90, 0); }, {"mean wind speed [m/s] = 0"});
    check_refused([&] { iec_turbulence(IecTurbulence::ewm1, wind_class, 90, 12); }, {"ewm1", "as the class has it"});
    TurbulenceRequest request = small_request(TurbulenceModel::kaimal);
    request.deviation = 0;
    check_refused([&] { make_turbulence(request); }, {"standard deviation [m/s] = 0"});
    request = small_request(TurbulenceModel::kaimal);
    request.exponent = 3;
    check_refused([&] { target_of(request); }, {"exponent of the shear = 3", "-1 ... 1"});
    request = small_request(TurbulenceModel::mann);
    request.grid.rows = 1;
    check_refused([&] { make_turbulence(request); }, {"rows = 1"});
}

}  // namespace cardan::testing::turbulence_request_tests
