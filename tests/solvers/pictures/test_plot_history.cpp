#include "mbs/base/types.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/pictures/stack.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <sstream>

using namespace cardan;
using namespace cardan::solvers;
using cardan::test::bytes_of;
using cardan::test::Folder;
using cardan::testing::check_refused;
using Catch::Matchers::Contains;

namespace {

History history() {
    History h;
    h.title = "gust at 5_s";
    h.channels = {{.name = "tip flap", .units = "m", .long_name = "deflection of the tip, downwind"},
                  {.name = "tip edge", .units = "m", .long_name = "deflection of the tip, leading edge"},
                  {.name = "blade pitch", .units = "rad", .long_name = "pitch angle"},
                  {.name = "pitch rate", .units = "rad s-1", .long_name = "rate of the pitch angle"},
                  {.name = "rotor speed", .units = "rad s-1", .long_name = "rotor speed"},
                  {.name = "root moment", .units = "N m", .long_name = "moment about y", .alias = "RootMyb1"},
                  {.name = "steps", .units = "1", .long_name = "accepted steps"},
                  {.name = "order", .units = "1", .long_name = "order of the last step"}};
    h.values.resize(h.channels.size());
    for (int i = 0; i <= 1000; ++i) {
        const double t = 0.02 * i;
        h.time.push_back(t);
        const std::vector<double> row{2 + std::sin(2 * pi * t),
                                      0.1 * std::cos(2 * pi * t),
                                      0.05 * std::sin(t),
                                      0.05 * std::cos(t),
                                      1.2 + 0.01 * t,
                                      4e6 * std::cos(2 * pi * t),
                                      static_cast<double>(3 * i),
                                      static_cast<double>(1 + i % 5)};
        for (std::size_t c = 0; c < row.size(); ++c) h.values[c].push_back(row[c]);
    }
    return h;
}

History energies() {
    History h;
    h.title = "start";
    h.time = {0, 1, 2};
    for (const char* name : {"kinetic energy", "potential energy", "dissipated energy", "energy from drives",
                             "energy from loads", "energy error"}) {
        h.channels.push_back({.name = name, .units = "J", .long_name = name});
        h.values.push_back({0, 2e6, 1e6});
    }
    h.values.back() = {0, 1e-4, 2e-4};
    return h;
}

// y of the highest point of the lines in the first colour (blue), legend left out; pixels from above.
double highest_blue(const std::string& svg, double below) {
    double highest = 1e9;
    const std::string begin = "<path stroke='rgb(  0, 114, 178)'  d='";
    for (std::size_t at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
        const std::size_t from = at + begin.size();
        std::istringstream path(svg.substr(from, svg.find('\'', from) - from));
        for (std::string point; path >> point;) {
            const std::size_t comma = point.find(',');
            if (comma == std::string::npos) continue;
            const double y = std::stod(point.substr(comma + 1));
            if (y > below) highest = std::min(highest, y);
        }
    }
    return highest;
}

}  // namespace

TEST_CASE("shown units: degrees, degrees per second, and rpm for speeds", "[analytic]") {
    const Channel angle{"pitch", "rad", "pitch"}, rate{"pitch rate", "rad s-1", "rate"};
    const Channel speed{"rotor speed", "rad s-1", "speed"}, moment{"moment", "N m", "moment"};
    const Channel acceleration{"yaw acceleration", "rad s-2", "acceleration"};
    CHECK(shown_units(angle, AngleUnits::degrees).factor * pi == Approx(180).epsilon(1e-15));
    CHECK(shown_units(rate, AngleUnits::degrees).factor * pi == Approx(180).epsilon(1e-15));
    CHECK(shown_units(speed, AngleUnits::degrees).factor * 2 * pi == Approx(60).epsilon(1e-15));
    CHECK(shown_units(angle, AngleUnits::degrees).units == "deg");
    CHECK(shown_units(rate, AngleUnits::degrees).units == "deg s-1");
    CHECK(shown_units(acceleration, AngleUnits::degrees).units == "deg s-2");
    CHECK(shown_units(speed, AngleUnits::degrees).units == "rpm");
    for (const Channel& channel : {angle, rate, speed, moment, acceleration}) {
        CHECK(shown_units(channel, AngleUnits::radians).factor == 1);
        CHECK(shown_units(channel, AngleUnits::radians).units == channel.units);
    }
    CHECK(shown_units(moment, AngleUnits::degrees).units == "N m");
}

TEST_CASE("shown units: prefixes keep numbers between 1 and 1000, where the units have prefixes", "[analytic]") {
    const auto check = [](const char* units, double largest, double factor, const char* expected) {
        const ShownUnits shown = with_prefix(units, largest);
        CAPTURE(units, largest);
        CHECK(shown.factor == Approx(factor).epsilon(1e-14));
        CHECK(shown.units == expected);
    };
    check("N m", 4e6, 1e-6, "MN m");
    check("N m", 1000, 1e-3, "kN m");
    check("N m", 999, 1, "N m");
    check("W", 5e9, 1e-9, "GW");
    check("W", 5e13, 1e-9, "GW");
    check("J", 2e-5, 1e6, "µJ");
    check("J", 2e-15, 1e9, "nJ");
    check("m", 0.0099, 1e3, "mm");
    check("m", 0.01, 1, "m");
    check("m", 5e4, 1, "m");
    check("s", 1e-3, 1e3, "ms");
    check("rpm", 1e5, 1, "rpm");
    check("N", 0, 1, "N");
    check("N", std::numeric_limits<double>::infinity(), 1, "N");
}

TEST_CASE("shown units: products and powers are written as people write them", "[property]") {
    const std::pair<const char*, const char*> pairs[] = {{"m", "m"},
                                                         {"m s-2", "m/s²"},
                                                         {"N m rad-1", "N m/rad"},
                                                         {"kg m2", "kg m²"},
                                                         {"s-1", "1/s"},
                                                         {"N m s rad-1", "N m s/rad"},
                                                         {"W m-2 K-1", "W/(m² K)"},
                                                         {"1", "pure number"},
                                                         {"-", "pure number"},
                                                         {"m/s^2", "m/s^2"},
                                                         {"deg", "deg"},
                                                         {"", "pure number"}};
    for (const auto& pair : pairs) CHECK(display_text(pair.first) == pair.second);
    CHECK(density_text("m") == "m²/Hz");
    CHECK(density_text("N m") == "(N m)²/Hz");
    CHECK(density_text("m s-2") == "(m/s²)²/Hz");
    CHECK(density_text("1") == "1/Hz");
}

TEST_CASE("panels: channels with the same shown units share one, up to the number of colours; numbers stay alone",
          "[property]") {
    const History h = history();
    const auto panels = panels_by_units(
        h, {"tip flap", "rotor speed", "blade pitch", "tip edge", "pitch rate", "RootMyb1", "steps", "order"});
    REQUIRE(panels.size() == 7);
    CHECK(panels[0].channels == std::vector<std::string>{"tip flap", "tip edge"});
    CHECK(panels[1].channels == std::vector<std::string>{"rotor speed"});  // rpm
    CHECK(panels[3].channels == std::vector<std::string>{"pitch rate"});   // deg/s
    CHECK(panels_by_units(h, {"rotor speed", "pitch rate"}, AngleUnits::radians).size() == 1);
    CHECK(panels_by_units(h, std::vector<std::string>(15, "tip flap")).size() == 3);
    CHECK(one_panel_each({"a", "b"}).size() == 2);
    check_refused([&] { (void)panels_by_units(h, {"nothing"}); }, {"'nothing'", "'tip flap'"});
}

TEST_CASE("history pictures: long names, units, marks and the title are in them; the ending says the kind",
          "[property]") {
    const Folder folder;
    HistoryPlotOptions options;
    options.marks = {{5, "gust begins"}, {5.1, "and_rises"}, {19.9, "near the end"}, {77, "outside"}};
    const std::vector<HistoryPanel> panels{{{"tip flap", "tip edge"}}, {{"blade pitch"}}, {{"RootMyb1"}},
                                           {{"rotor speed"}},          {{"pitch rate"}},  {{"order"}}};
    plot(history(), panels, folder.path / "a.svg", options);
    const std::string svg = bytes_of(folder / "a.svg");
    for (const char* expected :
         {"gust at 5_s", "tip flap: deflection of the tip, downwind", "tip edge: deflection of the tip, leading edge",
          "root moment (RootMyb1): moment about y", ">deg<", ">MN m<", ">rpm<", ">deg/s<", ">m<", ">pure number<",
          "time, s", "gust begins", "and_rises", "near the end"})
        CHECK_THAT(svg, Contains(expected));
    CHECK(svg.find("outside") == std::string::npos);
    options.angles = AngleUnits::radians;
    options.title = "another";
    plot(history(), panels, folder.path / "b.svg", options);
    CHECK_THAT(bytes_of(folder / "b.svg"), Contains(">rad<") && Contains(">rad/s<") && Contains("another"));
    plot(history(), panels, folder.path / "a.png");
    plot(history(), panels, folder.path / "a.pdf");
    CHECK(bytes_of(folder / "a.png").substr(1, 3) == "PNG");
    CHECK(bytes_of(folder / "a.pdf").substr(0, 5) == "%PDF-");
}

TEST_CASE("history pictures: a million samples make a small file in which the peak has its height", "[property]") {
    const Folder folder;
    History h{"long", {{"a", "m", "a"}}, {}, {{}}};
    for (int i = 0; i < 1000000; ++i) {
        h.time.push_back(1e-3 * i);
        h.values[0].push_back(i == 654321 ? 10 : std::sin(0.37 * i));
    }
    plot(h, {{{"a"}}}, folder.path / "long.svg");
    // This range of values with the peak among a few samples only.
    const History few{"few", {{"a", "m", "a"}}, {0, 300, 654.321, 700, 999.999}, {{-1, 0, 10, 0, -1}}};
    plot(few, {{{"a"}}}, folder.path / "few.svg");
    const std::string all = bytes_of(folder / "long.svg");
    CHECK(all.size() < 150000);
    const double legend = 60;
    CHECK(highest_blue(all, legend) == Approx(highest_blue(bytes_of(folder / "few.svg"), legend)).margin(0.02));
    CHECK(highest_blue(all, legend) < 120);
}

TEST_CASE("history pictures: constants, gaps, channels without a finite value and huge or tiny numbers are drawn",
          "[property]") {
    const Folder folder;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    History h{"odd", {}, {0, 1, 2, 3}, {}};
    const auto add = [&](const char* name, const char* units, std::vector<double> values) {
        h.channels.push_back({name, units, name});
        h.values.push_back(std::move(values));
    };
    add("zero", "m", {0, 0, 0, 0});
    add("constant", "m", {-12.5, -12.5, -12.5, -12.5});
    add("gap", "m", {1, nan, 2, 3});
    add("nothing", "m", {nan, nan, nan, nan});
    add("close", "K", {300, 300.000001, 300.000002, 300});
    add("huge", "K", {0, 3e7, 1e7, 0});
    add("tiny", "K", {0, 3e-7, 1e-7, 0});
    std::vector<std::string> names;
    for (const Channel& channel : h.channels) names.push_back(channel.name);
    plot(h, one_panel_each(names), folder.path / "odd.svg");
    CHECK_THAT(bytes_of(folder / "odd.svg"), Contains("10⁶ K") && Contains("10⁻⁹ K") && Contains("10⁻⁶ K above 300<"));
}

TEST_CASE("energy pictures: the error has a panel of its own; missing energies are named", "[property]") {
    const Folder folder;
    History h = energies();
    plot_energies(h, folder.path / "e.svg");
    CHECK_THAT(bytes_of(folder / "e.svg"), Contains(">MJ<") && Contains(">µJ<") && Contains("energy from drives") &&
                                               Contains("dissipated energy") && Contains("energy error"));
    for (double& value : h.values[1]) value += 3e7;  // the potential counts from the start
    plot_energies(h, folder.path / "high.svg");
    CHECK(bytes_of(folder / "high.svg") == bytes_of(folder / "e.svg"));
    h.channels.pop_back();
    h.values.pop_back();
    check_refused([&] { plot_energies(h, folder.path / "f.svg"); }, {"history 'start'", "'energy error'"});
}

TEST_CASE("spectrum pictures: units of amplitudes and densities, nP lines where they have room", "[property]") {
    const Folder folder;
    SpectrumPlotOptions options;
    options.rotor_frequency_hz = 0.2;
    options.max_frequency_hz = 3;
    const std::vector<HistoryPanel> panels{{{"tip flap", "tip edge"}}, {{"RootMyb1"}}, {{"blade pitch"}}};
    plot_spectra(history(), panels, folder.path / "a.svg", options);
    CHECK_THAT(bytes_of(folder / "a.svg"), Contains("amplitude, MN m") && Contains("amplitude, deg") &&
                                               Contains("frequency, Hz") && Contains(">1P<") && Contains(">12P<"));
    options.density = true;
    options.max_frequency_hz = 0;
    options.rotor_frequency_hz = 0.01;
    plot_spectra(history(), panels, folder.path / "b.svg", options);
    const std::string svg = bytes_of(folder / "b.svg");
    CHECK_THAT(svg, Contains("density, (N m)²/Hz") && Contains("density, deg²/Hz") && Contains("density, m²/Hz"));
    CHECK(svg.find(">1P<") == std::string::npos);
}

TEST_CASE("history pictures: bad input is refused with place, value and limit", "[property]") {
    const Folder folder;
    const auto path = folder.path / "a.svg";
    History h = history();
    check_refused(
        [&] {
            plot(h, {{{"tip flap", "steps"}}}, path);
        },
        {"units of the channel 'steps' = 1", "m, those of 'tip flap'"});
    check_refused([&] { plot(h, {}, path); }, {"number of panels = 0", "at least one"});
    check_refused([&] { plot(h, {HistoryPanel{}}, path); }, {"curves in the panel '' = 0", "1 to 7"});
    check_refused([&] { plot(h, {{std::vector<std::string>(8, "tip flap")}}, path); }, {"= 8", "1 to 7"});
    check_refused([&] { plot(h, {{{"tip"}}}, path); }, {"'tip'", "'tip flap'"});
    HistoryPlotOptions options;
    options.from = 19.99;
    check_refused([&] { plot(h, {{{"tip flap"}}}, path, options); }, {"from, to [s] = 19.99", "between 0 and 20"});
    options = {};
    options.width = 300;
    check_refused([&] { plot(h, {{{"tip flap"}}}, path, options); }, {"width in pixels = 300", "400 to 20000"});
    check_refused([&] { plot(h, one_panel_each(std::vector<std::string>(150, "order")), path); },
                  {"panels = 150", "20000"});
    SpectrumPlotOptions spectra;
    spectra.blades = -1;
    check_refused([&] { plot_spectra(h, {{{"order"}}}, path, spectra); }, {"number of blades = -1", ">= 0"});
    spectra.blades = 3;
    spectra.max_frequency_hz = -1;
    check_refused([&] { plot_spectra(h, {{{"order"}}}, path, spectra); }, {"largest frequency [Hz] = -1"});
    h.values[1].pop_back();
    check_refused([&] { plot(h, {{{"tip flap"}}}, path); }, {"values of the channel 'tip edge' = 1000", "1001"});
    h.values.pop_back();
    check_refused([&] { plot(h, {{{"tip flap"}}}, path); }, {"rows of values = 7", "8"});
    h = history();
    h.time[7] = 0;
    check_refused([&] { plot(h, {{{"tip flap"}}}, path); }, {"x of point 7 = 0", "rising"});
    CHECK_FALSE(std::filesystem::exists(path));
    CHECK_THROWS_AS(plot(history(), {{{"order"}}}, folder.path / "a.bmp"), FileError);
}

TEST_CASE("plot: several histories over each other, each with its name, from the first time to the last",
          "[property]") {
    const Folder folder;
    const History all = history();
    History late = all;
    for (double& time : late.time) time += 5;
    late.channels[0].name = "tip";
    late.channels[5].units = "N";
    const std::vector<NamedHistory> both{{"before", &all}, {"after", &late}};
    plot(both, one_panel_each({"tip edge", "tip flap", "tip"}), folder / "both.svg");
    const std::string svg = bytes_of(folder / "both.svg");
    for (const char* label : {"before: tip edge", "after: tip edge", "before: tip flap", "after: tip"})
        CHECK_THAT(svg, Contains(label));
    CHECK_THAT(svg, !Contains("after: tip flap") && !Contains("before: tip<"));
    CHECK_THAT(svg, Contains(">25<"));  // the last time
    check_refused([&] { plot(both, {{{"gear"}}}, folder / "x.svg"); }, {"channel = gear", "any of them"});
    check_refused([&] { plot(both, {{{"RootMyb1"}}}, folder / "x.svg"); }, {"units of the channel"});
    check_refused([&] { plot(std::vector<NamedHistory>{}, {{{"tip"}}}, folder / "x.svg"); }, {"number of histories"});
    // One alone is the picture of one.
    const std::vector<NamedHistory> one{{"before", &all}};
    plot(one, one_panel_each({"tip edge"}), folder / "one.svg");
    plot(all, one_panel_each({"tip edge"}), folder / "alone.svg");
    CHECK(bytes_of(folder / "one.svg") == bytes_of(folder / "alone.svg"));
    plot_spectra(both, one_panel_each({"tip edge"}), folder / "spectra.svg");
    CHECK_THAT(bytes_of(folder / "spectra.svg"), Contains("after: tip edge"));
}
