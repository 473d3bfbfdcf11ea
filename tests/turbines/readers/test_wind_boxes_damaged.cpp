// Wind files that are cut, too long, of another program, or have a value that cannot be: each is refused with the file
// and the place in it, or else read whole.
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/wind_box_bytes.hpp"
#include "tests/turbines/readers/wind_box_files.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

#include <limits>
#include <random>

namespace cardan::testing::damaged_wind_box_tests {

namespace {

using namespace turbines;
using test::Bytes;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();
constexpr int most = std::numeric_limits<int>::max();

class Damaged : public test::ModelFolder {
public:
    Damaged() : ModelFolder("wind") {}
    [[nodiscard]] std::string original(const std::string& name) const { return test::bytes_of(test::wind_file(name)); }
    // What reading says of a file with other contents, which it keeps.
    [[nodiscard]] std::string with(const std::string& name, const std::string& contents,
                                   const std::string& opened) const {
        write(name, contents);
        return test::message_of([&] { static_cast<void>(read_wind_box(*this / opened)); });
    }
    void check(const std::string& name, const std::string& contents, const std::string& part) const {
        const std::string said = with(name, contents, name);
        CAPTURE(said, part);
        CHECK(said.find(part) != std::string::npos);
        CHECK(said.find(name) != std::string::npos);
    }
    template <class Number>
    void check_value(const std::string& name, std::size_t at, Number value, const std::string& part) const {
        Bytes bytes{original(name)};
        check(name, bytes.put(at, value).all, part);
    }
};

const std::string accepted = "nothing was thrown";

}  // namespace

TEST_CASE("damaged wind boxes: binary files cut at any byte, or with one more, are refused", "[property]") {
    const Damaged folder;
    for (const std::string name : {"box7.bts", "box8.bts", "nrel.wnd", "native.wnd"}) {
        const std::string all = folder.original(name), opened = name == "native.wnd" ? "native.ipt" : name;
        for (std::size_t length = 0; length <= all.size() + 1; ++length) {
            if (length > 120 && length < all.size() - 8 && length % 41 != 0) continue;
            std::string cut = all;
            cut.resize(length);
            const std::string said = folder.with(name, cut, opened);
            CAPTURE(name, length, said);
            CHECK((length == all.size()) == (said == accepted));
            if (said != accepted) CHECK(said.find(name + ": ") != std::string::npos);
        }
    }
    folder.check("box8.bts", folder.original("box8.bts") + "x", "it is too long");
    folder.check("box8.bts", folder.original("box8.bts").substr(0, 60),
                 "ends at byte 60, within its header: slope of w");
    folder.check("box8.bts", folder.original("box8.bts").substr(0, 75), "within its header: description (15 bytes)");
}

TEST_CASE("damaged wind boxes: values of TurbSim's header that cannot be", "[property]") {
    const Damaged folder;
    const std::string name = "box8.bts";
    const auto read = [&] { static_cast<void>(read_turbsim_box(folder / name)); };
    folder.check_value(name, 0, std::int16_t{9}, "byte 0: begins with 9; allowed: 7 or 8 (TurbSim)");
    folder.write(name, Bytes{folder.original(name)}.put(0, std::int16_t{-99}).all);
    CHECK(test::message_of(read).find("byte 0: begins with -99") != std::string::npos);
    folder.check_value(name, 2, 0, "byte 2: number of points upward = 0; allowed: 2");
    folder.check_value(name, 2, -4, "byte 2: number of points upward = -4");
    folder.check_value(name, 6, 1, "byte 6: number of points across = 1");
    folder.check_value(name, 10, -1, "byte 10: number of points of the tower = -1");
    folder.check_value(name, 14, -16, "byte 14: number of planes = -16");
    folder.check_value(name, 18, 0.F, "byte 18: distance of points upward [m] = 0");
    folder.check_value(name, 22, -1.F, "byte 22: distance of points across [m] = -1");
    folder.check_value(name, 26, not_a_number, "byte 26: time between planes [s] = nan");
    folder.check_value(name, 30, infinite, "byte 30: mean wind speed [m/s] = inf");
    folder.check_value(name, 30, 0.F, "byte 30: mean wind speed [m/s] = 0");
    folder.check_value(name, 34, -90.F, "byte 34: height of the hub [m] = -90");
    folder.check_value(name, 38, not_a_number, "byte 38: height of the lowest points [m] = nan");
    folder.check_value(name, 42, 0.F, "byte 42: slope of u = 0 s/m; allowed: at least 1 in size");
    folder.check_value(name, 50, not_a_number, "byte 50: slope of v = nan");
    folder.check_value(name, 62, infinite, "byte 62: offset of w = inf");
    folder.check_value(name, 46, 1e29F, "byte 42: by its slope and offset u becomes");
    folder.check_value(name, 50, 1.F, "byte 50: by its slope and offset v becomes");
    folder.check_value(name, 66, -1, "byte 66: length of the description = -1");
    folder.check_value(name, 66, most, "ends at byte 2197, within its header: description");
    // Sizes whose product does not fit.
    Bytes large{folder.original(name)};
    large.put(2, most).put(6, most).put(10, most).put(14, most);
    folder.check(name, large.all, "has 2197 bytes; allowed: 85 before the numbers and 18446744073709551615 for");
    folder.check_value(name, 14, 15, "it is too long");
    folder.check_value(name, 14, 17, "it is cut");
}

TEST_CASE("damaged wind boxes: values of headers of Bladed's kind that cannot be", "[property]") {
    const Damaged folder;
    const std::string name = "nrel.wnd";
    folder.write(name, Bytes{folder.original(name)}.put(0, std::int16_t{8}).all);
    CHECK(test::message_of([&] {
              static_cast<void>(read_bladed_box(folder / name));
          }).find("byte 0: begins with 8; a wind file of Bladed's kind") != std::string::npos);
    folder.check_value(name, 2, std::int16_t{6}, "byte 2: kind of turbulence = 6; allowed: 1, 2, 3, 4, 5, 7, 8");
    folder.check_value(name, 4, 0, "byte 4: number of components = 0");
    folder.check_value(name, 4, 4, "byte 4: number of components = 4");
    folder.check_value(name, 20, not_a_number, "byte 20: intensity [%] = nan");
    folder.check_value(name, 32, 0.F, "byte 32: distance of points upward [m] = 0");
    folder.check_value(name, 40, infinite, "byte 40: distance of planes [m] = inf");
    folder.check_value(name, 44, 0, "byte 44: half the number of planes = 0");
    folder.check_value(name, 44, most, "byte 44: half the number of planes = 2147483647");
    folder.check_value(name, 48, -10.F, "byte 48: mean wind speed [m/s] = -10");
    folder.check_value(name, 72, 1, "byte 72: number of points upward = 1");
    folder.check_value(name, 76, -5, "byte 76: number of points across = -5");
    Bytes large{folder.original(name)};
    folder.check(name, large.put(72, most).put(76, most).put(44, most / 2).all, "it is cut");
    Bytes old;
    for (const int one : {-3, 20000, 15000, 5000, 8, 0, 1, 2, 3, 0, 7, 4000, 5000})
        old.add(static_cast<std::int16_t>(one));
    folder.check(name, old.all, "byte 10: mean wind speed [0.1 m/s] = 0");
    old.put(10, std::int16_t{100}).put(22, std::int16_t{1999});
    folder.check(name, old.all, "byte 22: 1000 times the number of points upward = 1999");
}

TEST_CASE("damaged wind boxes: summaries without their entries, and native texts", "[property]") {
    const Damaged folder;
    const auto without = [&](const std::string& name, std::size_t line) {
        std::vector<std::string> lines = test::lines_of(folder.original(name));
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
        return test::joined(lines);
    };
    const auto check = [&](const std::string& name, const std::string& opened, const std::string& contents,
                           const std::string& part) {
        const std::string said = folder.with(name, contents, opened);
        CAPTURE(said, part);
        CHECK(said.find(part) != std::string::npos);
    };
    const auto changed = [&](const std::string& name, const std::string& from, const std::string& to) {
        std::string all = folder.original(name);
        return all.replace(all.find(from), from.size(), to);
    };
    check("nrel.sum", "nrel.wnd", without("nrel.sum", 1), "nrel.sum:12: ends without the entry 'HUB HEIGHT'");
    check("nrel.sum", "nrel.wnd", without("nrel.sum", 3), "nrel.sum:12: ends without the entry 'UBAR'");
    check("nrel.sum", "nrel.wnd", without("nrel.sum", 4), "nrel.sum:7: no number for intensity [%]: ''");
    check("nrel.sum", "nrel.wnd", changed("nrel.sum", "UBAR = 10", "UBAR = x"), "nrel.sum:4: no number for UBAR");
    check("nrel.sum", "nrel.wnd", changed("nrel.sum", "UBAR = 10", "UBAR = 11"), "UBAR = 11 m/s; allowed: 10");
    check("nrel.sum", "nrel.wnd", changed("nrel.sum", "70 HUB", "-70 HUB"), "nrel.sum:2: HUB HEIGHT = -70");
    check("nrel.sum", "nrel.wnd", changed("nrel.sum", "T  CLOCK", "7  CLOCK"), "nrel.sum:1: no T or F, nor Yes or No");
    check("nrel.sum", "nrel.wnd", changed("nrel.sum", "1.5231", "nan"), "nrel.sum:5: no number for intensity");
    check("nrel.sum", "nrel.wnd", "", "ends without the entry 'HUB HEIGHT'");
    check("nrel.sum", "nrel.wnd", std::string("T\0", 2), "NUL");
    std::filesystem::remove(folder / "nrel.sum");
    CHECK(test::message_of([&] {
              static_cast<void>(read_wind_box(folder / "nrel.wnd"));
          }).find("nrel.sum: cannot be read: No such file") != std::string::npos);

    const std::vector<std::string> words = {"UBAR", "REFHT", "TI", "TI_V", "TI_W", "WDIR", "FLINC", "WINDF", "WSHEAR"};
    for (std::size_t i = 0; i < words.size(); ++i)
        check("native.ipt", "native.ipt", without("native.ipt", i), "native.ipt:9: ends without the entry " + words[i]);
    const auto native = [&](const std::string& from, const std::string& to, const std::string& part) {
        check("native.ipt", "native.ipt", changed("native.ipt", from, to), part);
    };
    native("XOffset 3", "REFLENGTH 5", accepted);
    native("UBAR 10", "UBAR 0", "native.ipt:1: UBAR = 0; allowed: 0.001 ... 1000");
    native("TI 0.17", "TI nan", "native.ipt:3: TI: 'nan' is not a number");
    native("TI 0.17", "TI -1", "native.ipt:3: TI = -1");
    native("TI 0.17", "TI 0.17\nTI 0.1", "native.ipt:4: TI occurs twice, first in line 3");
    native("\"native.wnd\"", "\"\"", "native.ipt:8: WINDF: the name of the file is empty");
    native("native.wnd", "none.wnd", "none.wnd: cannot be read");
    native("native.wnd", "box8.bts", "box8.bts: byte 0: begins with 8");
    native("XOffset 3", "VLINSHEAR 0.1", "ends without the entry REFLENGTH");
    native("XOffset 3", "VLINSHEAR 0.1\nREFLENGTH 0", "native.ipt:11: REFLENGTH = 0");
    // At the middle point nothing changes.
    folder.write("native.ipt", folder.original("native.ipt"));
    check("native.wnd", "native.ipt", folder.original("native.wnd").substr(0, 92) + std::string(16 * 4 * 5 * 6, '\1'),
          "native.ipt:3: TI = 0.17; allowed: 0, for a component");
}

TEST_CASE("damaged wind boxes: files of HAWC2's kind that do not fit, and numbers that are none", "[property]") {
    const Damaged folder;
    const auto refused = [&](const Hawc2Box& box, const std::string& part) {
        const std::string said = test::message_of([&] { static_cast<void>(read_hawc2_box(box)); });
        CAPTURE(said, part);
        CHECK(said.find(part) != std::string::npos);
    };
    const Hawc2Box good = test::hawc2_box_in(folder.folder.path.string());
    CHECK_NOTHROW(read_hawc2_box(good));
    const auto with = [&](auto Hawc2Box::*member, const auto& value, const std::string& part) {
        Hawc2Box box = good;
        box.*member = value;
        refused(box, part);
    };
    for (auto Hawc2Box::*count : {&Hawc2Box::planes, &Hawc2Box::rows, &Hawc2Box::columns})
        for (const int value : {-5, 0, 1}) with(count, value, text(" = ", value, "; allowed: at least 2"));
    for (auto Hawc2Box::*spacing : {&Hawc2Box::plane_spacing, &Hawc2Box::row_spacing, &Hawc2Box::column_spacing})
        for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL}) with(spacing, value, "allowed: finite and > 0");
    with(&Hawc2Box::planes, most, "hawc_u.bin: has 1280 bytes");
    with(&Hawc2Box::start, HUGE_VAL, "place of the first plane [m] = inf");
    with(&Hawc2Box::factors, std::array{1.0, std::nan(""), 1.0}, "factor = nan");
    with(&Hawc2Box::deviations, std::array{1.0, -1.0, 1.0}, "standard deviation [m/s] = -1");
    Hawc2Box box = good;
    box.planes = box.rows = box.columns = most;
    refused(box, "hawc_u.bin: has 1280 bytes; allowed: 0 before the numbers and 18446744073709551615");
    box = good;
    box.mean.speed = 0;
    refused(box, "mean wind speed [m/s] = 0");

    const std::string v = test::bytes_of(folder / "hawc_v.bin");
    for (const std::size_t size : {v.size() - 1, v.size() + 4}) {
        std::string other = v;
        other.resize(size);
        folder.write("hawc_v.bin", other);
        refused(good, text("hawc_v.bin: has ", size, " bytes"));
    }
    for (const float value : {not_a_number, -infinite, 1e30F}) {
        folder.write("hawc_v.bin", Bytes{v}.put(1276, value).all);
        refused(good, "hawc_v.bin: byte 1276: ");
    }
    folder.write("hawc_v.bin", std::string(1280, '\0'));
    CHECK_NOTHROW(read_hawc2_box(good));
    box = good;
    box.scaling = BoxScaling::deviations;
    box.deviations = {1, 0, 1};
    CHECK_NOTHROW(read_hawc2_box(box));
    box.deviations = {1, 1, 1};
    refused(box, "hawc_v.bin: does not change at the middle point");
}

TEST_CASE("damaged wind boxes: with any bytes changed they are refused, or give numbers everywhere", "[property]") {
    const Damaged folder;
    std::mt19937 random(7);
    int read = 0, refused = 0;
    for (const auto& [name, opened, header] : {std::tuple("box7.bts", "box7.bts", 90),
                                               {"nrel.wnd", "nrel.wnd", 110},
                                               {"nrel.sum", "nrel.wnd", 224},
                                               {"native.wnd", "native.ipt", 100},
                                               {"native.ipt", "native.ipt", 101}})
        for (int i = 0; i < 60; ++i) {
            std::string bytes = folder.original(name);
            for (int n = 0; n <= i % 3; ++n)
                bytes[random() % static_cast<std::size_t>(header)] = static_cast<char>(random());
            folder.write(name, bytes);
            try {
                const WindBoxFile file = read_wind_box(folder / opened);
                const WindBox box = file.box->with_outside(OutsideBox::hold);
                for (const double z : {-1.0, 5.0, 70.0, 1e4})
                    for (const double t : {-3.0, 0.0, 2.2, 1e4}) {
                        const WindBox::Sample is = box.with_gradient({1, -20, z}, t);
                        CHECK((is.velocity.allFinite() && is.gradient.allFinite()));
                    }
                ++read;
            } catch (const Error&) {
                ++refused;
            }
            folder.write(name, folder.original(name));
        }
    CHECK(read > 20);
    CHECK(refused > 20);
}

}  // namespace cardan::testing::damaged_wind_box_tests
