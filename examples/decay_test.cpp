// Decay test of a damped beam: displaced in its first mode and let go, logarithmic decrement from peak to peak.
#include <cardan/elements/cardan_beam/single_beam.hpp>
#include <cardan/mbs/base/entry.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/equilibrium/natural_modes.hpp>
#include <cardan/solvers/time/integrate.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    constexpr double length = 30, mass = 300, EI = 1e9, ratio = 0.01;  // m, kg/m, N m^2, of critical damping
    const double hz = 3.5160153 / (2 * pi * length * length) * std::sqrt(EI / mass);
    const SingleBeam beam =
        clamped_beam(uniform_beam(length, {.mass = mass, .EI_flap = EI, .EI_edge = EI}),
                     {.elements = 6, .torsion = false, .locked_z = true, .damping = BeamDamping::ratio_at(ratio, hz)});
    const solvers::NaturalModes natural = solvers::natural_modes(beam.system);
    const solvers::Mode& mode = natural.modes.front();

    // One hundredth of a radian at the root, everything else as in the mode.
    const Vector zero = Vector::Zero(beam.system.model.size());
    Vector q = zero;
    for (Eigen::Index i = 0; i < mode.shape.size(); ++i)
        q(entry(natural.unknowns, i)) = 0.01 * (mode.shape(i) / mode.shape(0)).real();
    const int root = natural.unknowns.front();
    solvers::IntegrationOptions options;
    options.events = {
        {.name = "peak", .function = [root](const StateView& at) { return at.qd(root); }, .direction = -1}};
    solvers::Integrator integrator(beam.system, {}, 0, q, zero, options);

    std::printf("peak     time, s   angle, rad   decrement\n");
    std::vector<double> times, angles;
    for (int peak = 0; peak <= 5; ++peak) {
        const solvers::Advance end = integrator.advance(100);
        if (end.end != solvers::Advance::End::event) throw NumericalError(end.message);
        times.push_back(end.time);
        angles.push_back(integrator.state().q(root));
        std::printf("%4d %11.5f %12.8f", peak, times.back(), angles.back());
        if (peak > 0) std::printf("%12.6f", std::log(angles.end()[-2] / angles.back()));
        std::printf("\n");
    }
    std::printf("decrement  %.6f, of the damping ratio %.6f\n", std::log(angles.front() / angles.back()) / 5,
                2 * pi * ratio / std::sqrt(1 - ratio * ratio));
    std::printf("frequency  %.6f Hz, of the mode %.6f Hz\n", 5 / (times.back() - times.front()), mode.damped_hz());
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
