/// @file
/// The machine under the program, in time.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"
#include "solvers/time/recorder.hpp"

#include <memory>
#include <string>

namespace cardan::controlled {

/// A simulation from the trim of a plant under winds that follow one another.
class Simulation {
public:
    Simulation(const Plant& plant, const WindSteps& wind, const DamperOptions& damper, double tolerance);
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;
    ~Simulation() = default;

    solvers::Integrator& integrator() { return *integrator_; }
    solvers::Recorder& recorder() { return *recorder_; }
    const turbines::Turbine& turbine() const { return machine_.turbine; }

private:
    turbines::ControlledMachine machine_;
    std::unique_ptr<solvers::Integrator> integrator_;
    std::unique_ptr<solvers::Recorder> recorder_;
};

/// One channel at equal steps from 0 to `duration`, alone in a history.
/// @param name  that it gets
solvers::History response(const Plant& plant, const WindSteps& wind, const DamperOptions& damper, double duration,
                          double step, const std::string& channel, const std::string& name);

}  // namespace cardan::controlled
