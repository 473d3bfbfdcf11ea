// BeamDyn files: matrices, axes, twist, curved lines, damping.
#include "elements/sections/beam_line.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/beamdyn.hpp"

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::message_of;

namespace {

using units::degree;

struct KeyPoint {
    double x, y, z, twist;  // BeamDyn's axes, m; degrees
};
struct Station {
    double eta;
    SectionMatrices matrices;  // BeamDyn's axes
};

std::string digits(double value) {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
}

// Writes the two files; the blade's rows as BeamDyn has them.
void write(const test::Folder& folder, const std::vector<KeyPoint>& points, const std::vector<Station>& stations) {
    std::ofstream main(folder / "bd.dat"), blade(folder / "blade.dat");
    main << "--- BeamDyn\ntest\n 1 member_total\n " << points.size() << " kp_total\n 1 " << points.size()
         << "  - member\n kp_xr kp_yr kp_zr initial_twist\n (m) (m) (m) (deg)\n";
    for (const KeyPoint& p : points)
        main << digits(p.x) << " " << digits(p.y) << " " << digits(p.z) << " " << digits(p.twist) << "\n";
    main << "--- material\n\"blade.dat\" BldFile\nFalse UsePitchAct\n";
    blade << "--- blade\ntest\n " << stations.size() << " station_total\n 0 damp_type\n--- Distributed Properties\n";
    for (const Station& s : stations) {
        blade << digits(s.eta) << "\n";
        for (const Mat6* m : {&s.matrices.stiffness, &s.matrices.mass}) {
            for (Eigen::Index i = 0; i < 6; ++i) {
                for (Eigen::Index j = 0; j < 6; ++j) blade << " " << digits((*m)(i, j));
                blade << "\n";
            }
            blade << "\n";
        }
    }
}

EngineeringSection section(double scale) {
    EngineeringSection s;
    s.mass = 50 * scale;
    s.EA = 5e8 * scale;
    s.GJ = 2e6 * scale;
    s.EI_flap = 4e6 * scale;
    s.EI_edge = 2e7 * scale;
    s.GA_y = 8e7 * scale;
    s.GA_z = 5e7 * scale;
    s.mass_centre = {-0.08, 0.02};
    s.shear_centre = {0.05, -0.01};
    s.tension_centre = {-0.03, 0.015};
    s.j_flap = 1.5 * scale;
    s.j_edge = 4 * scale;
    return s;
}

// A section without twist in BeamDyn's axes: x downwind (z here), y to the trailing edge (-y), z along the blade (x).
SectionMatrices in_beamdyn_axes(const EngineeringSection& s) {
    Mat3 R;
    R << 0, 0, 1, 0, -1, 0, 1, 0, 0;
    return rotated(section_matrices(s.section()), R);
}

}  // namespace

TEST_CASE("beamdyn: a file written from known sections gives the sections back, turned by the twist", "[crosscheck]") {
    const test::Folder folder;
    const double length = 20;
    write(folder, {{0, 0, 0, 12}, {0, 0, 8, 7}, {0, 0, length, -1}},
          {{0, in_beamdyn_axes(section(1))}, {0.4, in_beamdyn_axes(section(0.5))}, {1, in_beamdyn_axes(section(0.1))}});
    const BeamDynBlade blade = read_beamdyn(folder / "bd.dat");
    CHECK(blade.beam.line.length == length);
    CHECK(blade.beam.line.is_straight());
    CHECK(blade.pitch.is_rigid());
    const auto check = [&](double x, double scale, double twist) {
        EngineeringSection expected = section(scale);
        expected.beta = -twist * degree;
        const BeamSection a = expected.section(), b = blade.beam.line.section(x);
        CAPTURE(x);
        CHECK((a.compliance - b.compliance).norm() < 1e-12 * a.compliance.norm());
        CHECK(b.mass == Approx(a.mass).epsilon(1e-14));
        CHECK((a.centre - b.centre).norm() < 1e-13);
        CHECK((a.J - b.J).norm() < 1e-12 * a.J.norm());
        CHECK(b.beta == Approx(a.beta).margin(1e-15));
    };
    check(0, 1, 12);
    check(8, 0.5, 7);
    check(20, 0.1, -1);
    check(4, 0.75, 9.5);  // all entries are linear in the section's axes, the centres stay
}

TEST_CASE("beamdyn: at 90 degrees of twist the trailing edge points downwind", "[analytic]") {
    const test::Folder folder;
    EngineeringSection s = section(1);
    s.mass_centre = {-0.3, 0};  // toward the trailing edge
    write(folder, {{0, 0, 0, 90}, {0, 0, 5, 90}}, {{0, in_beamdyn_axes(s)}, {1, in_beamdyn_axes(s)}});
    const BeamSection read = read_beamdyn(folder / "bd.dat").beam.line.section(2);
    CHECK((read.centre - Vec3(0, 0, 0.3)).norm() < 1e-14);
    // Bending about the chord, soft: the chord lies along the shaft.
    CHECK(read.compliance(5, 5) > 4 * read.compliance(4, 4));
}

TEST_CASE("beamdyn: an offset of the mass centre is where the 6 x 6 mass has it", "[analytic]") {
    const test::Folder folder;
    const double m = 10, xc = 0.02, yc = 0.1;  // downwind, trailing edge
    SectionMatrices s = in_beamdyn_axes(section(1));
    s.mass << m, 0, 0, 0, 0, -m * yc,                     //
        0, m, 0, 0, 0, m * xc,                            //
        0, 0, m, m * yc, -m * xc, 0,                      //
        0, 0, m * yc, 2 + m * yc * yc, -m * xc * yc, 0,   //
        0, 0, -m * xc, -m * xc * yc, 1 + m * xc * xc, 0,  //
        -m * yc, m * xc, 0, 0, 0, 3 + m * (xc * xc + yc * yc);
    write(folder, {{0, 0, 0, 0}, {0, 0, 5, 0}}, {{0, s}, {1, s}});
    const BeamSection read = read_beamdyn(folder / "bd.dat").beam.line.section(1);
    CHECK((read.centre - Vec3(0, -yc, xc)).norm() < 1e-14);
    CHECK((read.J - Mat3(Vec3(3, 1, 2).asDiagonal())).norm() < 1e-13);
}

TEST_CASE("beamdyn: on a curved line stations count arc length and untwisted axes stay upright", "[analytic]") {
    const test::Folder folder;
    // A quarter of a helix-like line that leaves every plane.
    std::vector<KeyPoint> points;
    for (int i = 0; i <= 10; ++i) {
        const double s = i / 10.0;
        points.push_back({-0.8 * s * s, 0.5 * s * s * s, 10 * s, 0});
    }
    const SectionMatrices m = in_beamdyn_axes(section(1));
    write(folder, points, {{0, m}, {1, m}});
    const BeamLine line = read_beamdyn(folder / "bd.dat").beam.line;
    REQUIRE_FALSE(line.is_straight());
    double chords = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        chords +=
            std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y, points[i].z - points[i - 1].z);
    CHECK(line.length > chords);
    CHECK(line.length == Approx(chords).epsilon(1e-3));
    CHECK((line.pose(line.length).p - Vec3(10, -0.5, -0.8)).norm() <
          1e-9);  // prebend upwind, sweep to the trailing edge
    const BeamTable* table = line.section.table();
    REQUIRE(table != nullptr);
    for (std::size_t i = 0; i < table->stations.size(); ++i) {
        const Mat3 R = line.pose(table->stations[i]).R * rot_x(table->beta[i]);
        CHECK(std::abs(R(1, 2)) < 1e-12);  // BeamDyn's x has no component along its root's y
        CHECK(R(2, 2) > 0);
    }
    CHECK(std::abs(table->beta.back()) > 1e-4);  // the carried axes have turned against them
}

TEST_CASE("beamdyn: damping and pitch drive", "[analytic]") {
    const test::ModelFolder model("openfast");
    const BeamDynBlade blade = read_beamdyn(model / "small_BeamDyn.dat");
    // mu: shear x (flap), shear y (edge), extension, bending about x (edge), about y (flap), torsion.
    const std::array<double, 6> expected{1.2e-3, 1.1e-3, 1.0e-3, 1.5e-3, 1.4e-3, 1.3e-3};
    CHECK(blade.beam.damping.time_constants == expected);
    CHECK(blade.pitch.stiffness == 2e6);
    CHECK(blade.pitch.damping == 5e3);
    CHECK(blade.pitch_inertia == 20);
    CHECK(test::has_note(blade.beam.notes, "n_modes, zeta", "not chosen"));
    model.replace("small_BeamDyn_Blade.dat", "             1   damp_type", "             2   damp_type");
    const BeamDynBlade modal = read_beamdyn(model / "small_BeamDyn.dat");
    CHECK(modal.beam.damping.modal.all == std::vector<double>{0.01, 0.02});
}

TEST_CASE("openfast: with CompElast = 2 the blades come from BeamDyn", "[property]") {
    const TurbineFile file = read_openfast(test::data_file("openfast/small_BeamDyn.fst"));
    CHECK_FALSE(file.description.blade.line.is_straight());
    CHECK(file.description.blade.pitch.stiffness == 2e6);
    CHECK(test::has_note(file.notes, "BldFile(1)", "BeamDyn"));
    CHECK(test::has_note(file.notes, "TipRad", "along its reference line"));
    CHECK(test::difference(file.description.blade.line,
                           read_beamdyn(test::data_file("openfast/small_BeamDyn.dat")).beam.line) == 0);
}

TEST_CASE("openfast: blades with BeamDyn files of their own are own_blades", "[property]") {
    const test::ModelFolder model("openfast");
    const auto copy = [&](const char* from, const char* to) { model.write(to, test::bytes_of(model / from)); };
    copy("small_BeamDyn.dat", "other_BeamDyn.dat");
    copy("small_BeamDyn_Blade.dat", "other_Blade.dat");
    model.replace("other_BeamDyn.dat", "small_BeamDyn_Blade.dat", "other_Blade.dat");
    model.replace("other_Blade.dat", "             1   damp_type", "             0   damp_type");
    model.replace("small_BeamDyn.fst", "\"small_BeamDyn.dat\"    BDBldFile(2)",
                  "\"other_BeamDyn.dat\"    BDBldFile(2)");
    const TurbineFile file = read_openfast(model / "small_BeamDyn.fst");
    const TurbineDescription& d = file.description;
    REQUIRE(d.individual_blades.size() == 1);
    const BladeDescription& own = *d.individual_blades.at(2);
    CHECK(test::difference(own.line, read_beamdyn(model / "other_BeamDyn.dat").beam.line) == 0);
    CHECK(own.damping.time_constants == std::array<double, 6>{});
    CHECK_FALSE(d.blade.damping.time_constants == std::array<double, 6>{});
    CHECK(own.cone == d.blade.cone);
    CHECK(own.pitch.stiffness == d.blade.pitch.stiffness);
    CHECK_THAT(d.source, Catch::Matchers::Contains("other_Blade.dat"));
    CHECK_NOTHROW(d.check());
    // Without a pitch drive beside others with one: it is held.
    model.replace("other_BeamDyn.dat", "True   UsePitchAct", "False   UsePitchAct");
    const TurbineDescription held = read_openfast(model / "small_BeamDyn.fst").description;
    CHECK(held.individual_blades.at(2)->pitch.kind == JointSupport::Kind::prescribed);
    CHECK_NOTHROW(held.check());
    // And the other way round.
    model.replace("small_BeamDyn.dat", "True   UsePitchAct", "False   UsePitchAct");
    model.replace("other_BeamDyn.dat", "False   UsePitchAct", "True   UsePitchAct");
    const TurbineFile rigid = read_openfast(model / "small_BeamDyn.fst");
    CHECK(rigid.description.individual_blades.at(2)->pitch.is_rigid());
    CHECK(test::has_note(rigid.notes, "UsePitchAct", "rigid"));
}

TEST_CASE("openfast: the BeamDyn file of a blade that is not there is not read", "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ElastoDyn.dat", " 3   NumBl", " 2   NumBl");
    model.replace("small_BeamDyn.fst", "\"small_BeamDyn.dat\"    BDBldFile(3)", "\"unused\"    BDBldFile(3)");
    const TurbineFile file = read_openfast(model / "small_BeamDyn.fst");
    CHECK(file.description.individual_blades.empty());
    CHECK(test::has_note(file.notes, "BDBldFile(3)", "does not have"));
}

TEST_CASE("beamdyn: files that do not describe a blade are refused with the line", "[property]") {
    const auto message = [](const char* file, const char* old_text, const char* new_text) {
        const test::ModelFolder model("openfast");
        model.replace(file, old_text, new_text);
        return message_of([&] { (void)read_beamdyn(model / "small_BeamDyn.dat"); });
    };
    const auto main = [&](const char* a, const char* b) { return message("small_BeamDyn.dat", a, b); };
    CHECK_THAT(main("             5   kp_total", "             6   kp_total"),
               Contains("row 6 of 6 of the table of kp_xr"));
    CHECK_THAT(main("5.0000      4.0000", "2.0000      4.0000"), Contains("kp_zr = 2 after 2.5; allowed: larger"));
    CHECK_THAT(main("0.0000      0.0000      0.0000", "0.1000      0.0000      0.0000"), Contains("first key point"));
    CHECK(main("0.0000      0.0000      0.0000", "0.0000      0.0000     -8.1E-28") == "nothing was thrown");
    const auto blade = [&](const char* a, const char* b) { return message("small_BeamDyn_Blade.dat", a, b); };
    CHECK_THAT(blade("             3   station_total", "             4   station_total"),
               Contains("station 4 of 4, place"));
    CHECK_THAT(blade("             3   station_total", "             2   station_total"),
               Contains("place = 0.4; allowed"));
    CHECK_THAT(blade("  0.4000", "  1.4000"), Contains("station 3 of 3, place = 1; allowed"));
    CHECK_THAT(blade("  6.00000E+07   0.00000E+00", " -6.00000E+07   0.00000E+00"),
               Contains("small_BeamDyn_Blade.dat:14: station 1 of 3: 6 x 6 stiffness"));
    CHECK_THAT(blade(" 1.0E-03 1.1E-03", " 1.1E-03"), Contains("mu1 ... mu6: 6 numbers expected, found 5"));
}
