/// @file
/// Time integration of a system: one interface for all methods.
#pragma once

#include "mbs/base/error.hpp"
#include "solvers/time/equations_of_motion.hpp"
#include "solvers/time/sampled.hpp"

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cardan::solvers {

enum class Method : std::uint8_t {
    /// ARKODE, diagonally implicit Runge-Kutta method of order 5, L-stable, Newton with the exact Jacobian: for elastic
    /// machines at any accuracy; the default.                                              [Kennedy and Carpenter 2019]
    dirk,
    /// CVODE, BDF of order 1 to 5, Newton with the exact Jacobian: for strongly damped stiff systems and loose
    /// tolerances. Weakly damped fast modes limit its steps, since the higher orders are unstable for them.
    ///                                                                                                 [Hindmarsh 1992]
    bdf,
    adams,  ///< CVODE, Adams-Moulton of order 1 to 12, fixed-point iteration: smooth motions without stiffness
    erk,    ///< ARKODE, Dormand and Prince's explicit method of order 5
    generalised_alpha  ///< second order, numerical dissipation of high frequencies chosen by its spectral radius
};

/// Required accuracy: the estimated error of a step is kept below absolute + relative times the magnitude, as an RMS
/// over positions, rates and states. Angles count as 1 rad at most, whatever the number of turns.
struct Tolerances {
    double relative = 1e-6;
    double angle = 1e-8;         ///< rad
    double length = 1e-8;        ///< m
    double angular_rate = 1e-7;  ///< rad/s
    double speed = 1e-7;         ///< m/s
    double state = 1e-8;         ///< of a state, times its scale
};

struct IntegrationStatistics {
    long steps = 0;           ///< accepted
    long rejected = 0;        ///< by the error test
    long not_converged = 0;   ///< steps repeated because the iteration did not converge
    long evaluations = 0;     ///< of the equations of motion, by the method itself, not for outputs, events and work
    long jacobians = 0;       ///< or tangents
    long factorisations = 0;  ///< of the matrix of Newton's method
    long iterations = 0;      ///< nonlinear
    /// After events and changes, of multistep methods also at breaks and samples, not counting the first start.
    long restarts = 0;
    int order = 0;         ///< of the last step
    double last_step = 0;  ///< s
};

class Integrator;

/// Course of the integration after the action of an event.
enum class AfterEvent : std::uint8_t {
    proceed,  ///< nothing has changed
    restart,  ///< motions or forces have changed: the method restarts
    stop      ///< advance() returns
};

/// Something that happens when a function of the state changes sign. Signs are compared at the ends of steps and at
/// outputs: two changes within one step are missed; limit the step size to prevent that.
struct Event {
    std::string name = {};
    std::function<double(const StateView&)> function = {};
    int direction = 0;  ///< 1: rising through zero, -1: falling, 0: both
    /// May call set_motion(), set_forces() and set_state(); state() is the state at the event. Empty: stop.
    std::function<AfterEvent(Integrator&)> action = {};
    /// Instead of `function`, of what costs an evaluation of the equations of motion: accelerations, forces of drives,
    /// multipliers of loops.
    std::function<double(const DynamicState&)> of_state = {};
};

struct IntegrationOptions {
    Method method = Method::dirk;
    Tolerances tolerances = {};
    double max_step = 0;  ///< s; 0: no limit
    /// Highest order of bdf (up to 5) and adams (up to 12); 0: no further limit.
    int max_order = 0;
    double first_step = 0;  ///< s; 0: chosen by the method
    /// s; if positive, steps have this length (shorter only to end at a break): dirk, erk, generalised_alpha
    double fixed_step = 0;
    double spectral_radius = 0.8;  ///< of generalised_alpha at infinite frequency, 0 ... 1 (1: no dissipation)
    /// Integrates the work done along with the motion by Gauss quadrature, which costs two evaluations per step (three
    /// with dirk and erk).
    bool integrate_work = true;
    Vector states = {};               ///< states at the start; empty: as their table says
    std::vector<double> breaks = {};  ///< further times, ascending, at which to restart: jumps of force elements
    std::vector<Event> events = {};
    std::vector<SampledController> controllers = {};                               ///< called in this order
    std::function<bool()> cancelled = {};                                          ///< called before every step
    std::function<void(double time, const IntegrationStatistics&)> progress = {};  ///< called after every step
};

/// Time integrals of Powers since the start, J. Work-energy theorem: forces + drives = change of kinetic energy.
struct Work {
    double forces = 0, dissipation = 0, drives = 0;
    double state_supply = 0, state_dissipation = 0, state_work = 0;  ///< of StateEnergy
};

/// Energies at a state and the work that was done, J.
struct EnergyBalance {
    double kinetic = 0, potential = 0;
    double dissipated = 0;  ///< by dampers of linear laws
    double drives = 0;      ///< supplied by drives
    /// Supplied by forces without potential, by time-dependent potentials, and by replacing forces.
    double loads = 0;
    /// Change of kinetic energy minus the work of all forces: energy lost or gained by the integration method.
    double error = 0;
    /// Energies of elements with states that report them: stored, and supplied and dissipated since the start.
    double stored = 0, state_supply = 0, state_dissipation = 0;
    /// Change of what is stored minus supply, plus dissipation and work of their forces: error of the integration.
    double state_error = 0;
};

/// Result of advance().
struct [[nodiscard]] Advance {
    enum class End : std::uint8_t { reached, event, cancelled, failed };
    End end = End::reached;
    double time = 0;           ///< s, reached
    std::string event = {};    ///< name of the event that stopped it, empty without
    std::string message = {};  ///< why it failed and what to do, empty if it did not

    bool reached() const { return end == End::reached; }
};

/// @throws NumericalError with the message if the integration failed
inline void require_result(const Advance& advance) {
    if (advance.end == Advance::End::failed) throw NumericalError(advance.message);
}

/// Allows a one-step method to repeat exactly the steps it has taken since it started or last dropped its matrices and
/// estimates.
struct MethodState {
    long steps = -1;        ///< taken since; -1: nothing to repeat, the method restarts
    double time = 0;        ///< s, there
    double horizon = 0;     ///< s, the next output time then: a scale of the first step
    Vector x = {};          ///< unknowns there: positions, rates, states
    Vector memory = {};     ///< of the step control there
    double since = 0;       ///< s, the first start
    Vector positions = {};  ///< of all coordinates at that time: where motions at a constant rate began
};

/// State that is needed to continue from a point in time, if need be in another process. A one-step method continues
/// bit for bit as if it had not stopped, provided that system, options, processor and library are the same; otherwise,
/// and with multistep methods, it restarts there, and the results agree within the tolerances. Motions and forces that
/// events have replaced must be replaced again by the user; notes tell which.
struct Checkpoint {
    double time = 0;
    Vector q, qd;  ///< size n
    Work work;
    double kinetic_at_start = 0, potential_at_start = 0;  ///< J, at the start, when the work was zero
    IntegrationStatistics statistics;
    std::map<std::string, double> notes = {};  ///< see Integrator::note()
    MethodState method = {};
    Vector s = {};               ///< states
    double stored_at_start = 0;  ///< J, in elements with states
    Vector u = {};               ///< inputs
    std::vector<SampledState> controllers = {};
};

class Stepper;

/// Integrates the equations of motion and those of the states beside them. It ends a step at breaks of the motions and
/// of loads over time (FrameLoad::breaks), so that the method sees only smooth functions; one-step methods go on from
/// there with the step and the Jacobian that they have, the others begin anew. Outputs between steps come from the
/// method's own interpolation.
///
/// Forces may change in the action of an event and between two calls of advance(), not within one. By then the method
/// has stepped beyond the output time: if accelerations have changed, at that time or at the end of the step, advance()
/// restarts from the output. Call restart() for a change that cannot be detected there.
///
/// Free bodies (Tree::add_free_body()) turn as they like: their coordinates are changed on the way where they come near
/// to a singularity.
///
/// Exceptions of user functions propagate. After a failure or an exception the last accepted state is kept. Steps
/// allocate nothing unless user functions do. Keeps a reference to the system; one object per thread.
class Integrator {
public:
    /// @param drives  motions of coordinates, which are then driven whatever their role; coordinates with role driven
    ///                and no motion keep their rate in qd
    /// @param q, qd   initial state, size n; coordinates with a motion start from that instead
    /// @throws InputError for values out of range
    Integrator(const System& system, std::vector<Drive> drives, double time, const Vector& q, const Vector& qd,
               IntegrationOptions options = {});
    /// Continues from a checkpoint of the same system, including work, energies and statistics. Pass the drives as
    /// they were at the checkpoint; forces may be restored before the first advance().
    Integrator(const System& system, std::vector<Drive> drives, const Checkpoint& from,
               IntegrationOptions options = {});
    /// The system must live longer.
    Integrator(System&&, std::vector<Drive>, double, const Vector&, const Vector&, IntegrationOptions = {}) = delete;
    Integrator(System&&, std::vector<Drive>, const Checkpoint&, IntegrationOptions = {}) = delete;
    ~Integrator();
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;

    /// Advances exactly to the time, unless an event stops it, it is cancelled or fails. It also fails if a thousand
    /// steps have advanced the time by less than a billionth of what is left, or by less than its resolution.
    /// @throws InputError if the time lies before the present one, or if called within advance(): from a force, the
    /// function or action of an event, `progress` or `cancelled`. The same holds for step() and run().
    Advance advance(double time);
    /// Advances to the end of the method's next step, or to the next event that stops.
    Advance step();
    /// Advances to one time after another and calls `output` at each.
    /// @param times  rising
    Advance run(const std::vector<double>& times, const std::function<void(Integrator&)>& output);

    const Model& model() const { return equations_.model(); }
    /// True if driven by a motion or by its role.
    bool is_driven(int coordinate) const { return equations_.is_driven(coordinate); }
    double time() const { return state_.time; }
    /// The present state; at a break, accelerations and drive forces are those just before it.
    const DynamicState& state() const { return state_; }
    const Work& work() const { return work_; }
    const Loops& loops() const { return equations_.system_loops(); }
    /// The forces in effect now.
    const Forces& forces() const { return equations_.forces(); }
    /// Energies at the present state. Allocates.  @throws InputError if the work is not integrated
    EnergyBalance energy();
    IntegrationStatistics statistics() const;
    /// @throws InputError unless resumable()
    Checkpoint checkpoint() const;
    /// False: a controller keeps its memory to itself, and there are no checkpoints.
    bool resumable() const { return controllers_.tell_their_state(); }
    /// Stores a number in all further checkpoints, e.g. what the action of an event has done, so that a continued run
    /// can repeat it. It has no other effect.
    /// @throws InputError for a name that is empty, "." or has a '/'
    void note(const std::string& name, double value);
    const std::map<std::string, double>& notes() const { return notes_; }

    /// @name Changes
    /// Allowed between two calls of advance() or in the action of an event, InputError elsewhere. The method restarts.
    ///@{
    /// Replaces the motion of a driven coordinate from now on; position and rate must not jump.
    void set_motion(int coordinate, Motion motion);
    /// Replaces the forces from now on; nullptr: those of the system. They must live as long as the integrator uses
    /// them.
    void set_forces(const Forces* forces);
    /// Replaces positions and rates from now on, as an impact does; what that adds to the kinetic energy counts as work
    /// of loads. Driven coordinates go on as they are driven, whatever is given for them.
    /// @throws InputError for values that are not finite, and where they do not close the loops
    void set_state(const Vector& q, const Vector& qd);
    /// Evaluates accelerations, forces of drives and multipliers of the present state anew: in an action, after what
    /// they depend on has changed.
    void update();
    /// Load that an engaged lock has to hold: in an action, after update().
    LockHold hold(int equation) { return equations_.hold(equation); }
    /// Call when forces have changed: results beyond the present time are discarded.
    void restart();
    ///@}

private:
    enum class Doing : std::uint8_t { nothing, acting, advancing };
    /// Activity of the integrator while this lives.
    class While;

    void watch_free_bodies();
    void turn_reference(const Model::Free& body);
    void go_on_from(const Checkpoint& from);
    void repeat_steps();
    void check_options(double time) const;
    Vector states_at_start() const;
    void check_allowed(const char* what, Doing latest) const;
    void state_at(double time, Vector& x);
    bool accelerations_changed();
    bool take_step(double horizon, Advance& result);
    void note_accelerations();
    bool stands_still(double horizon);
    void find_breaks();
    void begin_piece();
    void pass_piece_end();
    bool sample_due() const;
    Advance advance(double target, bool one_step);
    void advance_until(double target, bool one_step, Advance& result);
    bool process(double to, Advance& result);
    int first_event(double to, double& at);
    double root(std::size_t event, double to);
    double event_value(std::size_t event, double time);
    bool accumulate(double to);
    void complete(Advance& result);
    bool due(std::size_t event) const;
    void set_sides(int happened);
    AfterEvent act(int event);

    IntegrationOptions options_;
    EquationsOfMotion equations_;
    SampledControllers controllers_;
    Workspace workspace_;
    Vector u_;
    std::unique_ptr<Stepper> stepper_;
    std::vector<double> breaks_;
    double piece_end_ = 0;  ///< s, the next break or sample
    bool start_pending_ = true, go_on_pending_ = false, repeat_pending_ = false;
    long starts_ = 0;
    Doing doing_ = Doing::nothing;
    long steps_ = 0;    ///< since `moved_`
    double moved_ = 0;  ///< s
    Vector x_, x_between_;
    double seen_at_ = std::numeric_limits<double>::quiet_NaN();  ///< s, end of the step of `seen_end_`
    Vector seen_end_, now_;                                      ///< xdd there; to compare
    MethodState from_;                                           ///< to be repeated
    std::vector<double> values_;                                 ///< of the event functions at the end of the stretch
    std::vector<int> sides_;                                     ///< last sign of each event function that was not zero
    DynamicState state_, between_;
    Work work_;
    double kinetic_at_start_ = 0, potential_at_start_ = 0, stored_at_start_ = 0;
    std::map<std::string, double> notes_;
    IntegrationStatistics earlier_;  ///< up to the checkpoint it started from, less those that were repeated
    double since_ = 0;               ///< s, of the first start
    Vector positions_;               ///< then
};

}  // namespace cardan::solvers
