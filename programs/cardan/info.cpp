// What is in a machine or in a result.
//
// Of a machine, from any source: size, operation, degrees of freedom, masses, and the lowest frequencies of a blade
// clamped at its root. Of a result: what it is, how it was made, its channels or modes. Files that a program is writing
// at the moment can be looked at as well; nothing is changed.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/shared/history_state.hpp"
#include "programs/shared/program.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"

#include <cmath>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <map>

namespace cardan::program {

namespace {

struct InfoArguments {
    MachineOptions machine;
    bool description = false;
};

void declare(CommandLine& app, InfoArguments& a) {
    app.add_option("what", a.machine.model, "a machine, or the file of a result (.h5)").required();
    app.add_flag("--description", a.description, "of a result: print its whole input description");
    add_source_options(app, a.machine);
    app.footer(text("\n", machine_help()));
}

void print_statistics(const solvers::IntegrationStatistics& s) {
    std::cout << "steps       " << s.steps << " accepted, " << s.rejected << " rejected, " << s.not_converged
              << " not converged; last step " << s.last_step << " s of order " << s.order << "\n"
              << "work        " << s.evaluations << " evaluations, " << s.jacobians << " Jacobians, "
              << s.factorisations << " factorisations, " << s.iterations << " iterations, " << s.restarts
              << " restarts\n";
}

void print_channels(const std::vector<Channel>& channels) {
    std::cout << "\nchannel                         units       alias           what\n" << std::left;
    for (const Channel& c : channels) {
        std::cout << "  " << std::setw(29) << c.name << " " << std::setw(11) << c.units << " " << std::setw(15)
                  << (c.alias.empty() ? "-" : c.alias) << " " << c.long_name;
        if (!c.frame.empty()) std::cout << "; axes: " << c.frame;
        if (!c.point.empty()) std::cout << "; at: " << c.point;
        std::cout << "\n";
    }
}

// Of a run in time, with the seed and the checksum of a box; why it cannot be had, where its files are no longer there.
std::string wind_in_words(const std::string& description, const std::string& file) {
    try {
        const std::optional<Wind> wind = turbines::wind_of(description, file);
        if (!wind) return {};
        return wind->is_steady() ? text(wind->rows().front().speed, " m/s, steady") : turbines::in_words(*wind);
    } catch (const Error& error) {
        return error.what();
    }
}

void print_history(const std::string& file) {
    const solvers::HistoryInfo info = solvers::read_history_info(file);
    std::cout << file << ": history '" << info.about.title << "', " << state_in_words(info) << "\n";
    if (info.needs_repair)
        std::cout << "repair      needed for programs other than this one: cardan repair " << file << "\n";
    std::cout << "program     " << info.about.program << " " << info.version << "\n";
    if (const std::string wind = wind_in_words(info.about.description, file); !wind.empty())
        std::cout << "wind        " << wind << "\n";
    if (!info.about.method.empty()) std::cout << "method      " << info.about.method << "\n";
    std::cout << "rows        " << info.rows;
    if (info.rows > 0) std::cout << ", " << info.first_time << " ... " << info.last_time << " s";
    std::cout << "\ncheckpoint  ";
    if (info.checkpoint)
        std::cout << "at " << info.checkpoint->time << " s, after " << info.checkpoint_rows << " rows\n";
    else
        std::cout << "none\n";
    if (info.statistics) print_statistics(*info.statistics);
    print_channels(info.channels);
}

// Campbell diagrams and linear models: their attributes, and the names in them.
void print_file(const solvers::Hdf5File& file) {
    std::cout << file.path() << ": " << file.string_attribute("/", "title") << "\n";
    for (const char* name : {"program", "version", "method", "method_reason", "remark", "accuracy", "warning"})
        if (file.has_attribute("/", name))
            if (const std::string value = file.string_attribute("/", name); !value.empty())
                std::cout << std::left << std::setw(15) << name << " " << value << "\n";
    for (const std::string& names :
         std::vector<std::string>{"branches", "model/states", "model/inputs", "model/outputs"}) {
        if (!file.has(names + "/name")) continue;
        const std::vector<std::string> all = file.read_strings(names + "/name");
        std::cout << names.substr(names.find('/') + 1) << " (" << all.size() << ")\n";
        for (const std::string& name : all) std::cout << "  " << name << "\n";
    }
}

void print_result(const std::string& file, bool description) {
    if (turbines::is_history(file))
        print_history(file);
    else
        print_file(solvers::Hdf5File::open(file));
    if (description) std::cout << "\ninput description:\n" << turbines::input_description(file) << "\n";
}

using Part = turbines::MissingEntry::Part;

void add_masses(const turbines::Turbine& turbine, std::map<std::string, double>& parts) {
    for (const PartMass& part : masses_by_part(turbine.tree())) parts[part.part] += part.mass;
}

void print_masses(const std::map<std::string, double>& parts, bool whole) {
    double total = 0;
    std::printf("masses, kg\n");
    for (const auto& [part, mass] : parts) {
        std::printf("  %-24s %14.6g\n", part.c_str(), mass);
        total += mass;
    }
    if (whole) std::printf("  %-24s %14.6g\n", "total", total);
}

void print_size(const turbines::TurbineDescription& d) {
    const double height = d.tower.line.length + d.nacelle.shaft_height + d.nacelle.overhang * std::sin(d.nacelle.tilt) +
                          (d.platform ? d.platform->tower_base.z() : 0);
    std::printf("blades        %d, %s\n", d.blades, d.nacelle.overhang < 0 ? "downwind" : "upwind");
    if (d.blades > 0 && d.hub.radius > 0 && d.blade.line.length > 0)
        std::printf("rotor         %g m, twice hub radius and blade along the cone\n",
                    2 * (d.hub.radius + d.blade.line.length) * std::cos(d.blade.cone));
    if (d.tower.line.length > 0)
        std::printf("%s    %g m above the %s\n", d.nacelle.shaft_height > 0 ? "hub height" : "tower top ", height,
                    d.platform ? "water" : "foot of the tower");
    if (d.platform) std::printf("stands on     %s\n", d.platform->name.c_str());
}

void print_air(const turbines::Machine& machine) {
    if (machine.air)
        std::printf("air           %zu sections, %zu airfoils%s, %g kg/m^3\n", machine.air->blade.sections(),
                    machine.air->blade.polars.size(), machine.air->unsteady_airfoils.empty() ? "" : " with lags",
                    machine.air->density);
    else
        std::printf("air           none: %s\n", machine.no_air.c_str());
}

void print_operation(const turbines::Machine& machine) {
    const turbines::MachineOperation& o = machine.operation;
    if (o.rated_power > 0) std::printf("rated power   %g kW on the rotor\n", o.rated_power / 1e3);
    if (o.min_speed > 0) std::printf("minimum speed %g rpm\n", o.min_speed * units::to_rpm);
    if (o.tip_speed_ratio > 0) std::printf("tip speed     %g times the wind's below rated power\n", o.tip_speed_ratio);
    const turbines::ModelController& c = machine.controller;
    if (!c.library.empty()) std::printf("controller    %s\n", c.library.c_str());
    if (!c.input.empty()) std::printf("its input     %s\n", c.input.c_str());
    if (c.generator_efficiency > 0) std::printf("generator     efficiency %g\n", c.generator_efficiency);
}

void print_hz(const char* what, const std::vector<double>& hz) {
    std::printf("%s at rest, Hz (12 elements)\n ", what);
    for (std::size_t i = 0; i < hz.size() && i < 6; ++i) std::printf(" %.4f", hz[i]);
    std::printf("\n");
}

void print_blade(const turbines::Machine& machine, const MachineOptions& options) {
    if (machine.description.blade_at(1) == nullptr || !machine.description.has(Part::blade)) return;
    print_hz("blade 1 clamped at its root and",
             turbines::clamped_blade_hz(machine.description, assembly_options(machine, options)));
}

// What there is of a machine whose source lacks masses.
void print_parts(const turbines::Machine& machine, const MachineOptions& coarse, const MachineOptions& options) {
    const turbines::TurbineDescription& d = machine.description;
    const turbines::AssemblyOptions assembly = assembly_options(machine, coarse);
    std::map<std::string, double> masses;
    if (d.has(Part::blade))
        for (int number = 1; number <= d.blades; ++number)
            add_masses(turbines::isolated_blade(d, assembly, number), masses);
    const bool tower = d.has(Part::tower) && !d.tower.rigid;
    if (tower) add_masses(turbines::isolated_tower(d, assembly), masses);
    if (!masses.empty()) print_masses(masses, false);
    print_blade(machine, options);
    if (tower)
        print_hz("tower clamped at its foot, without what it carries,",
                 turbines::clamped_tower_hz(d, assembly_options(machine, options)));
    std::printf("%s\n", in_words(d.missing).c_str());
}

void print_machine(InfoArguments& a) {
    const turbines::Machine machine = prepared_machine(a.machine);
    const turbines::TurbineDescription& d = machine.description;
    const double speed = rotor_speed({}, machine);
    set_pitch(machine, a.machine, speed);
    std::cout << std::flush;
    std::printf("machine       %s\n", d.name.c_str());
    print_size(d);
    print_air(machine);
    print_operation(machine);
    MachineOptions coarse = a.machine;
    coarse.blade_elements = coarse.tower_elements = 4;
    if (!d.missing.empty()) return print_parts(machine, coarse, a.machine);
    const turbines::Turbine turbine = turbines::assemble(d, assembly_options(machine, coarse));
    introduce(turbine, false);
    std::map<std::string, double> masses;
    add_masses(turbine, masses);
    print_masses(masses, true);
    print_blade(machine, a.machine);
}

int run(InfoArguments& a, const CommandLine& /*command*/) {
    stop_at_once();
    if (turbines::is_result(a.machine.model))
        print_result(a.machine.model, a.description);
    else
        print_machine(a);
    return 0;
}

}  // namespace

int info_command(int argc, char** argv) {
    return run_command<InfoArguments>("cardan info",
                                      "What is in a machine: size, operation, masses, frequencies of a blade; or in a "
                                      "result: how it was made, its channels or modes.",
                                      argc, argv, declare, run);
}

}  // namespace cardan::program
