// The air on the NREL 5 MW machine beside its structure: forces beside the forward dynamics, derivatives beside those
// of the forward dynamics. Skewed wake and shear, 57 sections.
#include "bench/pairs.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

#include <benchmark/benchmark.h>

#include <optional>

namespace cardan {

namespace {

// In operation, a little out of shape.
class Machine {
public:
    Machine()
        : turbine_(turbines::nrel5mw()),
          air_(turbines::MachineAir(turbine_, turbines::nrel5mw_aero_blade(),
                                    SteadyWind{.speed = 10, .shear = Shear::power, .exponent = 0.2})
                   .element()),
          workspace_(model()),
          wrenches_(air_.points.size()),
          dynamics_(model()),
          derivatives_(model()) {
        const Eigen::Index n = model().size();
        state_.q = Vector::LinSpaced(n, -0.005, 0.005);
        state_.qd = Vector::LinSpaced(n, -0.002, 0.002);  // the hub moves at 1 m/s by it
        state_.qd(turbine_.rotor().spin) = 1.1;
        Q_ = qdd_ = actuator_ = Vector::Zero(n);
        by_q_ = by_qd_ = Matrix::Zero(n, n);
        columns_.resize(n, 0);
        rows_.resize(0, n);
        new_input();
    }

    void forces_of_air() {
        ElementForces out{Q_, none_, wrenches_};
        air_.evaluate(input(), out);
        benchmark::DoNotOptimize(wrenches_.data());
    }
    void forward_dynamics() {
        const StateView at = new_input();
        turbine_.system().forces.generalised_forces(at, Q_);
        dynamics_.solve(at.kinematics, at.qd, Q_, qdd_, actuator_);
        benchmark::DoNotOptimize(qdd_.data());
    }
    void derivatives_of_air() {
        ElementJacobian out{by_q_, by_qd_, columns_, columns_, columns_, rows_, rows_, nothing_, nothing_, nothing_};
        air_.jacobian(input(), out);
        benchmark::DoNotOptimize(by_q_.data());
    }
    void derivatives_of_dynamics() {
        const StateView at = new_input();
        turbine_.system().forces.derivatives(at, forces_);
        benchmark::DoNotOptimize(derivatives_.compute(at.kinematics, at.qd, qdd_, &forces_));
    }

private:
    const Model& model() const { return turbine_.system().model; }
    // The structure computes the kinematics, the air finds them.
    StateView input() const { return {state_, *kin_}; }
    StateView new_input() {
        kin_.emplace(kinematics(model(), state_.q, workspace_));
        return input();
    }

    turbines::Turbine turbine_;
    ForceElement air_;
    Workspace workspace_;
    std::optional<Kinematics> kin_;
    std::vector<Wrench> wrenches_;
    ForwardDynamics dynamics_;
    ForwardDynamicsDerivatives derivatives_;
    ForceDerivatives forces_;
    State state_;
    Vector qdd_, Q_, actuator_;
    Vector none_;
    Matrix by_q_, by_qd_, columns_, rows_, nothing_;
};

void beside(benchmark::State& state, void (Machine::*air)(), void (Machine::*structure)()) {
    Machine machine;
    const auto many = [&](void (Machine::*what)()) {
        return bench::cpu_time_of([&] {
            for (int i = 0; i < 50; ++i) (machine.*what)();
        });
    };
    bench::Pairs times;
    for ([[maybe_unused]] auto _ : state) {
        const double own = many(air);
        times.add(own, many(structure));
        state.SetIterationTime(own / 50);
    }
    state.counters["air over structure"] = times.ratio();
}

BENCHMARK_CAPTURE(beside, forces, &Machine::forces_of_air, &Machine::forward_dynamics)
    ->UseManualTime()
    ->Iterations(bench::Pairs::min)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(beside, derivatives, &Machine::derivatives_of_air, &Machine::derivatives_of_dynamics)
    ->UseManualTime()
    ->Iterations(bench::Pairs::min)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace cardan
