#include "examples/studies/wt600_electric/damping.hpp"

#include "examples/studies/drive_train.hpp"
#include "examples/studies/wt600_simulation.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/campbell.hpp"
#include "turbines/electric/electric_wt600.hpp"
#include "turbines/model/generator_slip.hpp"

#include <cstdio>
#include <iostream>
#include <numeric>
#include <optional>

namespace cardan::electric {

namespace {

// No wind and no torque, the grid's frequency that of the rotor, its voltage in proportion.
turbines::Turbine machine_at(const MotionOptions& o, std::optional<MachineOrder> order, double speed) {
    if (!order)
        return turbines::with_generator_slip(
            turbines::wt600(program::elements_of_paper(o.blade_elements, o.tower_elements)),
            turbines::wt600_kloss_curve());
    turbines::ElectricWt600Options options;
    options.assembly = program::elements_of_paper(o.blade_elements, o.tower_elements);
    options.wind = 0;
    options.order = *order;
    const double ratio = turbines::wt600_description().drive_train.gear_ratio,
                 share = speed * ratio / turbines::wt600_equivalent_circuit().synchronous_speed();
    options.grid.frequency *= share;
    options.grid.line_voltage *= share;
    options.running = speed * ratio;
    return turbines::electric_wt600(options).turbine;
}

solvers::Mode torsion_at(const turbines::Turbine& turbine, double speed) {
    const solvers::SteadyState steady =
        solvers::steady_state(turbine.system(), turbine.rotor().spin, {.rotor_speed = speed});
    require_result(steady, "steady state");
    const solvers::SecondOrderSystem system = program::multi_blade_system(turbine, steady.at);
    return program::drive_train_mode(turbine, system, solvers::modes(system), 8);
}

}  // namespace

int damping(const MotionOptions& machine, const DampingOptions& options) {
    const std::vector<double> speeds = program::numbers("--speeds", options.speeds, "numbers separated by commas, rpm");
    for (const double rpm : speeds) require_positive("--speeds", "rotor speed [rpm]", rpm);
    program::check_outputs(machine.run.out, {".svg", ".png"});
    std::printf("torsion of the drive train, Hz, and damping ratio, %%\n%6s %17s %17s %17s %17s\n", "rpm",
                "steady curve", "first order", "third order", "fifth order");
    std::vector<turbines::Turbine> fifth;
    for (const double rpm : speeds) {
        std::printf("%6.1f", rpm);
        for (const std::optional<MachineOrder> order :
             {std::optional<MachineOrder>(), std::optional(MachineOrder::first), std::optional(MachineOrder::third),
              std::optional(MachineOrder::fifth)}) {
            const turbines::Turbine turbine = machine_at(machine, order, rpm * units::rpm);
            const solvers::Mode mode = torsion_at(turbine, rpm * units::rpm);
            std::printf(" %8.4f %8.3f", mode.natural_hz(), 100 * mode.damping_ratio());
            if (order == MachineOrder::fifth) fifth.push_back(turbine);
        }
        std::printf("\n");
    }
    std::vector<solvers::CampbellCase> cases;
    cases.reserve(speeds.size());
    for (std::size_t i = 0; i < speeds.size(); ++i)
        cases.push_back({&fifth[i].system(), &fifth[i].rotor(), speeds[i] * units::rpm, speeds[i]});
    solvers::CampbellOptions campbell;
    campbell.method = solvers::CampbellMethod::coleman;
    campbell.max_frequency_hz = options.max_frequency;
    const solvers::Campbell diagram = solvers::campbell(cases, "rotor speed, rpm", campbell);
    std::cout << "\n" << solvers::table(diagram);
    for (const char* ending : {".svg", ".png"}) solvers::plot(diagram, machine.run.out + ending);
    std::printf("\nfiles: %s.svg, .png\n", machine.run.out.c_str());
    return 0;
}

}  // namespace cardan::electric
