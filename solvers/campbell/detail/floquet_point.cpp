#include "solvers/campbell/detail/floquet_point.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/detail/blade_frame.hpp"
#include "solvers/campbell/detail/displacements.hpp"
#include "solvers/campbell/detail/rotor_speed.hpp"
#include "solvers/campbell/detail/structure_symmetry.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// EnergyFraction of the energy that a vibration named after its springs has in them: half where no other stiffness
// acts, less where the centrifugal force holds the blades.
constexpr double elastic_limit = 0.05;
// Asymmetry of the blades relative to the diagonals; more is not rounding.
constexpr double small_difference = 1e-4;
// Outer harmonics with less energy are left out.
constexpr double negligible_participation = 1e-12;

// Kinetic energies of the rows alone; of joint coordinates each carries all that is outboard.
Vector kinetic_by_row(const SecondOrderSystem& system, const ComplexVector& shape, Complex eigenvalue) {
    return std::norm(eigenvalue) * system.M.diagonal().cwiseProduct(shape.cwiseAbs2());
}

int largest(const Vector& v) {
    Index at = 0;
    v.maxCoeff(&at);
    return static_cast<int>(at);
}

// Every harmonic as a mode of its own.
std::vector<Mode> harmonics_of(const FloquetMode& mode) {
    std::vector<Mode> all;
    for (Index i = 0; i < mode.harmonics.cols(); ++i) {
        const double j = mode.first_harmonic + static_cast<double>(i);
        all.push_back({mode.exponent + Complex(0, 2 * pi * j / mode.period), mode.harmonics.col(i)});
    }
    return all;
}

void leave_out_ends(FloquetMode& mode) {
    Index first = 0, last = mode.harmonics.cols() - 1;
    const Index principal = -mode.first_harmonic;
    while (first < principal && mode.participation(first) < negligible_participation) ++first;
    while (last > principal && mode.participation(last) < negligible_participation) --last;
    for (ComplexMatrix* harmonics : {&mode.harmonics, &mode.state_harmonics})
        *harmonics = harmonics->middleCols(first, last - first + 1).eval();
    mode.participation = mode.participation.segment(first, last - first + 1).eval();
    mode.first_harmonic += static_cast<int>(first);
}

double lowest_elastic(const CampbellPoint& point) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const CampbellMode& m : point.modes)
        if (m.row < 0 && m.mode.oscillates()) lowest = std::min(lowest, std::abs(m.mode.eigenvalue));
    return std::isfinite(lowest) ? lowest : 0;
}

}  // namespace

int naming_row(const SecondOrderSystem& system, const Mode& mode) {
    const double elastic = hermitian_form(system.K_elastic, mode.shape),
                 kinetic = std::norm(mode.eigenvalue) * hermitian_form(system.M, mode.shape);
    if (elastic > elastic_limit * (elastic + kinetic)) return -1;
    return largest(kinetic_by_row(system, mode.shape, mode.eigenvalue));
}

PeriodicPointSolver::PeriodicPointSolver(const System& system, const RotorMap& rotor, const CampbellOptions& options)
    : PointSolver(system, rotor, options) {
    if (rotor.spin < 0) throw InputError(rotor.machine, "rotor", "none", "one, for Floquet's theory");
    if (options.balanced)
        throw InputError(rotor.machine, "balanced rotor with a periodic steady state", "asked for",
                         "one with constant equations (without gravity, three blades or more that are alike)");
    const CampbellFloquetOptions& o = options.floquet;
    if (!(o.per_period >= 0))
        throw InputError(rotor.machine, "frequency per revolution up to which modes are accurate", o.per_period,
                         ">= 0");
    if (o.max_steps < 0) throw InputError(rotor.machine, "limit of steps per revolution", o.max_steps, ">= 0");
}

void PeriodicPointSolver::warn_once(const std::string& what) {
    if (warned_ || what.empty()) return;
    warn(what);
    warned_ = true;
}

void PeriodicPointSolver::start_from(const Matrix& coordinates, const Matrix& states) {
    PointSolver::start_from(coordinates, states);
    start_ = coordinates;
    state_start_ = states;
    prepared_.clear();
    state_.reset();
}

void PeriodicPointSolver::prepare(std::span<const double> rotor_speeds) {
    for (const double speed : rotor_speeds) {
        if (speed == 0) continue;
        find_steady_state(speed);
        prepared_.insert_or_assign(speed, *state_);
    }
}

void PeriodicPointSolver::solve(double rotor_speed, CampbellPoint& point) {
    if (rotor_speed == 0) {
        PointSolver::solve(0, point);
        for (CampbellMode& m : point.modes) m.row = naming_row(current_, m.mode);
        name_weak_spin(point.modes, current_.M, spin_row());
        if (options_.method == CampbellMethod::averaged) leave_out_free_spin(lowest_elastic(point), point);
        return;
    }
    if (const auto known = prepared_.find(rotor_speed); known != prepared_.end())
        state_ = known->second;
    else
        find_steady_state(rotor_speed);
    const PeriodicSystem periodic = multi_blade_system();
    set_symmetry(periodic);
    set_mean(periodic);
    if (!energy_shares()) define_components(linearised_at(state_->at(0)));
    point.rotor_speed = rotor_speed;
    point.at = state_->at(0);
    point.periodic = state_;
    point.modes.clear();
    point.state_motions.clear();
    if (options_.method == CampbellMethod::averaged) {
        warn_of_differing_blades();
        set_mean_modes(point);
    } else {
        set_floquet_modes(periodic, point);
    }
    set_stability_margin(point);
}

void PeriodicPointSolver::find_steady_state(double rotor_speed) {
    PeriodicOptions options;
    options.harmonics = options_.floquet.harmonics;
    options.fixed_means = options_.floquet.fixed_means;
    options.rotor = &rotor_;
    options.more_harmonics = true;
    options.rotor_speed = rotor_speed;
    options.start = state_ ? state_->coefficients : start_;
    options.state_start = state_ ? state_->state_coefficients : state_start_;
    options.cancelled = options_.cancelled;
    PeriodicSteadyState found = harmonic_balance(system_, rotor_.spin, options);
    if (!found.converged && state_) {
        const std::array from_the_last{state_->rotor_speed, rotor_speed};
        found = periodic_sweep(system_, rotor_.spin, from_the_last, options).back();
    }
    require_result(found, [&] { return text(rotor_.machine, " at ", rotor_speed * units::to_rpm, " rpm"); });
    if (!found.note.empty()) warn_once(text("at ", rotor_speed * units::to_rpm, " rpm ", found.note));
    warn_once(found.neglected_in_words());
    state_ = std::move(found);
}

PeriodicSystem PeriodicPointSolver::multi_blade_system() const {
    PeriodicSystem raw = linearised(system_, *state_, moving(), unknowns());
    const ColemanTransform* T = coleman();
    return T ? in_multi_blade_rows(std::move(raw), *T, state_->rotor_speed) : raw;
}

void PeriodicPointSolver::set_mean(const PeriodicSystem& periodic) {
    const int samples = std::max({24, 2 * static_cast<int>(rotor_.blades.size()) + 1, 4 * (state_->harmonics() + 1)});
    current_ = mean_over_period(periodic, samples, symmetry_);
}

// x(t + T/Q) in multi-blade rows, where equal blades look the same except for signs.
BladeSymmetry PeriodicPointSolver::renumbering() const {
    const ColemanTransform* T = coleman();
    if (!T || rotor_.blades.empty() || !rotor_.evenly_spaced) return {};
    std::vector<int> odd = rotor_.blades.size() == 2 ? rotor_.odd_coordinates : std::vector<int>();
    std::erase_if(odd, [&](int i) { return row_of(unknowns(), i) < 0; });
    BladeSymmetry found = blade_symmetry(rotor_, unknowns(), state_->rotor_speed, odd, system_.forces.states());
    const auto turned = [&](const Matrix& P, const Matrix& now, const Matrix& later) {
        // Few entries in a row of each: of one coordinate or state of all blades.
        const Eigen::SparseMatrix<double> back = now.transpose().sparseView(), symmetry = P.sparseView(),
                                          forth = later.sparseView();
        const Matrix own = back * (symmetry * forth).eval();
        return Matrix(own.unaryExpr([](double p) { return std::abs(p - std::round(p)) < 1e-12 ? std::round(p) : p; }));
    };
    const double part = 2 * pi / found.parts;
    found.P = turned(found.P, T->matrix(0), T->matrix(part));
    if (found.P_beside.size() > 0) found.P_beside = turned(found.P_beside, T->state_matrix(0), T->state_matrix(part));
    return found;
}

// None if the blades differ.
void PeriodicPointSolver::set_symmetry(const PeriodicSystem& periodic) {
    symmetry_ = renumbering();
    difference_ = asymmetry(periodic, symmetry_);
    structure_differs_ =
        difference_ > small_difference && structure_differs(system_, rotor_, *this, symmetry_, small_difference);
    // Blades that move alike differ by kinks only, which the mean of all parts of the turn tells no better than one's.
    const bool alike = difference_ < 1e-8 || (options_.method == CampbellMethod::averaged && !structure_differs_ &&
                                              blades_move_alike(rotor_, *state_, system_.forces.states()));
    if (!alike) symmetry_ = {};
}

// A mode localised in one blade has no frequency in the fixed frame: the average invents one.
void PeriodicPointSolver::warn_of_differing_blades() {
    if (!(difference_ > small_difference)) return;
    const std::string where =
        text("at ", state_->rotor_speed * units::to_rpm,
             " rpm the rotor is not the same when its blades are renumbered (", difference_, " of the diagonals): ");
    if (structure_differs_)
        warn_once(text(where,
                       "blades or hub differ, and the mean over the azimuth may have frequencies that no motion of the "
                       "machine has. Take CampbellMethod::floquet"));
    else
        warn_once(
            text(where,
                 "what acts on the blades differs, as on curves of airfoils with kinks, where a section may have one "
                 "slope on one blade and another on the next; mass and springs are alike, and the mean over the "
                 "azimuth has the mean of the slopes"));
}

FloquetOptions PeriodicPointSolver::floquet_options() const {
    const CampbellFloquetOptions& own = options_.floquet;
    FloquetOptions options;
    options.symmetry = symmetry_;
    options.per_period =
        own.per_period > 0 ? own.per_period : options_.max_frequency_hz * 2 * pi / std::abs(state_->rotor_speed);
    if (options.per_period > 1e4)
        throw InputError(rotor_.machine,
                         text("frequency per revolution at ", state_->rotor_speed * units::to_rpm, " rpm"),
                         options.per_period, "at most 10000: a higher rotor speed, or a lower largest frequency");
    options.tolerance = own.tolerance;
    options.only_slow = true;
    options.max_steps =
        own.max_steps > 0 ? own.max_steps : std::max(4096, static_cast<int>(64 * std::min(options.per_period, 1e4)));
    return options;
}

Index PeriodicPointSolver::spin_row() const {
    return row_of(unknowns(), rotor_.spin);
}

void PeriodicPointSolver::set_floquet_modes(const PeriodicSystem& periodic, CampbellPoint& point) {
    const FloquetOptions options = floquet_options();
    Floquet result = floquet(periodic, options);
    if (!result.note.empty()) warn_once(text("at ", state_->rotor_speed * units::to_rpm, " rpm ", result.note));
    move_state_motions(result.modes, point);
    find_weak_spin(result.modes, current_.M, std::abs(state_->rotor_speed), spin_row());
    for (FloquetMode& mode : result.modes) {
        find_displacement(mode, current_.M, std::abs(state_->rotor_speed));
        const bool slow = std::abs(mode.exponent) < rigid_per_radian * std::abs(state_->rotor_speed),
                   pair = mode.kind == FloquetKind::oscillation;
        if (slow) mode.kind = FloquetKind::rigid;
        if (slow && pair) point.modes.push_back(make(FloquetMode(mode)));
        point.modes.push_back(make(std::move(mode)));
    }
    separate_displacements(point.modes, current_.M);
    name_weak_spin(point.modes, current_.M, spin_row());
    std::stable_sort(point.modes.begin(), point.modes.end(), [](const CampbellMode& a, const CampbellMode& b) {
        return a.mode.natural_hz() < b.mode.natural_hz();
    });
    if (options.symmetry.parts == 1 && rotor_.blades.size() > 1) set_blade_shares(point);
}

// Out of the modes, by the size of the exponent; each as its principal harmonic.
void PeriodicPointSolver::move_state_motions(std::vector<FloquetMode>& modes, CampbellPoint& point) const {
    for (const FloquetMode& mode : modes) {
        if (!mode.is_state_motion()) continue;
        const Index principal = -mode.first_harmonic;
        point.state_motions.push_back(state_motion({.eigenvalue = mode.exponent,
                                                    .shape = mode.harmonics.col(principal),
                                                    .states = mode.state_harmonics.col(principal),
                                                    .state_share = mode.state_share},
                                                   current_.states.scales));
    }
    std::erase_if(modes, [](const FloquetMode& mode) { return mode.is_state_motion(); });
    std::stable_sort(point.state_motions.begin(), point.state_motions.end(),
                     [](const StateMotion& a, const StateMotion& b) {
                         if (a.mode.oscillates() != b.mode.oscillates()) return a.mode.oscillates();
                         return std::abs(a.mode.eigenvalue) < std::abs(b.mode.eigenvalue);
                     });
}

// Where blades differ, one may move alone. Multi-blade coordinates spread its motion over all patterns; back in the
// blades' own coordinates, their elastic energies over the revolution tell.
void PeriodicPointSolver::set_blade_shares(CampbellPoint& point) const {
    constexpr int azimuths = 32, most = 8;  // most: harmonics that are compared
    const ColemanTransform* T = coleman();
    const Linearisation lin = linearised_at(point.at);
    std::vector<Matrix> at;
    at.reserve(azimuths);
    for (int i = 0; i < azimuths; ++i) at.push_back(T ? T->matrix(2 * pi * i / azimuths) : rotating_coordinates());
    for (CampbellMode& m : point.modes) {
        m.blade_shares = Vector::Zero(std::ssize(rotor_.blades));
        ComplexMatrix harmonics = ComplexMatrix::Zero(std::ssize(unknowns()), 2 * most + 1);
        for (int i = 0; i < azimuths; ++i) {
            const ComplexVector x = entry(at, i) * m.floquet->shape(m.floquet->period * i / azimuths);
            m.blade_shares += blade_energies(lin, x);
            for (int j = -most; j <= most; ++j)
                harmonics.col(j + most) += std::polar(1.0 / azimuths, -2 * pi * j * i / azimuths) * x;
        }
        if (const double sum = m.blade_shares.sum(); sum > 0) m.blade_shares /= sum;
        Vector energy(harmonics.cols());
        for (Index j = 0; j < energy.size(); ++j) energy(j) = blade_energies(lin, harmonics.col(j)).sum();
        m.own_harmonic = largest(energy) - most;
    }
}

CampbellMode PeriodicPointSolver::make(FloquetMode&& found) const {
    CampbellMode out;
    FloquetMode& mode = out.floquet.emplace(std::move(found));
    const bool rigid = mode.kind == FloquetKind::rigid;
    if (rigid)
        keep_displacement(mode);
    else
        leave_out_ends(mode);
    const ComplexVector principal = mode.harmonics.col(-mode.first_harmonic);
    // A rigid displacement has no energy.
    const double energy = rigid ? hermitian_form(current_.M, principal) : 2 * mode.share(0),
                 factor = energy > 0 ? std::sqrt(2 / energy) : 1.0;
    if (rigid) {
        mode.harmonics *= factor;
        mode.state_harmonics *= factor;
    }
    out.mode = {mode.exponent, factor * principal, factor * mode.state_harmonics.col(-mode.first_harmonic),
                mode.state_share};
    const std::vector<Mode> harmonics = harmonics_of(mode);
    out.shares = energy_shares()->shares(harmonics, 2 * pi / mode.period);
    if (rigid)
        for (EnergyFraction& share : out.shares) share = EnergyFraction{};
    Vector elastic = Vector::Zero(current_.M.rows()), kinetic = elastic;
    for (const Mode& one : harmonics) {
        const ComplexVector force = current_.K_elastic * one.shape;
        elastic += (one.shape.conjugate().array() * force.array()).real().matrix();
        kinetic += kinetic_by_row(current_, one.shape, one.eigenvalue);
    }
    const double total = elastic.sum();
    out.row_shares = total > 0 && !rigid ? Vector(elastic / total) : Vector::Zero(elastic.size());
    if (rigid)
        out.row = largest(kinetic_by_row(current_, principal, 1));
    else if (total < 2 * elastic_limit)  // of the energy, which is 2 in these units
        out.row = largest(kinetic);
    return out;
}

void PeriodicPointSolver::set_mean_modes(CampbellPoint& point) {
    for (Mode& mode : modes(current_, range_.largest(options_, state_->rotor_speed, current_))) {
        if (mode.is_state_motion()) {
            point.state_motions.push_back(state_motion(std::move(mode), current_.states.scales));
            continue;
        }
        if (std::abs(mode.eigenvalue) < rigid_per_radian * std::abs(state_->rotor_speed)) continue;
        CampbellMode& m = point.modes.emplace_back();
        if (std::abs(mode.eigenvalue) < free_spin_limit * std::abs(state_->rotor_speed))
            m.row = naming_row(current_, mode);
        if (is_motion_of_speed(current_, mode, static_cast<int>(spin_row()))) m.row = static_cast<int>(spin_row());
        m.row_shares = energy_by_row(current_, mode);
        m.shares = energy_shares()->shares(mode);
        m.mode = std::move(mode);
    }
    range_.set(point.modes, state_->rotor_speed);
    leave_out_free_spin(std::abs(state_->rotor_speed), point);
}

// Gravity on bent blades keeps it from being exactly zero.
void PeriodicPointSolver::leave_out_free_spin(double scale, CampbellPoint& point) const {
    std::erase_if(point.modes, [&](const CampbellMode& m) {
        if (std::abs(m.mode.eigenvalue) >= free_spin_limit * scale) return false;
        const int row = largest(kinetic_by_row(current_, m.mode.shape, m.mode.eigenvalue));
        return entry(unknowns(), row) == rotor_.spin;
    });
    set_stability_margin(point);
}

std::unique_ptr<PointSolver> point_solver(const System& system, const RotorMap& rotor, const CampbellOptions& options) {
    if (options.method == CampbellMethod::floquet || options.method == CampbellMethod::averaged)
        return std::make_unique<PeriodicPointSolver>(system, rotor, options);
    return std::make_unique<PointSolver>(system, rotor, options);
}

}  // namespace cardan::solvers
