// Campbell diagram of a machine that exists as an OpenFAST or windIO model, without a line of code.
//
// Problem: the files of the model (OpenFAST's .fst or ElastoDyn file, a windIO .yaml, or our own .yaml) become a
// description of the machine, blades and tower as beams; at every rotor speed it is brought to its steady state and
// linearised, and the multi-blade transformation makes the equations constant. With gravity or an unbalanced hub the
// steady state is periodic and the modes are those of the mean over the azimuth, with two blades they are Floquet's.
// What the files hold beside the structure, and what is taken otherwise than in the program they were made for, is
// printed as notes. Frames, signs, and what is read: docs/coming_from_openfast.md.
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/difference.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/readers/openfast.hpp"
#include "turbines/yaml/description.hpp"
#include "turbines/yaml/windio.hpp"

#include "examples/programs/campbell_program.hpp"
#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <optional>

using namespace cardan;

namespace {

struct Arguments {
    std::string model, rpm, out = "openfast_campbell", save, generator, yaw;
    int blade_elements = 6, tower_elements = 4;
    bool gravity = false, notes = false, undamped = false, summary = false;
    double max_frequency = 5, generator_inertia = 0;
    std::optional<double> pitch;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Campbell diagram of an existing model: OpenFAST (.fst, or an ElastoDyn file), windIO (.yaml), our own .yaml.\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png, and prints a table.");
    app.add_option("model", a.model, "FILE.fst, ElastoDyn.dat or FILE.yaml").required();
    app.add_option("--rpm", a.rpm,
                   "rotor speeds, numbers and FIRST:LAST:STEP separated by commas, rev/min (default: from 0 to 1.2 "
                   "times the model's, in 12 steps)");
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower");
    app.add_option("--max-frequency", a.max_frequency, "follow modes up to this frequency, Hz");
    app.add_option("--pitch", a.pitch, "pitch of the blades, deg, leading edge upwind (default: the model's)");
    const std::vector<std::string> free_or_locked{"free", "locked"};
    app.add_option("--generator", a.generator,
                   "free: the rotor turns freely; locked: at its speed, whatever happens (default: the model's, GenDOF "
                   "of ElastoDyn; else free)")
        .one_of(free_or_locked);
    app.add_option("--yaw", a.yaw,
                   "yaw bearing: free on the spring of the yaw drive, or locked (default: the model's, YawDOF of "
                   "ElastoDyn)")
        .one_of(free_or_locked);
    app.add_option("--generator-inertia", a.generator_inertia,
                   "inertia of the generator on its own shaft, kg m^2, for models that do not give it")
        .hide_default();
    app.add_option("--out", a.out, "prefix of the files");
    app.add_option("--save", a.save, "also write the machine as our own YAML to this file (.yaml)");
    app.add_flag("--gravity", a.gravity, "with gravity");
    app.add_flag("--undamped", a.undamped, "leave out all damping");
    app.add_flag("--notes", a.notes, "print all notes; else those on groups of entries are only counted");
    app.add_flag("--summary", a.summary, "print bodies, coordinates and masses first");
    return app.parse(argc, argv);
}

bool is_yaml(const std::filesystem::path& path) {
    const std::string ending = lower_case(path.extension().string());
    return ending == ".yaml" || ending == ".yml";
}

turbines::TurbineFile read(const std::string& model) {
    const std::filesystem::path path(model);
    if (!is_yaml(path)) return turbines::read_openfast(path);
    if (!turbines::is_description(text_file(path))) return turbines::read_windio(path);
    turbines::TurbineFile own;
    own.description = turbines::read_description(path);
    return own;
}

void print(const std::vector<turbines::FileNote>& notes, bool all) {
    int groups = 0;
    for (const turbines::FileNote& note : notes) {
        const bool group = note.line == 0;
        if (group) ++groups;
        if (all || !group) std::cout << "note: " << to_text(note) << "\n";
    }
    if (!all && groups > 0) std::cout << groups << " more notes, on entries without meaning here: --notes\n";
}

std::vector<double> rotor_speeds(const std::string& given, double rated) {
    if (!given.empty()) return program::rotor_speeds(given);
    if (!(rated > 0))
        throw InputError("--rpm", "value", "none, and the model names no rotor speed", program::rpm_format);
    const double last = 1.2 * rated * units::to_rpm;
    return solvers::rpm_range(0, last, last / 12);
}

// Directions in which the sections are rigid have no coordinate.
CardanBeamOptions beam_options(const BeamLine& line, int elements, bool extension) {
    CardanBeamOptions options;
    options.elements = elements;
    const Mat6 compliance = line.section(line.length / 2).compliance;
    options.torsion = compliance(3, 3) > 0;
    options.extension = extension && compliance(0, 0) > 0;
    return options;
}

// What was asked for in the place of what the files say.
void set_dofs(const Arguments& a, turbines::TurbineFile& model) {
    turbines::Bearing& yaw = model.description.yaw.rotation;
    if (!a.generator.empty()) model.dofs.generator = a.generator == "free";
    if (a.yaw == "locked") yaw = turbines::rigid_joint;
    if (a.yaw != "free" || !yaw.is_rigid()) return;
    if (model.yaw_drive.is_rigid())
        throw InputError("--yaw", "value", "free", "locked: the model gives no spring of a yaw drive");
    yaw = model.yaw_drive;
}

std::string dofs_in_words(const turbines::TurbineFile& model) {
    const turbines::FileDofs& f = model.dofs;
    std::string locked = f.generator ? "" : ", generator locked";
    if (model.description.yaw.rotation.is_rigid()) locked += ", yaw bearing locked";
    if (model.description.drive_train.main_shaft.is_rigid()) locked += ", main shaft rigid";
    if (!f.tower_fore_aft) locked += ", tower rigid fore-aft";
    if (!f.tower_side_side) locked += ", tower rigid side-side";
    if (!f.blades) locked += ", blades rigid";
    return locked.empty() ? "generator and yaw bearing free" : locked.substr(2);
}

turbines::AssemblyOptions assembly_options(const Arguments& a, const turbines::TurbineFile& model) {
    turbines::AssemblyOptions o;
    o.pitch = a.pitch ? *a.pitch * units::degree : model.pitch;
    if (a.gravity) o.gravity = {0, 0, -units::standard_gravity};
    if (a.undamped) o.structural_damping = o.joint_damping = false;
    o.blade_beam = beam_options(model.description.blade.line, a.blade_elements, true);
    o.tower_beam = beam_options(model.description.tower.line, a.tower_elements, false);
    o.tower_beam->held_y = !model.dofs.tower_side_side;
    o.tower_beam->held_z = !model.dofs.tower_fore_aft;
    o.blade_beam->held_y = o.blade_beam->held_z = !model.dofs.blades;
    return o;
}

// The mean over the azimuth is an approximation that serves equal blades under gravity or on an unbalanced hub.
solvers::CampbellMethod method_for(const Arguments& a, const turbines::TurbineDescription& machine) {
    const RigidInertia& hub = machine.hub.inertia;
    const bool balanced = hub.com.head<2>().isZero(0) && hub.J(0, 0) == hub.J(1, 1) && hub.J(0, 1) == 0 &&
                          hub.J(0, 2) == 0 && hub.J(1, 2) == 0;
    const bool equal = machine.blades > 2 && machine.own_blades.empty();
    return equal && (a.gravity || !balanced) ? solvers::CampbellMethod::averaged : solvers::CampbellMethod::automatic;
}

void save(const Arguments& a, const turbines::TurbineFile& model) {
    std::error_code error;
    if (!is_yaml(a.save)) throw InputError("--save", "file", a.save, "one that ends in .yaml");
    if (std::filesystem::equivalent(a.save, a.model, error))
        throw InputError("--save", "file", a.save, "another one than the model");
    turbines::write_description(model.description, a.save);
    const turbines::FileDofs& f = model.dofs;
    if (model.pitch != 0 || model.rotor_speed != 0 || !f.generator)
        std::cout << "note: " << a.save << " holds the machine, not how it runs: --pitch "
                  << model.pitch * units::to_degrees << ", " << model.rotor_speed * units::to_rpm << " rpm"
                  << (f.generator ? "" : ", --generator locked") << "\n";
    if (!f.tower_fore_aft || !f.tower_side_side || !f.blades)
        std::cout << "note: " << a.save
                  << " holds tower and blades with their stiffness, not that they are rigid here\n";
}

// At standstill, where it costs least: the same modes with twice as many elements.
void print_mesh_error(const Arguments& a, const turbines::TurbineFile& model, solvers::CampbellOptions options) {
    options.keep_shapes = false;
    options.progress = {};
    const auto at_rest = [&](int times) {
        Arguments b = a;
        b.blade_elements *= times;
        b.tower_elements *= times;
        const turbines::Turbine turbine = turbines::assemble(model.description, assembly_options(b, model));
        const std::array standstill{0.0};
        return solvers::campbell(turbine.system(), turbine.rotor(), standstill, options);
    };
    const solvers::Campbell coarse = at_rest(1), fine = at_rest(2);
    if (coarse.points.empty() || fine.points.empty()) return;
    std::vector<std::pair<double, std::string>> changes;
    for (const solvers::BranchDifference& one : solvers::differences(coarse, fine)) {
        const solvers::Branch &branch = coarse.branch(one.name), &other = fine.branch(one.name);
        if (branch.doubtful[0] || other.doubtful[0] || !(fine.damped_hz(other, 0) > 0)) continue;
        changes.emplace_back(100 * one.frequency_hz[0] / fine.damped_hz(other, 0), one.name);
    }
    if (changes.empty()) return;
    const auto larger = [](const auto& x, const auto& y) { return std::abs(x.first) > std::abs(y.first); };
    std::sort(changes.begin(), changes.end(), larger);
    std::cout << "\nmesh: at standstill " << a.blade_elements << " elements per blade and " << a.tower_elements
              << " of the tower are off from twice as many by\n"
              << std::showpos << std::fixed << std::setprecision(2);
    for (std::size_t i = 0; i < std::min<std::size_t>(4, changes.size()); ++i)
        std::cout << "  " << std::setw(7) << changes[i].first << " %  " << changes[i].second << "\n";
    std::cout << std::noshowpos << "(of " << changes.size()
              << " modes with a name beyond doubt these are off most; --blade-elements, --tower-elements)\n"
              << std::defaultfloat;
}

int run(const Arguments& a) {
    turbines::TurbineFile model = read(a.model);
    print(model.notes, a.notes);
    set_dofs(a, model);
    std::cout << "degrees of freedom: " << dofs_in_words(model) << "\n";
    if (a.generator_inertia != 0) model.description.drive_train.generator_inertia = a.generator_inertia;
    if (!a.save.empty()) save(a, model);
    const std::vector<double> speeds = rotor_speeds(a.rpm, model.rotor_speed);
    const turbines::Turbine turbine = turbines::assemble(model.description, assembly_options(a, model));
    program::introduce(turbine, a.summary);

    program::check_outputs(a.out, {".h5", ".csv", ".svg", ".png"});
    solvers::CampbellOptions options = program::campbell_options(a.max_frequency);
    options.method = method_for(a, model.description);
    options.spin = model.dofs.generator ? solvers::RotorSpin::free : solvers::RotorSpin::prescribed;
    const solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    program::stop_at_once();
    program::print_table(diagram);
    if (diagram.points.empty()) return 130;
    if (diagram.complete) print_mesh_error(a, model, options);
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = a.max_frequency;
    program::write_files(diagram, a.out, picture);
    std::cout << "\nfiles: " << a.out << ".h5, .csv, .svg, .png" << (a.save.empty() ? "" : ", " + a.save) << "\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("openfast_campbell", argc, argv, parse, run);
}
