#include "solvers/linear_models/state_space.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/equilibrium/detail/closed_start.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/problem_size.hpp"
#include "solvers/linear_models/detail/state_space.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cardan::solvers {

namespace {

using detail::Directions;
using detail::Layout;
using detail::OutputDifferences;
using Index = Eigen::Index;

class Builder {
public:
    Builder(const System& system, const RotorMap& rotor, const std::vector<LinearInput>& inputs,
            const std::vector<ChannelGroup>& outputs, const StateSpaceOptions& options)
        : system_(system),
          rotor_(rotor),
          layout_(system, rotor, inputs, options),
          differences_(system, outputs, options.outputs),
          lineariser_(system, LoopState::in_motion),
          workspace_(system.model) {}

    /// With loops: what is independent on the way of the steady states.
    void choose_states(const std::vector<DynamicState>& points);
    /// Those of the steady state, where they are not given.
    void set_multipliers(DynamicState& at);
    LinearModel empty(double rotor_speed) const;
    /// @param at  steady state; its states stand still unless it has their rates
    void add(const DynamicState& at, double psi, LinearModel& model);
    void finish(LinearModel& model) const;

private:
    Vector missing_forces(const DynamicState& at, Vector& state_rates);
    void follow();
    void solve(const Matrix& right);
    void solve_with_loops(const Matrix& right);
    void find_forces(LinearModel& model);

    const System& system_;
    const RotorMap& rotor_;
    Layout layout_;
    OutputDifferences differences_;
    Lineariser lineariser_;
    Workspace workspace_;
    Linearisation lin_;
    Directions directions_;
    Vector state_rates_;
    Vector error_, size_;  // of the outputs' differences
};

LinearModel Builder::empty(double rotor_speed) const {
    LinearModel model;
    model.machine = rotor_.machine;
    model.description = rotor_.description;
    std::vector<std::string> free;
    for (const Signal& input : layout_.input_signals) free.push_back(input.name);
    if (const std::string held = held_inputs(system_.forces, free); !held.empty()) model.description += "\n" + held;
    model.rotor_speed = rotor_speed;
    model.blades = static_cast<int>(rotor_.blades.size());
    model.states = layout_.state_signals;
    model.inputs = layout_.input_signals;
    model.outputs = differences_.signals();
    model.coordinates = layout_.coordinates;
    model.first_order = static_cast<int>(layout_.first_order());
    return model;
}

void Builder::choose_states(const std::vector<DynamicState>& points) {
    std::vector<Linearisation> way(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) lineariser_.linearise(points[i], way[i]);
    layout_.keep_independent(independent_on_the_way(way, layout_.unknowns, rotor_.spin));
}

// Inertial less applied forces of all coordinates, and the rates of the states.
Vector Builder::missing_forces(const DynamicState& at, Vector& state_rates) {
    const Kinematics kin = kinematics(system_.model, at.q, workspace_);
    Vector tau(at.q.size()), Q(at.q.size());
    inverse_dynamics<double>(kin, at.qd, at.qdd, tau);
    state_rates.resize(layout_.first_order());
    system_.forces.generalised_forces({at, kin}, Q, state_rates);
    return tau - Q;
}

void Builder::set_multipliers(DynamicState& at) {
    if (system_.loops.empty() || at.lambda.size() > 0) return;
    if (at.s.size() == 0) at.s = system_.forces.states().initial();
    if (at.u.size() == 0) at.u = system_.forces.inputs().initial();
    at.lambda = loop_start(system_, rotor_.spin, at.time, at.q, missing_forces(at, state_rates_)).lambda;
}

// Positions and rates of the unknowns that follow: G q = 0, G qd + G' q = 0.
void Builder::follow() {
    const std::vector<int>& f = layout_.followers;
    const Matrix& G = lin_.constraints;
    directions_.q(f, Eigen::all) = solvers::follow(G, f, G * directions_.q);
    directions_.qd(f, Eigen::all) = solvers::follow(G, f, G * directions_.qd + lin_.constraint_rates * directions_.q);
}

// Accelerations of the unknowns along every direction, and forces of drives:
// M qdd + C qd + K q = Q + actuator, zero on the unknowns.
void Builder::solve(const Matrix& right) {
    const std::vector<int>&f = layout_.unknowns, &d = layout_.driven;
    const Matrix M = lin_.mass(f, f);
    const Eigen::LLT<Matrix> mass(M);
    if (mass.info() != Eigen::Success)
        throw NumericalError(
            text(in_linear_model, ": the mass matrix of the free coordinates is not positive definite"));
    const Matrix accelerations = mass.solve(Matrix(right(f, Eigen::all)));
    directions_.qdd(f, Eigen::all) = accelerations;
    if (!directions_.qdd.allFinite()) throw NumericalError(text(in_linear_model, ": accelerations are not finite"));
    // `right` holds the prescribed accelerations already.
    directions_.actuator(d, Eigen::all) = Matrix(lin_.mass(d, f)) * accelerations - Matrix(right(d, Eigen::all));
}

// The same where G qdd + 2 G' qd + G'' q = 0: M qdd = right + G^T lambda.
void Builder::solve_with_loops(const Matrix& right) {
    const std::vector<int>&f = layout_.unknowns, &d = layout_.driven;
    const Matrix& G = lin_.constraints;
    // What the other directions ask of those that follow, before the independent ones accelerate.
    const Matrix right_of_followers = G * directions_.qdd + 2 * lin_.constraint_rates * directions_.qd +
                                      lin_.constraint_accelerations * directions_.q;
    directions_.qdd(layout_.followers, Eigen::all) = solvers::follow(G, layout_.followers, right_of_followers);
    const Matrix asked = directions_.qdd(f, Eigen::all), M = lin_.mass(f, f);
    const Matrix Z = following(G, f, layout_.independent);
    const Eigen::LLT<Matrix> mass(Matrix(Z.transpose() * M * Z));
    if (mass.info() != Eigen::Success)
        throw NumericalError(
            text(in_linear_model, ": the mass matrix where loops are closed is not positive definite"));
    const Matrix load = right(f, Eigen::all);
    const Matrix accelerations = asked + Z * mass.solve(Matrix(Z.transpose() * (load - M * asked)));
    directions_.qdd(f, Eigen::all) = accelerations;
    if (!accelerations.allFinite()) throw NumericalError(text(in_linear_model, ": accelerations are not finite"));
    directions_.lambda = multipliers_on(G, f, M * accelerations - load);
    directions_.actuator(d, Eigen::all) = Matrix(lin_.mass(d, f)) * accelerations - Matrix(right(d, Eigen::all)) -
                                          Matrix(G(Eigen::all, d).transpose()) * directions_.lambda;
}

// What the drives, that of the spin among them, carry at the operating point, and what no drive carries.
void Builder::find_forces(LinearModel& model) {
    Vector missing = missing_forces(lin_.at, state_rates_);
    if (!system_.loops.empty()) missing -= lin_.constraints.transpose() * lin_.at.lambda;
    Vector& actuator = lin_.at.actuator;
    actuator = Vector::Zero(missing.size());
    for (int i : layout_.driven) actuator(i) = missing(i);
    Vector on_unknowns = missing(layout_.unknowns);
    for (Index row = 0; row < on_unknowns.size(); ++row)
        if (entry(layout_.unknowns, row) == rotor_.spin) {
            actuator(rotor_.spin) = missing(rotor_.spin);
            on_unknowns(row) = 0;
        }
    const Matrix M = lin_.mass(layout_.unknowns, layout_.unknowns);
    const Vector off = M.llt().solve(on_unknowns);
    if (off.size() > 0) model.imbalance = std::max(model.imbalance, off.cwiseAbs().maxCoeff());
    // States that do not move as they should, by their scales, in a second.
    const Vector& rates = lin_.at.s_rate;
    for (int i = 0; const StateInfo& state : system_.forces.states()) {
        const double moves = rates.size() > 0 ? rates(i) : 0.0;
        const double rate = state.kind == StateKind::angle ? 0 : std::abs(state_rates_(i) - moves) / state.scale;
        model.imbalance = std::max(model.imbalance, rate);
        ++i;
    }
}

void Builder::add(const DynamicState& at, double psi, LinearModel& model) {
    lineariser_.linearise(at, lin_);
    layout_.begin(kinematics(system_.model, at.q, workspace_), directions_);
    const bool loops = !system_.loops.empty();
    if (loops) follow();
    // Prescribed accelerations stand in qdd already; the others are zero and follow.
    Matrix right = directions_.Q - lin_.mass * directions_.qdd - lin_.velocity() * directions_.qd -
                   lin_.stiffness() * directions_.q;
    const StateDerivatives& d = lin_.state_derivatives;
    if (system_.forces.has_states()) {
        right += d.Q_s * directions_.s + d.Q_u * directions_.u;
        directions_.s_rate =
            d.f_q * directions_.q + d.f_qd * directions_.qd + d.f_s * directions_.s + d.f_u * directions_.u;
    }
    if (loops)
        solve_with_loops(right);
    else
        solve(right);
    find_forces(model);

    const Index states = layout_.states(), half = std::ssize(layout_.coordinates), first = layout_.first_order(),
                inputs = layout_.columns() - states;
    LinearSample sample;
    sample.azimuth = psi;
    sample.time = at.time;
    Matrix rates(states, layout_.columns());
    rates.topRows(half) = directions_.qd(layout_.coordinates, Eigen::all);
    rates.middleRows(half, half) = directions_.qdd(layout_.coordinates, Eigen::all);
    if (first > 0) rates.bottomRows(first) = directions_.s_rate;
    sample.A = rates.leftCols(states);
    sample.B = rates.rightCols(inputs);
    sample.x.resize(states);
    sample.x << at.q(layout_.coordinates), at.qd(layout_.coordinates), lin_.at.s;
    sample.xdot.resize(states);
    sample.xdot << at.qd(layout_.coordinates), at.qdd(layout_.coordinates), state_rates_;
    sample.u = layout_.input_values(at);
    sample.y = differences_.at(lin_.at, system_.forces);
    const Matrix slopes = differences_.along(lin_.at, directions_, layout_, error_, size_);
    sample.C = slopes.leftCols(states);
    sample.D = slopes.rightCols(inputs);

    model.samples.push_back(std::move(sample));
}

void Builder::finish(LinearModel& model) const {
    model.output_error = Vector::Zero(size_.size());
    for (Index i = 0; i < size_.size(); ++i)
        if (size_(i) > 0) model.output_error(i) = error_(i) / size_(i);
}

// @param steady  the steady state at an azimuth
LinearModel build(const System& system, const RotorMap& rotor, double rotor_speed, int azimuths,
                  const std::function<DynamicState(double psi)>& steady, double first,
                  const std::vector<LinearInput>& inputs, const std::vector<ChannelGroup>& outputs,
                  const StateSpaceOptions& options) {
    check_number_of_unknowns(rotor.machine, system.model.coordinates().free().size());
    Builder builder(system, rotor, inputs, outputs, options);
    const auto azimuth = [&](int s) { return azimuths == 1 ? first : 2 * pi * s / azimuths; };
    const auto at = [&](int s) {
        DynamicState now = steady(azimuth(s));
        builder.set_multipliers(now);
        return now;
    };
    if (!system.loops.empty()) {
        std::vector<DynamicState> way;
        way.reserve(static_cast<std::size_t>(azimuths));
        for (int s = 0; s < azimuths; ++s) way.push_back(at(s));
        builder.choose_states(way);
    }
    LinearModel model = builder.empty(rotor_speed);
    for (int s = 0; s < azimuths; ++s) {
        const double psi = azimuth(s);
        builder.add(at(s), psi, model);
    }
    builder.finish(model);
    return model;
}

}  // namespace

LinearModel state_space(const System& system, const RotorMap& rotor, const PeriodicSteadyState& about,
                        const std::vector<LinearInput>& inputs, const std::vector<ChannelGroup>& outputs,
                        const StateSpaceOptions& options) {
    if (!about.converged) throw InputError(in_linear_model, "periodic steady state", "not converged", "converged");
    if (about.coefficients.rows() != system.model.size() || about.spin != rotor.spin || rotor.spin < 0)
        throw InputError(in_linear_model, "coordinates and spin of the periodic steady state",
                         text(about.coefficients.rows(), ", ", about.spin),
                         text(system.model.size(), ", ", rotor.spin));
    if (about.state_coefficients.rows() != system.forces.states().size())
        throw InputError(in_linear_model, "states of the periodic steady state", about.state_coefficients.rows(),
                         text("those of the system, ", system.forces.states().size()));
    if (options.azimuths < 3) throw InputError(in_linear_model, "number of azimuths", options.azimuths, ">= 3");
    return build(
        system, rotor, about.rotor_speed, options.azimuths, [&](double psi) { return about.at(psi); }, 0, inputs,
        outputs, options);
}

LinearModel state_space(const System& system, const RotorMap& rotor, const DynamicState& about,
                        const std::vector<LinearInput>& inputs, const std::vector<ChannelGroup>& outputs,
                        const StateSpaceOptions& options) {
    for (const Vector* v : {&about.q, &about.qd, &about.qdd})
        if (v->size() != system.model.size() || !v->allFinite())
            throw InputError(in_linear_model, "coordinates of the operating point", v->size(),
                             text(system.model.size(), ", all finite"));
    if (rotor.spin >= system.model.size())
        throw InputError(in_linear_model, "index of the spin coordinate", rotor.spin,
                         text("-1 ... ", system.model.size() - 1));
    const double speed = rotor.spin < 0 ? 0 : about.qd(rotor.spin), first = rotor.spin < 0 ? 0 : about.q(rotor.spin);
    const int azimuths = speed == 0 ? 1 : options.azimuths;
    if (speed != 0 && azimuths < 3) throw InputError(in_linear_model, "number of azimuths", azimuths, ">= 3");
    const auto at = [&](double psi) {
        DynamicState turned = about;
        turned.s_rate.resize(0);
        if (speed == 0) return turned;
        turned.q(rotor.spin) = psi;
        turned.time = psi / speed;
        return turned;
    };
    return build(system, rotor, speed, azimuths, at, first, inputs, outputs, options);
}

}  // namespace cardan::solvers
