/// @file
/// Motion of a system in time: one face for all methods of integration.
#pragma once

#include "solvers/time/equations_of_motion.hpp"

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cardan::solvers {

enum class Method : std::uint8_t {
    /// ARKODE, diagonally implicit Runge-Kutta method of order 5, L-stable, Newton with the exact Jacobian: elastic
    /// machines at any accuracy, the default.                                      [Kennedy and Carpenter 2019]
    dirk,
    /// CVODE, BDF of order 1 to 5, Newton with the exact Jacobian: strongly damped stiff systems, loose tolerances.
    /// Weakly damped fast modes limit its steps where a higher order is unstable.           [Hindmarsh 1992]
    bdf,
    adams,  ///< CVODE, Adams-Moulton of order 1 to 12, fixed-point iteration: smooth motions without stiffness
    erk,    ///< ARKODE, Dormand and Prince's explicit method of order 5
    generalised_alpha  ///< second order, numerical dissipation of high frequencies chosen by its spectral radius
};

/// Wanted accuracy: the estimated error of a step is kept below absolute + relative times the magnitude, in the mean
/// over positions and rates. Angles count as 1 rad at most, whatever the number of turns.
struct Tolerances {
    double relative = 1e-6;
    double angle = 1e-8;         ///< rad
    double length = 1e-8;        ///< m
    double angular_rate = 1e-7;  ///< rad/s
    double speed = 1e-7;         ///< m/s
};

struct IntegrationStatistics {
    long steps = 0;           ///< accepted
    long rejected = 0;        ///< by the error test
    long not_converged = 0;   ///< steps repeated because the iteration did not converge
    long evaluations = 0;     ///< of the equations of motion by the method; outputs, events and works are not counted
    long jacobians = 0;       ///< or tangents
    long factorisations = 0;  ///< of the matrix of Newton's method
    long iterations = 0;      ///< nonlinear
    long restarts = 0;        ///< at breaks of motions and after events, the first start not counted
    int order = 0;            ///< of the last step
    double last_step = 0;     ///< s
};

class Integrator;

/// What happens after the action of an event.
enum class AfterEvent : std::uint8_t {
    go_on,    ///< nothing has changed
    restart,  ///< motions or forces have changed: the method starts anew
    stop      ///< advance() returns
};

/// Something that happens when a function of the state changes its sign. Signs are compared at the ends of steps and at
/// outputs: two changes within one step go unseen, a largest step prevents that.
struct Event {
    std::string name = {};
    std::function<double(const ForceInput&)> function = {};
    int direction = 0;  ///< 1: rising through zero, -1: falling, 0: both
    /// May call set_motion() and set_forces(); state() is the state at the event. Empty: stop.
    std::function<AfterEvent(Integrator&)> action = {};
};

struct IntegrationOptions {
    Method method = Method::dirk;
    Tolerances tolerances = {};
    double max_step = 0;  ///< s; 0: no limit
    /// Highest order of bdf (up to 5) and adams (up to 12); 0: that.
    int max_order = 0;
    double first_step = 0;  ///< s; 0: chosen by the method
    /// s; above zero steps are of this length (shorter only to end at a break): dirk, erk, generalised_alpha
    double fixed_step = 0;
    double spectral_radius = 0.8;  ///< of generalised_alpha at infinite frequency, 0 ... 1 (1: no dissipation)
    /// Works are integrated beside the motion by Gauss' formula, which costs two evaluations per step (three with dirk
    /// and erk).
    bool works = true;
    std::vector<double> breaks = {};  ///< more times, rising, at which to stop and start: jumps of user forces
    std::vector<Event> events = {};
    std::function<bool()> cancelled = {};                                          ///< asked before every step
    std::function<void(double time, const IntegrationStatistics&)> progress = {};  ///< told after every step
};

/// Time integrals of Powers since the start, J. The theorem of energy: forces + drives = change of kinetic energy.
struct Works {
    double forces = 0, dissipation = 0, drives = 0;
};

/// Energies at a state and where they came from, J.
struct EnergyBalance {
    double kinetic = 0, potential = 0;
    double dissipated = 0;  ///< by dampers of linear laws
    double drives = 0;      ///< supplied by drives
    /// Supplied by forces without potential, by a potential that depends on time, and by an exchange of forces.
    double loads = 0;
    /// Change of kinetic energy less the work of all forces: what the method of integration has lost or won.
    double error = 0;
};

/// How advance() ended.
struct [[nodiscard]] Advance {
    enum class End : std::uint8_t { reached, event, cancelled, failed };
    End end = End::reached;
    double time = 0;           ///< s, reached
    std::string message = {};  ///< name of the event; or why it failed and what to do

    bool reached() const { return end == End::reached; }
};

/// How a method of one step came to where it is: from where it started, or dropped its matrices and estimates last, it
/// takes the very same steps again.
struct MethodState {
    long steps = -1;        ///< taken since; -1: nothing to repeat, it starts anew
    double time = 0;        ///< s, there
    double horizon = 0;     ///< s, the time that was wanted next: a scale of the first step
    Vector x = {};          ///< unknowns there: positions, rates
    Vector memory = {};     ///< of the step control there
    double since = 0;       ///< s, the first start
    Vector positions = {};  ///< then, of all coordinates: what is driven at a constant rate began there
};

/// All that is needed to go on from a moment, in another process if need be. A method of one step goes on bit for bit
/// as if it had not stopped, if system, options, processor and library are the same; otherwise, and with a method of
/// several steps, it starts anew there, and the results agree within the tolerances. Motions and forces that events
/// have exchanged are the user's to exchange again; notes tell which.
struct Checkpoint {
    double time = 0;
    Vector q, qd;  ///< size n
    Works works;
    double kinetic_at_start = 0, potential_at_start = 0;  ///< J, when the works were zero
    IntegrationStatistics statistics;
    std::map<std::string, double> notes = {};  ///< see Integrator::note()
    MethodState method = {};
};

class Stepper;

/// Integrates the equations of motion. At breaks of the motions it stops and starts, so that the method sees smooth
/// functions only; outputs between steps come from the method's own interpolation.
///
/// Forces may change in the action of an event and between two calls of advance(), not in between. The method has
/// stepped beyond the time of an output by then: where accelerations differ from what they were, at that time or at the
/// end of the step, advance() starts anew from the output. restart() says so for a change that cannot be seen there.
///
/// Exceptions of user functions pass through. After a failure or an exception the last accepted state stands.
/// Steps allocate nothing but what user functions do. Keeps a reference to the system; one object per thread.
class Integrator {
public:
    /// @param drives  motions of coordinates, which are driven then whatever their role; coordinates with role driven
    ///                and no motion keep the rate they have in qd
    /// @param q, qd   start, size n; what has a motion takes it from there
    /// @throws InputError for values out of range
    Integrator(const System& system, std::vector<Drive> drives, double time, const Vector& q, const Vector& qd,
               IntegrationOptions options = {});
    /// Goes on from a checkpoint of the same system: works, energies and statistics go on as well. Drives as they were
    /// at the checkpoint; forces may be put back to what they were until the first advance().
    Integrator(const System& system, std::vector<Drive> drives, const Checkpoint& from,
               IntegrationOptions options = {});
    ~Integrator();
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;

    /// To the time exactly, unless an event stops it, it is cancelled or fails. It fails as well if a thousand steps
    /// have moved the clock by less than 1e-9 s, or by what the clock can tell.
    /// @throws InputError if the time lies before the present one, or if it is called within advance(): from a force,
    ///         the function or action of an event, `progress` or `cancelled`. So do step() and run().
    Advance advance(double time);
    /// To the end of the next step of the method, or to the next event that stops.
    Advance step();
    /// Advances to one time after another and hands the state out at each.
    /// @param times  rising
    Advance run(const std::vector<double>& times, const std::function<void(Integrator&)>& output);

    const Model& model() const { return equations_.model(); }
    /// By a motion, or by its role.
    bool is_driven(int coordinate) const { return equations_.is_driven(coordinate); }
    double time() const { return state_.time; }
    /// At a break: accelerations and forces of drives just before it.
    const DynamicState& state() const { return state_; }
    const Works& works() const { return works_; }
    /// That act now.
    const Forces& forces() const { return equations_.forces(); }
    /// Energies at the present state. Allocates.  @throws InputError if works are not integrated
    EnergyBalance energy();
    IntegrationStatistics statistics() const;
    Checkpoint checkpoint() const;
    /// Keeps a number for checkpoints from now on: what the action of an event has done, so that a run that goes on can
    /// do it again. It is not looked at otherwise.
    /// @throws InputError for a name that is empty, "." or has a '/'
    void note(const std::string& name, double value);
    const std::map<std::string, double>& notes() const { return notes_; }

    /// @name Changes
    /// Between two calls of advance() or in the action of an event, InputError elsewhere. The method starts anew.
    ///@{
    /// Another motion of a driven coordinate from now on; position and rate must not jump.
    void set_motion(int coordinate, Motion motion);
    /// Other forces from now on; nullptr: those of the system. They must live as long as the integrator uses them.
    void set_forces(const Forces* forces);
    /// Forces have changed: what was computed beyond the present time is thrown away.
    void restart();
    ///@}

private:
    enum class Doing : std::uint8_t { nothing, acting, advancing };
    /// What it does while this lives.
    class While;

    void go_on_from(const Checkpoint& from);
    void repeat_steps();
    void check_options(double time) const;
    void check_allowed(const char* what, Doing latest) const;
    bool accelerations_changed();
    bool take_step(double horizon, Advance& result);
    void note_accelerations();
    bool stands_still();
    void find_breaks();
    void begin_piece();
    Advance advance(double target, bool one_step);
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
    std::unique_ptr<Stepper> stepper_;
    std::vector<double> breaks_;
    double piece_end_ = 0;
    bool start_pending_ = true, repeat_pending_ = false;
    long starts_ = 0;
    Doing doing_ = Doing::nothing;
    long steps_ = 0;    ///< since `moved_`
    double moved_ = 0;  ///< s
    Vector x_, x_between_;
    double seen_at_ = std::numeric_limits<double>::quiet_NaN();  ///< s, end of the step of `seen_end_`
    Vector seen_end_, now_;                                      ///< accelerations there; to compare
    MethodState from_;                                           ///< to be repeated
    std::vector<double> values_;                                 ///< of the event functions at the end of the stretch
    std::vector<int> sides_;                                     ///< last sign of each event function that was not zero
    DynamicState state_;
    Works works_;
    double kinetic_at_start_ = 0, potential_at_start_ = 0;
    std::map<std::string, double> notes_;
    IntegrationStatistics earlier_;  ///< up to the checkpoint it started from, less those that were repeated
    double since_ = 0;               ///< s, of the first start
    Vector positions_;               ///< then
};

}  // namespace cardan::solvers
