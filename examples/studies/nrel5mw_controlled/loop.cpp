#include "examples/studies/nrel5mw_controlled/simulate.hpp"
#include "examples/studies/nrel5mw_controlled/studies.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "solvers/pictures/history.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace cardan::controlled {

namespace {

constexpr double frequency_allowed = 0.01, damping_allowed = 0.01;  // part; of the ratio

// A part c exp(eigenvalue t) of a motion.
struct FreeMotion {
    Complex eigenvalue;  // 1/s
    Complex amplitude;   // c, of the first sample
};

// y_(k+n) = sum_i a_i y_(k+i), in the sense of least squares.
Vector recursion(const Vector& y, Eigen::Index order) {
    const Eigen::Index rows = y.size() - order;
    Matrix H(rows, order);
    for (Eigen::Index i = 0; i < order; ++i) H.col(i) = y.segment(i, rows);
    return Eigen::JacobiSVD<Matrix>(H, Eigen::ComputeThinU | Eigen::ComputeThinV).solve(y.tail(rows));
}

ComplexVector roots(const Vector& a) {
    const Eigen::Index n = a.size();
    Matrix companion = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) companion(i, i + 1) = 1;
    companion.row(n - 1) = a.transpose();
    return Eigen::EigenSolver<Matrix>(companion, false).eigenvalues();
}

// A motion y_k at equal steps as a sum of `order` such parts and a constant. Prony's method on the differences
// y_(k+1) - y_k: their recursion by least squares, its roots, amplitudes by least squares.    [Hildebrand 1956, ch. 9]
// @param step  s
// @returns parts by falling amplitude
// @throws InputError for fewer than three samples per part
std::vector<FreeMotion> prony(const std::vector<double>& samples, double step, int order) {
    const auto count = std::ssize(samples) - 1;
    if (order < 1 || count < 3 * static_cast<std::ptrdiff_t>(order))
        throw InputError("Prony's method", "samples", count, text(">= ", 3 * order));
    Vector y(count);
    for (Eigen::Index k = 0; k < count; ++k)
        y(k) = samples[static_cast<std::size_t>(k) + 1] - samples[static_cast<std::size_t>(k)];
    const ComplexVector z = roots(recursion(y, order));
    ComplexMatrix powers(count, z.size());
    powers.row(0).setOnes();
    for (Eigen::Index k = 1; k < count; ++k) powers.row(k) = powers.row(k - 1).cwiseProduct(z.transpose());
    const ComplexVector right = y.cast<Complex>(),
                        c = Eigen::JacobiSVD<ComplexMatrix>(powers, Eigen::ComputeThinU | Eigen::ComputeThinV)
                                .solve(right);
    std::vector<FreeMotion> parts;
    for (Eigen::Index i = 0; i < z.size(); ++i) parts.push_back({std::log(z(i)) / step, c(i) / (z(i) - 1.0)});
    std::ranges::sort(parts, std::greater<>(), [](const FreeMotion& part) { return std::abs(part.amplitude); });
    return parts;
}

// The largest of them that oscillates.
FreeMotion largest_oscillation(const std::vector<FreeMotion>& parts) {
    for (const FreeMotion& part : parts)
        if (part.eigenvalue.imag() > 1e-6 * std::abs(part.eigenvalue)) return part;
    throw NumericalError("the motion does not oscillate");
}

double damping(Complex eigenvalue) {
    return -eigenvalue.real() / std::abs(eigenvalue);
}

// Means over a time: parts of a motion keep their eigenvalues and fast ones become small.
std::vector<double> means(const std::vector<double>& samples, std::size_t width) {
    std::vector<double> smooth;
    for (std::size_t i = 0; i + width <= samples.size(); ++i) {
        double sum = 0;
        for (std::size_t k = i; k < i + width; ++k) sum += samples[k];
        smooth.push_back(sum / static_cast<double>(width));
    }
    return smooth;
}

// From the rotor speed after the step, without the vibrations of tower (0.3 Hz) and drive train.
Complex measured_loop(const solvers::History& speed, double from) {
    constexpr std::size_t every = 5;  // samples, 0.5 s: the loop is slow
    std::vector<double> samples, few;
    for (std::size_t i = 0; i < speed.time.size(); ++i)
        if (speed.time[i] >= from) samples.push_back(speed.values[0][i]);
    for (const std::size_t width : {31, 20, 10}) samples = means(samples, width);
    for (std::size_t i = 0; i < samples.size(); i += every) few.push_back(samples[i]);
    return largest_oscillation(prony(few, every * (speed.time[1] - speed.time[0]), 5)).eigenvalue;
}

struct Loop {
    double wind, pitch;
    std::vector<Complex> rigid;  // from the gains alone to all that lags
    Complex elastic, measured;
    solvers::History speed;
};

std::vector<Complex> rigid_loops(const SteadyPoint& point, double inertia) {
    std::vector<Complex> found;
    for (const RigidParts& parts :
         {RigidParts{false, false, false, false}, RigidParts{true, false, false, false},
          RigidParts{true, true, false, false}, RigidParts{true, true, true, false}, RigidParts{}})
        found.push_back(rigid_loop(point, inertia, parts));
    return found;
}

Loop loop_at(const MachineOptions& machine, double wind, const LoopOptions& options) {
    constexpr double step = 0.1, at = 1;  // s; the wind changes at `at`
    const Plant here = plant(machine, wind);
    Loop loop{wind, here.point.pitch, rigid_loops(here.point, rotor_inertia(here)), {}, {}, {}};
    loop.elastic = elastic_loop(linear_loop(here, {}), loop.rigid.back()).eigenvalue;
    const double before = wind - options.change;
    const WindSteps change{{before, wind}, at};  // it settles where the eigenvalue holds
    loop.speed = response(plant(machine, before), change, {}, options.duration, step, "RotSpeed",
                          text("wind of ", wind, " m/s"));
    if (!program::interrupted()) loop.measured = measured_loop(loop.speed, at + 1);
    return loop;
}

void print_row(const Loop& loop, const std::vector<Complex>& eigenvalues) {
    std::printf("%6.1f %7.2f", loop.wind, loop.pitch * units::to_degrees);
    for (const Complex eigenvalue : eigenvalues)
        std::printf("   %7.4f %7.4f", std::abs(eigenvalue), damping(eigenvalue));
}

void print_rigid(const std::vector<Loop>& loops) {
    std::printf("natural frequency, rad/s, and damping ratio of the speed loop of a rigid machine\n\n");
    std::printf("%6s %7s   %-15s   %-15s   %-15s   %-15s   %-15s\n", "wind", "pitch", "gains alone", "and schedule",
                "and power", "and filter", "and drives");
    for (const Loop& loop : loops) {
        print_row(loop, loop.rigid);
        std::printf("\n");
    }
}

bool print_elastic(const std::vector<Loop>& loops) {
    std::printf("\nof the elastic machine, and as the response of the program shows them\n\n");
    std::printf("%6s %7s   %-15s   %-15s   %s\n", "wind", "pitch", "eigenvalue", "response", "difference");
    bool all = true;
    for (const Loop& loop : loops) {
        const double frequency = std::abs(loop.measured) / std::abs(loop.elastic) - 1,
                     ratio_difference = damping(loop.measured) - damping(loop.elastic);
        const bool good = std::abs(frequency) < frequency_allowed && std::abs(ratio_difference) < damping_allowed;
        print_row(loop, {loop.elastic, loop.measured});
        std::printf("   %+6.2f %% %+8.4f%s\n", 100 * frequency, ratio_difference, good ? "" : "  DIFFERS");
        all = all && good;
    }
    return all;
}

// All responses as channels of one history.
solvers::History joined(const std::vector<Loop>& loops) {
    solvers::History all{
        "Rotor speed after a step of the rotor's torque, NREL 5 MW machine", {}, loops.front().speed.time, {}};
    for (const Loop& loop : loops) {
        all.channels.push_back(loop.speed.channels.front());
        all.values.push_back(loop.speed.values.front());
    }
    return all;
}

void check(const std::vector<double>& all, const LoopOptions& options) {
    if (all.size() > 7)
        throw InputError("--winds", "number of winds", all.size(), "at most 7, the colours of a picture");
    if (!(std::abs(options.change) > 0 && std::abs(options.change) <= 1))
        throw InputError("--change", "of the wind [m/s]", options.change, "up to 1, not 0");
    if (!(options.duration >= 30)) throw InputError("--duration", "value [s]", options.duration, ">= 30");
}

}  // namespace

const solvers::Mode& elastic_loop(const LinearLoop& loop, Complex rigid) {
    const auto nearest = std::ranges::min_element(
        loop.modes, {}, [&](const solvers::Mode& mode) { return std::abs(mode.eigenvalue - rigid); });
    if (nearest == loop.modes.end()) throw NumericalError("the closed loop has no modes");
    return *nearest;
}

Complex rigid_loop(const SteadyPoint& point, double inertia, const RigidParts& parts) {
    constexpr double fast = 1e5;  // rad/s
    const VariableSpeedController controller(turbines::nrel5mw_controller());
    const VariableSpeedParameters& p = controller.parameters();
    const turbines::ActuatorOptions a = pitch_actuators();
    const double S = trim_point(point.wind).sensitivity / rated_speed, g = controller.gain(point.pitch),
                 h = parts.schedule ? g * point.pitch / p.doubling_pitch : 0,
                 w = parts.drives ? a.pitch_frequency : fast, t = parts.drives ? a.torque_time_constant : 1 / fast,
                 c = parts.filter ? p.corner_frequency : fast, speed = gear_ratio * point.rotor_speed,
                 slope = parts.power ? -p.rated_power / (speed * speed) : 0;
    enum State : std::uint8_t { W, f, z, pitch, rate, torque, count };
    Matrix A = Matrix::Zero(count, count);
    A(W, pitch) = S / inertia, A(W, torque) = -gear_ratio / inertia;
    A(f, W) = c * gear_ratio, A(f, f) = -c;
    A(z, f) = p.integral;
    A(pitch, rate) = 1;
    A(rate, f) = w * w * g * p.proportional, A(rate, z) = w * w * g, A(rate, pitch) = -w * w * (1 + h),
            A(rate, rate) = -2 * a.pitch_damping * w;
    A(torque, f) = slope / t, A(torque, torque) = -1 / t;
    const ComplexVector roots = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
    Complex lowest(0, 1e300);
    for (const Complex root : roots)
        if (root.imag() > 1e-9 && std::abs(root) < std::abs(lowest)) lowest = root;
    return lowest;
}

int loop(const MachineOptions& machine, const LoopOptions& options, const std::string& out) {
    const std::vector<double> all = winds_above_rated("--winds", options.winds);
    check(all, options);
    program::check_outputs(out, {".svg", ".png"});
    std::vector<Loop> loops;
    for (const double wind : all) {
        program::progress(text("\rwind ", wind, " m/s   "));
        loops.push_back(loop_at(machine, wind, options));
        if (program::interrupted()) return 130;
    }
    program::progress("\r                \r");
    print_rigid(loops);
    const bool good = print_elastic(loops);
    const solvers::History history = joined(loops);
    solvers::HistoryPanel panel;
    for (const Channel& channel : history.channels) panel.channels.push_back(channel.name);
    for (const char* ending : {".svg", ".png"}) solvers::plot(history, {panel}, out + ending);
    std::printf("\nfiles: %s.svg, .png\n", out.c_str());
    return good ? 0 : 3;
}

}  // namespace cardan::controlled
