#include "turbines/analysis/baseline_controller.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/metric.hpp"
#include "turbines/analysis/detail/rigid_rotor.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

// Of the NREL 5 MW machine, over its rated speed of 1.2671 rad/s and its rated torque.
constexpr double damping_ratio = 0.7, frequency_ratio = 0.6 / 1.2671, filter_ratio = 2 * pi * 0.25 / 1.2671;
constexpr double pitch_rate_ratio = 8 * units::degree / 1.2671, torque_rate_ratio = 15000 / 43093.55;
constexpr double rated_ratio = 0.99, slip = 0.1, largest_torque_ratio = 1.1, optimum_ratio = 1.3;

// A machine as far as its controller knows it.
struct Ratings {
    double ratio;   // of the gearbox
    double speed;   // of the generator, rad/s
    double torque;  // N m
    double rotor_speed() const { return speed / ratio; }
    double power() const { return torque * speed; }
};

[[noreturn]] void refuse(const char* quantity) {
    throw InputError("Controller::baseline()", quantity, "none, and the model names none",
                     "one, or another controller: SimulationSettings::controller");
}

Ratings ratings_of(const Machine& machine) {
    const ControllerGains& gains = machine.controller.gains;
    const double ratio = machine.description.drive_train.gear_ratio;
    const double speed = gains.rated_speed > 0 ? gains.rated_speed : machine.operation.rotor_speed * ratio;
    if (!(speed > 0)) refuse("rated speed of the machine [rad/s]");
    const double torque = gains.rated_torque > 0 ? gains.rated_torque : machine.operation.rated_power / speed;
    if (!(torque > 0)) refuse("MachineOperation::rated_power [W]");
    return {ratio, speed, torque};
}

bool is_nrel5mw(const Machine& machine) {
    const double rated = machine.operation.rotor_speed * machine.description.drive_train.gear_ratio;
    return machine.description.drive_train.gear_ratio == 97 &&
           std::abs(rated / nrel5mw_controller().reference_speed - 1) < 0.02;
}

// About the shaft, of all that turns with it, kg m^2.
double rotor_inertia(const Machine& machine) {
    AssemblyOptions options;
    options.blade_elements = options.tower_elements = 1;
    const Turbine turbine = assemble(machine.description, options);
    const Model& model = turbine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    Vector unit = Vector::Zero(model.size());
    unit(turbine.rotor().spin) = 1;
    return 2 * kinetic_energy(kin, unit);
}

std::vector<PitchGains> own_gains(const Machine& machine, const Ratings& rated) {
    const RigidRotor rotor(machine);
    const double inertia = rotor_inertia(machine), speed = rated.rotor_speed(), frequency = frequency_ratio * speed;
    const double wind = rotor.rated_wind(speed, rated.power());
    if (wind == 0) refuse("wind in which the rotor reaches rated power [m/s]");
    std::vector<PitchGains> rows;
    for (const double part : {1.1, 1.2, 1.35, 1.5, 1.7, 1.9, 2.1}) {
        const double pitch = rotor.pitch_for(rated.power(), part * wind, speed);
        const double falls = rotor.sensitivity(part * wind, speed, pitch) * rated.ratio;
        if (!(falls > 0) || (!rows.empty() && !(pitch > rows.back().pitch))) continue;
        rows.push_back({pitch, 2 * inertia * speed * damping_ratio * frequency / falls,
                        inertia * speed * frequency * frequency / falls});
    }
    if (rows.empty()) refuse("pitch that lowers the power [rad]");
    return rows;
}

// Torque over the square of the generator's speed at the best tip-speed ratio, N m s^2/rad^2.
double own_optimum(const Machine& machine, const Ratings& rated) {
    const RigidRotor rotor(machine);
    const double wind = rotor.radius() / rotor.ratio();  // in which it turns with 1 rad/s
    return rotor.power(wind, 1, machine.operation.pitch) / (rated.ratio * rated.ratio * rated.ratio);
}

void set_gains(const Machine& machine, const Ratings& rated, VariableSpeedParameters& p, std::string& from) {
    p.gains = machine.controller.gains.pitch_gains;
    if (!p.gains.empty()) return;
    p.gains = own_gains(machine, rated);
    from = text("gains of the pitch from the rotor's power over it, for a damping ratio of ", damping_ratio, " at ",
                frequency_ratio * rated.rotor_speed() / (2 * pi), " Hz");
}

// Rising speeds, whatever the limits of the machine are.
void set_speeds(const Machine& machine, const Ratings& rated, VariableSpeedParameters& p) {
    const double min = std::max(machine.controller.gains.min_speed, machine.operation.min_speed * rated.ratio);
    p.reference_speed = rated.speed;
    p.rated_speed = rated_ratio * rated.speed;
    p.slip = slip;
    // The parabola must end below rated torque, so that the line of the slip meets it below rated speed.
    p.optimal_gain = std::min(p.optimal_gain, 0.95 * rated.torque / (p.rated_speed * p.rated_speed));
    const double highest = p.torque_law().transition_speed();
    p.region_1_5_speed = std::min(min > 0 ? min : 0.4 * rated.speed, 0.9 * highest);
    p.region_2_speed = std::min(optimum_ratio * p.region_1_5_speed, (p.region_1_5_speed + highest) / 2);
}

double largest_fine_pitch(const Machine& machine) {
    double max = machine.operation.pitch;
    for (const PitchAtWind& one : machine.operation.min_pitch) max = std::max(max, one.pitch);
    for (const PitchAt& one : machine.operation.pitch_schedule) max = std::max(max, one.pitch);
    return max;
}

double first_of(double given, double otherwise) {
    return given > 0 ? given : otherwise;
}

}  // namespace

VariableSpeedParameters baseline_controller(const Machine& machine, const Report& report) {
    if (is_nrel5mw(machine)) {
        VariableSpeedParameters p = nrel5mw_controller();
        p.period = 0;
        report_remark(report, {Remark::Kind::taken, "controller: baseline, numbers of the NREL 5 MW machine's report"});
        return p;
    }
    const ControllerGains& gains = machine.controller.gains;
    const Ratings rated = ratings_of(machine);
    VariableSpeedParameters p;
    p.name = text("baseline controller of ", machine.description.name);
    p.corner_frequency = first_of(gains.corner_frequency, filter_ratio * rated.rotor_speed());
    p.rated_power = rated.power();
    p.constant_power = gains.constant_power;
    p.optimal_gain = gains.optimal_gain > 0 ? gains.optimal_gain : own_optimum(machine, rated);
    set_speeds(machine, rated, p);
    p.max_torque = std::max(gains.max_torque, largest_torque_ratio * rated.torque);
    p.max_torque_rate = first_of(gains.max_torque_rate, torque_rate_ratio * rated.torque);
    p.constant_power_pitch = largest_fine_pitch(machine) + 1 * units::degree;
    p.min_pitch = machine.operation.pitch;
    for (const PitchAt& one : machine.operation.pitch_schedule)
        p.min_pitches.push_back({one.rotor_speed * rated.ratio, one.pitch});
    p.max_pitch = first_of(gains.max_pitch, pi / 2);
    p.max_pitch_rate = first_of(gains.max_pitch_rate, pitch_rate_ratio * rated.rotor_speed());
    std::string from = text("gains of ", gains.source);
    set_gains(machine, rated, p, from);
    report_remark(report, {Remark::Kind::taken, text("controller: baseline, ", from)});
    return p;
}

}  // namespace cardan::turbines
