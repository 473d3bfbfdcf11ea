// The NREL 5 MW blade, isolated and clamped at 1.5 m: mass, frequencies at rest and in rotation, convergence.
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_blade.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <fstream>
#include <sstream>

namespace cardan::testing::isolated_nrel5mw_blade {

using turbines::nrel5mw_blade;
using turbines::nrel5mw_blade_elements;
using turbines::nrel5mw_blade_refined;

namespace {

// Hz, exact to 1e-4: converged by a method that shares nothing with the joint chain. [docs/nrel5mw_blade.md]
constexpr double digit = 1e-4;
constexpr std::array<std::array<double, 6>, 3> exact{{{0.6772, 1.0855, 1.9516, 3.9962, 4.5160, 5.4709},
                                                      {0.6904, 1.0875, 1.9663, 4.0015, 4.5287, 5.4719},
                                                      {0.7288, 1.0936, 2.0105, 4.0173, 4.5676, 5.4753}}};

double error(const solvers::Campbell& d, std::size_t mode, std::size_t point) {
    return hz(d, mode, point) / exact.at(point).at(mode) - 1;
}

// Rounding of the references, relative.
double resolution(std::size_t mode, std::size_t point) {
    return digit / exact.at(point).at(mode);
}

}  // namespace

TEST_CASE("NREL 5 MW blade: mass 17608.83 kg, first moment 361352 kg m, 1.5 m to 63 m", "[analytic]") {
    const turbines::Nrel5mwBlade blade = nrel5mw_blade();
    CHECK(blade.root_radius == 1.5);
    CHECK(blade.tip_radius == 63.0);
    CHECK(blade.line.length == 61.5);
    CHECK(blade.mass() == Approx(17608.83).margin(0.005));
    CHECK(blade.first_moment() == Approx(361352).margin(0.5));
    for (const CardanBeamOptions& elements :
         {nrel5mw_blade_elements(1), nrel5mw_blade_elements(16), nrel5mw_blade_refined(),
          nrel5mw_blade_elements(16, Partition::static_moment)})
        CHECK(turbines::isolated_blade(blade, elements).layout().blades.front().mass ==
              Approx(blade.mass()).epsilon(1e-12));
}

TEST_CASE("NREL 5 MW blade: without the factor 16844.75 kg, which is the trapezoidal sum of the table", "[analytic]") {
    const auto table = turbines::CsvTable::parse(turbines::embedded_data("nrel5mw_blade.csv"), "nrel5mw_blade.csv");
    const auto r = table.column("radius_from_rotor_apex", "m"), mu = table.column("mass_per_length", "kg/m");
    double sum = 0;
    for (std::size_t i = 1; i < r.size(); ++i) sum += (r[i] - r[i - 1]) * (mu[i] + mu[i - 1]) / 2;
    turbines::Nrel5mwBladeOptions options;
    options.mass_factor = 1;
    CHECK(nrel5mw_blade(options).mass() == Approx(sum).epsilon(1e-13));
    CHECK(sum == Approx(17608.83 / 1.04536).epsilon(1e-6));
    const auto quantities =
        turbines::CsvQuantities::parse(turbines::embedded_data("nrel5mw_turbine.csv"), "nrel5mw_turbine.csv");
    CHECK(turbines::Nrel5mwBladeOptions().mass_factor == quantities.number("blade_mass_adjust_factor", "-"));
    CHECK(nrel5mw_blade().tip_radius == quantities.number("rotor_tip_radius", "m"));
    CHECK(nrel5mw_blade().root_radius == quantities.number("hub_radius", "m"));
}

TEST_CASE("NREL 5 MW blade: a section is the table's row in blade axes", "[property]") {
    // Row at 13.699755 m: 406.186 kg/m, twist 12.848 deg, mass centre 0.30756 m toward the trailing edge.
    const turbines::Nrel5mwBlade blade = nrel5mw_blade();
    const double x = 13.699755 - 1.5, twist = 12.848 * units::degree;
    const BeamSection s = blade.line.section(x);
    CHECK(s.mass == Approx(1.04536 * 406.186).epsilon(1e-12));
    CHECK(s.centre.y() == Approx(-0.30756 * std::cos(twist)).epsilon(1e-12));
    CHECK(s.centre.z() == Approx(0.30756 * std::sin(twist)).epsilon(1e-12));  // leading edge turned upwind
    CHECK(s.J(0, 0) == Approx(1.04536 * (215.91 + 601.28)).epsilon(1e-12));
    CHECK(s.compliance(0, 0) == Approx(1 / 4.08597e9).epsilon(1e-12));
    CHECK(s.compliance(3, 3) == Approx(1 / 5.4749e8).epsilon(1e-12));
    const Eigen::Matrix2d bending = s.compliance.bottomRightCorner<2, 2>();
    CHECK(bending.trace() == Approx(1 / 3.38652e9 + 1 / 7.0817e9).epsilon(1e-12));
    CHECK(bending(0, 0) * bending(1, 1) - bending(0, 1) * bending(1, 0) ==
          Approx(1 / 3.38652e9 / 7.0817e9).epsilon(1e-12));
    CHECK(s.compliance(1, 1) == 0.0);
    CHECK(s.compliance.topRightCorner<3, 3>().norm() == 0.0);

    turbines::Nrel5mwBladeOptions options;
    options.axial = options.mass_offset = false;
    options.shear_ratio = 20;
    const BeamSection other = nrel5mw_blade(options).line.section(x);
    CHECK(other.centre.norm() == 0.0);
    CHECK(other.compliance(0, 0) == 0.0);
    CHECK(other.compliance(1, 1) == Approx(1 / (20 * 4.08597e9)).epsilon(1e-12));
    CHECK(other.compliance(2, 2) == Approx(1 / (20 * 4.08597e9)).epsilon(1e-12));
}

TEST_CASE("NREL 5 MW blade: 16 elements within 0.1 % on flap 1, edge 1 and flap 2 at 0, 6 and 12.1 rpm", "[analytic]") {
    const solvers::Campbell d = diagram(nrel5mw_blade_elements(16));
    CHECK(d.warning.empty());
    for (std::size_t point = 0; point < blade_speeds.size(); ++point) {
        CAPTURE(point);
        for (std::size_t mode : {0, 1, 2}) CHECK(std::abs(error(d, mode, point)) < 1e-3);
        // Sharper, what 16 elements give: the rest of the references' rounding included.
        CHECK(std::abs(error(d, 0, point)) < 1.01 * resolution(0, point));
        CHECK(std::abs(error(d, 1, point)) < 1.01 * resolution(1, point));
        CHECK(error(d, 2, point) == Approx(point == 2 ? -2.2e-4 : -3.5e-4).margin(resolution(2, point)));
        CHECK(error(d, 3, point) == Approx(-1.5e-4).margin(resolution(3, point) + 3e-5));
        CHECK(error(d, 4, point) == Approx(-1.8e-3).margin(2e-4));
        CHECK(error(d, 5, point) == Approx(-5.8e-3).margin(2e-4));
    }
}

TEST_CASE("NREL 5 MW blade: 8 elements refined toward the tip within 0.5 %, equal ones miss that on flap 2",
          "[analytic]") {
    const solvers::Campbell refined = diagram(nrel5mw_blade_refined()), equal = diagram(nrel5mw_blade_elements(8));
    for (std::size_t point = 0; point < blade_speeds.size(); ++point) {
        CAPTURE(point);
        for (std::size_t mode : {0, 1, 2}) CHECK(std::abs(error(refined, mode, point)) < 5e-3);
        CHECK(std::abs(error(refined, 2, point)) < 1.2e-3);
        CHECK(error(equal, 2, point) < -6e-3);
        CHECK(error(equal, 2, point) > -8e-3);
    }
}

TEST_CASE("NREL 5 MW blade: segment masses converge with order 4 in bending and 2 in torsion", "[analytic]") {
    const solvers::Campbell n4 = diagram(nrel5mw_blade_elements(4)), n8 = diagram(nrel5mw_blade_elements(8)),
                            n16 = diagram(nrel5mw_blade_elements(16));
    for (std::size_t point = 0; point < blade_speeds.size(); ++point) {
        for (std::size_t mode = 0; mode < blade_mode_names.size(); ++mode) {
            CAPTURE(point, blade_mode_names.at(mode), error(n4, mode, point), error(n8, mode, point),
                    error(n16, mode, point));
            CHECK(std::abs(error(n8, mode, point)) < 0.35 * std::abs(error(n4, mode, point)));
            CHECK(std::abs(error(n16, mode, point)) < 0.3 * std::abs(error(n8, mode, point)) + resolution(mode, point));
        }
        // Where the rounding of the reference leaves the order visible.
        CHECK(observed_order(error(n4, 0, point), error(n8, 0, point)) > 4);
        CHECK(observed_order(error(n4, 1, point), error(n8, 1, point)) > 4);
        CHECK(observed_order(error(n8, 2, point), error(n16, 2, point)) > 4);
        CHECK(observed_order(error(n8, 3, point), error(n16, 3, point)) > 4);
        CHECK(observed_order(error(n8, 4, point), error(n16, 4, point)) == Approx(4.05).margin(0.15));
        CHECK(observed_order(error(n8, 5, point), error(n16, 5, point)) == Approx(2.17).margin(0.1));
    }
}

TEST_CASE("NREL 5 MW blade: both partitions meet the exact frequencies with 32 elements", "[analytic][slow]") {
    for (const Partition partition : {Partition::segment_masses, Partition::static_moment}) {
        const solvers::Campbell n16 = diagram(nrel5mw_blade_elements(16, partition)),
                                n32 = diagram(nrel5mw_blade_elements(32, partition));
        for (std::size_t point = 0; point < blade_speeds.size(); ++point) {
            for (std::size_t mode = 0; mode < 4; ++mode) {
                CAPTURE(point, blade_mode_names.at(mode), hz(n32, mode, point));
                CHECK(std::abs(hz(n32, mode, point) - exact.at(point).at(mode)) < digit);
            }
            CHECK(std::abs(error(n32, 4, point)) < 1.2e-4);
            CHECK(observed_order(error(n16, 4, point), error(n32, 4, point)) > 3.8);
            CHECK(error(n32, 5, point) == Approx(-1.5e-3).margin(5e-5));
            CHECK(observed_order(error(n16, 5, point), error(n32, 5, point)) == Approx(2.05).margin(0.15));
        }
    }
}

TEST_CASE("NREL 5 MW blade: static moments with a last element of 1 m: order above 4 in bending, 2 in torsion",
          "[analytic]") {
    const auto blade = [](int n) { return diagram(nrel5mw_blade_elements(n, Partition::static_moment)); };
    const solvers::Campbell n4 = blade(4), n8 = blade(8), n16 = blade(16);
    for (std::size_t point = 0; point < blade_speeds.size(); ++point) {
        for (std::size_t mode = 0; mode < blade_mode_names.size(); ++mode) {
            CAPTURE(point, blade_mode_names.at(mode), error(n4, mode, point), error(n8, mode, point),
                    error(n16, mode, point));
            CHECK(std::abs(error(n8, mode, point)) < 0.25 * std::abs(error(n4, mode, point)));
            CHECK(std::abs(error(n16, mode, point)) <
                  0.25 * std::abs(error(n8, mode, point)) + resolution(mode, point));
        }
        CHECK(observed_order(error(n4, 2, point), error(n8, 2, point)) > 4);
        CHECK(observed_order(error(n8, 4, point), error(n16, 4, point)) > 4);
        CHECK(observed_order(error(n8, 5, point), error(n16, 5, point)) == Approx(2.26).margin(0.1));
    }
}

TEST_CASE("NREL 5 MW blade: static moments refuse equal elements, whose last one would need a negative inertia",
          "[property]") {
    CardanBeamOptions equal = nrel5mw_blade_elements(16);
    equal.partition = Partition::static_moment;
    equal.delta = 1.0 / 6;
    check_refused([&] { (void)turbines::isolated_blade(nrel5mw_blade(), equal); }, {"inertia", "allowed: >= 0"});
    const auto isolated =
        turbines::isolated_blade(nrel5mw_blade(), nrel5mw_blade_elements(16, Partition::static_moment));
    REQUIRE(isolated.layout().blades.front().warnings.size() == 1);  // the last metre is still steep for this partition
    CHECK(isolated.layout().blades.front().warnings.front().find("element at 60.5 m") != std::string::npos);
}

TEST_CASE("NREL 5 MW blade at 12.1 rpm: condensed extension gives flap 1 0.7290 and edge 1 1.0943 Hz", "[analytic]") {
    const double speed[] = {12.1 * rpm};
    CardanBeamOptions condensed = nrel5mw_blade_elements(16);
    condensed.extension = false;
    const solvers::Campbell d = diagram(condensed, speed);
    CHECK(hz(d, 0, 0) == Approx(0.7290).margin(digit));
    CHECK(hz(d, 1, 0) == Approx(1.0943).margin(digit));
    // An inextensible section is the same blade.
    turbines::Nrel5mwBladeOptions options;
    options.axial = false;
    const solvers::Campbell rigid = diagram(condensed, speed, nrel5mw_blade(options));
    for (std::size_t mode = 0; mode < blade_mode_names.size(); ++mode)
        CHECK(hz(rigid, mode, 0) == Approx(hz(d, mode, 0)).epsilon(1e-10));
}

namespace {

// Stations of the table for the rod, which has log-linear stiffnesses, and a polar inertia shared out as the bending
// stiffnesses are; and the library's blade with the same two changes. Read without the library's reader.
struct Variant {
    std::vector<oracles::BladeStation> stations;
    turbines::Nrel5mwBlade blade;
};

Variant log_linear_variant() {
    std::ifstream file(std::string(CARDAN_SOURCE_DIR) + "/turbines/data/nrel5mw_blade.csv");
    Variant v;
    std::vector<double> x;
    std::vector<EngineeringSection> sections;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#' || line.starts_with("span_fraction")) continue;
        std::vector<double> c;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) c.push_back(std::stod(cell));
        const double factor = 1.04536, twist = c.at(3) * units::degree, polar = factor * (c.at(9) + c.at(10));
        v.stations.push_back({.x = c.at(1) - 1.5,
                              .mass_per_length = factor * c.at(4),
                              .flap_stiffness = c.at(5),
                              .edge_stiffness = c.at(6),
                              .torsion_stiffness = c.at(7),
                              .twist = twist,
                              .mass_centre_offset = c.at(11),
                              .shear_centre_offset = 0,
                              .polar_inertia = polar});
        EngineeringSection s;
        s.mass = factor * c.at(4);
        s.EI_flap = c.at(5), s.EI_edge = c.at(6), s.GJ = c.at(7);
        s.beta = -twist;
        s.mass_centre.y = -c.at(11);
        s.j_edge = polar;
        x.push_back(c.at(1) - 1.5);
        sections.push_back(s);
    }
    const BeamTable table{"NREL 5 MW blade, log-linear", x, sections, Interpolation::log_linear_stiffness};
    v.blade = nrel5mw_blade();
    v.blade.line = beam_line(table);
    v.blade.line.section = [table](double at) {
        EngineeringSection s = table.constants(at);
        const double polar = s.j_edge;
        s.j_edge = polar * s.EI_edge / (s.EI_edge + s.EI_flap);
        s.j_flap = polar - s.j_edge;
        return s.section();
    };
    return v;
}

}  // namespace

TEST_CASE("NREL 5 MW blade, inextensible, log-linear: the chain converges to the geometrically exact rod",
          "[analytic][slow]") {
    const Variant variant = log_linear_variant();
    const oracles::RotatingBlade rod(oracles::BladeStations(variant.stations), 1.5, 3);
    CardanBeamOptions elements = nrel5mw_blade_elements(32);
    elements.extension = false;
    const solvers::Campbell n32 = diagram(elements, blade_speeds, variant.blade);
    for (std::size_t point : {0, 2}) {
        const Eigen::VectorXd f = rod.modes(blade_speeds.at(point), 6).frequency;
        for (std::size_t mode = 0; mode < blade_mode_names.size(); ++mode) {
            const double relative = hz(n32, mode, point) / f(static_cast<Eigen::Index>(mode)) - 1;
            CAPTURE(point, blade_mode_names.at(mode), f(static_cast<Eigen::Index>(mode)), relative);
            CHECK(std::abs(relative) < std::array{3e-5, 3e-5, 5e-5, 5e-5, 2e-4, 2e-3}.at(mode));
        }
    }
}

TEST_CASE("NREL 5 MW blade: bad options and data are refused", "[property]") {
    const auto with = [](auto change) {
        turbines::Nrel5mwBladeOptions options;
        change(options);
        return [options] { (void)nrel5mw_blade(options); };
    };
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    for (double value : {0.0, -1.0, nan, infinite})
        check_refused(with([&](auto& o) { o.mass_factor = value; }),
                      {"NREL 5 MW blade: mass factor", "finite and > 0"});
    for (double value : {0.0, -1.0, nan})
        check_refused(with([&](auto& o) { o.shear_ratio = value; }), {"shear ratio GA / EA", "> 0"});

    const turbines::Nrel5mwBlade blade = nrel5mw_blade();
    for (int n : {0, -1, 1001})
        check_refused([&] { (void)turbines::isolated_blade(blade, nrel5mw_blade_elements(n)); },
                      {"number of elements", text(n)});
    CardanBeamOptions elements = nrel5mw_blade_refined();
    elements.boundaries.back() = 61;
    check_refused([&] { (void)turbines::isolated_blade(blade, elements); }, {"element boundaries", "61.5"});
    elements = nrel5mw_blade_elements();
    elements.delta = 0.5;
    check_refused([&] { (void)turbines::isolated_blade(blade, elements); }, {"delta", "0.5"});

    turbines::Nrel5mwBladeOptions rigid;
    rigid.axial = false;
    check_refused([&] { (void)turbines::isolated_blade(nrel5mw_blade(rigid), nrel5mw_blade_elements()); },
                  {"blade 1", "extension", "EA"});

    const test::Folder folder;
    CHECK(test::message_of([&] { (void)nrel5mw_blade(folder.path); }).find("nrel5mw_blade.csv: cannot be read") !=
          std::string::npos);
    std::string table(turbines::embedded_data("nrel5mw_blade.csv"));
    std::ofstream(folder / "nrel5mw_blade.csv") << table;
    CHECK(nrel5mw_blade(folder.path).mass() == blade.mass());
    CHECK(nrel5mw_blade(folder.path).source == blade.source);
    table.replace(table.find("edge_cg_offset[m]"), 17, "edge_cg_offset[mm]");
    std::ofstream(folder / "nrel5mw_blade.csv") << table;
    CHECK(test::message_of([&] { (void)nrel5mw_blade(folder.path); }).find("unit m expected, mm found") !=
          std::string::npos);
}

}  // namespace cardan::testing::isolated_nrel5mw_blade
