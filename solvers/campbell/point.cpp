#include "solvers/campbell/point.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "mbs/loops/closure.hpp"
#include "solvers/campbell/detail/floquet_point.hpp"
#include "solvers/campbell/detail/rotor_speed.hpp"
#include "solvers/linear/coordinate_rows.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/problem_size.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace cardan::solvers {

namespace {

// What all methods need but Floquet's, if the rotor turns.
void require_constant_rows(const RotorMap& rotor, const std::vector<int>& unknowns) {
    const std::size_t blades = rotor.blades.size();
    if (blades == 2)
        throw InputError(rotor.machine, "number of blades", blades,
                         "3 or more, or 1 (two blades have a periodic system: CampbellMethod::floquet)");
    if (const std::string why = without_multi_blade_coordinates(rotor, unknowns); !why.empty())
        throw InputError(rotor.machine, "multi-blade coordinates", text("none (", why, ")"),
                         "blades at equal angles, all with the same free coordinates; else CampbellMethod::floquet or "
                         "automatic");
}

std::vector<int> unknowns_of(const System& system, const RotorMap& rotor, const CampbellOptions& options) {
    check(rotor, system.model);
    const bool spin_is_unknown = options.spin == RotorSpin::free && !rotor.hub_is_driven;
    std::vector<int> unknowns = system.model.coordinates().free_without(spin_is_unknown ? -1 : rotor.spin);
    check_number_of_unknowns(rotor.machine, unknowns.size());
    if (rotor.spin >= 0 && options.method != CampbellMethod::floquet) require_constant_rows(rotor, unknowns);
    return unknowns;
}

// The coordinate alone, beside the lowest: ten times what no certain mode has.
constexpr double rigid_ratio = 10 * max_reliable_ratio;

}  // namespace

double lowest_vibration(const std::vector<CampbellMode>& modes) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const CampbellMode& m : modes)
        if (m.kind() != FloquetKind::rigid && m.mode.oscillates())
            lowest = std::min(lowest, std::abs(m.mode.eigenvalue));
    return lowest;
}

void set_stability_margin(CampbellPoint& point) {
    const double lowest = lowest_vibration(point.modes);
    double growth = -std::numeric_limits<double>::infinity();
    for (const CampbellMode& m : point.modes) {
        const double size = std::abs(m.mode.eigenvalue), own = m.mode.eigenvalue.real();
        if (m.kind() == FloquetKind::rigid || size > max_reliable_ratio * lowest) continue;
        const double scale = std::isfinite(lowest) ? std::max(size, lowest) : size;
        growth = std::max(growth, std::abs(own) < 1e-8 * scale ? 0 : own);
    }
    for (const StateMotion& motion : point.state_motions) growth = std::max(growth, motion.mode.eigenvalue.real());
    point.stability_margin = growth == 0 ? 0 : -growth;
}

StateMotion state_motion(Mode mode, const Vector& scales) {
    StateMotion out{.mode = std::move(mode)};
    (out.mode.states.cwiseAbs().array() / scales.array()).maxCoeff(&out.state);
    return out;
}

PointSolver::PointSolver(const System& system, const RotorMap& rotor, const CampbellOptions& options)
    : system_(system),
      rotor_(rotor),
      options_(options),
      unknowns_(unknowns_of(system, rotor, options)),
      steady_solver_(system, rotor.spin),
      lineariser_(system) {
    if (!system.loops.empty()) reduce_unknowns();
    plain_rows_.resize(unknowns_.size());
    const bool disc = rotor.blades.empty() && rotor.spin >= 0 && !rotor.rotating_pairs.empty();
    const bool blades = rotor.blades.size() > 1 && without_multi_blade_coordinates(rotor, unknowns_).empty();
    if (disc || blades) coleman_.emplace(rotor, unknowns_, system.forces.states());
}

// With loops: the coordinates that are independent where these are closed.
void PointSolver::reduce_unknowns() {
    ClosureOptions options;
    if (rotor_.spin >= 0) options.fixed = {rotor_.spin};
    const Vector zero = Vector::Zero(system_.model.size());
    const Closure closed = close_loops(system_.model, system_.loops, zero, options);
    require_result(closed, rotor_.machine);
    lineariser_.linearise(at_rest(closed.q), lin_);
    moving_ = unknowns_;
    unknowns_ = independent_coordinates(lin_, moving_, rotor_.spin);
    if (rotor_.blades.size() > 1 && options_.method != CampbellMethod::floquet)
        require_constant_rows(rotor_, unknowns_);
}

void PointSolver::linearise(const DynamicState& at) {
    lineariser_.linearise(at, lin_);
    if (!moving_.empty()) condense_loops(lin_, moving_, unknowns_);
}

Linearisation PointSolver::linearised_at(const DynamicState& at) const {
    Linearisation lin = solvers::linearise(system_, at, LoopState::in_motion);
    condense_loops(lin, moving(), unknowns_);
    return lin;
}

Matrix PointSolver::followers(const DynamicState& at) const {
    if (moving_.empty()) return {};
    Workspace workspace(system_.model);
    Matrix G(system_.loops.size(), system_.model.size());
    system_.loops.gradient<double>(kinematics(system_.model, at.q, workspace), at.time, at.q, G);
    const Matrix shape = following(G, moving_, unknowns_);
    Matrix all = Matrix::Zero(G.cols(), shape.cols());
    for (Eigen::Index i = 0; i < shape.rows(); ++i) all.row(entry(moving_, i)) = shape.row(i);
    return all;
}

// A constant state: from the mean of a periodic one.
void PointSolver::start_from(const Matrix& coordinates, const Matrix& states) {
    if (coordinates.size() > 0) steady_options_.initial = coordinates.col(0);
    if (states.size() > 0) steady_options_.states = states.col(0);
}

void PointSolver::find_steady_state(double rotor_speed) {
    steady_options_.rotor_speed = rotor_speed;
    if (options_.balanced && rotor_speed != 0 && rotor_.spin >= 0) steady_options_.trim.emplace();
    steady_solver_.solve(steady_options_, steady_);
    require_result(steady_, [&] { return text(rotor_.machine, " at ", rotor_speed * units::to_rpm, " rpm"); });
    steady_options_.initial = steady_.at.q;
    steady_options_.states = steady_.at.s;
}

// At the first point: the components, and memory that it may not need itself (nothing is averaged at standstill).
void PointSolver::start() {
    if (!energy_shares_) define_components(lin_);
    restrict_to(lin_, unknowns_, rotor_.spin, other_);
    turned_ = steady_.at;
    note_rigid_springs();
}

// A spring meant to be rigid: where its coordinate alone would vibrate beyond what eigenvalues can tell.
void PointSolver::note_rigid_springs() {
    Vector omega(other_.M.rows());
    for (Eigen::Index i = 0; i < omega.size(); ++i) omega(i) = std::sqrt(other_.K_elastic(i, i) / other_.M(i, i));
    double lowest = std::numeric_limits<double>::infinity();
    for (double w : omega)
        if (w > 0) lowest = std::min(lowest, w);
    std::string names;
    for (Eigen::Index i = 0; i < omega.size(); ++i)
        if (const int k = entry(unknowns_, i); omega(i) > rigid_ratio * lowest)
            names += text(names.empty() ? "'" : ", '", system_.forces.stiffest_law(k), "' (", other_.K_elastic(i, i),
                          " on the coordinate '", system_.model.coordinates()[k].name, "')");
    if (!names.empty())
        warning_ =
            text("springs so stiff that growth and decay of their modes are rounding: ", names,
                 "; such modes count for no stability margin. Drive the coordinate instead, or let it be softer");
}

void PointSolver::define_components(const Linearisation& lin) {
    energy_shares_.emplace(lin, system_.model, rotor_, unknowns_, rows());
}

// Eigenvalues at a frozen azimuth tell nothing about stability.
void PointSolver::set_margin(CampbellPoint& point) const {
    const bool motions = options_.method != CampbellMethod::frozen_azimuth || rotor_.blades.size() < 3;
    if (motions)
        set_stability_margin(point);
    else
        point.stability_margin = std::numeric_limits<double>::quiet_NaN();
}

void PointSolver::solve(double rotor_speed, CampbellPoint& point) {
    find_steady_state(rotor_speed);
    if (steady_options_.trim) rotor_speed = steady_.at.qd(rotor_.spin);
    linearise(steady_.at);
    if (turned_.q.size() == 0) start();
    set_system(rotor_speed);
    point.rotor_speed = rotor_speed;
    point.at = steady_.at;
    if (!mode_solver_) mode_solver_.emplace(std::ssize(unknowns_), system_.forces.states().size());
    set_modes(mode_solver_->solve(current_, range_.largest(options_, rotor_speed, current_)), point);
    range_.set(point.modes, rotor_speed);
    if (rotor_speed == 0 && blades_stand_out()) set_blade_shares(point);
    point.periodic.reset();
    set_margin(point);
}

// Those of the solver, and motions of states apart.
void PointSolver::set_modes(std::size_t count, CampbellPoint& point) {
    const auto is_motion_of_states = [&](std::size_t i) { return mode_solver_->state_share(i) >= 0.5; };
    point.state_motions.clear();
    for (std::size_t i = 0; i < count; ++i)
        if (is_motion_of_states(i)) {
            Mode mode;
            mode_solver_->copy(i, mode);
            point.state_motions.push_back(state_motion(std::move(mode), current_.states.scales));
        }
    set_count(point.modes, count - point.state_motions.size());
    for (std::size_t i = 0, next = 0; i < count; ++i) {
        if (is_motion_of_states(i)) continue;
        CampbellMode& m = point.modes[next++];
        mode_solver_->copy(i, m.mode);
        mode_solver_->energy_by_row(i, m.row_shares);
        energy_shares_->shares(m.mode, m.shares);
        // In a closed loop the rotor oscillates with hardly any spring.
        m.row = -1;
        if (current_.states.size() > 0) {
            const int spin = row_of(unknowns_, rotor_.spin);
            m.row = is_motion_of_speed(current_, m.mode, spin) ? spin : naming_row(current_, m.mode);
        }
        m.floquet.reset();
        m.blade_shares.resize(0);
    }
}

bool PointSolver::blades_stand_out() const {
    return rotor_.blades.size() > 1 && (energy_shares_->blades_differ() || !rotor_.evenly_spaced || !coleman_);
}

void PointSolver::set_blade_shares(CampbellPoint& point) const {
    const Matrix T = rotating_coordinates();
    for (CampbellMode& m : point.modes) {
        const ComplexVector shape = T * m.mode.shape;
        m.blade_shares = blade_energies(lin_, shape);
        if (const double sum = m.blade_shares.sum(); sum > 0) m.blade_shares /= sum;
    }
}

Vector PointSolver::blade_energies(const Linearisation& lin, const ComplexVector& shape) const {
    Vector energies = Vector::Zero(std::ssize(rotor_.blades));
    for (Eigen::Index k = 0; k < energies.size(); ++k) {
        const std::vector<int> rows = rows_of(unknowns_, entry(rotor_.blades, k));
        std::vector<int> own;
        own.reserve(rows.size());
        for (const int row : rows) own.push_back(entry(unknowns_, row));
        energies(k) = hermitian_form(Matrix(lin.elastic(own, own)), ComplexVector(shape(rows)));
    }
    return energies;
}

// The number of modes varies with rotor speed (a pair may turn into two aperiodic motions). Memory of modes that
// disappear is kept here, and there is memory for the largest possible number.
void PointSolver::set_count(std::vector<CampbellMode>& modes, std::size_t count) {
    const std::size_t most = 2 * unknowns_.size() + static_cast<std::size_t>(system_.forces.states().size());
    modes.reserve(most);
    spare_.reserve(most);
    const auto n = std::ssize(unknowns_);
    const std::size_t components = energy_shares_->components().size();
    const auto higher = static_cast<std::size_t>(energy_shares_->harmonics() - 1);
    while (modes.size() + spare_.size() < most) {
        CampbellMode& blank = spare_.emplace_back();
        blank.mode.shape.resize(n);
        blank.row_shares.resize(n);
        blank.shares.resize(components);
        for (EnergyFraction& share : blank.shares) share.higher.reserve(higher);
    }
    for (; modes.size() < count; spare_.pop_back()) modes.push_back(std::move(spare_.back()));
    for (; modes.size() > count; modes.pop_back()) spare_.push_back(std::move(modes.back()));
}

void PointSolver::set_system(double rotor_speed) {
    restrict_to(lin_, unknowns_, rotor_.spin, current_);
    const bool frozen = options_.method == CampbellMethod::frozen_azimuth;
    if (coleman_) coleman_->transform_in_place(current_, 0, frozen ? 0 : rotor_speed);
    if (frozen || rotor_speed == 0 || rotor_.spin < 0) return;
    const double changing = remainder(rotor_speed);
    if (changing < negligible_remainder) return;
    if (coleman_)
        take_mean(rotor_speed, changing);
    else if (!warned_of("not constant"))
        warn(text("the equations are not constant, although there is no rotor to transform: they change by ", changing,
                  " (relative) with the azimuth, and those of azimuth 0 are used, which describe no motion of the "
                  "machine. Take CampbellMethod::floquet"));
}

void PointSolver::set_at_azimuth(double psi, double rotor_speed, SecondOrderSystem& out) {
    turned_ = steady_.at;
    turned_.q(rotor_.spin) += psi;
    linearise(turned_);
    restrict_to(lin_, unknowns_, rotor_.spin, out);
    if (coleman_) coleman_->transform_in_place(out, psi, rotor_speed);
}

double PointSolver::remainder(double rotor_speed) {
    const SecondOrderSystem& z = current_;
    set_at_azimuth(1.0, rotor_speed, other_);
    // Derivatives of elements with states may be differences, good to some nine digits.
    const double states = relative_change(other_.states, z.states, std::abs(rotor_speed));
    return (other_.K - z.K).norm() / std::max(z.K.norm(), std::numeric_limits<double>::min()) +
           (other_.M - z.M).norm() / z.M.norm() + (states > 1e-7 ? states : 0);
}

double PointSolver::periodic_remainder(double rotor_speed) {
    find_steady_state(rotor_speed);
    if (steady_options_.trim) rotor_speed = steady_.at.qd(rotor_.spin);
    linearise(steady_.at);
    if (turned_.q.size() == 0) start();
    restrict_to(lin_, unknowns_, rotor_.spin, current_);
    if (coleman_) coleman_->transform_in_place(current_, 0, rotor_speed);
    return remainder(rotor_speed);
}

// The transformed matrices of an isotropic rotor are constant; otherwise their azimuthal average is used, with a
// warning. The steady state is the constant one of this solver: only the rotor is turned. PeriodicPointSolver and
// azimuth_average() take the periodic one.
void PointSolver::take_mean(double rotor_speed, double remainder) {
    const int azimuths = std::max(24, 2 * static_cast<int>(rotor_.blades.size()) + 1);
    const auto at = [&](int i, SecondOrderSystem& out) { set_at_azimuth(2 * pi * i / azimuths, rotor_speed, out); };
    average(azimuths, at, current_, other_);
    if (!warned_of("not isotropic"))
        warn(text("the rotor is not isotropic: the multi-blade system keeps a periodic remainder of ", remainder,
                  " (relative); its mean over the azimuth is used, which is an approximation"));
}

bool PointSolver::warned_of(std::string_view what) const {
    return warning_.find(what) != std::string::npos;
}

void PointSolver::warn(const std::string& what) {
    warning_ += text(warning_.empty() ? "" : "; ", what);
}

std::vector<std::string> PointSolver::row_names() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
        const MultiBladeRow& row = rows()[i];
        const bool blade = row.blade_coordinate >= 0;
        const int coordinate = blade ? entry(rotor_.blades[0], row.blade_coordinate) : unknowns_[i];
        const std::string& name = system_.model.coordinates()[coordinate].name;
        names.push_back(blade ? text(name, " (", multi_blade_name(row), ")") : name);
    }
    return names;
}

std::vector<std::string> PointSolver::state_names() const {
    const StateTable& states = system_.forces.states();
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(states.size()));
    for (const StateInfo& state : states) names.push_back(state.name);
    if (!coleman_) return names;
    // Rows of the same state of all blades are called after that of the first, which is the collective one's.
    std::map<int, std::string> first;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const MultiBladeRow& row = coleman_->state_rows()[i];
        if (row.kind == MultiBlade::collective) first[row.blade_coordinate] = names[i];
    }
    for (std::size_t i = 0; i < names.size(); ++i)
        if (const MultiBladeRow& row = coleman_->state_rows()[i]; row.blade_coordinate >= 0)
            names[i] = text(first[row.blade_coordinate], " (", multi_blade_name(row), ")");
    return names;
}

Matrix PointSolver::rotating_coordinates() const {
    const auto n = std::ssize(unknowns_);
    return coleman_ ? coleman_->matrix(0) : Matrix(Matrix::Identity(n, n));
}

}  // namespace cardan::solvers
