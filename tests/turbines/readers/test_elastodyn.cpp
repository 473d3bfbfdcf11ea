// ElastoDyn files: numbers, signs, frames, factors, notes.
#include "elements/sections/beam_line.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/readers/elastodyn.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <array>

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::message_of;

namespace {

using units::degree;

// The table of the NREL 5 MW blade in the layout of FAST 7.
std::string fast7_blade() {
    const CsvTable t = CsvTable::parse(embedded_data("nrel5mw_blade.csv"), "nrel5mw_blade.csv");
    const std::vector<const char*> columns{"span_fraction",
                                           "structural_twist",
                                           "mass_per_length",
                                           "flap_stiffness",
                                           "edge_stiffness",
                                           "torsion_stiffness_GJ",
                                           "axial_stiffness_EA",
                                           "flap_mass_inertia_per_length",
                                           "edge_mass_inertia_per_length",
                                           "edge_cg_offset"};
    std::string all = text("--- blade\nNREL 5 MW\n ", t.rows(),
                           " NBlInpSt\n 0.477465 BldFlDmp(1)\n 0.477465 BldFlDmp(2)\n 0.477465 BldEdDmp(1)\n"
                           " 1 FlStTunr(1)\n 1 FlStTunr(2)\n 1.04536 AdjBlMs\n 1 AdjFlSt\n 1 AdjEdSt\n"
                           "BlFract StrcTwst BMassDen FlpStff EdgStff GJStff EAStff FlpIner EdgIner EdgcgOf\n(-)\n");
    for (std::size_t i = 0; i < t.rows(); ++i) {
        for (const char* name : columns) all += text(" ", t.column(name)[i]);
        all += "\n";
    }
    return all;
}

double trapezoid(const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0;
    for (std::size_t i = 1; i < x.size(); ++i) sum += (x[i] - x[i - 1]) * (y[i] + y[i - 1]) / 2;
    return sum;
}

AssemblyOptions bending_only() {
    CardanBeamOptions beam;
    beam.elements = 3;
    beam.torsion = false;
    AssemblyOptions options;
    options.blade_beam = options.tower_beam = beam;
    return options;
}

}  // namespace

TEST_CASE("elastodyn: a blade file with the data of the NREL 5 MW machine is the built-in blade", "[crosscheck]") {
    const test::Folder folder;
    std::ofstream(folder / "blade.dat") << fast7_blade();
    const ElastoDynBeam read = elastodyn_blade(folder / "blade.dat", 61.5);
    const Nrel5mwBlade built_in = nrel5mw_blade();
    // Stations as fractions of the length there, as radii here: rounding.
    CHECK(test::difference(read.line, built_in.line) < 1e-11);
    CHECK(read.damping.modal.bending_y == std::vector<double>{0.00477465, 0.00477465});
    CHECK(read.damping.modal.bending_z == std::vector<double>{0.00477465});
    REQUIRE(read.notes.size() == 1);
    CHECK_THAT(to_text(read.notes[0]), Contains("GJStff, EAStff, FlpIner, EdgIner, EdgcgOf: columns of FAST 7"));
}

TEST_CASE("elastodyn: figures of the main file in the frames and units of the library", "[analytic]") {
    const TurbineFile file = read_elastodyn(test::data_file("openfast/small_ElastoDyn.dat"));
    const TurbineDescription& d = file.description;
    CHECK(d.name == "Fictitious 100 kW machine for tests; no figure belongs to a machine that was built");
    CHECK(d.blades == 3);
    CHECK(d.nacelle.tilt == Approx(4 * degree).epsilon(1e-15));  // ShftTilt = -4: upwind end up
    CHECK(d.nacelle.overhang == 2.0);                            // OverHang = -2: upwind
    CHECK(d.blade.cone == Approx(-2 * degree).epsilon(1e-15));   // PreCone = -2: tips upwind
    CHECK(file.pitch == Approx(1.5 * degree).epsilon(1e-15));
    CHECK(file.rotor_speed == Approx(4.71238898).epsilon(1e-9));  // 45 rpm
    CHECK(d.nacelle.shaft_height == 0.9);
    CHECK(d.hub.radius == 0.5);
    // The bearing's 150 kg at the tower top with the nacelle's 4500 kg.
    CHECK(d.nacelle.inertia.mass == 4650);
    CHECK(d.nacelle.inertia.com.isApprox(Vec3(0.2, 0.05, 0.6) * 4500 / 4650, 1e-14));
    // About the yaw axis the bearing adds nothing: NacYIner is what stays.
    const RigidInertia& n = d.nacelle.inertia;
    CHECK(n.J(2, 2) + n.mass * n.com.head<2>().squaredNorm() == Approx(9000).epsilon(1e-13));
    CHECK(d.hub.inertia.mass == 1200);
    CHECK(d.hub.inertia.com.isApprox(Vec3(0, 0, 0.1)));  // downwind of the apex
    CHECK(d.hub.inertia.J.isApprox(Mat3(Vec3(0, 0, 300).asDiagonal())));
    CHECK(d.drive_train.gear_ratio == 25);
    CHECK(d.drive_train.generator_inertia == 4);
    CHECK(d.drive_train.main_shaft.stiffness == 5e6);
    CHECK(d.drive_train.main_shaft.damping == 1e4);
    for (const JointSupport* rigid : {&d.yaw.rotation, &d.yaw.translation, &d.nacelle.tilt_bearing, &d.blade.pitch,
                                      &d.drive_train.high_speed_shaft})
        CHECK(rigid->is_rigid());
}

TEST_CASE("elastodyn: factors multiply the distributed properties; twist is against the angle of the section",
          "[analytic]") {
    const TurbineFile file = read_elastodyn(test::data_file("openfast/small_ElastoDyn.dat"));
    const BeamTable* blade = file.description.blade.line.section.table();
    REQUIRE(blade != nullptr);
    CHECK(blade->stations == std::vector<double>{0, 0.5, 2, 5, 8, 10});
    const EngineeringSection& s = blade->sections[2];  // 40 kg/m, 1.5e7, 2.8e7 N m^2, 10 degrees
    CHECK(s.mass == Approx(1.05 * 40).epsilon(1e-15));
    CHECK(s.EI_flap == Approx(0.95 * 1.5e7).epsilon(1e-15));
    CHECK(s.EI_edge == Approx(1.1 * 2.8e7).epsilon(1e-15));
    CHECK(s.beta == Approx(-10 * degree).epsilon(1e-15));
    CHECK(std::isinf(s.GJ));
    CHECK(std::isinf(s.EA));
    const BeamTable* tower = file.description.tower.line.section.table();
    REQUIRE(tower != nullptr);
    CHECK(tower->stations == std::vector<double>{0, 0.4 * 24, 0.7 * 24, 24});
    // Beam axes of the tower: y downwind; fore-aft is bending about z.
    const BeamSection top = file.description.tower.line.section(24);
    CHECK(1 / top.compliance(5, 5) == Approx(0.98 * 8e8).epsilon(1e-13));
    CHECK(1 / top.compliance(4, 4) == Approx(0.97 * 8.24e8).epsilon(1e-13));
    CHECK(top.mass == Approx(1.01 * 300).epsilon(1e-15));
    const BeamDamping &b = file.description.blade.damping, &t = file.description.tower.damping;
    CHECK(b.modal.bending_y == std::vector<double>{0.5 / 100, 0.7 / 100});
    CHECK(b.modal.bending_z == std::vector<double>{0.6 / 100});
    CHECK(t.modal.bending_z == std::vector<double>{1.0 / 100, 1.1 / 100});
    CHECK(t.modal.bending_y == std::vector<double>{1.2 / 100, 1.3 / 100});
}

TEST_CASE("elastodyn: the machine has the masses of the files, summed by hand", "[analytic]") {
    const TurbineFile file = read_elastodyn(test::data_file("openfast/small_ElastoDyn.dat"));
    const Turbine turbine = assemble(file.description, bending_only());
    const double blade = 1.05 * trapezoid({0, 0.5, 2, 5, 8, 10}, {60, 55, 40, 28, 16, 8});
    const double tower = 1.01 * trapezoid({0, 9.6, 16.8, 24}, {500, 420, 360, 300});
    CHECK(turbine.layout().blades[1].mass == Approx(blade).epsilon(1e-12));
    REQUIRE(turbine.layout().tower);
    CHECK(turbine.layout().tower->mass == Approx(tower).epsilon(1e-12));
    CHECK_THAT(turbine.summary(), Contains("nacelle"));
}

TEST_CASE("elastodyn: angles and ratios that machines do not have are taken as they are, and noted", "[property]") {
    CHECK_FALSE(read_elastodyn(test::data_file("openfast/small_ElastoDyn.dat")).description.unusual);
    const auto read = [](const char* old_text, const char* new_text) {
        const test::ModelFolder model("openfast");
        model.replace("small_ElastoDyn.dat", old_text, new_text);
        return read_openfast(model / "small.fst");
    };
    const TurbineFile tilt = read("          -4.0   ShftTilt", "         -25.0   ShftTilt");
    CHECK(tilt.description.unusual);
    CHECK(test::has_note(tilt.notes, unusual_entries, "nacelle.tilt [rad] = 0.43"));
    CHECK_NOTHROW(tilt.description.check());
    const TurbineFile cone = read("          -2.0   PreCone(3)", "         -40.0   PreCone(3)");
    CHECK(cone.description.unusual);
    CHECK(test::has_note(cone.notes, unusual_entries, "own_blades[3].cone [rad] = -0.698"));
}

TEST_CASE("elastodyn: inertia of pitch bearings and of blades about their axes is that of the pitch", "[property]") {
    const test::ModelFolder model("openfast");
    for (const auto& [keyword, value] :
         {std::pair("PBrIner(1)", " 200"), {"PBrIner(2)", " 300"}, {"BlPIner(1)", "5000"}})
        model.replace("small_ElastoDyn.dat", std::string("             0   ") + keyword,
                      text("          ", value, "   ", keyword));
    const TurbineFile file = read_openfast(model / "small_ElastoDyn.dat");
    CHECK(file.description.blade.pitch_inertia == 5200);
    CHECK(file.description.individual_blades.at(2)->pitch_inertia == 300);
    CHECK(file.description.individual_blades.at(3)->pitch_inertia == 0);
    // As an armature of the pitch coordinate, where there is one.
    TurbineDescription d = file.description;
    d.tower.rigid = true;
    AssemblyOptions options;
    options.blade_beam.emplace().torsion = false;
    const auto armatures = [&] { return assemble(d, options).tree().armatures().size(); };
    const std::size_t rigid = armatures();
    d.blade.pitch = prescribed_joint;
    for (auto& [number, blade] : d.individual_blades) blade->pitch = prescribed_joint;
    CHECK(armatures() == rigid + 2);
    // BeamDyn's sections have inertia about their axis, and its pitch drive may have its own.
    CHECK(read_openfast(model / "small_BeamDyn.fst").description.blade.pitch_inertia == 20);
    model.replace("small_BeamDyn.dat", " True   UsePitchAct", "False   UsePitchAct");
    const TurbineFile no_drive = read_openfast(model / "small_BeamDyn.fst");
    CHECK(no_drive.description.blade.pitch_inertia == 200);
    CHECK(test::has_note(no_drive.notes, "BlPIner(1)", "BeamDyn's sections"));
    model.replace("small_ElastoDyn.dat", "  200   PBrIner(1)", " -200   PBrIner(1)");
    CHECK_THROWS_WITH(read_openfast(model / "small_ElastoDyn.dat"),
                      Catch::Contains("PBrIner(1) = -200; allowed: >= 0"));
}

TEST_CASE("elastodyn: everything that is not in the description is noted, with file, line and value", "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ElastoDyn.dat", "             0   NacYaw", "            15   NacYaw");
    model.replace("small_ElastoDyn.dat", "             0   TipMass(2)", "            12   TipMass(2)");
    model.replace("small_ElastoDyn.dat", "          -2.0   PreCone(3)", "          -2.5   PreCone(3)");
    model.replace("small_ElastoDyn.dat", "             0   PtfmMass", "          5000   PtfmMass");
    model.replace("small_ElastoDyn.dat", "           100   GBoxEff", "            95   GBoxEff");
    const TurbineFile file = read_openfast(model / "small_ElastoDyn.dat");
    const auto noted = [&](const char* keyword, const char* why) { return test::has_note(file.notes, keyword, why); };
    CHECK(noted("NacYaw", "into the wind"));
    CHECK(file.description.individual_blades.at(3)->cone == Approx(-2.5 * degree).epsilon(1e-15));
    CHECK(file.description.individual_blades.at(2)->tip_mass == 12);
    CHECK(file.description.blade.tip_mass == 0);
    CHECK(noted("PtfmMass", "platform"));
    CHECK(noted("GBoxEff", "losses"));
    CHECK(noted("TwSSDOF2", "one mode cannot be switched off"));
    CHECK(noted("YawDOF", "rigid without"));
    CHECK(noted("YawBrMass", "part of the nacelle"));
    CHECK(noted("FlStTunr(2)", "stiffness of one mode"));
    CHECK(noted("BldFl1Sh(2), BldFl1Sh(3)", "mode shapes"));
    CHECK(noted("Echo, Method, DT", "numerical settings"));
    CHECK(noted("PitchAxis", "columns"));
    for (const FileNote& note : file.notes) {
        CAPTURE(to_text(note));
        CHECK(note.why.find("not known") == std::string::npos);
        if (note.keyword == "NacYaw") CHECK_THAT(to_text(note), Contains("small_ElastoDyn.dat:34: NacYaw = 15: "));
    }
}

TEST_CASE("elastodyn: degrees of freedom switched off in the file are taken from the machine", "[property]") {
    const auto changed = [](std::initializer_list<const char*> off, const char* main = "small_ElastoDyn.dat") {
        const test::ModelFolder model("openfast");
        for (const char* keyword : off)
            model.replace("small_ElastoDyn.dat", text("          True   ", keyword, " "),
                          text("         False   ", keyword, " "));
        return read_openfast(model / main);
    };
    const TurbineFile as_it_is = changed({}, "small.fst");
    CHECK(dofs_of(as_it_is.description).generator);
    CHECK(dofs_of(as_it_is.description).tower_fore_aft);
    CHECK(dofs_of(as_it_is.description).tower_side_side);  // one of two
    CHECK(dofs_of(as_it_is.description).blades);
    CHECK(as_it_is.yaw_drive.stiffness == 2e7);
    const TurbineFile locked = changed({"GenDOF"});
    CHECK(!dofs_of(locked.description).generator);
    CHECK(locked.description.drive_train.spin == CoordinateRole::prescribed);
    CHECK(as_it_is.description.drive_train.spin == CoordinateRole::free);
    CHECK(changed({"DrTrDOF"}).description.drive_train.main_shaft.is_rigid());
    const TurbineFile yaw = changed({"YawDOF"}, "small.fst");
    CHECK(yaw.description.yaw.rotation.is_rigid());
    CHECK(yaw.yaw_drive.stiffness == 2e7);  // for who wants it free
    const TurbineFile one = changed({"TwFADOF2"});
    CHECK(dofs_of(one.description).tower_fore_aft);
    CHECK(test::has_note(one.notes, "TwFADOF2", "one mode cannot be switched off"));
    const TurbineFile fore_aft = changed({"TwFADOF1", "TwFADOF2"});
    CHECK(!dofs_of(fore_aft.description).tower_fore_aft);
    CHECK(dofs_of(fore_aft.description).tower_side_side);
    CHECK(!test::has_note(fore_aft.notes, "TwFADOF", ""));
    CHECK(!fore_aft.description.tower.rigid);
    CHECK(fore_aft.description.tower.locked_fore_aft);
    CHECK(!fore_aft.description.tower.locked_side_side);
    const TurbineFile stiff = changed({"TwFADOF1", "TwFADOF2", "TwSSDOF1"});
    CHECK(stiff.description.tower.rigid);
    AssemblyOptions options;
    options.blade_beam.emplace().torsion = false;
    const Turbine turbine = assemble(stiff.description, options);
    CHECK(turbine.system().model.coordinates().of_part("tower").empty());
    CHECK(!dofs_of(changed({"TwSSDOF1"}).description).tower_side_side);
    CHECK(dofs_of(changed({"FlapDOF1", "FlapDOF2"}).description).blades);
    CHECK(!changed({"FlapDOF1", "FlapDOF2"}).description.blade.rigid);
    CHECK(!dofs_of(changed({"FlapDOF1", "FlapDOF2", "EdgeDOF"}).description).blades);
    CHECK(changed({"FlapDOF1", "FlapDOF2", "EdgeDOF"}).description.blade.rigid);
}

TEST_CASE("elastodyn: a tower of one station has the same section everywhere", "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small_Tower.dat", "4   NTwInpSt", "1   NTwInpSt");
    for (const char* row :
         {"  0.400     420.000   1.5000E+09   1.5450E+09\n", "  0.700     360.000   1.1000E+09   1.1330E+09\n",
          "  1.000     300.000   8.0000E+08   8.2400E+08\n"})
        model.replace("small_Tower.dat", row, "");
    const BeamLine tower = read_elastodyn(model / "small_ElastoDyn.dat").description.tower.line;
    for (double x : {0.0, 11.0, 24.0}) {
        CHECK(tower.section(x).mass == Approx(1.01 * 500));
        CHECK(1 / tower.section(x).compliance(5, 5) == Approx(0.98 * 2e9));
    }
}

TEST_CASE("beams that are held in bending: the machine moves as with an infinitely stiff one", "[crosscheck]") {
    const TurbineFile file = read_elastodyn(test::data_file("openfast/small_ElastoDyn.dat"));
    AssemblyOptions options = bending_only();
    const auto frequencies = [](const Turbine& machine) {
        solvers::CampbellOptions sweep;
        sweep.spin = solvers::RotorSpin::prescribed;
        sweep.keep_shapes = false;
        const std::array speed{45 * units::rpm};
        std::vector<double> all;
        const solvers::Campbell d = solvers::campbell(machine.system(), machine.rotor(), speed, sweep);
        for (const solvers::CampbellMode& m : d.points[0].modes) all.push_back(m.mode.natural_hz());
        return all;
    };
    // Rows and columns of the compliance that stand for bending about y or z, a ten-thousandth as flexible.
    const auto stiff = [](BeamLine line, bool y, bool z) {
        line.section = [own = line.section, y, z](double x) {
            BeamSection s = own(x);
            Vec6 scale = Vec6::Ones();
            if (y) scale(4) = 0.01;
            if (z) scale(5) = 0.01;
            s.compliance = (scale.asDiagonal() * s.compliance * scale.asDiagonal()).eval();
            return s;
        };
        return line;
    };
    const auto compare = [&](const TurbineDescription& stiffened) {
        AssemblyOptions free = options;
        for (auto* b : {&*free.tower_beam, &*free.blade_beam}) b->locked_y = b->locked_z = false;
        const std::vector<double> held = frequencies(assemble(file.description, options)),
                                  expected = frequencies(assemble(stiffened, free));
        REQUIRE(held.size() >= 4);
        for (std::size_t i = 0; i < 4; ++i) CHECK(held[i] == Approx(expected.at(i)).epsilon(5e-4));
    };
    TurbineDescription d = file.description;
    options.tower_beam->locked_z = true;  // fore-aft
    d.tower.line = stiff(file.description.tower.line, false, true);
    compare(d);
    options.tower_beam->locked_y = true;
    d.tower.line = stiff(file.description.tower.line, true, true);
    compare(d);
    options.tower_beam->locked_y = options.tower_beam->locked_z = false;
    options.blade_beam->locked_y = options.blade_beam->locked_z = true;
    d = file.description;
    d.blade.line = stiff(file.description.blade.line, true, true);
    compare(d);
}

TEST_CASE("openfast: the main file leads to the others, and ServoDyn's spring holds the yaw joint", "[property]") {
    const TurbineFile file = read_openfast(test::data_file("openfast/small.fst"));
    CHECK(file.description.yaw.rotation.stiffness == 2e7);
    CHECK(file.description.yaw.rotation.damping == 3e4);
    CHECK(file.rotor_speed == Approx(46 * units::rpm).epsilon(1e-14));  // 1150 rpm of the generator over 25
    CHECK(file.gravity == 9.80665);
    CHECK(test::has_note(file.notes, "AbortLevel", "without meaning"));
    CHECK(test::has_note(file.notes, "YCMode", "control"));
    CHECK(file.controller.generator_efficiency == Approx(0.95).epsilon(1e-15));
    CHECK(!test::has_note(file.notes, "CompAero", "not in the file"));
    const test::ModelFolder model("openfast");
    model.replace("small.fst", "             0   CompAero     - (switch)\n", "");
    CHECK(test::has_note(read_openfast(model / "small.fst").notes, "CompAero", "a run has no air"));
    std::filesystem::remove(model / "small_ServoDyn.dat");
    const TurbineFile without = read_openfast(model / "small.fst");
    CHECK(without.description.yaw.rotation.is_rigid());
    CHECK(test::has_note(without.notes, "ServoFile", "not read"));
    model.replace("small.fst", "   CompElast", "5   CompElast");
    CHECK_THAT(message_of([&] { (void)read_openfast(model / "small.fst"); }),
               Contains("CompElast = 15; allowed: 1 ... 2"));
}

TEST_CASE("elastodyn: numbers that do not describe a machine are refused with the line", "[property]") {
    const auto message = [](const char* file, const char* old_text, const char* new_text) {
        const test::ModelFolder model("openfast");
        model.replace(file, old_text, new_text);
        return message_of([&] { (void)read_openfast(model / "small.fst"); });
    };
    const auto main = [&](const char* a, const char* b) { return message("small_ElastoDyn.dat", a, b); };
    CHECK_THAT(main("10.5   TipRad", " 0.4   TipRad"), Contains("TipRad = 0.4; allowed: above HubRad = 0.5"));
    CHECK_THAT(main("24.0   TowerHt", "-1.0   TowerHt"),
               Contains("TowerHt = -1; allowed: above the tower's foot, 0 (TowerBsHt)"));
    CHECK_THAT(main("9.0E+03   NacYIner", "1.0E+01   NacYIner"), Contains("NacYIner = 10; allowed: at least 191.25"));
    CHECK_THAT(main("   1200   HubMass", "  -1200   HubMass"), Contains("HubMass = -1200; allowed: >= 0"));
    CHECK_THAT(main("     25   GBRatio", "      0   GBRatio"), Contains("GBRatio = 0; allowed: > 0"));
    CHECK_THAT(main("      3   NumBl", "      4   NumBl"), Contains("NumBl = 4; allowed: 1 ... 3"));
    CHECK_THAT(main("      3   NumBl", "    2.5   NumBl"), Contains("NumBl = 2.5; allowed: a whole number, 1 ... 3"));
    CHECK_THAT(main("5.0E+06   DTTorSpr", "0.0E+06   DTTorSpr"), Contains("DTTorSpr = 0; allowed: > 0"));
    CHECK_THAT(main("   -4.0   ShftTilt", " -400.0   ShftTilt"),
               Contains("ShftTilt = -400; allowed: -45 ... 45 degrees"));
    CHECK_THAT(main("small_Blade.dat", "no_such.dat"), Contains("small_ElastoDyn.dat:96: BldFile(1): "));
    const auto blade = [&](const char* a, const char* b) { return message("small_Blade.dat", a, b); };
    CHECK_THAT(blade("  0.200", "  0.020"), Contains("small_Blade.dat:19: BlFract = 0.02 after 0.05; allowed: larger"));
    CHECK_THAT(blade("  1.000     0.25", "  0.900     0.25"), Contains("BlFract = 0.9 in the last row; allowed: 1"));
    CHECK_THAT(blade("4.0000E+06", "-4.000E+06"), Contains("small_Blade.dat:20: FlpStff = -3800000; allowed: > 0"));
    CHECK_THAT(blade("  0.7   BldFlDmp(2)", " -0.7   BldFlDmp(2)"), Contains("BldFlDmp(2) = -0.7; allowed: >= 0"));
    CHECK_THAT(blade("     6   NBlInpSt", "     5   NBlInpSt"),
               Contains("small_Blade.dat:22: one more row than the 5"));
    CHECK_THAT(message("small_Tower.dat", "   0.97   AdjSSSt", "1e-320   AdjSSSt"),
               Contains("small_Tower.dat:16: ") && Contains("allowed: > 0 (1e-30 ... 1e30)"));
    CHECK_THAT(blade("StrcTwst", "Twist"), Contains("no column 'StrcTwst'; there are: BlFract, PitchAxis, Twist"));
}
