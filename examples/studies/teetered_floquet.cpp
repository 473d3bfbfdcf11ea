// Modes of the two-bladed teetered machine at one rotor speed, by Floquet's theory.
//
// Problem: the machine of Lee, Hodges and Patil, Wind Energy 5 (2002), Table I: elastic tower, free yaw, teetered hub,
// two elastic blades, rotor speed prescribed. Linearised about its periodic steady state, M(t) x'' + C(t) x' + K(t) x =
// 0 of period 2 pi / Omega; solutions exp(lambda t) p(t). Of lambda + i j Omega the one whose harmonic holds most
// energy is printed, in multiples of Omega, with the shares of the others. Reference: converged frequencies by another
// method, for a tower of 100 times the blades' rigidity and for a rigid one. Goal with six elements per blade and
// tower: 0.3 % for every first mode, 1 % for every second one. The paper's Tables II and III stand beside them; they do
// not follow from its Table I (docs/teetered.md).
#include "examples/studies/teetered_floquet/pictures.hpp"
#include "examples/studies/teetered_program.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

using namespace cardan;

namespace {

constexpr double nominal_speed = 6.02;
constexpr double first_goal = 0.3, second_goal = 1;  // %
constexpr int elements_for_goals = 6;                // and the default
constexpr int name_width = 45;

struct Arguments {
    double speed = nominal_speed, max_per_rev = 140;
    program::TeeteredArguments machine;
    bool modes = false, no_pictures = false;
    std::string out = "teetered_floquet";
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Modes of the two-bladed teetered machine of Lee, Hodges and Patil (2002) at one rotor speed, by Floquet's "
        "theory.\nPrints a table and writes PREFIX.h5, PREFIX.csv, PREFIX_harmonics.csv, PREFIX.svg and PREFIX.png "
        "(mode shapes in the arrangement of the paper's Figs. 3 to 14).");
    app.footer(
        "Exit code: 0; 1 error; 2 wrong usage; 3 a goal (0.3 % for first, 1 % for second modes, with six elements and "
        "more and the paper's data) is missed.");
    app.add_option("--speed", a.speed, "rotor speed, rad/s");
    program::add_options(app, a.machine);
    app.add_option("--max", a.max_per_rev, "modes up to this frequency, per revolution");
    app.add_option("--out", a.out, "prefix of the files");
    const program::Option modes =
        app.add_flag("--modes", a.modes, "also draw every mode shape (PREFIX_modes/*.svg, *.png)");
    app.add_flag("--no-pictures", a.no_pictures, "tables and files only").excludes(modes);
    return app.parse(argc, argv);
}

solvers::Campbell modes_of(const Arguments& a, const turbines::Turbine& machine) {
    solvers::CampbellOptions options =
        program::campbell_options(a.machine, machine, a.max_per_rev * a.speed / (2 * pi));
    options.progress = {};
    const std::array speeds{a.speed};
    solvers::Campbell diagram = solvers::campbell(machine.system(), machine.rotor(), speeds, options);
    program::tell_elements(diagram, machine);
    return diagram;
}

// "0: 99.97 %, +2: 0.03 %", largest first.
std::string harmonics(const solvers::FloquetMode& mode) {
    std::vector<std::pair<double, int>> shares;
    for (Eigen::Index i = 0; i < mode.participation.size(); ++i)
        if (mode.participation(i) > 5e-5)
            shares.emplace_back(mode.participation(i), mode.first_harmonic + static_cast<int>(i));
    std::sort(shares.begin(), shares.end(), std::greater<>());
    if (shares.size() > 4) shares.resize(4);
    std::ostringstream out = text_stream();
    for (const auto& [share, j] : shares)
        out << (out.tellp() > 0 ? ", " : "") << (j > 0 ? "+" : "") << j << ": " << std::fixed << std::setprecision(2)
            << 100 * share << " %";
    return out.str();
}

class Table {
public:
    Table(const solvers::Campbell& diagram, const std::vector<teetered::KnownMode>& known, bool as_published)
        : d_(diagram), known_(known), as_published_(as_published) {}

    void print(std::ostream& out) {
        out << d_.machine << "\n"
            << d_.method << ", " << d_.points[0].rotor_speed << " rad/s\n"
            << d_.remark << "\n"
            << d_.accuracy << "\n\n"
            << std::left << std::setw(name_width) << "mode" << std::right << std::setw(10) << "per rev" << std::setw(11)
            << "Hz" << std::setw(13) << "growth/Omega";
        if (as_published_) out << std::setw(11) << "reference" << std::setw(9) << "error" << std::setw(9) << "paper";
        out << "   harmonics: energy\n";
        for (const solvers::Branch& branch : d_.branches)
            if (branch.mode[0] >= 0) line(out, branch);
        out << "\n?: the name is doubtful, the mode is a mixture. Harmonics j: of the motion with j revolutions "
               "more.\n";
        if (!d_.warning.empty()) out << "warning: " << d_.warning << "\n";
    }
    bool compared() const { return compared_; }
    double worst_first = 0, worst_second = 0;  ///< beyond the digits of the reference, %

private:
    void line(std::ostream& out, const solvers::Branch& branch) {
        const solvers::CampbellMode& mode = *d_.mode(branch, 0);
        const double speed = d_.points[0].rotor_speed, f = mode.mode.eigenvalue.imag() / speed,
                     growth = mode.mode.eigenvalue.real() / speed;
        out << std::left << std::setw(name_width) << branch.name + (branch.doubtful[0] ? " ?" : "") << std::right
            << std::fixed << std::setprecision(4) << std::setw(10) << f << std::setw(11) << mode.mode.damped_hz()
            << std::setw(13) << std::setprecision(5) << (std::abs(growth) < 5e-6 ? 0 : growth);
        if (as_published_) compare(out, branch.name, f);
        if (mode.floquet && mode.kind() != solvers::FloquetKind::rigid) out << "   " << harmonics(*mode.floquet);
        out << "\n";
    }
    void compare(std::ostream& out, const std::string& name, double f) {
        const auto found =
            std::find_if(known_.begin(), known_.end(), [&](const auto& known) { return known.name == name; });
        const auto entry = [&](const std::optional<double>& value, int width, int decimals, const char* unit) {
            if (value)
                out << std::setprecision(decimals) << std::setw(width) << *value << unit;
            else
                out << std::setw(width) << "-" << std::string(std::strlen(unit), ' ');
        };
        if (found == known_.end() || !found->reference) {
            entry({}, 11, 0, "");
            entry({}, 8, 0, "%");
        } else {
            const double off = 100 * (f / *found->reference - 1);
            entry(found->reference, 11, 4, "");
            entry(off, 8, 2, "%");
            double& worst = name[0] == '1' ? worst_first : worst_second;
            worst = std::max(worst, std::abs(off) - 100 * found->digit / *found->reference);
            compared_ = true;
        }
        entry(found == known_.end() ? std::nullopt : found->paper, 9, 3, "");
    }

    const solvers::Campbell& d_;
    const std::vector<teetered::KnownMode>& known_;
    bool as_published_, compared_ = false;
};

void write_harmonics(const solvers::Campbell& diagram, const std::string& path) {
    std::ostringstream out = text_stream();
    out << "# shares of the energy; harmonic j: frequency of the mode plus j per revolution\n"
        << "mode,frequency[1/rev],growth[1/rev],harmonic,share\n"
        << std::setprecision(10);
    const double speed = diagram.points[0].rotor_speed;
    for (const solvers::Branch& branch : diagram.branches) {
        const solvers::CampbellMode* mode = diagram.mode(branch, 0);
        if (!mode || !mode->floquet) continue;
        const solvers::FloquetMode& f = *mode->floquet;
        for (Eigen::Index i = 0; i < f.participation.size(); ++i)
            out << solvers::csv_field(branch.name) << "," << f.exponent.imag() / speed << "," << f.growth() / speed
                << "," << f.first_harmonic + static_cast<int>(i) << "," << f.participation(i) << "\n";
    }
    write_file(path, out.str());
}

void draw_modes(const solvers::Campbell& diagram, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError(folder.string(), error.message());
    for (const solvers::Branch& branch : diagram.branches) {
        if (branch.mode[0] < 0) continue;
        for (const char* kind : {".svg", ".png"}) {
            const std::filesystem::path path = folder / (program::file_name(branch.name) + kind);
            if (branch.family == "blade torsion")
                teetered::draw_twist(diagram, branch, path);
            else
                solvers::plot_mode(diagram, branch, 0, path);
        }
    }
}

int run(const Arguments& a) {
    if (!std::isfinite(a.speed) || !(a.speed > 0)) throw InputError("--speed", "value [rad/s]", a.speed, "> 0");
    if (!(a.max_per_rev > 0)) throw InputError("--max", "frequency per revolution", a.max_per_rev, "> 0");
    program::check_outputs(a.out, {".h5", ".csv", "_harmonics.csv", ".svg", ".png"});
    program::stop_at_once();
    const turbines::Turbine machine = program::machine(a.machine);
    program::introduce(machine, a.machine.summary);

    const solvers::Campbell diagram = modes_of(a, machine);
    const bool published =
        a.speed == nominal_speed && !a.machine.no_teeter && !a.machine.gravity && a.machine.data.empty();
    const std::vector<teetered::KnownMode> known = teetered::known_modes(
        a.machine.rigid_tower ? std::numeric_limits<double>::infinity() : a.machine.tower_ratio.value_or(100));
    Table table(diagram, known, published);
    table.print(std::cout);
    const bool goals =
        table.compared() && std::min(a.machine.blade_elements, a.machine.tower_elements) >= elements_for_goals;
    const bool reached = table.worst_first <= first_goal && table.worst_second <= second_goal;
    if (goals)
        std::cout << std::setprecision(3) << "largest error of first modes " << table.worst_first << " % (goal "
                  << first_goal << "), of second modes " << table.worst_second << " % (goal " << second_goal
                  << "): " << (reached ? "reached" : "MISSED") << "\n";
    std::cout << std::flush;
    if (!std::cout) throw FileError("standard output", "the table could not be written");

    solvers::write_hdf5(diagram, a.out + ".h5");
    solvers::write_csv(diagram, a.out + ".csv");
    write_harmonics(diagram, a.out + "_harmonics.csv");
    bool drawn = !a.no_pictures;
    for (const char* kind : {".svg", ".png"}) drawn = drawn && teetered::draw_figures(diagram, known, a.out + kind);
    if (a.modes) draw_modes(diagram, a.out + "_modes");
    std::cout << "\nfiles: " << a.out << ".h5, .csv, _harmonics.csv" << (drawn ? ", .svg, .png" : "")
              << (a.modes ? text("; mode shapes in ", a.out, "_modes/") : "") << "\n";
    return goals && !reached ? 3 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("teetered_floquet", argc, argv, parse, run);
}
