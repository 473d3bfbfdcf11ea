/// @file
/// Records channels of a motion while it is integrated.
#pragma once

#include "solvers/signals/history.hpp"
#include "solvers/time/integrate.hpp"

#include <array>
#include <functional>
#include <vector>

namespace cardan::solvers {

/// Options of what is recorded in addition to the user's own channels.
struct RecorderOptions {
    bool coordinates = true;     ///< "<coordinate>", rad or m
    bool rates = true;           ///< "<coordinate> rate"
    bool accelerations = false;  ///< "<coordinate> acceleration"
    bool states = true;          ///< "<state>", of those beside the coordinates
    bool actuators = true;       ///< "<coordinate> drive": force of the drive, for driven coordinates
    bool energies = true;        ///< "kinetic energy" ... "energy error", J; see EnergyBalance
    bool statistics = true;      ///< "steps", "rejected steps" ..., see IntegrationStatistics
};

/// Names of the channels of RecorderOptions::energies, which plot_energies() draws.
inline constexpr std::array energy_channels{"kinetic energy",     "potential energy",  "dissipated energy",
                                            "energy from drives", "energy from loads", "energy error"};

/// Values of a fixed list of channels at the state of an integrator. Keeps a reference to its model.
class Recorder {
public:
    /// @param integrator  this one, or any other of the same system with the same driven coordinates, is sampled
    /// @param more        channels of elements, machines and users
    /// @throws InputError for a duplicate name or alias, or a channel without a name, units or long_name
    explicit Recorder(const Integrator& integrator, std::vector<ChannelGroup> more = {}, RecorderOptions options = {});
    explicit Recorder(Integrator&&, std::vector<ChannelGroup> = {}, RecorderOptions = {}) = delete;  // must live longer

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
    void add_energy(const char* name, const char* long_name);
    void add_energies();
    void add_state_energies();
    void add_statistics();
    void check_names() const;

    const Model* model_;
    std::vector<Channel> channels_;
    std::vector<State> states_;
    bool energies_, statistics_, state_energies_ = false;
    std::vector<ChannelGroup> more_;
    Workspace workspace_;
};

/// Times from `from` to `to` in equal steps, both included if the length is a multiple of the step.
/// @throws InputError for a step that is not positive, times out of order or more than 1e8 of them
std::vector<double> sample_times(double from, double to, double step);

/// Receives one row of values.
using RecordRow = std::function<void(double time, const std::vector<double>& values)>;

/// Advances to one time after another and passes the values at each to `row`; no step is taken to a time equal to the
/// present one. Stopping events, failure and cancellation end it as they end Integrator::advance(). The state reached
/// by an event or a failure is output as a last row if it is later than the previous row; a cancelled run has rows at
/// the given times only, so that it may be continued.
/// @throws InputError for an empty function, descending times
Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, const RecordRow& row);
/// Records into memory, appending to the history.
/// @throws InputError if the channels of `into` differ or it has not one list of values for each
Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, History& into);

}  // namespace cardan::solvers
