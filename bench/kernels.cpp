// Kernels on the tree of the 600 kW machine (70 coordinates with 3 elements per part; 3 or 12 elements).
#include "mbs/geometry/curvature.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <benchmark/benchmark.h>

using namespace cardan;

namespace {

struct Fixture {
    explicit Fixture(benchmark::State& state)
        : turbine(turbines::wt600(turbines::wt600_paper_assembly(static_cast<int>(state.range(0))))),
          model(turbine.system().model),
          workspace(model),
          n(model.size()),
          q(Vector::Constant(n, 0.01)),
          qd(Vector::Constant(n, 0.1)),
          qdd(Vector::Constant(n, 1.0)),
          tau(n),
          other(n),
          A(n, n),
          B(n, n) {
        state.counters["coordinates"] = static_cast<double>(n);
    }
    Kinematics kin() { return kinematics(model, q, workspace); }

    turbines::Turbine turbine;
    const Model& model;
    Workspace workspace;
    Eigen::Index n;
    Vector q, qd, qdd, tau, other;
    Matrix A, B;
};

void kinematics_only(benchmark::State& state) {
    Fixture f(state);
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(f.kin());
}
void inverse_dynamics_newton_euler(benchmark::State& state) {
    Fixture f(state);
    for ([[maybe_unused]] auto _ : state) {
        inverse_dynamics<double>(f.kin(), f.qd, f.qdd, f.tau);
        benchmark::ClobberMemory();
    }
}
void metric_full(benchmark::State& state) {
    Fixture f(state);
    for ([[maybe_unused]] auto _ : state) {
        metric<double>(f.kin(), f.A);
        benchmark::ClobberMemory();
    }
}
void christoffel_all(benchmark::State& state) {
    Fixture f(state);
    Christoffel gamma(f.model);
    state.counters["symbols"] = static_cast<double>(gamma.stored());
    for ([[maybe_unused]] auto _ : state) {
        christoffel_first_kind(f.kin(), gamma);
        benchmark::ClobberMemory();
    }
}
void forward_dynamics_articulated_body(benchmark::State& state) {
    Fixture f(state);
    ForwardDynamics forward(f.model);
    for ([[maybe_unused]] auto _ : state) {
        forward.solve(f.kin(), f.qd, f.qdd, f.tau, f.other);
        benchmark::ClobberMemory();
    }
}
void inverse_dynamics_partial_derivatives(benchmark::State& state) {
    Fixture f(state);
    for ([[maybe_unused]] auto _ : state) {
        inverse_dynamics_derivatives(f.kin(), f.qd, f.qdd, f.A, f.B);
        benchmark::ClobberMemory();
    }
}

void metric_factorised(benchmark::State& state) {
    Fixture f(state);
    MetricFactor factor(f.model);
    metric<double>(f.kin(), f.A);
    state.counters["entries"] = static_cast<double>(factor.stored());
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(factor.factorise(f.A));
}
void metric_factor_solve_vector(benchmark::State& state) {
    Fixture f(state);
    MetricFactor factor(f.model);
    if (!factor.factorise(f.kin())) state.SkipWithError("singular metric");
    for ([[maybe_unused]] auto _ : state) {
        f.tau = f.qdd;
        factor.solve(f.tau);
        benchmark::ClobberMemory();
    }
}
void metric_factor_solve_matrix(benchmark::State& state) {
    Fixture f(state);
    MetricFactor factor(f.model);
    if (!factor.factorise(f.kin())) state.SkipWithError("singular metric");
    for ([[maybe_unused]] auto _ : state) {
        f.A.setIdentity();
        factor.solve(f.A);
        benchmark::ClobberMemory();
    }
}
void christoffel_symbols_visited(benchmark::State& state) {
    Fixture f(state);
    Christoffel gamma(f.model);
    christoffel_first_kind(f.kin(), gamma);
    for ([[maybe_unused]] auto _ : state) {
        f.tau.setZero();
        for (auto [a, b, c, value] : gamma.symbols()) f.tau(a) += (b == c ? 1 : 2) * value * f.qd(b) * f.qd(c);
        benchmark::ClobberMemory();
    }
}
void christoffel_contraction(benchmark::State& state) {
    Fixture f(state);
    Christoffel gamma(f.model);
    christoffel_first_kind(f.kin(), gamma);
    for ([[maybe_unused]] auto _ : state) {
        gamma.contract(f.qd, f.qdd, f.tau);
        benchmark::ClobberMemory();
    }
}
void christoffel_along_the_spin(benchmark::State& state) {
    Fixture f(state);
    const int spin = f.turbine.rotor().spin;
    for ([[maybe_unused]] auto _ : state) {
        christoffel_along<double>(f.kin(), spin, f.A);
        benchmark::ClobberMemory();
    }
}
void forward_dynamics_partial_derivatives(benchmark::State& state) {
    Fixture f(state);
    ForwardDynamicsDerivatives derivatives(f.model);
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(derivatives.compute(f.kin(), f.qd, f.qdd));
}
void curvature_force(benchmark::State& state) {
    Fixture f(state);
    Curvature curvature(f.model);
    if (!curvature.update(f.kin())) state.SkipWithError("singular metric");
    for ([[maybe_unused]] auto _ : state) {
        curvature.force(f.qd, f.qdd, f.tau);
        benchmark::ClobberMemory();
    }
}
void curvature_matrix(benchmark::State& state) {
    Fixture f(state);
    Curvature curvature(f.model);
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(curvature.update(f.kin()));
        curvature.matrix(f.qd, f.A);
        benchmark::ClobberMemory();
    }
}

BENCHMARK(kinematics_only)->Arg(3)->Arg(12);
BENCHMARK(inverse_dynamics_newton_euler)->Arg(3)->Arg(12);
BENCHMARK(metric_full)->Arg(3)->Arg(12);
BENCHMARK(christoffel_all)->Arg(3)->Arg(12);
BENCHMARK(forward_dynamics_articulated_body)->Arg(3)->Arg(12);
BENCHMARK(inverse_dynamics_partial_derivatives)->Arg(3)->Arg(12);
BENCHMARK(metric_factorised)->Arg(3)->Arg(12);
BENCHMARK(metric_factor_solve_vector)->Arg(3)->Arg(12);
BENCHMARK(metric_factor_solve_matrix)->Arg(3)->Arg(12);
BENCHMARK(christoffel_symbols_visited)->Arg(3)->Arg(12);
BENCHMARK(christoffel_contraction)->Arg(3)->Arg(12);
BENCHMARK(christoffel_along_the_spin)->Arg(3)->Arg(12);
BENCHMARK(forward_dynamics_partial_derivatives)->Arg(3)->Arg(12);
BENCHMARK(curvature_force)->Arg(3)->Arg(12);
BENCHMARK(curvature_matrix)->Arg(3)->Arg(12);

}  // namespace
