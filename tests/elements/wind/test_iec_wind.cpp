// Winds of IEC 61400-1: formulas against tables of another implementation and published numbers, names, what is
// refused.
#include "elements/wind/iec_wind.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/tables/csv.hpp"

#include <array>
#include <cmath>

namespace cardan::testing::iec_wind_tests {

namespace {

using turbines::CsvTable;

CsvTable table(const std::string& name) {
    return CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/data/wind/" + name);
}

// Half of the last of six digits, and what a sum may round.
constexpr double six_digits = 0.5e-6 + 1e-12;

const IecMachine machine{.wind_class = iec_class("I B"), .hub_height = 90, .rotor_diameter = 126};

struct Event {
    SteadyWind wind;
    Gust gust;
    Vec3 at(const Vec3& place, double time) const { return gust.applied(wind, time).at(place); }
};

Event event(const std::string& name, double start = 0) {
    const IecWindName wind = iec_wind_name(name);
    return {iec_wind(machine, wind), iec_gust(machine, wind, start)};
}

}  // namespace

TEST_CASE("IEC winds: turbulence, extreme speeds and amplitudes of four machines", "[discrete]") {
    const CsvTable rows = table("iec_amplitudes.csv");
    REQUIRE(rows.rows() == 24);
    for (std::size_t i = 0; i < rows.rows(); ++i) {
        const auto at = [&](const char* name) { return rows.column(name)[i]; };
        const auto agrees = [&](double own, const char* name, double unit = 1) {
            CAPTURE(i, name, own, at(name));
            CHECK(std::abs(own / unit - at(name)) < six_digits);
        };
        const std::string word = std::array{"I", "II", "III"}.at(static_cast<std::size_t>(at("class")) - 1);
        const IecClass its = iec_class(word + (at("I_ref") == 0.16 ? "A" : at("I_ref") == 0.14 ? "B" : "C"));
        REQUIRE(its.reference_intensity == at("I_ref"));
        const IecMachine own{its, at("hub_height"), at("diameter")};
        const double V = at("speed");
        agrees(iec_normal_turbulence(its, V), "sigma1_NTM");
        agrees(iec_extreme_turbulence(its, V), "sigma1_ETM");
        agrees(iec_steady_extreme_speed(its, IecRecurrence::fifty_years), "V_e50");
        agrees(iec_steady_extreme_speed(its, IecRecurrence::one_year), "V_e1");
        agrees(iec_eog_speed(own, V), "V_gust_EOG");
        agrees(iec_edc_angle(own, V), "theta_e_EDC", units::degree);
        agrees(iec_ecd_angle(own, V), "theta_cg_ECD", units::degree);
        agrees(iec_ews_speed(own, V), "K_EWS");
    }
}

TEST_CASE("IEC winds: gusts over time, at the hub and at the tips", "[discrete]") {
    const CsvTable rows = table("iec_gusts.csv");
    REQUIRE(rows.rows() == 25);
    const Event eog = event("eog:11.4"), edc = event("edc+:11.4"), ecd = event("ecd+:11.4"),
                above = event("ewsv+:11.4"), left = event("ewsh+:11.4");
    const Vec3 hub(0, 0, 90);
    for (std::size_t i = 0; i < rows.rows(); ++i) {
        const double t = rows.column("time", "s")[i];
        const auto agrees = [&](double own, const char* name) {
            CAPTURE(t, name, own, rows.column(name)[i]);
            CHECK(std::abs(own - rows.column(name)[i]) < six_digits);
        };
        const auto angle = [](const Vec3& wind) { return std::atan2(wind.y(), wind.x()) * units::to_degrees; };
        agrees(eog.at(hub, t).x(), "EOG_speed");
        agrees(angle(edc.at(hub, t)), "EDC_direction");
        agrees(angle(ecd.at(hub, t)), "ECD_direction");
        agrees(ecd.at(hub, t).norm(), "ECD_speed");
        agrees(above.at({0, 0, 153}, t).x(), "EWS_vertical_speed");
        agrees(left.at({0, 63, 90}, t).x(), "EWS_horizontal_speed");
    }
}

TEST_CASE("IEC winds: EOG as InflowWind's output has it", "[discrete]") {
    // InflowWind of OpenFAST 5.0.0, a file of this gust for class I B, D 126 m at 11.4 m/s: least and largest of a
    // speed that is printed every 0.1 s.
    const Event eog = event("eog:11.4", 20);
    double least = 1e3, largest = 0;
    for (int i = 0; i <= 600; ++i) {
        least = std::min(least, eog.at({0, 0, 90}, 0.1 * i).x());
        largest = std::max(largest, eog.at({0, 0, 90}, 0.1 * i).x());
    }
    CHECK(std::abs(least - 10.054) < 0.5e-3);
    CHECK(std::abs(largest - 15.117) < 0.5e-3);
}

TEST_CASE("IEC winds: numbers of the standard", "[published]") {
    // IEC 61400-1, ed. 4, table 1 and 6.3.
    for (const auto& [name, speed] : {std::pair("I", 50.0), {"II", 42.5}, {"III", 37.5}})
        for (const auto& [category, intensity] : {std::pair("A+", 0.18), {"A", 0.16}, {"B", 0.14}, {"C", 0.12}})
            CHECK(iec_class(text(name, category)) == IecClass{speed, intensity, 0.2 * speed});
    CHECK(iec_class("S 57 A+") == IecClass{57, 0.18, 0.2 * 57});
    const IecClass second = iec_class("II A");
    CHECK(iec_turbulent_extreme_speed(second, IecRecurrence::fifty_years) == Approx(42.5));
    CHECK(iec_turbulent_extreme_speed(second, IecRecurrence::one_year) == Approx(34));
    CHECK(iec_steady_extreme_speed(second, IecRecurrence::fifty_years) == Approx(59.5));
    CHECK(iec_steady_extreme_speed(second, IecRecurrence::one_year) == Approx(47.6));
    CHECK(iec_turbulence_scale(45) == Approx(31.5));
    CHECK(iec_turbulence_scale(60) == Approx(42));
    CHECK(iec_turbulence_scale(150) == Approx(42));
    // TurbSim's summary of ETM in class I B at 10 m/s.
    CHECK(std::abs(iec_extreme_turbulence(iec_class("IB"), 10) - 2.96128) < 0.5e-5);
}

TEST_CASE("IEC winds: EDC and ECD have their limits", "[analytic]") {
    // 4 arctan x is 180 deg where x = 1, that is V (1 + 0.1 D/Lambda_1) = sigma_1.
    const double a = 0.14, size = 1 + 0.1 * 126 / 42, limit = 5.6 * a / (size - 0.75 * a);
    CHECK(iec_edc_angle(machine, limit * 1.0001) < pi);
    CHECK(iec_edc_angle(machine, limit * 1.0001) == Approx(pi).epsilon(1e-4));
    CHECK(iec_edc_angle(machine, limit * 0.9999) == pi);
    CHECK(iec_edc_angle(machine, 1e-6) == pi);
    for (const double V : {0.1, 3.0, 4.0}) CHECK(iec_ecd_angle(machine, V) == pi);
    for (const double V : {4.5, 16.0, 50.0}) CHECK(iec_ecd_angle(machine, V) * V == Approx(720 * units::degree));
    CHECK_NOTHROW(iec_gust(machine, iec_wind_name("edc-:0.5"), 0).check());
    // A rotor of 10 Lambda_1 halves the tangent of a quarter of the angle; with 0.01 in the place of 0.1 it would
    // be 1.1.
    const auto tangent = [](double D) { return std::tan(iec_edc_angle({iec_class("IB"), 90, D}, 12) / 4); };
    CHECK(tangent(420) == Approx(tangent(1e-9) / 2));
    CHECK(iec_edc_angle(machine, 11.4) * units::to_degrees == Approx(30.454542).epsilon(1e-7));
    CHECK(std::abs(iec_edc_angle(machine, 11.4) * units::to_degrees - 38.3) > 7);
    // Which of its two terms limits EOG: near V_ref of a gusty class the first.
    const IecMachine gusty{{50, 0.6, 10}, 90, 126};
    CHECK(iec_eog_speed(gusty, 49) == Approx(1.35 * (56 - 49)));
}

TEST_CASE("IEC winds: normal and extreme winds have their power laws about the hub", "[analytic]") {
    const auto ratio = [](const SteadyWind& wind) { return wind.at({0, 0, 153}).x() / wind.at({0, 0, 90}).x(); };
    const SteadyWind normal = iec_wind(machine, {.speed = 12});
    CHECK(normal.at({5, 7, 90}).isApprox(Vec3(12, 0, 0)));
    CHECK(ratio(normal) == Approx(std::pow(1.7, 0.2)));
    IecMachine offshore = machine;
    offshore.exponent = iec_offshore_exponent;
    CHECK(ratio(iec_wind(offshore, {.speed = 12})) == Approx(std::pow(1.7, 0.14)));
    for (const auto& [name, speed] : {std::pair("ewm50", 70.0), {"ewm1", 56.0}}) {
        const Event extreme = event(name);
        CHECK(extreme.at({0, 0, 90}, 5).isApprox(Vec3(speed, 0, 0)));
        CHECK(ratio(extreme.wind) == Approx(std::pow(1.7, 0.11)));
        CHECK(extreme.gust == Gust{});
        CHECK(ratio(iec_wind(offshore, iec_wind_name(name))) == Approx(std::pow(1.7, 0.11)));
    }
    CHECK(event("nwp:12").gust == Gust{});
}

TEST_CASE("IEC winds: gusts of both signs differ in the sign alone, and add up to what has none", "[property]") {
    for (const std::string word : {"edc", "ecd", "ewsv", "ewsh"}) {
        CAPTURE(word);
        const Gust plus = event(word + "+:9", 30).gust, minus = event(word + "-:9", 30).gust;
        CHECK(plus.start == 30);
        CHECK(plus.hub_height == 90);
        CHECK(plus.angle >= 0);
        CHECK(plus.gradient >= 0);
        CHECK(plus.angle + plus.gradient > 0);
        Gust turned = minus;
        turned.angle = -minus.angle;
        turned.gradient = -minus.gradient;
        CHECK(turned == plus);
    }
}

TEST_CASE("IEC winds: names are read and written", "[property]") {
    CHECK(iec_wind_name("NWP:12") == IecWindName{IecWindKind::nwp, 1, 12});
    CHECK(iec_wind_name("Eog:11.4") == IecWindName{IecWindKind::eog, 1, 11.4});
    CHECK(iec_wind_name("EDC-:12") == IecWindName{IecWindKind::edc, -1, 12});
    CHECK(iec_wind_name("ecd+:8.5") == IecWindName{IecWindKind::ecd, 1, 8.5});
    CHECK(iec_wind_name("ewsV-:25") == IecWindName{IecWindKind::ews_vertical, -1, 25});
    CHECK(iec_wind_name("ewsh+:3e0") == IecWindName{IecWindKind::ews_horizontal, 1, 3});
    CHECK(iec_wind_name("EWM1") == IecWindName{IecWindKind::ewm1});
    CHECK(iec_wind_name("ewm50") == IecWindName{IecWindKind::ewm50});
    for (const char* name : {"nwp:12", "eog:11.4", "edc+:12", "edc-:0.1", "ecd+:8", "ecd-:8", "ewsv+:25", "ewsv-:25",
                             "ewsh+:3", "ewsh-:3", "ewm1", "ewm50"})
        CHECK(name_of(iec_wind_name(name)) == name);

    for (const char* name : {"ib", "I B", "IIA+", " ii a +", "iiic"}) CHECK_NOTHROW(iec_class(name));
    for (const char* name : {"I B", "II A+", "III C", "S 45 B", "S 57.25 A+"}) CHECK(name_of(iec_class(name)) == name);
    CHECK(name_of(iec_class("s45b")) == "S 45 B");
    CHECK(name_of(IecClass{45, 0.15, 9}) == "S (V_ref 45 m/s, I_ref 0.15, V_ave 9 m/s)");
    CHECK(name_of(IecClass{50, 0.16, 8}) == "S (V_ref 50 m/s, I_ref 0.16, V_ave 8 m/s)");
}

TEST_CASE("IEC winds: names that are not are refused with those that are", "[property]") {
    const auto refused = [](const char* name, std::initializer_list<std::string> parts) {
        CAPTURE(name);
        check_refused([&] { static_cast<void>(iec_wind_name(name)); }, parts);
    };
    const std::initializer_list<std::string> all{
        "nwp:V, eog:V, edc+:V, edc-:V, ecd+:V, ecd-:V, ewsv+:V, ewsv-:V, ewsh+:V, "
        "ewsh-:V, ewm1, ewm50, with V the speed at the hub in m/s"};
    for (const char* name : {"", ":", "+", "-:", "ews+:12", "ntm:12", " nwp:12", "nwp 12", "ewm", "12", "edc++:12"})
        refused(name, all);
    refused("edc:12", {"'edc:12'", "edc+:12 or edc-:12", "both signs"});
    refused("ewsv", {"ewsv+:V or ewsv-:V"});
    refused("eog-:12", {"'eog-:12'", "allowed: eog:12, without a sign"});
    refused("ewm50+", {"allowed: ewm50, without a sign"});
    refused("ewm1:30", {"'ewm1:30'", "allowed: ewm1, without a speed"});
    for (const char* name :
         {"nwp", "nwp:", "nwp:x", "nwp:12,5", "nwp:0", "nwp:-3", "nwp:nan", "nwp:inf", "nwp:1001", "nwp: 12"})
        refused(name, {name, "allowed: nwp:V with the speed at the hub in m/s, > 0 and at most 1000, such as nwp:12"});
    refused("ECD-:fast", {"ecd+:V or ecd-:V with the speed", "such as ecd-:12"});

    for (const char* name : {"", "I", "IV B", "I D", "A", "A+", "SA", "S x A", "S45", "I B C", "1A", "S nan A"})
        check_refused([&] { iec_class(name); },
                      {text("'", name, "'"), "I, II or III, or S and V_ref", "A+, A, B or C"});
    check_refused([] { iec_class("S 500 A"); }, {"V_ref [m/s] = 500", "1 ... 200"});
    check_refused([] { iec_class("S -45 A"); }, {"V_ref [m/s] = -45"});
}

TEST_CASE("IEC winds: numbers out of range are refused", "[property]") {
    const auto with = [](auto change) {
        IecMachine bad = machine;
        change(bad);
        return bad;
    };
    const IecWindName normal{.speed = 12};
    for (const double value : {0.0, -1.0, not_a_number, infinite}) {
        check_refused([&] { iec_wind(with([&](IecMachine& m) { m.hub_height = value; }), normal); },
                      {"hub height [m]"});
        check_refused([&] { iec_wind(with([&](IecMachine& m) { m.rotor_diameter = value; }), normal); },
                      {"diameter of the rotor [m]"});
        check_refused([&] { iec_wind(machine, {.speed = value}); }, {"speed at the hub [m/s]"});
        check_refused([&] { static_cast<void>(iec_turbulence_scale(value)); }, {"hub height [m]"});
    }
    check_refused([&] { iec_wind(with([](IecMachine& m) { m.exponent = 1.5; }), normal); },
                  {"exponent", "1.5", "0 ... 1"});
    check_refused(
        [&] { iec_wind(with([](IecMachine& m) { m.wind_class.reference_intensity = not_a_number; }), normal); },
        {"I_ref = nan", "0 ... 1"});
    check_refused([&] { iec_wind(with([](IecMachine& m) { m.wind_class.mean_speed = 60; }), normal); },
                  {"V_ave [m/s] = 60"});
    check_refused([] { static_cast<void>(iec_normal_turbulence(machine.wind_class, -1)); }, {"NTM", "-1"});
    check_refused([] { static_cast<void>(iec_extreme_turbulence(machine.wind_class, not_a_number)); }, {"ETM", "nan"});
    for (const char* name : {"eog:50.1", "edc+:50.1", "ecd-:50.1", "ewsh+:50.1"})
        check_refused([&] { iec_gust(machine, iec_wind_name(name), 0); },
                      {"speed at the hub [m/s] = 50.1", "V_ref", "50"});
    check_refused([] { iec_gust(machine, {IecWindKind::edc, 1, 0}, 0); }, {"EDC", "speed at the hub [m/s] = 0"});
    check_refused([] { iec_gust(machine, {IecWindKind::edc, 0, 12}, 0); }, {"edc", "sign = 0", "1, -1"});
    check_refused([] { iec_gust(machine, {IecWindKind::eog, -1, 12}, 0); }, {"eog", "sign = -1", "allowed: 1"});
    check_refused([] { iec_gust(machine, {IecWindKind::eog, 1, 12}, infinite); }, {"gust (EOG)", "start [s] = inf"});
}

}  // namespace cardan::testing::iec_wind_tests
