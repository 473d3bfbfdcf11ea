// Files of AeroDyn 12 to 14, with the blade in the main one: what is taken, noted, refused.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/aerodyn.hpp"

#include <fstream>
#include <regex>

namespace cardan::testing::aerodyn14_reader_tests {

using namespace turbines;
using test::check_error;

TEST_CASE("aerodyn: files of AeroDyn 14 and older: elements along the blade, options, the first table of each polar",
          "[property]") {
    const test::Folder folder;
    const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
    const auto main = [](const char* units, const char* induction) {
        return text("a title\n", units,
                    " SysUnits - units\nBEDDOES StallMod - lags\nUSE_CM UseCm - moments\n"
                    "EQUIL InfModel - inflow\n",
                    induction,
                    " IndModel - induction\n0.005 AToler - tolerance\n"
                    "PRANDtl TLModel - tip\nNONE HLModel - hub\n0.3 TwrShad - shadow\n1.1 AirDens - density\n"
                    "1.4E-5 KinVisc - air\n2 NumFoil - files\n\"a.dat\" FoilNm - names\n\"b.dat\"\n"
                    "2 BldNodes - elements\nRNodes AeroTwst DRNodes Chord NFoil PrnElm\n"
                    "3.0 12.0 2.0 1.5 1 NOPRINT\n6.5 4.0 5.0 1.0 2 PRINT\n");
    };
    write("main.ipt", main("SI", "SWIRL"));
    const std::string remarks = "0 0.5 Table ID parameter\n10 11 Stall angle (deg)\n0 0 No longer used\n";
    write("a.dat",
          "round\nroot\n1 Number of airfoil tables in this file\n0 Table ID parameter\n0 Stall angle (deg)\n"
          "-180 0 0.5 0\n180 0 0.5 0\n");
    write("b.dat",
          "thin\nof two\n2 Number of airfoil tables in this file\n" + remarks +
              "-180 0.0 0.1 0.2 0.9 0.9 0.9\n0 0.4 0.01 -0.1 0.9 0.9 0.9\n20 1.6 0.2 0 0.9 0.9 0.9 stalled\nEOT\n");
    const auto read = [&] { return read_aerodyn(folder / "main.ipt", 1.5); };
    const AeroDynFile file = read();
    // The elements reach from 2 to 4 m and from 4 to 9 m.
    CHECK(file.blade.position == std::vector<double>{2, 3, 6.5, 9});
    CHECK(file.blade.chord == std::vector<double>{1.5, 1.5, 1, 1});
    CHECK(file.blade.twist[1] == Approx(12 * units::degree));
    CHECK(file.blade.airfoil == std::vector<std::size_t>{0, 0, 1, 1});
    const auto at_10 = file.blade.polars[1].at(10 * units::degree);
    CHECK(at_10.lift == Approx(1.0));
    CHECK(at_10.moment == Approx(-0.05));
    CHECK(file.blade.polars[1].at(2).drag == 0.2);
    CHECK(file.options.induction);
    CHECK(file.options.momentum.rotation);
    CHECK(file.options.momentum.tip_loss);
    CHECK(!file.options.momentum.hub_loss);
    CHECK(file.density == 1.1);
    CHECK(file.model.airfoils == Airfoils::unsteady);
    CHECK(file.airfoils.size() == 2);
    for (const auto& [keyword, why] : {std::pair("StallMod", "UA_Mod = 4"),
                                       {"TwrShad", "no shadow"},
                                       {"airfoil tables", "the first one"},
                                       {"angles of attack", "-180 ... 20"}})
        CHECK((test::has_note(file.notes, keyword, why) || test::has_note(file.notes, keyword, "as in AeroDyn")));
    write("main.ipt", main("SI", "NONE"));
    CHECK(!read().options.induction);
    write("main.ipt", main("ENGLISH", "NONE"));
    check_error(read, {"main.ipt:2", "SysUnits = ENGLISH; allowed: SI"});
    write("main.ipt", std::regex_replace(main("SI", "WAKE"), std::regex("1.0 2 PRINT"), "1.0 3 PRINT"));
    check_error(read, {"main.ipt:19", "NFoil = 3; allowed: 1 ... 2"});
    write("main.ipt", main("SI", "WAKE"));
    write("a.dat", "x\ny\n1 Number of airfoil tables\n-180 0 0.5 0\n0 x 0.5 0\n180 0 0.5 0\n");
    check_error(read, {"a.dat:5", "polar: 4 numbers expected, found 1, then 'x'"});
}

}  // namespace cardan::testing::aerodyn14_reader_tests
