// Campbell diagram of the 600 kW three-blade machine.
//
// Problem: at every rotor speed the machine of Zhao, Maisser and Wu, Renewable Energy 32 (2007) 532-546, is brought to
// its steady state and linearised, M x'' + (C + G) x' + K x = 0; the multi-blade transformation makes the equations
// constant, their eigenvalues are the natural frequencies and damping ratios in the fixed frame.
// Reference: the values with 3 elements per blade and tower in docs/wt600.md, those of --paper.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/campbell_program.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/campbell_data/difference.hpp"
#include "turbines/model/generator_slip.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

#include <array>
#include <filesystem>
#include <iostream>

using namespace cardan;

namespace {

struct Arguments {
    std::string rpm = "0:40:1";
    std::string out = "wt600_campbell";
    std::string data;
    std::string generator = "free";
    double generator_torque = 0;  // N m, where its slip is linearised
    turbines::AssemblyOptions assembly;
    bool undamped = false, frozen = false, modes = false, summary = false;
    bool gravity = false, shaft_beam = false, floquet = false, paper = false;
    double max_frequency = 16;
};

void set_assembly(Arguments& a, bool with_limit) {
    if (a.paper) a.assembly = turbines::wt600_paper_assembly();
    if (with_limit) a.assembly.mesh.max_hz = a.max_frequency;
    if (a.undamped) a.assembly.structural_damping = a.assembly.joint_damping = false;
    if (a.gravity) a.assembly.gravity = {0, 0, -units::standard_gravity};
    if (a.shaft_beam) a.assembly.shaft_beam = turbines::ShaftBeam{2e8};
}

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Campbell diagram of the 600 kW three-blade machine (Zhao, Maisser, Wu 2007).\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png, PREFIX_tower_yaw_tilt.png and "
        "PREFIX_flap_edge.png, and prints a table.");
    app.add_option("--rpm", a.rpm, text("rotor speeds, ", program::rpm_format));
    const program::Option blade = app.add_option("--blade-elements", a.assembly.blade_elements,
                                                 "beam elements per blade (default: as many as it takes)"),
                          tower = app.add_option("--tower-elements", a.assembly.tower_elements,
                                                 "beam elements of the tower (default: as many as it takes)");
    app.add_flag("--paper", a.paper,
                 "with the elements of the comparison with the paper: three per blade and tower, second flap 4.5 % low")
        .excludes(blade)
        .excludes(tower);
    app.add_option("--out", a.out, "prefix of the files");
    app.add_option("--data", a.data, "folder with wt600_blade.csv and wt600_turbine.csv (default: built in)");
    const program::Option limit = app.add_option("--max-frequency", a.max_frequency,
                                                 "follow modes up to this frequency, Hz; if it is given, the elements "
                                                 "are chosen for it (by default for those up "
                                                 "to the second flap)");
    app.add_flag("--undamped", a.undamped, "leave out all damping");
    app.add_option("--generator", a.generator,
                   "free: no torque; slip: the data set's induction machine, linearised; locked: its speed prescribed")
        .one_of({"free", "slip", "locked"});
    app.add_option("--generator-torque", a.generator_torque,
                   "of the induction machine where its slip is linearised, N m");
    const program::Option frozen =
        app.add_flag("--frozen-azimuth", a.frozen,
                     "eigenvalues at one azimuth (no motions of the machine), for comparison with the paper");
    app.add_flag("--floquet", a.floquet,
                 "by Floquet's theory about the periodic steady state, beside the mean of the multi-blade system over "
                 "the azimuth (PREFIX_averaged.csv, PREFIX_difference.svg, .png)")
        .excludes(frozen);
    app.add_flag("--gravity", a.gravity,
                 "with gravity (in rotation the steady state is periodic: with --floquet only)");
    app.add_flag("--shaft-beam", a.shaft_beam,
                 "main shaft as one beam element (EI 2e8 N m^2) instead of a torsion spring");
    app.add_flag("--modes", a.modes,
                 "also draw mode shapes at the first and last rotor speed (PREFIX_modes/*.svg, *.png)");
    app.add_flag("--summary", a.summary, "print bodies, coordinates and masses first");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    set_assembly(a, limit.given());
    return -1;
}

turbines::Turbine with_generator(const turbines::Turbine& turbine, const Arguments& a) {
    if (a.generator == "slip")
        return turbines::with_generator_slip(
            turbine, a.data.empty() ? turbines::wt600_kloss_curve() : turbines::wt600_kloss_curve(a.data),
            a.generator_torque);
    if (a.generator_torque != 0)
        throw InputError("--generator-torque", "value [N m]", a.generator_torque, "0, or --generator slip");
    return turbine;
}

// The arrangement of the paper's Figs. 8 and 9.
void draw_panels(const solvers::Campbell& machine, const solvers::Campbell& blade, const std::string& out) {
    using program::panel;
    solvers::plot_panels(machine, out + "_tower_yaw_tilt.png",
                         {panel({"tower side-side"}, "tower, lateral (side-side)", 0, 6),
                          panel({"tower fore-aft"}, "tower, longitudinal (fore-aft)", 0, 6),
                          panel({"rotor yaw"}, "rotor yaw", 0, 2.5), panel({"rotor tilt"}, "rotor tilt", 0, 2.5)});
    std::vector<solvers::CampbellPlotOptions> blades{
        panel({"blade flap"}, "first flap", 1, 4), panel({"blade flap"}, "second flap", 2, 8),
        panel({"blade edge"}, "first lag (edge)", 1, 10), panel({"blade edge"}, "second lag (edge)", 2, 18)};
    for (auto& p : blades) p.isolated_blade = &blade;
    solvers::plot_panels(machine, out + "_flap_edge.png", blades);
}

// The mean of the multi-blade system over the azimuth about the same steady states.
// @return what was written
std::string compare(const turbines::Turbine& turbine, const solvers::Campbell& diagram,
                    solvers::CampbellOptions options, const std::string& out) {
    options.method = solvers::CampbellMethod::averaged;
    options.progress = {};
    options.keep_shapes = false;
    const solvers::Campbell averaged =
        solvers::campbell(turbine.system(), turbine.rotor(), diagram.rotor_speeds(), options);
    std::cout << "\n" << solvers::difference_table(diagram, averaged) << std::flush;
    solvers::write_csv(averaged, out + "_averaged.csv");
    if (solvers::differences(diagram, averaged).empty()) return ", _averaged.csv";
    for (const char* kind : {".svg", ".png"}) solvers::plot_differences(diagram, averaged, out + "_difference" + kind);
    return ", _averaged.csv, _difference.svg, .png";
}

int run(const Arguments& a) {
    const std::vector<double> speeds = program::rotor_speeds(a.rpm);
    if (a.gravity && !a.floquet && speeds.back() > 0)
        throw InputError("--gravity", "rotor speed [rev/min]", speeds.back() * units::to_rpm,
                         "0, or --floquet: in rotation there is a periodic steady state only");
    std::string files = text(a.out, ".h5, .csv, .svg, .png");
    const turbines::TurbineDescription description =
        a.data.empty() ? turbines::wt600_description() : turbines::wt600_description(std::filesystem::path(a.data));
    const turbines::Turbine turbine = with_generator(turbines::assemble(description, a.assembly), a);
    program::introduce(turbine, a.summary);

    solvers::CampbellOptions options = program::campbell_options(a.max_frequency);
    options.method = a.frozen    ? solvers::CampbellMethod::frozen_azimuth
                     : a.floquet ? solvers::CampbellMethod::floquet
                                 : solvers::CampbellMethod::coleman;
    options.spin = a.generator == "locked" ? solvers::RotorSpin::prescribed : solvers::RotorSpin::free;
    program::check_outputs(a.out, {".h5", ".csv", ".svg", ".png", "_tower_yaw_tilt.png", "_flap_edge.png"});
    if (a.floquet) program::check_outputs(a.out, {"_averaged.csv", "_difference.svg", "_difference.png"});
    solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    diagram.accuracy = turbines::in_words(turbine.mesh());
    if (a.paper) diagram.remark += text(diagram.remark.empty() ? "" : "; ", "elements of the paper");
    program::stop_at_once();
    program::print_table(diagram);
    if (diagram.points.empty()) return 130;
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = std::min(a.max_frequency, 10.0);  // the panels show the rest
    if (!diagram.remark.empty()) picture.title = text(diagram.machine, ", ", diagram.remark);
    program::write_files(diagram, a.out, picture);
    if (diagram.complete && speeds.size() > 1) {
        solvers::CampbellOptions blade_options = options;
        blade_options.progress = {};
        const turbines::Turbine blade =
            turbines::isolated_blade(description, turbines::with_elements(a.assembly, turbine.mesh()));
        draw_panels(diagram, solvers::campbell(blade.system(), blade.rotor(), speeds, blade_options), a.out);
        files += ", _tower_yaw_tilt.png, _flap_edge.png";
    }
    if (a.floquet && diagram.complete) files += compare(turbine, diagram, options, a.out);
    // Mode shapes at the first and the last rotor speed (the paper's Figs. 4-7).
    if (a.modes && diagram.complete) {
        program::draw_modes(diagram, a.out + "_modes");
        files += text("; mode shapes in ", a.out, "_modes/");
    }
    std::cout << "\nfiles: " << files << "\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_campbell", argc, argv, parse, run);
}
