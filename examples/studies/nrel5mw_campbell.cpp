// Campbell diagram of the land-based NREL 5 MW machine.
//
// Problem: at every rotor speed the machine of NREL/TP-500-38060 is brought to its steady state and linearised,
// M x'' + (C + G) x' + K x = 0; the multi-blade transformation makes the equations constant, their eigenvalues are the
// natural frequencies and damping ratios in the fixed frame. With --gravity the steady state is periodic, and the
// diagram is that of the mean of the multi-blade matrices over the azimuth.
//
// Reference: OpenFAST 5.0.0 at these speeds, with ElastoDyn's and with BeamDyn's blades, its yaw bearing locked
// (docs/nrel5mw.md): the same machine is --yaw locked with --variant fast or beamdyn. Found: the differences are those
// of ElastoDyn's shapes and sums, and of BeamDyn's one element of order 5.
#include "examples/studies/nrel5mw_campbell/comparison.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/campbell_program.hpp"
#include "turbines/model/scaling.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

#include <array>
#include <filesystem>
#include <iostream>

using namespace cardan;

namespace {

// Harmonics of the steady state under gravity to begin with; more are taken if needed. The cost rises with their cube.
constexpr int steady_harmonics = 4;
constexpr double tower_max_frequency = 12;  // Hz; first torsion and second bending modes are below

struct Arguments {
    std::string rpm = "0:12:1,12.1,13,14";
    std::string out = "nrel5mw_campbell", variant = "report", names = "community", yaw = "free", data;
    int blade_elements = 8, tower_elements = 6;
    double max_frequency = 4, power = 5, azimuth = 0;
    bool gravity = false, generator_free = false, modes = false, undamped = false, pitch_actuator = false,
         shapes = false, summary = false, tower = false;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Campbell diagram of the NREL 5 MW machine (land-based).\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png and PREFIX_families.png, and prints a table; at 0, 6 and "
        "12.1 rpm beside OpenFAST.");
    app.add_option("--rpm", a.rpm, text("rotor speeds, ", program::rpm_format));
    app.add_option("--variant", a.variant,
                   "data of the report; of FAST's ElastoDyn (no torsion of tower and blades, no offset of mass "
                   "centres); of OpenFAST's BeamDyn blade (no mass factor, no offset, GA = EA / 10)")
        .one_of({"report", "fast", "beamdyn"});
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower");
    const program::Option gravity = app.add_flag(
        "--gravity", a.gravity,
        "under gravity: modes of the mean over the azimuth; the table beside OpenFAST has those without as well");
    app.add_flag("--elastodyn-shapes", a.shapes,
                 "with --gravity, in the table beside OpenFAST: tower limited to ElastoDyn's two shapes per direction, "
                 "with --variant fast also each blade to its three")
        .needs(gravity);
    app.add_option("--azimuth", a.azimuth,
                   "with --gravity, in the table beside OpenFAST: where blade 1 stands at 0 rpm, deg (0: up)")
        .needs(gravity);
    app.add_option(
           "--yaw", a.yaw,
           "yaw bearing: free on the spring and damper of its drive, or locked as in the models of OpenFAST that "
           "the table compares with (YawDOF = False)")
        .one_of({"free", "locked"});
    app.add_flag("--generator-free", a.generator_free, "generator free instead of prescribed").excludes(gravity);
    app.add_flag("--pitch-actuator", a.pitch_actuator, "elastic pitch actuators (the report has them for ADAMS)");
    app.add_option("--power", a.power, "scaled by the rules of similarity to this power, MW");
    app.add_flag("--undamped", a.undamped, "leave out all damping");
    const program::Option highest =
        app.add_option("--max-frequency", a.max_frequency,
                       text("follow modes up to this frequency, Hz; with --tower by default ", tower_max_frequency));
    app.add_option("--names", a.names, "of modes: as reports and tools around OpenFAST print them, or Cardan's own")
        .one_of({"community", "descriptive"});
    app.add_flag("--modes", a.modes,
                 "also draw mode shapes at the first and last rotor speed (PREFIX_modes/*.svg, *.png)");
    app.add_flag("--tower", a.tower,
                 "only print the frequencies of the tower: alone, and with the rest as one rigid body on its top")
        .excludes(gravity);
    app.add_flag("--summary", a.summary, "print bodies, coordinates and masses first");
    app.add_option("--data", a.data,
                   "folder with nrel5mw_blade.csv, nrel5mw_tower.csv and nrel5mw_turbine.csv (default: built in)");
    app.add_option("--out", a.out, "prefix of the files");
    const int code = app.parse(argc, argv);
    if (a.tower && !highest.given()) a.max_frequency = tower_max_frequency;
    return code;
}

turbines::Nrel5mwVariant variant_of(const Arguments& a) {
    using turbines::Nrel5mwVariant;
    for (const Nrel5mwVariant variant : {Nrel5mwVariant::fast, Nrel5mwVariant::beamdyn})
        if (a.variant == turbines::variant_name(variant)) return variant;
    return Nrel5mwVariant::report;
}

solvers::NameStyle style_of(const Arguments& a) {
    return a.names == "community" ? solvers::NameStyle::community : solvers::NameStyle::descriptive;
}

struct Machine {
    turbines::TurbineDescription description;
    turbines::AssemblyOptions options;
};

Machine data_of(const Arguments& a) {
    turbines::Nrel5mwOptions data = turbines::nrel5mw_options(variant_of(a));
    data.pitch_actuator = a.pitch_actuator;
    Machine m{a.data.empty() ? turbines::nrel5mw_description(data)
                             : turbines::nrel5mw_description(std::filesystem::path(a.data), data),
              turbines::nrel5mw_assembly(variant_of(a), a.blade_elements, a.tower_elements)};
    if (a.yaw == "locked") m.description.yaw.rotation = turbines::rigid_joint;
    m.options.structural_damping = m.options.joint_damping = !a.undamped;
    if (a.power != 5) {
        require_positive("--power", "value [MW]", a.power);
        const double s = std::sqrt(a.power / 5);
        m.description = turbines::scaled(m.description, s);
        for (double& end : m.options.blade_beam->boundaries) end *= s;
        m.options.blade_beam->boundaries.back() = m.description.blade.line.length;
    }
    return m;
}

turbines::Turbine machine(const Arguments& a, const Vec3& gravity) {
    Machine m = data_of(a);
    m.options.gravity = gravity;
    return turbines::assemble(m.description, m.options);
}

// Without and with what stands on it, at rest, without and with gravity.
int print_tower(const Arguments& a) {
    Machine m = data_of(a);
    const solvers::NameStyle style = style_of(a);
    for (const bool with_top : {false, true})
        for (const Vec3& gravity : {Vec3(0, 0, 0), turbines::nrel5mw_gravity}) {
            m.options.gravity = gravity;
            const turbines::Turbine tower = turbines::isolated_tower(m.description, m.options, with_top);
            const std::array standstill{0.0};
            const solvers::Campbell diagram =
                solvers::renamed(solvers::campbell(tower.system(), tower.rotor(), standstill,
                                                   program::campbell_options(a.max_frequency)),
                                 style);
            std::cout << (gravity.isZero() ? "without gravity\n" : "under gravity\n");
            program::print_table(diagram);
            std::cout << "\n";
        }
    return 0;
}

// @return what was written
std::string write(const solvers::Campbell& diagram, const Arguments& a) {
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = a.max_frequency;
    if (a.gravity) picture.title = diagram.machine + ", under gravity";
    program::write_files(diagram, a.out, picture);
    std::string files = a.out + ".h5, .csv, .svg, .png";
    if (!diagram.complete) return files;
    if (diagram.points.size() > 1) {
        using program::panel;
        solvers::plot_panels(diagram, a.out + "_families.png",
                             {panel({"tower fore-aft", "tower side-side"}, "tower, first modes", 1, 0.8),
                              panel({"blade flap"}, "first flap", 1, 1.5),
                              panel({"blade edge", "drive-train torsion"}, "first edge, drive-train torsion", 1, 2.5),
                              panel({"blade flap"}, "second flap", 2, 3)});
        files += ", _families.png";
    }
    if (a.modes) {
        program::draw_modes(diagram, a.out + "_modes");
        files += text("; mode shapes in ", a.out, "_modes/");
    }
    return files;
}

// At the rotor speeds of the references, the modes that come nearest to those without gravity.
std::vector<nrel5mw_campbell::UnderGravity> beside_references(const Arguments& a, const turbines::Turbine& heavy,
                                                              const solvers::Campbell& light) {
    using nrel5mw_campbell::Limited;
    const Limited limited = !a.shapes             ? Limited::nothing
                            : a.variant == "fast" ? Limited::tower_and_blades
                                                  : Limited::tower;
    std::vector<nrel5mw_campbell::UnderGravity> all;
    for (const nrel5mw_campbell::OpenFast& reference : nrel5mw_campbell::openfast)
        if (const auto point = nrel5mw_campbell::point_at(light, reference.rpm))
            all.push_back(nrel5mw_campbell::under_gravity(heavy, light, *point, limited, a.azimuth * units::degree));
    return all;
}

int run(const Arguments& a) {
    if (a.tower) return print_tower(a);
    const std::vector<double> speeds = program::rotor_speeds(a.rpm);
    const turbines::Turbine turbine = machine(a, Vec3::Zero());
    program::introduce(turbine, a.summary);

    solvers::CampbellOptions options = program::campbell_options(a.max_frequency);
    options.spin = a.generator_free ? solvers::RotorSpin::free : solvers::RotorSpin::prescribed;
    program::check_outputs(a.out, {".h5", ".csv", ".svg", ".png", "_families.png"});
    const solvers::Campbell light = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    solvers::Campbell diagram = light;
    std::vector<nrel5mw_campbell::UnderGravity> gravity;
    if (a.gravity && light.complete) {
        const turbines::Turbine heavy = machine(a, turbines::nrel5mw_gravity);
        options.method = solvers::CampbellMethod::averaged;
        options.floquet.harmonics = steady_harmonics;
        diagram = solvers::campbell(heavy.system(), heavy.rotor(), speeds, options);
        gravity = beside_references(a, heavy, light);
    }
    program::stop_at_once();
    const solvers::NameStyle style = style_of(a);
    diagram = solvers::renamed(diagram, style);
    program::print_table(diagram);
    if (a.power == 5 && !a.generator_free) nrel5mw_campbell::print_comparison(light, gravity, style, a.yaw == "locked");
    if (!std::cout.flush()) throw FileError("standard output", "the table could not be written");
    if (diagram.points.empty()) return 130;
    std::cout << "\nfiles: " << write(diagram, a) << "\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("nrel5mw_campbell", argc, argv, parse, run);
}
