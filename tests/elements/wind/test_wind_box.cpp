// Winds from boxes: linear fields come out exactly, with their gradients; edges, the ground and turned axes.
#include "elements/wind/box_files.hpp"
#include "elements/wind/wind.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

namespace cardan::testing::wind_box_tests {

namespace {

constexpr BoxGrid small_grid{
    .steps = 8, .rows = 4, .columns = 5, .time_step = 0.5, .row_spacing = 10, .column_spacing = 8, .lowest = 20};
constexpr double speed = 12;

// Numbers in the order of TurbSim: planes, rows, columns, components.
template <class Number>
WindBoxData box_of(const BoxGrid& grid, const std::function<Number(int c, int t, int k, int j)>& number) {
    const auto numbers = std::make_shared<std::vector<Number>>();
    for (int t = 0; t < grid.steps; ++t)
        for (int k = 0; k < grid.rows; ++k)
            for (int j = 0; j < grid.columns; ++j)
                for (int c = 0; c < 3; ++c) numbers->push_back(number(c, t, k, j));
    WindBoxData box{.grid = grid, .components = {}, .speed = speed, .memory = numbers};
    for (int c = 0; c < 3; ++c)
        box.components.at(static_cast<std::size_t>(c)) = {
            .data = numbers->data() + c,
            .type = std::is_same_v<Number, float> ? BoxNumbers::Type::float32 : BoxNumbers::Type::int16,
            .step = 3 * std::ptrdiff_t{grid.rows} * grid.columns,
            .row = 3 * std::ptrdiff_t{grid.columns},
            .column = 3};
    return box;
}

// By integers, so that sums are exact.
WindBoxData linear_box() {
    return box_of<float>(small_grid, [](int c, int t, int k, int j) {
        return static_cast<float>((c + 1) * t + (c - 2) * k + (2 * c + 1) * j + c);
    });
}

WindBoxData random_box(std::uint32_t seed, const BoxGrid& grid = small_grid) {
    Random random(seed);
    return box_of<float>(grid, [&](int, int, int, int) { return static_cast<float>(uniform(random, -3, 3)); });
}

// Within the box at every time from 0 to 3 s.
Vec3 random_place(Random& random) {
    return {uniform(random, -5, 0), uniform(random, -16, 16), uniform(random, 20, 50)};
}

}  // namespace

TEST_CASE("wind box: a linear field comes out exactly, with its gradient", "[analytic]") {
    const WindBox box(linear_box());
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        const Vec3 place = random_place(random);
        const double time = uniform(random, 0, 3), t = (time - place.x() / speed) / 0.5, k = (place.z() - 20) / 10,
                     j = (place.y() + 16) / 8;
        const WindBox::Sample found = box.with_gradient(place, time);
        CHECK(found.velocity == box.at(place, time));
        for (int c = 0; c < 3; ++c) {
            CHECK(found.velocity(c) == Approx((c + 1) * t + (c - 2) * k + (2 * c + 1) * j + c).margin(1e-12));
            CHECK(found.gradient(c, 0) == Approx(-(c + 1) / (0.5 * speed)).epsilon(1e-12));
            CHECK(found.gradient(c, 1) == Approx((2 * c + 1) / 8.0).epsilon(1e-12));
            CHECK(found.gradient(c, 2) == Approx((c - 2) / 10.0).margin(1e-12));
        }
    }
    CHECK(box.at_point(3, 2, 1) == Vec3(3 - 4 + 1, 6 - 2 + 3 + 1, 9 + 5 + 2));
}

TEST_CASE("wind box: numbers as they lie, of either type, backwards and scaled, give one wind", "[analytic]") {
    Random random(2);
    const auto number = [](int c, int t, int k, int j) {
        return static_cast<std::int16_t>((7919 * (t + 8 * (k + 4 * (j + 5 * c)))) % 2003 - 1000);
    };
    WindBoxData whole = box_of<std::int16_t>(small_grid, number);
    for (BoxNumbers& of : whole.components) {
        of.scale = 0.03125;
        of.offset = 3;
    }
    const WindBox by_integers(whole), by_floats(box_of<float>(small_grid, [&](int c, int t, int k, int j) {
        return 3 + 0.03125F * static_cast<float>(number(c, t, k, j));
    }));
    // Turned about in memory: planes, rows and columns run backwards.
    WindBoxData backwards = box_of<float>(small_grid, [&](int c, int t, int k, int j) {
        return 3 + 0.03125F * static_cast<float>(number(c, 7 - t, 3 - k, 4 - j));
    });
    for (BoxNumbers& of : backwards.components) {
        of.data = static_cast<const float*>(of.data) + 7 * of.step + 3 * of.row + 4 * of.column;
        of.step = -of.step;
        of.row = -of.row;
        of.column = -of.column;
    }
    const WindBox reversed(backwards);
    for (int i = 0; i < 50; ++i) {
        const Vec3 place = random_place(random);
        const double time = uniform(random, 0, 3);
        CHECK((by_integers.at(place, time) - by_floats.at(place, time)).norm() < 1e-12);
        CHECK(reversed.at(place, time) == by_floats.at(place, time));
    }
}

TEST_CASE("wind box: gradients are those of differences, below the grid too", "[analytic]") {
    WindBoxData data = random_box(3);
    data.means.resize(20);
    Random random(4);
    for (double& mean : data.means) mean = uniform(random, -1, 1);
    data.periodic = true;
    const auto tower_numbers = std::make_shared<std::vector<float>>();
    for (int i = 0; i < 8 * 2 * 3; ++i) tower_numbers->push_back(static_cast<float>(uniform(random, -3, 3)));
    BoxTower tower{.components = {}, .points = 2, .highest = 20, .spacing = 8};
    for (int c = 0; c < 3; ++c)
        tower.components.at(static_cast<std::size_t>(c)) = {.data = tower_numbers->data() + c, .step = 6, .row = 3};
    data.tower = tower;
    for (const BelowBox below : {BelowBox::tower, BelowBox::to_ground}) {
        data.below = below;
        const WindBox box(data);
        for (int i = 0; i < 200; ++i) {
            const Vec3 place(uniform(random, -90, 90), uniform(random, -16, 16), uniform(random, 1, 50));
            const double time = uniform(random, -20, 20), h = 1e-6;
            Mat3 expected;
            for (int x = 0; x < 3; ++x)
                expected.col(x) =
                    (box.at(place + h * Vec3::Unit(x), time) - box.at(place - h * Vec3::Unit(x), time)) / (2 * h);
            const Mat3 found = box.with_gradient(place, time).gradient;
            // A cell's edge between the two places is rare, and known by both sides.
            const double at = (time - place.x() / speed) / 0.5;
            if (std::abs(at - std::round(at)) < 1e-5) continue;
            CHECK((found - expected).norm() < 1e-7);
        }
        CHECK(box.at({0, 0, 0}, 1).isZero(0));
        CHECK(box.at({0, 0, -4}, 1).isZero(0));
        CHECK(box.at({0, 3, 1e-9}, 1).norm() < 1e-8);
    }
    data.below = BelowBox::to_ground;
    CHECK((WindBox(data).at({0, 3, 5}, 1) - 0.25 * WindBox(data).at({0, 3, 20}, 1)).norm() < 1e-12);
}

TEST_CASE("wind box: periodic in time, without a step where it begins again", "[analytic]") {
    WindBoxData data = random_box(5);
    data.periodic = true;
    const WindBox box(data);
    Random random(6);
    for (int i = 0; i < 20; ++i) {
        const Vec3 place = random_place(random);
        const double time = uniform(random, -50, 50);
        CHECK((box.at(place, time) - box.at(place, time + 4)).norm() < 1e-11);
        CHECK((box.at(place, time) - box.at(place - Vec3(speed * 4, 0, 0), time)).norm() < 1e-11);
    }
    const Vec3 there(0, 1, 30);
    CHECK((box.at(there, 4 - 1e-9) - box.at(there, 4 + 1e-9)).norm() < 1e-7);
    CHECK((box.at(there, 3.75) - (box.at(there, 3.5) + box.at(there, 0)) / 2).norm() < 1e-12);
}

TEST_CASE("wind box: outside it refuses, holds or repeats, and never is silently still", "[analytic]") {
    WindBoxData data = random_box(7);
    data.start = 6;  // half a second early
    const WindBox box(data), held = box.with_outside(OutsideBox::hold), repeated = box.with_outside(OutsideBox::repeat);
    const Vec3 there(0, 1, 30);
    CHECK_NOTHROW(box.at(there, -0.5));
    CHECK_NOTHROW(box.at(there, 3));
    CHECK_NOTHROW(box.at({0, 16 + 0.8e-2 * 0.9, 50 + 0.9e-2}, 1));  // a thousandth of a cell
    check_refused([&] { box.at(there, -0.6); }, {"wind box", "time in the box [s] = -0.1", "0 ... 3.5", "(0, 1, 30) m",
                                                 "t = -0.6 s", "OutsideBox::hold or OutsideBox::repeat"});
    check_refused([&] { box.at(there, 3.1); }, {"time in the box [s] = 3.6"});
    check_refused([&] { box.at({0, 17, 30}, 1); }, {"place across the wind [m] = 17", "-16 ... 16"});
    check_refused([&] { box.at({0, -17, 30}, 1); }, {"place across the wind [m] = -17"});
    check_refused([&] { box.at({0, 0, 51}, 1); }, {"height [m] = 51", "20 ... 50"});
    check_refused([&] { box.at({0, 0, 19}, 1); }, {"height [m] = 19"});
    check_refused([&] { box.at({0, 0, std::nan("")}, 1); }, {"height [m] = nan"});
    check_refused([&] { box.at({std::nan(""), 0, 30}, 1); }, {"time in the box"});
    check_refused([&] { held.at({0, std::nan(""), 30}, 1); }, {"place across the wind [m] = nan"});
    CHECK(held.at(there, -9) == box.at(there, -0.5));
    CHECK(held.at(there, 90) == box.at(there, 3));
    CHECK(held.at({0, 40, 30}, 1) == box.at({0, 16, 30}, 1));
    CHECK(held.at({0, -40, 60}, 1) == box.at({0, -16, 50}, 1));
    CHECK(held.at({0, 0, 7}, 1) == box.at({0, 0, 20}, 1));
    const WindBox::Sample edge = held.with_gradient({0, 40, 60}, 90);
    CHECK(edge.gradient.isZero(0));
    CHECK((repeated.at(there, 1) - repeated.at(there, 5)).norm() < 1e-12);
    CHECK((repeated.at(there, 1) - repeated.at({0, 1 + 40, 30}, 1)).norm() < 1e-12);
    CHECK(repeated.at({0, 1, 90}, 1) == box.at({0, 1, 50}, 1));
}

TEST_CASE("wind box: of two points that are as near the lower right one is taken", "[analytic]") {
    CHECK(small_grid.row_near(35) == 1);
    CHECK(small_grid.row_near(35.1) == 2);
    CHECK(small_grid.row_near(-9) == 0);
    CHECK(small_grid.row_near(99) == 3);
    CHECK(small_grid.column_near(0) == 2);
    CHECK(small_grid.column_near(4) == 2);
    CHECK(small_grid.column_near(-4) == 1);
    CHECK(small_grid.height_of(small_grid.row_near(42)) == 40);
    CHECK(small_grid.place_of(small_grid.column_near(15)) == 16);
}

TEST_CASE("wind box: a file that is written to, or shortened, is found out", "[property]") {
    const std::filesystem::path path = std::filesystem::path(CARDAN_TEST_OUTPUT_DIR) / "changing.bin";
    const auto write = [&](std::size_t bytes) { std::ofstream(path, std::ios::binary) << std::string(bytes, 'a'); };
    write(100);
    const auto guard = change_guard({std::make_shared<const MappedFile>(path)});
    CHECK_NOTHROW(guard());
    write(99);
    CHECK_THROWS_WITH(guard(), Catch::Contains("changing.bin") && Catch::Contains("has now 99 bytes"));
    write(100);
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(2));
    CHECK_THROWS_WITH(guard(), Catch::Contains("was written to while a run was in it"));
}

TEST_CASE("wind box: grids and numbers that cannot be are refused", "[bad input]") {
    const auto refused = [](const std::function<void(WindBoxData&)>& change, const char* words) {
        WindBoxData data = random_box(8);
        change(data);
        check_refused([&] { WindBox box(std::move(data)); }, {words});
    };
    refused([](WindBoxData& d) { d.grid.steps = 1; }, "number of planes = 1");
    refused([](WindBoxData& d) { d.grid.rows = 0; }, "number of rows = 0");
    refused([](WindBoxData& d) { d.grid.columns = -3; }, "number of columns = -3");
    refused([](WindBoxData& d) { d.grid.time_step = 0; }, "time between planes [s] = 0");
    refused([](WindBoxData& d) { d.grid.row_spacing = -1; }, "spacing of the rows [m] = -1");
    refused([](WindBoxData& d) { d.speed = 0; }, "speed with which the air passes [m/s] = 0");
    refused([](WindBoxData& d) { d.means.resize(3); }, "number of means = 3");
    refused([](WindBoxData& d) { d.components[1].data = nullptr; }, "numbers = none");
    refused([](WindBoxData& d) { d.below = BelowBox::tower; }, "points of the tower = none");
}

TEST_CASE("wind with a box: steady wind and box are added; turned axes turn both and the places", "[analytic]") {
    WindBoxData data = random_box(9);
    data.periodic = true;
    const auto box = std::make_shared<const WindBox>(data);
    const SteadyWind steady{.speed = 9, .reference_height = 35, .shear = Shear::power, .exponent = 0.2};
    const Wind wind(box, steady), turned = wind.turned(0.3, 0.1);
    CHECK(!wind.is_steady());
    const WindAxes axes(0.3, 0.1, 35);
    CHECK((axes.R * axes.R.transpose() - Mat3::Identity()).norm() < 1e-15);
    CHECK((axes.R.transpose() * Vec3(1, 0, 0) -
           Vec3(std::cos(0.1) * std::cos(0.3), std::cos(0.1) * std::sin(0.3), std::sin(0.1)))
              .norm() < 1e-15);
    Random random(10);
    std::vector<Vec3> places, many(20);
    for (int i = 0; i < 20; ++i)
        places.push_back({uniform(random, -5, 5), uniform(random, -9, 9), uniform(random, 26, 44)});
    const double time = 1.3;
    wind.at(time).at(places, many);
    for (std::size_t i = 0; i < places.size(); ++i) {
        CHECK((many[i] - steady.at(places[i]) - box->at(places[i], time)).norm() < 1e-13);
        CHECK((wind.at(time).at(places[i]) - many[i]).norm() < 1e-13);
        // A place that is turned with the wind feels the same, turned.
        const Vec3 pivot(0, 0, 35), there = axes.R.transpose() * (places[i] - pivot) + pivot;
        CHECK((turned.at(time).at(there) - axes.R.transpose() * many[i]).norm() < 1e-12);
        const Mat3 gradient = turned.at(time).gradient_at(there);
        CHECK((gradient - axes.R.transpose() * wind.at(time).gradient_at(places[i]) * axes.R).norm() < 1e-12);
        // Seen from ground that lies lower.
        const Vec3 down(0, 0, -15);
        CHECK((wind.over(-15).at(time).at(places[i] + down) - many[i]).norm() < 1e-12);
        CHECK((turned.over(-15).at(time).at(there + down) - turned.at(time).at(there)).norm() < 1e-12);
    }
    CHECK(turned.mean().direction == 0.3);
    CHECK(turned.mean().speed == 9);
    CHECK((turned.turned(-0.3, -0.1).at(time).at(places[0]) - many[0]).norm() < 1e-13);
    check_refused([&] { static_cast<void>(wind.turned(0, 2)); }, {"upflow [rad] = 2"});
    check_refused([&] { Wind none(std::shared_ptr<const WindBox>(), steady); }, {"box = none"});
}

TEST_CASE("wind with a box: a machine's mirror image sees the mirror image of the wind", "[analytic]") {
    WindBoxData data = random_box(11), mirrored = data;
    for (BoxNumbers& of : mirrored.components) {
        of.data = static_cast<const float*>(of.data) + 4 * of.column;
        of.column = -of.column;
    }
    mirrored.components[1].scale = -1;
    const SteadyWind steady{.speed = 9, .direction = 0.1, .lateral = 0.002};
    SteadyWind other = steady;
    other.direction = -0.1;
    other.lateral = -0.002;
    const Wind wind = Wind(std::make_shared<const WindBox>(data), steady).turned(0.2, 0.05),
               image = Wind(std::make_shared<const WindBox>(mirrored), other).turned(-0.2, 0.05);
    const Vec3 flip(1, -1, 1), place(-3, 7, 33);
    CHECK((image.at(1).at(flip.cwiseProduct(place)) - flip.cwiseProduct(wind.at(1).at(place))).norm() < 1e-13);
}

TEST_CASE("wind with a box: the steady wind near to it has its mean speed and shear", "[analytic]") {
    const WindBox box(box_of<float>(small_grid, [](int c, int t, int k, int) {
        const double waves = t % 2 == 0 ? 1 : -1;
        return c == 0 ? static_cast<float>(10 * std::pow((20 + 10.0 * k) / 35, 0.14) + waves) : 0.F;
    }));
    const Wind wind(std::make_shared<const WindBox>(box), {.speed = 0, .reference_height = 35});
    const SteadyWind steady = wind.mean();
    CHECK(steady.speed == Approx(10).epsilon(2e-3));
    CHECK(steady.exponent == Approx(0.14).epsilon(1e-2));
    CHECK(steady.at({0, 0, 50}).x() == Approx(10 * std::pow(50 / 35.0, 0.14)).epsilon(3e-3));
}

TEST_CASE("checksum: of known bytes, and in parts as of the whole", "[analytic]") {
    std::array<std::byte, 24> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes.at(i) = static_cast<std::byte>(i * 37);
    const std::span all(bytes);
    CHECK(checksum_of(all.subspan(16), checksum_of(all.first(16))) == checksum_of(all));
    CHECK(checksum_of(all.first(23)) != checksum_of(all));
    CHECK(checksum_text(checksum_of({})) == "cbf29ce484222325");
    // FNV-1a of the one byte 'a' [Fowler, Noll, Vo].
    const std::array<std::byte, 1> a{std::byte{'a'}};
    CHECK(checksum_text(checksum_of(a)) == "af63dc4c8601ec8c");
}

}  // namespace cardan::testing::wind_box_tests
