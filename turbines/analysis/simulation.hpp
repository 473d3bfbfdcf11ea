/// @file
/// The motion of a machine in time: with its generator or a controller, in the air or driven by a torque.
///
///     const turbines::Machine machine = turbines::read_machine("MODEL.fst");
///     turbines::Simulation run(machine, {.wind = 12, .controller = turbines::Controller::baseline()});
///     const turbines::Recording result = run.record("run.h5", {.duration = 20});
///
/// It is what `cardan simulate` computes, to the last digit.
#pragma once

#include "solvers/signals/history.hpp"
#include "solvers/time/recorder.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"
#include "turbines/model/assembly.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cardan::turbines {

/// Recording of a run.
struct Recording {
    solvers::History history;       ///< of the channels in RecordSettings::kept
    bool complete = false;          ///< false: it was cancelled before
    solvers::EnergyBalance energy;  ///< at its end
    solvers::IntegrationStatistics statistics;
};

/// A machine on its way through time, from a start in steady rotation. One object per thread.
class Simulation {
public:
    /// Assembles the machine, with as many elements as it takes, and finds the start, which can take a second or two.
    /// @throws InputError for settings out of range, with the field, and for what the machine does not have: airfoils,
    /// a generator that turns freely, coordinates; NumericalError if no steady state shows the torque of the air; as
    /// the readers
    explicit Simulation(const Machine& machine, const SimulationSettings& settings = {});
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Goes on to the end of the duration and records all channels, in memory and in a file of HDF5
    /// (solvers::read_history()), which is replaced if it exists. The rotor turns freely against the torque of the
    /// generator or, where that is locked, at constant speed.
    /// @throws InputError for settings out of range, and for a file to go on with that is of another run, or under a
    /// library as controller, which keeps its memory to itself; FileError; NumericalError if the integration fails
    Recording record(const std::filesystem::path& file, const RecordSettings& settings = {});
    /// Records a run in memory alone.
    Recording record(const RecordSettings& settings = {});

    /// Duration that record() would simulate, s.
    double duration(const RecordSettings& settings = {}) const;

    /// The machine as it runs, with the settings.
    const Machine& machine() const;
    /// Settings with what was not given: rotor speed, pitch, elements, individual pitch.
    const SimulationSettings& settings() const;
    /// The assembled machine with air, controller and loads.
    const Turbine& turbine() const;
    const std::vector<Channel>& channels() const;
    /// "NREL 5 MW, no gravity"
    const std::string& title() const;
    /// Remarks of the simulation so far.
    const std::vector<Remark>& remarks() const;
    const solvers::Integrator& integrator() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace cardan::turbines
