/// @file
/// Records channels of a motion while it is integrated.
#pragma once

#include "solvers/signals/history.hpp"
#include "solvers/time/integrate.hpp"

#include <functional>
#include <vector>

namespace cardan::solvers {

/// What is recorded besides the user's own channels.
struct RecorderOptions {
    bool coordinates = true;     ///< "<coordinate>", rad or m
    bool rates = true;           ///< "<coordinate> rate"
    bool accelerations = false;  ///< "<coordinate> acceleration"
    bool actuators = true;       ///< "<coordinate> drive": force of the drive, for driven coordinates
    bool energies = true;        ///< "kinetic energy" ... "energy error", J; see EnergyBalance
    bool statistics = true;      ///< "steps", "rejected steps" ..., see IntegrationStatistics
};

/// Values of a fixed list of channels at the state of an integrator. Keeps a reference to its model.
class Recorder {
public:
    /// @param integrator  or another one of the same system with the same driven coordinates
    /// @param more        channels of elements, machines and users
    /// @throws InputError for a name or alias that comes twice, or a channel without a name, units or long_name
    explicit Recorder(const Integrator& integrator, std::vector<ChannelGroup> more = {}, RecorderOptions options = {});

    const std::vector<Channel>& channels() const { return channels_; }
    /// @param values  out, one per channel.  Allocates.
    /// @throws InputError for an integrator of another system, or with other driven coordinates
    void sample(Integrator& integrator, double* values);

private:
    /// One entry of a vector of the state.
    struct State {
        Vector DynamicState::*vector;
        Eigen::Index entry;
    };
    void add_states(const RecorderOptions& options, const Integrator& integrator);
    void add_energies();
    void add_statistics();
    void check_names() const;

    const Model* model_;
    std::vector<Channel> channels_;
    std::vector<State> states_;
    bool energies_, statistics_;
    std::vector<ChannelGroup> more_;
    Workspace workspace_;
};

/// Times from `from` to `to` in equal steps, both included if the length is a multiple of the step.
/// @throws InputError for a step that is not positive, times out of order or more than 1e8 of them
std::vector<double> sample_times(double from, double to, double step);

/// Receives one row of values.
using RecordRow = std::function<void(double time, const std::vector<double>& values)>;

/// Advances to one time after another and hands the values at each to `row`; a time that is the present one is not
/// advanced to. Events that stop, failure and cancellation end it as they end Integrator::advance(). What an event or a
/// failure has reached is handed out as a last row if it lies after the row before; a run that was cancelled has the
/// rows at its times only, so that it may go on.
/// @throws InputError for an empty function, falling times
Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, const RecordRow& row);
/// The same into memory, appended to what is there.
/// @throws InputError if `into` has other channels
Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, History& into);

}  // namespace cardan::solvers
