/// @file
/// What fragments in the documents may take as given: an HTML comment before the block names it,
/// <!-- given: turbine, integrator -->
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/machine_elements/joints.hpp"
#include "solvers/time/recorder.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

extern const cardan::turbines::Turbine turbine;
extern const cardan::Tree tree;
extern const cardan::System linkage;
extern const cardan::JointedFrame slide;
extern const cardan::BodyId shaft;
extern cardan::ForceSet forces;
extern const cardan::Polar polar;
extern const cardan::AeroBlade aero_blade;
extern std::vector<cardan::solvers::Drive> drives;
extern cardan::solvers::IntegrationOptions options;
extern cardan::solvers::SampledController sampled_controller;
extern cardan::solvers::Integrator integrator;
extern cardan::solvers::Recorder recorder;
extern cardan::solvers::History history;
