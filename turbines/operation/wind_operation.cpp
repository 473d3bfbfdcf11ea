#include "turbines/operation/wind_operation.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/periodic/steady_state.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr double pitch_step = 2 * units::degree;  // in search of a bracket
constexpr double max_pitch = pi / 2;
constexpr double power_error = 1e-6;  // of rated power
constexpr int max_secants = 6;

bool is_constant_in(const SteadyWind& wind) {
    return wind.is_uniform() && wind.direction == 0 && wind.upflow == 0 && wind.vertical == 0;
}

// Nothing in the machine depends on the azimuth: three or more equal blades, no gravity, a level shaft that stays so.
bool is_isotropic(const TurbineDescription& d, const AssemblyOptions& options) {
    const bool held = d.tower.rigid && d.yaw.rotation.is_rigid() && d.yaw.translation.is_rigid() &&
                      d.nacelle.tilt_bearing.is_rigid() && !d.platform && !options.shaft_beam;
    return d.has_equal_blades() && d.hub.is_balanced() && d.nacelle.tilt == 0 && held && options.gravity.isZero(0);
}

// What the next state is looked for from: the coefficients of a revolution.
Matrix start_from(const WindOperatingPoint& point) {
    return point.coefficients.size() > 0 ? point.coefficients : Matrix(point.revolution.front().q);
}

}  // namespace

Operation operation_at(const std::vector<Operation>& schedule, double wind) {
    if (schedule.empty()) throw InputError("schedule of operation", "number of rows", 0, "at least 1");
    for (std::size_t i = 1; i < schedule.size(); ++i)
        if (!(schedule[i].wind > schedule[i - 1].wind))
            throw InputError("schedule of operation", "wind speed [m/s]", schedule[i].wind, "ascending");
    const Operation &first = schedule.front(), &last = schedule.back();
    if (!(wind >= first.wind && wind <= last.wind))
        throw InputError("schedule of operation", "wind speed [m/s]", wind, text(first.wind, " ... ", last.wind));
    const auto next = std::ranges::find_if(schedule, [wind](const Operation& one) { return one.wind >= wind; });
    if (next == schedule.begin()) return first;
    const Operation &a = next[-1], &b = *next;
    const double t = (wind - a.wind) / (b.wind - a.wind);
    return {wind, (1 - t) * a.rotor_speed + t * b.rotor_speed, (1 - t) * a.pitch + t * b.pitch};
}

void VariableSpeed::check() const {
    constexpr const char* here = "operation at variable speed";
    require_positive(here, "tip-speed ratio", tip_speed_ratio);
    require_positive(here, "rated speed [rad/s]", rated_speed);
    require_positive(here, "rated power [W]", rated_power);
    if (!(min_rotor_speed >= 0 && min_rotor_speed <= rated_speed))
        throw InputError(here, "minimum rotor speed [rad/s]", min_rotor_speed,
                         text("0 ... ", rated_speed, ", the rated speed"));
    if (!std::isfinite(fine_pitch)) throw InputError(here, "fine pitch [rad]", fine_pitch, "finite");
}

double VariableSpeed::speed_at(double wind, double radius) const {
    return std::clamp(tip_speed_ratio * wind / radius, std::min(min_rotor_speed, rated_speed), rated_speed);
}

double best_tip_speed_ratio(const AeroBlade& blade, int blades, double cone, double pitch,
                            const RotorAirOptions& options) {
    const auto power = [&](double ratio) {
        return -rotor_coefficients(blade, blades, cone, ratio, pitch, options).power;
    };
    constexpr double step = 0.5;
    double best = 2;
    for (int i = 4; i <= 40; ++i)
        if (power(i * step) < power(best)) best = i * step;
    return boost::math::tools::brent_find_minima(power, best - step, best + step, 20).first;
}

WindOperation::WindOperation(TurbineDescription description, AssemblyOptions options, const AeroBlade& blade,
                             WindOperationOptions wind)
    : description_(std::move(description)),
      options_(std::move(wind)),
      constant_(is_isotropic(description_, options) && is_constant_in(options_.wind) &&
                !options_.support.tower.has_influence()) {
    options.pitch = 0;
    options.pitch_drives = true;
    turbine_ = assemble(description_, options);
    air_.emplace(*turbine_, blade, options_.wind, options_.air, options_.support);
    if (!options_.airfoils.empty()) air_ = air_->lagging({.airfoils = options_.airfoils, .airfoils_at_rest = true});
    if (options_.harmonics < 1) throw InputError("operation in the wind", "harmonics", options_.harmonics, ">= 1");
    if (options_.azimuths < 1) throw InputError("operation in the wind", "azimuths", options_.azimuths, ">= 1");
    options_.azimuths = std::max(options_.azimuths, air_->min_azimuths());
}

double WindOperation::radius() const {
    return air_->radius();
}

bool WindOperation::is_constant() const {
    return constant_;
}

MachineAir WindOperation::air_at(const Operation& operation) const {
    SteadyWind wind = options_.wind;
    wind.speed = operation.wind;
    return air_->in(wind);
}

Turbine WindOperation::machine(const Operation& operation) const {
    return air_at(operation).on(*turbine_);
}

// Means of the drives' coordinates, which are positive away from feather.
Matrix WindOperation::with_pitch(Matrix start, double pitch) const {
    const Model& model = turbine_->system().model;
    if (start.size() == 0) start = Matrix::Zero(model.size(), 1);
    for (const BodyId drive : turbine_->layout().pitch_drives) start(model.index(drive), 0) = -pitch;
    return start;
}

WindOperatingPoint WindOperation::solve(const Operation& operation, const Matrix& start) const {
    WindOperatingPoint point;
    point.operation = operation;
    const MachineAir air = air_at(operation);
    const Turbine windy = air.on(*turbine_);
    const Matrix from = with_pitch(start, operation.pitch);
    const int spin = windy.rotor().spin;
    const auto take = [&](const Outcome& outcome) {
        point.converged = outcome.converged;
        point.message = outcome.message;
    };
    try {
        if (constant_ || operation.rotor_speed == 0) {
            const solvers::SteadyState found = solvers::steady_state(
                windy.system(), spin, {.rotor_speed = operation.rotor_speed, .initial = from.col(0)});
            take(found);
            point.revolution = {found.at};
        } else {
            solvers::PeriodicOptions periodic;
            periodic.rotor_speed = operation.rotor_speed;
            periodic.harmonics = options_.harmonics;
            if (air.has_tower_influence()) periodic.samples = std::max(4 * (options_.harmonics + 1), options_.azimuths);
            periodic.start = from;
            periodic.cancelled = options_.cancelled;
            periodic.rotor = &windy.rotor();
            const solvers::PeriodicSteadyState found = solvers::harmonic_balance(windy.system(), spin, periodic);
            take(found);
            point.remainder = found.remainder;
            point.note = found.note;
            const bool begun = found.coefficients.size() > 0;  // else cancelled before there was anything
            for (int i = 0; begun && i < options_.azimuths; ++i)
                point.revolution.push_back(found.at(2 * pi * i / options_.azimuths));
            point.coefficients = found.coefficients;
        }
        if (point.converged) evaluate(point, air, windy);
    } catch (const NumericalError& error) {
        point.converged = false;
        point.message = error.what();
    }
    if (!point.converged)
        point.message = text("wind ", operation.wind, " m/s, ", operation.rotor_speed * units::to_rpm, " rpm, pitch ",
                             operation.pitch * units::to_degrees, " deg: ", point.message);
    return point;
}

void WindOperation::evaluate(WindOperatingPoint& point, const MachineAir& air, const Turbine& windy) const {
    const Model& model = windy.system().model;
    Workspace workspace(model);
    const double share = 1 / static_cast<double>(point.revolution.size());
    const AeroBlade& blade = air.blade();
    point.sections.assign(blade.sections(), {});
    for (const DynamicState& state : point.revolution) {
        const Kinematics kin = kinematics(model, state.q, workspace);
        const StateView at(state, kin);
        const MachineAir::Rotor rotor = air.rotor(at);
        point.power += share * rotor.power();
        point.thrust += share * rotor.force.x();
        point.torque += share * rotor.moment.x();
        const std::vector<SectionAir> sections = air.sections(at).front();
        for (std::size_t i = 0; i < sections.size(); ++i) {
            const SectionAir& one = sections[i];
            SectionMean& mean = point.sections[i];
            mean.position = blade.position[i];
            mean.axial += share * one.induction.axial;
            mean.tangential += share * one.induction.tangential;
            mean.inflow += share * one.induction.phi;
            mean.attack += share * one.force.attack;
            mean.speed +=
                share * std::hypot(one.V_x * (1 - one.induction.axial), one.V_y * (1 + one.induction.tangential));
            mean.normal += share * one.force.normal;
            mean.driving += share * one.force.driving;
            mean.moment += share * one.force.moment;
        }
    }
    const double R = radius(), V = point.operation.wind, pressure = options_.wind.density / 2 * pi * R * R * V * V;
    if (V > 0) {
        point.power_coefficient = point.power / (pressure * V);
        point.thrust_coefficient = point.thrust / pressure;
        point.tip_speed_ratio = point.operation.rotor_speed * R / V;
    }
}

// From the last state that was found, in one step or in parts.
WindOperatingPoint WindOperation::at(const Operation& operation) {
    WindOperatingPoint point = solve(operation, last_);
    const auto cancelled = [&] { return options_.cancelled && options_.cancelled(); };
    if (!point.converged && last_operation_ && !cancelled()) {
        const Operation from = *last_operation_;
        for (int parts = 2; parts <= 32 && !point.converged; parts *= 2) {
            Matrix start = last_;
            for (int i = 1; i <= parts; ++i) {
                const double t = static_cast<double>(i) / parts;
                const auto between = [t](double a, double b) { return (1 - t) * a + t * b; };
                point = solve({between(from.wind, operation.wind), between(from.rotor_speed, operation.rotor_speed),
                               between(from.pitch, operation.pitch)},
                              start);
                if (!point.converged) break;
                start = start_from(point);
            }
        }
    }
    if (point.converged) {
        last_ = start_from(point);
        last_operation_ = point.operation;
    }
    return point;
}

void WindOperation::keep_rated(const RatedPitch& found) {
    if (rated_.size() == 2) rated_.erase(rated_.begin());
    rated_.push_back(found);
}

// From the pitch that the last two winds point to. Nothing where that is out of range or does not settle at once: the
// search of a bracket is slower and finds it anyway.
std::optional<WindOperatingPoint> WindOperation::at_rated_by_secants(double wind, const VariableSpeed& law) {
    if (rated_.empty()) return std::nullopt;
    const RatedPitch &before = rated_.front(), &last = rated_.back();
    const double rise = last.wind == before.wind ? 0 : (last.pitch - before.pitch) / (last.wind - before.wind);
    double pitch = last.pitch + rise * (wind - last.wind), slope = last.slope, pitch_before = pitch, excess_before = 0;
    for (int i = 0; i < max_secants; ++i) {
        if (!(pitch >= law.min_pitch_at(wind) && pitch <= max_pitch)) return std::nullopt;
        WindOperatingPoint point = at({wind, law.rated_speed, pitch});
        if (!point.converged) return std::nullopt;
        const double excess = point.power / law.rated_power - 1;
        if (i > 0 && pitch != pitch_before) slope = (excess - excess_before) / (pitch - pitch_before);
        if (!(slope < 0)) return std::nullopt;
        if (std::abs(excess) < power_error) {
            keep_rated({wind, pitch, slope});
            return point;
        }
        pitch_before = pitch;
        excess_before = excess;
        pitch -= excess / slope;
    }
    return std::nullopt;
}

// The power falls as the blades turn to feather: from the pitch before, on either side, until it has changed its sign.
WindOperatingPoint WindOperation::at_rated(double wind, const VariableSpeed& law) {
    if (std::optional<WindOperatingPoint> found = at_rated_by_secants(wind, law)) return *std::move(found);
    WindOperatingPoint point;
    RatedPitch last{.wind = wind, .pitch = 0, .slope = 0};
    double excess_before = 0;
    const auto excess = [&](double pitch) {
        point = at({wind, law.rated_speed, pitch});
        require_result(point);
        const double own = point.power / law.rated_power - 1;
        if (pitch != last.pitch) last.slope = (own - excess_before) / (pitch - last.pitch);
        last.pitch = pitch;
        excess_before = own;
        return own;
    };
    const double min = law.min_pitch_at(wind);
    double low = std::max(min, last_operation_ ? last_operation_->pitch : min), at_low = excess(low), high = low,
           at_high = at_low;
    while (at_low < 0 && low > min) {
        high = low;
        at_high = at_low;
        low = std::max(min, low - pitch_step);
        at_low = excess(low);
    }
    if (at_low <= 0) return point;
    while (at_high > 0) {
        if (high >= max_pitch)
            throw NumericalError(text("no pitch up to 90 deg brings the power down to ", law.rated_power, " W"));
        low = high;
        at_low = at_high;
        high = std::min(max_pitch, high + pitch_step);
        at_high = excess(high);
    }
    std::uintmax_t iterations = 50;
    const auto close = [&](double, double) { return std::abs(point.power / law.rated_power - 1) < power_error; };
    boost::math::tools::toms748_solve(excess, low, high, at_low, at_high, close, iterations);
    keep_rated(last);
    return point;
}

WindOperatingPoint WindOperation::at(double wind, const VariableSpeed& law) {
    law.check();
    const double speed = law.speed_at(wind, radius());
    const double min = law.min_pitch_at(wind);
    // Beyond rated wind the minimum pitch may be far from where the machine runs.
    const bool beyond = last_operation_ && last_operation_->pitch > min && speed == law.rated_speed;
    WindOperatingPoint point;
    if (!beyond) point = at({wind, speed, min});
    if (point.converged && point.power <= law.rated_power) return point;
    try {
        return at_rated(wind, law);
    } catch (const NumericalError& error) {
        point.operation.wind = wind;
        point.converged = false;
        point.message = error.what();
        return point;
    }
}

std::vector<WindOperatingPoint> WindOperation::over(const std::vector<Operation>& schedule) {
    std::vector<WindOperatingPoint> points;
    points.reserve(schedule.size());
    for (const Operation& one : schedule) {
        points.push_back(at(one));
        if (options_.progress && !options_.progress(points.back())) break;
    }
    return points;
}

std::vector<WindOperatingPoint> WindOperation::over(const std::vector<double>& winds, const VariableSpeed& law) {
    std::vector<WindOperatingPoint> points;
    points.reserve(winds.size());
    for (const double wind : winds) {
        points.push_back(at(wind, law));
        if (options_.progress && !options_.progress(points.back())) break;
    }
    return points;
}

}  // namespace cardan::turbines
