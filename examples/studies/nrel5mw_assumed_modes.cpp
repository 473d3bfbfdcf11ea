// The NREL 5 MW blade by assumed modes, beside a paper of 2018 that has the same model and beside the joint chain.
//
// Problem: beam equations after Hodges and Dowell in a frame that moves with the hub, Galerkin's method
// (examples/studies/beams/assumed_modes_blade.hpp). Frequencies and mode shapes of the rotating blade with the
// functions of the paper, with the tension integrated from the wrong end (its Table 2) and from the free tip, and with
// functions that converge; periodic response to gravity and to a pitching platform with and without the time
// derivatives of the frame's velocities, which the paper's Annex A does not have. References: the tables of the paper;
// converged frequencies and response of the same blade by other methods (docs/nrel5mw_blade.md,
// docs/nrel5mw_platform.md).
#include "examples/studies/nrel5mw_assumed_modes/functions.hpp"
#include "examples/studies/nrel5mw_assumed_modes/platform_case.hpp"
#include "examples/studies/nrel5mw_assumed_modes/shapes.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "solvers/pictures/stack.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

using namespace cardan;
using namespace cardan::paper2018;

namespace {

struct Arguments {
    std::string out = "nrel5mw_assumed_modes";
    int elements = 32, harmonics = 8, natural = 24;
    Functions functions;

    AssumedModesBasis basis() const { return functions.basis(turbines::nrel5mw_blade().line.length); }
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "The NREL 5 MW blade by assumed modes, beside the tables of a paper of 2018 and beside the joint chain:\n"
        "frequencies at rest and in rotation, mode shapes, response to a pitching platform. Writes\n"
        "PREFIX_frequencies.csv, PREFIX_shapes.csv, .svg (mode shapes over the length), PREFIX_platform.csv, .svg.");
    app.footer(
        "Exit code: 0; 1 error; 2 wrong usage; 3 a goal is missed: the paper's bending frequencies within 0.06 % by "
        "its\n"
        "own functions and tension (not judged by other functions), converged frequencies within 1.5e-4 of the\n"
        "reference, response to the pitching platform within 1 % and 1 deg.");
    app.add_option("--elements", a.elements, "of the joint chain");
    app.add_option("--harmonics", a.harmonics, "of the periodic response").range(6, 40);
    app.add_option("--modes", a.natural, "natural modes in which the blade on the platform moves").range(1, 384);
    add_options(app, a.functions);
    app.add_option("--out", a.out, "prefix of the files");
    return app.parse(argc, argv);
}

// Frequencies of one model at the paper's rotor speeds.
struct Column {
    std::string name;
    std::vector<Frequencies> hz;  // by rotor speed; 0: not known
    std::vector<NamedModes> named = {};
};

Column column(const std::string& name, const AssumedModesBlade& blade) {
    Column c{name, {}, {}};
    for (double rpm : printed_rpm) {
        c.named.push_back(named_modes(blade, rpm));
        c.hz.push_back(c.named.back().hz);
    }
    return c;
}

struct Models {
    explicit Models(const AssumedModesBasis& basis)
        : wrong_end(turbines::nrel5mw_blade_of_2018(basis, TensionIntegral::wrong_end)),
          from_tip(turbines::nrel5mw_blade_of_2018(basis, TensionIntegral::from_free_tip)) {}
    AssumedModesBlade wrong_end, from_tip;
    AssumedModesBlade converged = turbines::nrel5mw_blade_converged();
};

std::vector<Column> frequencies(const Models& models, int elements) {
    const Column chain{"joint chain", chain_frequencies(elements, {printed_rpm.begin(), printed_rpm.end()})};
    std::vector<Column> all;
    all.push_back({"paper", {printed.begin(), printed.end()}});
    all.push_back(column("wrong-end tension", models.wrong_end));
    all.push_back(column("right tension", models.from_tip));
    all.push_back(column("converged", models.converged));
    Column coriolis{"+ Coriolis forces", {}}, drawn_out{"+ steady stretch", {}};
    for (double rpm : printed_rpm) {
        if (program::interrupted()) return {};
        coriolis.hz.push_back(gyroscopic_frequencies(models.converged, rpm));
        drawn_out.hz.push_back(stretched_frequencies(rpm));
    }
    all.push_back(coriolis);
    all.push_back(drawn_out);
    all.push_back(chain);
    Column reference{"exact", std::vector<Frequencies>(printed_rpm.size())};
    for (std::size_t i = 0; i < printed_rpm.size(); ++i)
        for (std::size_t r = 0; r < exact_rpm.size(); ++r)
            if (exact_rpm.at(r) == printed_rpm.at(i)) reference.hz[i] = exact.at(r);
    all.push_back(reference);
    return all;
}

std::string hertz(double value) {
    std::ostringstream out = text_stream();
    if (value > 0) out << std::fixed << std::setprecision(4) << value;
    return value > 0 ? out.str() : "-";
}

// All columns of the paper's Table 1 beside what its functions and converged ones give.
void print_table1(const std::vector<Column>& columns, const Functions& functions) {
    const std::string ours = functions.are_of_the_paper() ? "its functions" : "functions given";
    const std::vector<std::pair<std::string, Frequencies>> table{
        {"Modes (FAST)", printed_modes},
        {"ADAMS", printed_adams},
        {"paper's model", printed.front()},
        {ours, columns[1].hz.front()},
        {"the same untwisted", untwisted_at_rest(functions.basis(turbines::nrel5mw_blade().line.length))},
        {"converged", columns[3].hz.front()}};
    std::cout << "Table 1 of the paper, at rest, Hz: its three columns; recomputed by its functions, with and without "
                 "twist, and\nby functions that converge\n"
              << std::setw(12) << "";
    for (const auto& [name, hz] : table) std::cout << std::setw(20) << name;
    for (std::size_t k = 0; k < modes; ++k) {
        std::cout << "\n" << std::left << std::setw(12) << mode_names.at(k) << std::right;
        for (const auto& [name, hz] : table) std::cout << std::setw(20) << hertz(hz.at(k));
    }
    std::cout << "\n\n";
}

void print_tables(const std::vector<Column>& columns, const Functions& functions) {
    if (!functions.are_of_the_paper())
        std::cout << "functions given: " << functions.description()
                  << "; they are not the paper's, whose tables\nstand beside them but are not judged\n\n";
    print_table1(columns, functions);
    std::cout << "natural frequencies, Hz; "
              << (functions.are_of_the_paper() ? "the paper's functions" : "functions given")
              << " with its tension from the wrong end and with the right "
                 "one,\nfunctions that converge, then with more terms; joint chain; independent reference\n";
    for (std::size_t k = 0; k < modes; ++k) {
        std::cout << "\n" << std::left << std::setw(12) << mode_names.at(k) << std::right;
        for (const Column& c : columns) std::cout << std::setw(19) << c.name;
        std::cout << "\n";
        for (std::size_t i = 0; i < printed_rpm.size(); ++i) {
            std::cout << std::setw(4) << printed_rpm.at(i) << " rpm    ";
            for (const Column& c : columns) std::cout << std::setw(19) << hertz(c.hz[i].at(k));
            std::cout << "\n";
        }
    }
}

double error(double value, double of) {
    return std::abs(value / of - 1);
}

// @return is the goal reached?
bool judge(const char* what, double value, double allowed) {
    std::cout << what << ": " << std::defaultfloat << std::setprecision(2) << 100 * value << " % (goal "
              << 100 * allowed << " %): " << (value <= allowed ? "reached" : "MISSED") << "\n";
    return value <= allowed;
}

// Judges against the paper's tables if the functions are the paper's; else only prints the difference.
bool judge_paper(const char* what, double difference, const Functions& functions) {
    if (functions.are_of_the_paper()) return judge(what, difference, 6e-4);
    std::cout << what << ": " << std::defaultfloat << std::setprecision(2) << 100 * difference
              << " % off, not judged: other functions\n";
    return true;
}

bool judge_frequencies(const std::vector<Column>& columns, const Arguments& a) {
    double table1 = 0, table2 = 0, converged = 0;
    for (std::size_t i = 0; i < printed_rpm.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            if (printed.at(i).at(k) == 0) continue;
            const double e = error(columns[1].hz[i].at(k), printed.at(i).at(k));
            (i == 0 ? table1 : table2) = std::max(i == 0 ? table1 : table2, e);
        }
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = 0; i < printed_rpm.size(); ++i) {
            const double reference = columns.back().hz[i].at(k);
            if (reference > 0) converged = std::max(converged, error(columns[5].hz[i].at(k), reference));
        }
    }
    const auto torsion = torsion_at_rest(a.basis());
    std::cout << std::fixed << std::setprecision(4) << "\n1st torsion at rest by "
              << (a.functions.are_of_the_paper() ? "the paper's functions: " : "the functions given: ") << torsion[0]
              << " Hz; with polar inertia without the mass factor " << torsion[1]
              << ", with the tabulated inertia about the pitch axis " << torsion[2] << "; paper "
              << printed.front().back() << "\n\n";
    const std::string by = a.functions.are_of_the_paper() ? "its functions" : "the functions given";
    const bool one = judge_paper(text("Table 1 of the paper, bending, by ", by).c_str(), table1, a.functions);
    const bool two = judge_paper(text("Table 2 of the paper by ", by, " and tension from the wrong end").c_str(),
                                 table2, a.functions);
    return judge("converged bending frequencies with Coriolis forces and stretch", converged, 1.5e-4) && one && two;
}

void write_frequencies(const std::vector<Column>& columns, const std::string& path) {
    std::string rows = "mode,rotor_speed[rpm]";
    for (const Column& c : columns) {
        std::string name = c.name;
        std::replace(name.begin(), name.end(), ',', ';');
        rows += "," + name + "[Hz]";
    }
    rows += "\n";
    for (std::size_t k = 0; k < modes; ++k)
        for (std::size_t i = 0; i < printed_rpm.size(); ++i) {
            rows += text(mode_names.at(k), ",", printed_rpm.at(i));
            for (const Column& c : columns) rows += c.hz[i].at(k) > 0 ? text(",", c.hz[i].at(k)) : ",";
            rows += "\n";
        }
    write_file(path, rows);
}

struct PlatformRun {
    std::string name;
    PlatformResponse response;
};

void print_signal(const std::string& name, const Signal& y, double unit) {
    std::cout << "  " << std::left << std::setw(26) << name << std::right << std::defaultfloat << std::setprecision(4);
    for (double value : {y.mean, y.max, y.min}) std::cout << std::setw(10) << value / unit;
    for (std::size_t k = 0; k < 5; ++k)
        std::cout << std::setw(10) << y.amplitude[k] / unit << std::setw(9)
                  << text("(", std::round(10 * y.phase[k] * units::to_degrees) / 10, ")");
    std::cout << "\n";
}

void print_reference(const platform::ReferenceSignal& r) {
    std::cout << "  " << std::left << std::setw(26) << "reference" << std::right << std::defaultfloat
              << std::setprecision(4);
    for (double value : {r.mean, r.max, r.min}) std::cout << std::setw(10) << value;
    for (int k = 1; k <= 5; ++k) {
        const platform::ReferenceHarmonic* known = r.harmonic(k);
        const bool has_phase = known && std::isfinite(known->phase);
        std::cout << std::setw(10) << (known ? text(known->amplitude) : "") << std::setw(9)
                  << (has_phase ? text("(", known->phase, ")") : "");
    }
    std::cout << "\n";
}

void print_platform(const char* title, const std::vector<PlatformRun>& runs, const platform::ReferenceCase& reference) {
    std::cout << "\n" << title << "\n" << std::left << std::setw(28) << "" << std::right;
    for (const char* head : {"mean", "max", "min"}) std::cout << std::setw(10) << head;
    for (int k = 1; k <= 5; ++k) std::cout << std::setw(10) << text("A", k) << std::setw(9) << "(phase)";
    std::cout << "\n";
    for (std::size_t s = 0; s < platform::signals; ++s) {
        const platform::SignalName& signal = platform::signal_names.at(s);
        std::cout << signal.name << "\n";
        print_reference(reference.by_signal.at(s));
        for (const PlatformRun& run : runs) print_signal(run.name, run.response.by_signal.at(s), signal.unit);
    }
}

// The largest error of mean values and of harmonics above 5 % of the largest one, of phases in degrees per 100 deg: 1 %
// is 1 deg.
double platform_error(const PlatformResponse& response, const platform::ReferenceCase& reference) {
    double worst = 0;
    for (std::size_t s = 0; s < platform::signals; ++s) {
        const platform::ReferenceSignal& r = reference.by_signal.at(s);
        const Signal& y = response.by_signal.at(s);
        const double unit = platform::signal_names.at(s).unit, largest = r.largest_amplitude();
        worst = std::max(worst, std::abs(y.mean / unit - r.mean) / std::max(std::abs(r.mean), largest));
        for (const platform::ReferenceHarmonic& h : r.harmonics) {
            if (h.amplitude < 0.05 * largest) continue;
            worst = std::max(worst, error(entry(y.amplitude, h.k - 1) / unit, h.amplitude));
            const double phase = entry(y.phase, h.k - 1) * units::to_degrees;
            if (std::isfinite(h.phase)) worst = std::max(worst, std::abs(std::remainder(phase - h.phase, 360)) / 100);
        }
    }
    return worst;
}

void draw_platform(const PlatformRun& with, const PlatformRun& without, const std::string& path) {
    const auto panel = [&](std::size_t s, const char* label) {
        return solvers::StackPanel{label,
                                   {{"with dA/dt and dB/dt", with.response.time, with.response.by_signal.at(s).samples},
                                    {"without", without.response.time, without.response.by_signal.at(s).samples}}};
    };
    solvers::PanelStack stack;
    stack.title = "Platform pitching by 5 deg at half the rotor's frequency, 12.1 rpm";
    stack.x_label = "time, s";
    stack.x_high = with.response.time.back();
    stack.panels = {panel(0, "tip, downwind, m"), panel(1, "tip, to leading edge, m")};
    stack.width = 1000;
    solvers::draw(stack, path);
}

void write_platform(const std::vector<PlatformRun>& runs, const std::string& path) {
    const std::array<const char*, platform::signals> names{"tip flap[m]", "tip edge[m]", "root My[N m]",
                                                           "root Mz[N m]"};
    std::string rows = "time[s]";
    for (const PlatformRun& run : runs)
        for (const char* name : names) rows += "," + run.name + " " + name;
    rows += "\n";
    for (std::size_t i = 0; i < runs.front().response.time.size(); ++i) {
        rows += text(runs.front().response.time[i]);
        for (const PlatformRun& run : runs)
            for (const Signal& y : run.response.by_signal) rows += text(",", y.samples[i]);
        rows += "\n";
    }
    write_file(path, rows);
}

bool platform_part(const Arguments& a) {
    const AssumedModesBlade full = turbines::nrel5mw_blade_converged(turbines::nrel5mw_platform_blade().line);
    const AssumedModesBlade blade = in_natural_modes(full, a.natural),
                            paper = turbines::nrel5mw_blade_of_2018(a.basis(), TensionIntegral::from_free_tip);
    const PlatformCase at_rest{.harmonics = a.harmonics};
    PlatformCase pitching{.pitch = 5 / units::to_degrees, .revolutions = 2, .harmonics = a.harmonics};
    const auto both = [&](const PlatformCase& of) {
        PlatformCase without = of;
        without.derivatives = false;
        return std::vector<PlatformRun>{
            {"with derivatives", platform_response(blade, of)},
            {a.functions.are_of_the_paper() ? "paper's functions" : "functions given", platform_response(paper, of)},
            {"without derivatives", platform_response(blade, without)}};
    };
    const std::vector<PlatformRun> still = both(at_rest), moving = both(pitching);
    const auto& [exact_still, exact_moving] = platform::reference_cases();
    print_platform("platform at rest", still, exact_still);
    print_platform("platform pitching", moving, exact_moving);
    PlatformCase heaving = at_rest, felt = at_rest;
    heaving.heave_rate = felt.heave_rate = 1;
    felt.derivatives = false;
    const auto first = [](const PlatformResponse& r) {
        return std::polar(r.by_signal[1].amplitude[0], r.by_signal[1].phase[0]);
    };
    const Complex rest = first(still[0].response);
    std::cout << "\nwhat a steady heave of 1 m/s adds to A1 of v, m: with derivatives " << std::setprecision(2)
              << std::abs(first(platform_response(blade, heaving)) - rest) << ", without "
              << std::abs(first(platform_response(blade, felt)) - rest) << "\n\n";
    const double worst =
        std::max(platform_error(still[0].response, exact_still), platform_error(moving[0].response, exact_moving));
    const bool good = judge("response on the platform", worst, 0.01);
    write_platform(moving, a.out + "_platform.csv");
    draw_platform(moving[0], moving[2], a.out + "_platform.svg");
    return good;
}

int run(const Arguments& a) {
    program::check_outputs(a.out, {"_frequencies.csv", "_shapes.csv", "_shapes.svg", "_platform.csv", "_platform.svg"});
    const Models models(a.basis());
    const std::vector<Column> columns = frequencies(models, a.elements);
    if (columns.empty()) return 130;
    program::stop_at_once();
    print_tables(columns, a.functions);
    bool good = judge_frequencies(columns, a);
    write_frequencies(columns, a.out + "_frequencies.csv");

    // Standstill, and the speeds named beside the paper's Fig. 6.
    std::vector<double> rpm;
    std::vector<NamedModes> wrong_end, from_tip;
    for (std::size_t i = 0; i < printed_rpm.size(); ++i) {
        if (printed.at(i).front() == 0) continue;
        rpm.push_back(printed_rpm.at(i));
        wrong_end.push_back(columns[1].named[i]);
        from_tip.push_back(columns[2].named[i]);
    }
    const std::vector<ShapeSet> shapes{shape_set("tension from the wrong end", models.wrong_end, rpm, wrong_end),
                                       shape_set("tension from the free tip", models.from_tip, rpm, from_tip)};
    write_csv(shapes, a.out + "_shapes.csv");
    draw(shapes, a.out + "_shapes.svg");
    good = platform_part(a) && good;
    std::cout << "\nfiles: " << a.out << "_frequencies.csv, _shapes.csv, _shapes.svg, _platform.csv, _platform.svg\n";
    if (!std::cout.flush()) throw FileError("standard output", "the tables could not be written");
    return good ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("nrel5mw_assumed_modes", argc, argv, parse, run);
}
