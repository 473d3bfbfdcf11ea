// Files of TurbSim, read here byte by byte, and against one that InflowWind reads as its table of values says.
#include "elements/turbulence/kaimal_box.hpp"
#include "elements/turbulence/turbsim_writer.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

using namespace cardan;
using namespace cardan::testing;

namespace {

struct ByteReader {
    std::string all;
    std::size_t at = 0;

    std::uint32_t bits(std::size_t count) {
        std::uint32_t out = 0;
        for (std::size_t i = 0; i < count; ++i)
            out |= static_cast<std::uint32_t>(static_cast<unsigned char>(all.at(at + i))) << (8 * i);
        at += count;
        return out;
    }
    int short_number() { return static_cast<std::int16_t>(bits(2)); }
    int number() { return static_cast<std::int32_t>(bits(4)); }
    double real() { return static_cast<double>(std::bit_cast<float>(bits(4))); }
};

struct FileOfTurbsim {
    int id, rows, columns, tower, steps;
    double row_spacing, column_spacing, time_step, speed, hub, lowest, slope[3], offset[3];
    std::string text;
    std::vector<int> numbers;  // [step][row][column][component]

    explicit FileOfTurbsim(const std::string& path) {
        ByteReader in{test::bytes_of(path)};
        id = in.short_number();
        for (int* out : {&rows, &columns, &tower, &steps}) *out = in.number();
        for (double* out : {&row_spacing, &column_spacing, &time_step, &speed, &hub, &lowest}) *out = in.real();
        for (int k = 0; k < 3; ++k) {
            slope[k] = in.real();
            offset[k] = in.real();
        }
        text.resize(static_cast<std::size_t>(in.number()));
        for (char& c : text) c = static_cast<char>(in.bits(1));
        while (in.at < in.all.size()) numbers.push_back(in.short_number());
    }
    double value(std::size_t i) const { return (numbers[i] - offset[i % 3]) / slope[i % 3]; }
};

TurbulenceBox box_to_write() {
    return kaimal_box(kaimal_turbulence(12, 2, 80), {.steps = 20,
                                                     .rows = 3,
                                                     .columns = 5,
                                                     .time_step = 0.25,
                                                     .row_spacing = 10,
                                                     .column_spacing = 8,
                                                     .lowest = 60});
}

const SteadyWind mean_wind{.speed = 12, .reference_height = 80, .shear = Shear::power, .exponent = 0.2};

}  // namespace

TEST_CASE("TurbSim files: turbulence and mean are within half a step of the range of 16 bits", "[property]") {
    const test::Folder folder;
    const TurbulenceBox box = box_to_write();
    write_turbsim(folder / "a.bts", box, {.mean = mean_wind, .text = "Cardan: Kaimal, seed 1"});
    const FileOfTurbsim file(folder / "a.bts");
    CHECK(file.id == 8);
    CHECK(file.rows == 3);
    CHECK(file.columns == 5);
    CHECK(file.tower == 0);
    CHECK(file.steps == 20);
    CHECK(file.row_spacing == 10);
    CHECK(file.column_spacing == 8);
    CHECK(file.time_step == 0.25);
    CHECK(file.speed == 12);
    CHECK(file.hub == 80);
    CHECK(file.lowest == 60);
    CHECK(file.text == "Cardan: Kaimal, seed 1");
    REQUIRE(file.numbers.size() == 900);
    Vec3 lowest = Vec3::Constant(1e9), highest = -lowest, error = Vec3::Zero();
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    for (std::size_t i = 0; i < 900; ++i) {
        const auto k = static_cast<Eigen::Index>(i % 3);
        const std::size_t row = i / 15 % 3;
        const double expected = static_cast<double>(box.velocity[i % 3][i / 3]) +
                                (k == 0 ? 12 * std::pow((60 + 10.0 * static_cast<double>(row)) / 80, 0.2) : 0);
        error[k] = std::max(error[k], std::abs(file.value(i) - expected));
        lowest[k] = std::min(lowest[k], expected);
        highest[k] = std::max(highest[k], expected);
        first[k] = std::min(first[k], 1.0 * file.numbers[i]);
        last[k] = std::max(last[k], 1.0 * file.numbers[i]);
    }
    for (int k = 0; k < 3; ++k) {
        CHECK(error[k] < 1.01 * (highest[k] - lowest[k]) / 65535 / 2);  // the offset has 24 bits
        CHECK(first[k] == -32768);
        CHECK(last[k] == 32767);
    }
}

TEST_CASE("TurbSim files: points of the tower go down to the ground, with the mean wind of their heights",
          "[property]") {
    const test::Folder folder;
    TurbulenceBox box = box_to_write();
    box.grid.lowest = 25;
    write_turbsim(folder / "a.bts", box, {.mean = mean_wind, .text = "", .tower = true});
    const FileOfTurbsim file(folder / "a.bts");
    CHECK(file.tower == 3);  // at 25, 15 and 5 m
    CHECK(file.lowest == 25);
    REQUIRE(file.numbers.size() == 20 * (15 + 3) * 3);
    for (int step = 0; step < 20; ++step)
        for (int point = 0; point < 3; ++point)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t at = static_cast<std::size_t>((step * 18 + 15 + point) * 3) + k;
                const double mean = k == 0 ? 12 * std::pow((25 - 10 * point) / 80.0, 0.2) : 0;
                const double turbulence = static_cast<double>(box.velocity[k][box.index(step, 0, 2)]);
                CHECK(std::abs(file.value(at) - mean - turbulence) < 0.51 / file.slope[k]);
            }
}

TEST_CASE("TurbSim files: what is read from one that InflowWind reads is written as it was", "[discrete]") {
    // tests/data/wind/box8_notower.bts: random numbers, periodic; InflowWind (OpenFAST 5.0.0) reads them to 5e-9 m/s.
    const FileOfTurbsim given(std::string(CARDAN_SOURCE_DIR) + "/tests/data/wind/box8_notower.bts");
    TurbulenceBox box{.grid = {given.steps, given.rows, given.columns, given.time_step, given.row_spacing,
                               given.column_spacing, given.lowest},
                      .speed = given.speed,
                      .velocity = {}};
    for (std::size_t i = 0; i < given.numbers.size(); ++i)
        box.velocity[i % 3].push_back(static_cast<float>(given.value(i)));
    const test::Folder folder;
    write_turbsim(folder / "a.bts", box, {.mean = {.reference_height = given.hub}, .text = given.text});
    const std::string mine = test::bytes_of(folder / "a.bts"),
                      other = test::bytes_of(std::string(CARDAN_SOURCE_DIR) + "/tests/data/wind/box8_notower.bts");
    CHECK(mine.size() == other.size());
    CHECK(mine.substr(0, 42) == other.substr(0, 42));
    CHECK(mine.substr(66, 19) == other.substr(66, 19));
    const FileOfTurbsim again(folder / "a.bts");
    for (std::size_t i = 0; i < given.numbers.size(); ++i)
        CHECK(std::abs(again.value(i) - given.value(i)) < 0.51 / given.slope[i % 3]);
}

TEST_CASE("TurbSim files: a component that is the same everywhere is exact, an aperiodic box says so", "[property]") {
    TurbulenceBox box = box_to_write();
    std::fill(box.velocity[2].begin(), box.velocity[2].end(), -0.75F);
    const test::Folder folder;
    write_turbsim(folder / "a.bts", box, {.mean = mean_wind, .text = {}, .periodic = false});
    const FileOfTurbsim file(folder / "a.bts");
    CHECK(file.id == 7);
    CHECK(file.text.empty());
    for (std::size_t i = 2; i < file.numbers.size(); i += 3) CHECK(file.value(i) == -0.75);
}

TEST_CASE("TurbSim files: what cannot be written is refused and leaves no file", "[property]") {
    const test::Folder folder;
    const auto write = [&](const TurbulenceBox& box, const TurbsimFile& file) {
        return [&] { write_turbsim(folder / "a.bts", box, file); };
    };
    const TurbulenceBox box = box_to_write();
    SteadyWind turned = mean_wind;
    turned.direction = 0.1;
    check_refused(write(box, {.mean = turned, .text = {}}), {"direction", "0.1", "turned where it is read"});
    check_refused(write(box, {.mean = mean_wind, .text = std::string(201, 'a')}), {"201", "at most 200"});
    check_refused(write(box, {.mean = mean_wind, .text = "two\nlines"}), {"ASCII"});
    check_refused(write(TurbulenceBox{}, {.mean = mean_wind, .text = {}}), {"rows = 0"});
    TurbulenceBox other = box;
    other.velocity[1].pop_back();
    check_refused(write(other, {.mean = mean_wind, .text = {}}), {"velocities of the box", "299"});
    other = box;
    other.velocity[1][30] = static_cast<float>(not_a_number);
    check_refused(write(other, {.mean = mean_wind, .text = {}}), {"component 1", "step 2", "nan"});
    other = box;
    other.grid.lowest = 0;
    check_refused(write(other, {.mean = mean_wind, .text = {}}), {"lowest row"});
    CHECK(folder.files() == 0);
    CHECK_THROWS_AS(write_turbsim(folder / "none/a.bts", box, {.mean = mean_wind, .text = {}}), FileError);
}
