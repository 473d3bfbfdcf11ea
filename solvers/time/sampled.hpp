/// @file
/// Controllers that run every so often, as on a computer, and hold their output in between.
#pragma once

#include "mbs/system/dynamic_view.hpp"
#include "mbs/system/input_drive.hpp"
#include "solvers/time/equations_of_motion.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

/// A controller that is called at exact multiples of its period, first + k period. The integration ends a step there,
/// so that no step spans a change of its output. What is recorded at that time holds the output before.
///
/// In linearisations and steady states its outputs are held: inputs of the system (open loop).
///
/// Coordinates may follow its outputs. With the period T and the demands d_k = factor (u_k - zero) of an InputDrive the
/// rate goes linearly from that of the last change, (d_k-1 - d_k-2) / T, to that of the new one, (d_k - d_k-1) / T,
/// within the period that follows sample k, so that
///
///     q(t_k) = (d_k-1 + d_k-2) / 2.
///
/// That is the demand as it is held, averaged twice over a period: position and rate are continuous, a demand is
/// reached after two periods without overshoot, one that rises evenly is followed evenly, and no rate is larger than
/// that of the demand. Of a demand of frequency w the amplitude is sinc^3(w T / 2) at a delay of 3/2 T behind the
/// samples (sinc x = sin x / x), or sinc^2 at a delay of T behind the demand as it is held. What moves the coordinate
/// counts as work of drives.
struct SampledController {
    std::string name;
    std::vector<std::string> inputs;  ///< of the system, which it sets: names of Forces::inputs()
    double period = 0;                ///< s
    double first = 0;                 ///< s, time of sample 0
    /// Coordinates that follow its inputs. Until the first sample they rest where they start.
    std::vector<InputDrive> drives = {};
    /// Whether the output of a sample is put out at the next one: the time that it takes to compute.
    bool delayed = false;
    /// @param sample  0, 1, 2 ...
    /// @param u       in: the present values of its inputs, out: the new ones
    std::function<void(long sample, const DynamicView& at, VectorOut u)> update = {};
    /// Memory of the controller for checkpoints (`save`), and back; both empty: it has none. `keeps_to_itself`: it has
    /// one that it does not give away; then there are no checkpoints.
    std::function<std::vector<double>()> save = {};
    std::function<void(std::span<const double>)> restore = {};
    bool keeps_to_itself = false;
};

/// A controller in a checkpoint.
struct SampledState {
    std::string name;
    long next = 0;                    ///< sample to come
    Vector pending = {};              ///< what a delayed one puts out then
    std::vector<double> memory = {};  ///< of SampledController::save
    /// Samples of each SampledController::drives: d_k-2, d_k-1, d_k, as positions of the coordinate: before the first
    /// sample that of the start.
    std::vector<double> followed = {};
};

/// Motions of the coordinates that follow a controller, from its last sample on.
std::vector<Drive> followed_motions(const SampledController& controller, const SampledState& state);

/// Drives with those until the first sample, at rest, for coordinates without a motion.
std::vector<Drive> with_followers(std::vector<Drive> drives, const std::vector<SampledController>& controllers,
                                  const Vector& q);

/// The controllers of a run. Internal to the integrator.
class SampledControllers {
public:
    /// @throws InputError: unknown inputs, two controllers for one, a period that is not positive, a missing function,
    /// a drive of a coordinate or by an input that it does not have
    /// @param q  at the start
    SampledControllers(std::vector<SampledController> controllers, const InputTable& inputs, const Vector& q,
                       double start);

    bool empty() const { return controllers_.empty(); }
    /// Time of the next sample, s; infinity: there is none.
    double next() const;
    /// Calls those whose time has come, within `resolution`, s.
    /// @param u  all inputs of the system
    /// @param set_motion  takes the new motions of the coordinates that follow them
    /// @throws NumericalError for an output that is not finite, with its time
    void run(const DynamicView& at, double resolution, Vector& u, const std::function<void(Drive)>& set_motion);

    /// False: one of them keeps its memory to itself, and state() throws InputError.
    bool tell_their_state() const;
    std::vector<SampledState> state() const;
    /// @throws InputError unless the states are those of these controllers
    void restore(const std::vector<SampledState>& states);

private:
    struct Running {
        SampledController own;
        std::vector<int> at;  ///< its inputs among those of the system
        long next = 0;
        Vector pending, values;
        std::vector<double> followed = {};
    };
    static SampledState state_of(const Running& controller);
    static void follow(Running& controller, const Vector& u);
    static double time_of(const Running& controller) {
        return controller.own.first + static_cast<double>(controller.next) * controller.own.period;
    }
    void update(Running& controller, const DynamicView& at, Vector& u);

    std::vector<Running> controllers_;
    const InputTable* inputs_;
};

}  // namespace cardan::solvers
