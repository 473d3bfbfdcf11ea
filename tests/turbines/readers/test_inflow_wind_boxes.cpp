// InflowWind's main file with boxes, in the spellings of its versions, against InflowWind itself; directions of its
// uniform winds.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/wind_box_files.hpp"
#include "turbines/readers/inflow_wind.hpp"
#include "turbines/readers/turbsim_box.hpp"

namespace cardan::testing::inflow_wind_box_tests {

namespace {

using namespace turbines;

// Spellings of what was once RefHt, Filename and PLexp in several parts.
struct Words {
    std::string steady_height, uniform_file, uniform_height, turbsim_file, hawc_height, hawc_exponent;
};
const Words oldest{"RefHt", "Filename", "RefHt", "Filename", "RefHt", "PLExp"};
const Words middle{"RefHtT1", "FilenameT2", "RefHtT2", "FilenameT3", "RefHtT5", "PLExp"};
const Words newest{"RefHt", "Filename_Uni", "RefHt_Uni", "FileName_BTS", "RefHt_Hawc", "PLExp_Hawc"};

struct MainFile {
    int type = 3;
    Words words = newest;
    std::string turbsim = "box8.bts", root = "nrel", scaling = "0", mean = "2", offset = "4", u = "hawc_u.bin",
                more = "";
    double direction = 0, upflow = 0;

    [[nodiscard]] std::string text() const {
        return cardan::text("------- InflowWind INPUT FILE ---\ntitle\n-----\nFalse Echo - flag\n", type,
                            " WindType - kind\n", direction, " PropagationDir - deg\n", upflow, " VFlowAng - deg\n",
                            more, "===== steady =====\n12 HWindSpeed - m/s\n42 ", words.steady_height,
                            " - m\n0.3 PLexp - exponent\n"
                            "===== uniform =====\n\"uniform.wnd\" ",
                            words.uniform_file, " - name\n70 ", words.uniform_height,
                            " - m\n100 RefLength - m\n===== TurbSim =====\n\"", turbsim, "\" ", words.turbsim_file,
                            " - name\n===== Bladed =====\n\"", root,
                            "\" FileNameRoot - name\nFalse TowerFile - flag\n"
                            "===== HAWC =====\n\"",
                            u,
                            "\" FileName_u - name\n\"HAWC_V.bin\" FileName_v - name\n\".\\hawc_w.bin\" "
                            "FileName_w - name\n16 nx\n5 ny\n4 nz\n5 dx\n15 dy\n20 dz\n70 ",
                            words.hawc_height, " - m\n --- scaling ---\n", scaling,
                            " ScaleMethod\n2 SFx\n3 SFy\n4 SFz\n1.7 SigmaFx\n1.3 SigmaFy\n"
                            "0.9 SigmaFz\n --- mean ---\n10 URef\n",
                            mean, " WindProfile\n0.2 ", words.hawc_exponent, " - exponent\n0.03 Z0\n",
                            offset.empty() ? "" : offset + " XOffset\n", "===== OUTPUT =====\nFalse SumPrint - flag\n");
    }
};

class WindFolder : public test::ModelFolder {
public:
    WindFolder() : ModelFolder("wind") {}
    [[nodiscard]] InflowWindFile read(const MainFile& main, PlaneOrder order = PlaneOrder::first_first) const {
        write("wind.dat", main.text());
        return read_inflow_wind(*this / "wind.dat", 1.2, order);
    }
    [[nodiscard]] std::string refused(const MainFile& main) const {
        return test::message_of([&] { static_cast<void>(read(main)); });
    }
};

void check_case(const std::string& name, const Wind& wind) {
    const auto values = test::wind_values(name);
    CHECK(!values.empty());
    for (const test::WindValue& one : values) {
        if (one.place.z() <= 0) continue;
        const Vec3 is = wind.at(one.time).at(one.place);
        CAPTURE(name, one.place.transpose(), one.time, is.transpose(), one.velocity.transpose());
        for (int c = 0; c < 3; ++c) CHECK(std::abs(is(c) - one.velocity(c)) <= test::digits_of(one.velocity(c)));
    }
}

void check_parts(const std::string& message, std::initializer_list<std::string> parts) {
    for (const std::string& part : parts) {
        CAPTURE(message, part);
        CHECK(message.find(part) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("inflow wind: all kinds of boxes, and uniform winds, are as InflowWind has them", "[discrete]") {
    const WindFolder folder;
    check_case("bts7", folder.read({.turbsim = "box7.bts"}).wind);
    check_case("bts8 PropagationDir -20 VFlowAng 8", folder.read({.direction = -20, .upflow = 8}).wind);
    check_case("wnd type 4 nrel", folder.read({.type = 4}).wind);
    check_case("wnd type 4 nrel", folder.read({.type = 4, .root = "NREL.wnd"}).wind);
    check_case("hawc", folder.read({.type = 5}).wind);
    check_case("hawc scaled log", folder.read({.type = 5, .scaling = "2", .mean = "1", .offset = ""}).wind);
    check_case("wnd native", folder.read({.type = 7, .root = "native.ipt"}).wind);
    check_case("uniform", folder.read({.type = 2}).wind);

    const InflowWindFile turned = folder.read({.type = 7, .root = "native_turned.ipt", .direction = 30});
    check_case("wnd native WDIR 0.15 FLINC 0.05", turned.wind);
    CHECK(test::has_note(turned.notes, "PropagationDir", "WDIR and FLINC"));
    CHECK(turned.wind.rows().front().density == 1.2);
}

TEST_CASE("inflow wind: spellings of all versions", "[discrete]") {
    const WindFolder folder;
    for (const Words& words : {oldest, middle, newest}) {
        CAPTURE(words.hawc_height);
        check_case("bts8", folder.read({.words = words}).wind);
        check_case("hawc", folder.read({.type = 5, .words = words}).wind);
        CHECK(folder.read({.type = 2, .words = words}).wind.rows().front().reference_height == 70);
        CHECK(folder.read({.type = 1, .words = words}).wind.rows().front().reference_height == 42);
    }
}

TEST_CASE("inflow wind: factors, the order of the planes, what boxes do not have", "[property]") {
    const WindFolder folder;
    const MainFile main{.type = 5, .scaling = "1", .mean = "0"};
    const InflowWindFile scaled = folder.read(main), as_is = folder.read({.type = 5, .mean = "0"}),
                         last = folder.read({.type = 5, .mean = "0"}, PlaneOrder::last_first);
    const WindBox &box = *scaled.wind.box(), &raw = *as_is.wind.box(), &reversed = *last.wind.box();
    CHECK(scaled.wind.rows().front().shear == Shear::none);
    for (int t = 0; t < 16; ++t)
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 5; ++j) {
                const Vec3 is = raw.at_point(t, k, j), mean = raw.statistics(k, j).mean;
                CHECK((box.at_point(t, k, j) - Vec3(2 * (is.x() - mean.x()), 3 * is.y(), 4 * is.z())).norm() < 1e-12);
                CHECK(reversed.at_point(15 - t, k, j) == is);
            }
    const InflowWindFile cubic = folder.read({.more = "True VelInterpCubic - flag\n"});
    CHECK(test::has_note(cubic.notes, "VelInterpCubic", "linear"));
}

TEST_CASE("inflow wind: what is wrong with a box is said at the entry of the main file", "[property]") {
    const WindFolder folder;
    check_parts(folder.refused({.turbsim = "none.bts"}), {"wind.dat:17: FileName_BTS", "none.bts: cannot be read"});
    check_parts(folder.refused({.turbsim = "nrel.wnd"}), {"wind.dat:17", "nrel.wnd: byte 0", "(.wnd)"});
    check_parts(folder.refused({.type = 4, .root = "box8.bts"}), {"wind.dat:19: FilenameRoot", "box8.bts.wnd"});
    check_parts(folder.refused({.type = 5, .u = "hawc.bin"}), {"wind.dat:22: FileName_u", "hawc.bin"});
    check_parts(folder.refused({.type = 5, .scaling = "3"}), {"wind.dat:33", "ScaleMethod = 3"});
    check_parts(folder.refused({.type = 5, .mean = "-1"}), {"wind.dat:42", "WindProfile = -1"});
    MainFile main{.type = 5};
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string all = main.text();
        all.replace(all.find(from), from.size(), to);
        folder.write("wind.dat", all);
        return test::message_of([&] { static_cast<void>(read_inflow_wind(folder / "wind.dat")); });
    };
    check_parts(with("16 nx", "-16 nx"), {"wind.dat:25", "nx = -16"});
    check_parts(with("16 nx", "15 nx"), {"wind.dat:22", "hawc_u.bin: has 1280 bytes; allowed:", "1200 for 15 planes"});
    check_parts(with("5 ny", "2000000000 ny"), {"wind.dat:22", "hawc_u.bin: has 1280 bytes"});
    check_parts(with("5 dx", "0 dx"), {"wind.dat:28", "dx"});
    check_parts(with("10 URef", "0 URef"), {"wind.dat:41", "URef"});
    check_parts(with("70 RefHt_Hawc", "-70 RefHt_Hawc"), {"wind.dat:41", "reference height [m] = -70"});
}

}  // namespace cardan::testing::inflow_wind_box_tests
