#include "solvers/campbell.hpp"

#include "mbs/error.hpp"
#include "solvers/campbell_point.hpp"
#include "solvers/tracking.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace cardan::solvers {

namespace {

double lowest_frequency(const Campbell& diagram, const Branch& branch) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        if (branch.mode[i] >= 0) lowest = std::min(lowest, diagram.natural_hz(branch, i));
    return lowest;
}

std::vector<int> modes_of_branches(const Campbell& diagram, std::size_t point) {
    std::vector<int> modes;
    for (const Branch& branch : diagram.branches)
        if (branch.mode[point] >= 0) modes.push_back(branch.mode[point]);
    return modes;
}

// Keeps the modes of the branches and those up to the limit; the rest was needed for tracking and naming only.
void drop_high_modes(Campbell& diagram, double limit_hz) {
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        std::vector<CampbellMode>& modes = diagram.points[i].modes;
        const std::vector<int> of_branches = modes_of_branches(diagram, i);
        std::vector<int> new_index(modes.size(), -1);
        std::vector<CampbellMode> kept;
        for (std::size_t m = 0; m < modes.size(); ++m) {
            const bool needed =
                std::find(of_branches.begin(), of_branches.end(), static_cast<int>(m)) != of_branches.end();
            if (!needed && modes[m].mode.natural_hz() > limit_hz) continue;
            new_index[m] = static_cast<int>(kept.size());
            kept.push_back(std::move(modes[m]));
        }
        modes = std::move(kept);
        for (Branch& branch : diagram.branches)
            if (branch.mode[i] >= 0) branch.mode[i] = new_index[static_cast<std::size_t>(branch.mode[i])];
    }
}

// Motions of frames in some modes: the shape in blade coordinates at azimuth 0 times the frame Jacobians.
std::vector<std::vector<FrameMotion>> motions(const System& system, const PointSolver& solver,
                                              const CampbellPoint& point, const std::vector<int>& modes,
                                              const std::vector<FrameId>& frames) {
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, point.at.q, workspace);
    const Matrix T = solver.rotating_coordinates();
    ComplexMatrix shapes(T.rows(), static_cast<Eigen::Index>(modes.size()));
    for (Eigen::Index j = 0; j < shapes.cols(); ++j)
        shapes.col(j) = T * point.modes[static_cast<std::size_t>(modes[static_cast<std::size_t>(j)])].mode.shape;
    Matrix jacobian(6, system.model.size());
    std::vector<std::vector<FrameMotion>> motions(point.modes.size());
    for (FrameId frame : frames) {
        frame_jacobian(kin, frame, jacobian);
        const ComplexMatrix all = jacobian(Eigen::all, solver.unknowns()) * shapes;
        for (std::size_t j = 0; j < modes.size(); ++j)
            motions[static_cast<std::size_t>(modes[j])].push_back({all.col(static_cast<Eigen::Index>(j))});
    }
    return motions;
}

// Frames on the lines of the machine (lines are renumbered to count in this list), then those of all bodies; each once.
std::vector<FrameId> recorded_frames(const System& system, const RotorMap& rotor, Campbell& diagram) {
    std::vector<FrameId> frames;
    diagram.lines = rotor.lines;
    for (Polyline& line : diagram.lines)
        for (FrameId& frame : line.points) {
            auto found = std::find(frames.begin(), frames.end(), frame);
            if (found == frames.end()) found = frames.insert(frames.end(), frame);
            frame = FrameId{static_cast<int>(found - frames.begin())};
        }
    const auto& all = system.model.frames();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const FrameId id{static_cast<int>(i)};
        const bool own = all[i].body >= 0 && all[i].name == system.model.body(all[i].body).name;
        if (own && std::find(frames.begin(), frames.end(), id) == frames.end()) frames.push_back(id);
    }
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, Vector::Zero(system.model.size()), workspace);
    for (FrameId frame : frames) {
        diagram.frames.push_back(system.model.frame(frame).name);
        diagram.frame_positions.push_back(pose(kin, frame).p);
    }
    return frames;
}

void find_crossings(Campbell& diagram) {
    for (std::size_t b = 0; b < diagram.branches.size(); ++b)
        for (int n : rotor_multiples(diagram.blades))
            for (std::size_t i = 0; i + 1 < diagram.points.size(); ++i) {
                const double w0 = diagram.points[i].rotor_speed, w1 = diagram.points[i + 1].rotor_speed;
                const double f0 = diagram.damped_hz(diagram.branches[b], i),
                             f1 = diagram.damped_hz(diagram.branches[b], i + 1);
                const double d0 = f0 - n * w0 / (2 * pi), d1 = f1 - n * w1 / (2 * pi);
                if (!(d0 * d1 <= 0) || d0 == d1 || (d1 == 0 && i + 2 < diagram.points.size())) continue;
                const double t = d0 / (d0 - d1);
                diagram.crossings.push_back({static_cast<int>(b), n, w0 + t * (w1 - w0), f0 + t * (f1 - f0)});
            }
    std::sort(diagram.crossings.begin(), diagram.crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.rotor_speed < b.rotor_speed; });
}

void check_speeds(std::span<const double> rotor_speed) {
    if (rotor_speed.empty()) throw InputError("Campbell diagram", "number of rotor speeds", 0, "at least one");
    for (std::size_t i = 0; i < rotor_speed.size(); ++i)
        if (!std::isfinite(rotor_speed[i]) || rotor_speed[i] < 0 || (i > 0 && !(rotor_speed[i] > rotor_speed[i - 1])))
            throw InputError("Campbell diagram", text("rotor speed number ", i + 1, " [rad/s]"), rotor_speed[i],
                             "finite, >= 0 and increasing");
}

// A growing motion is no vibration to design for; it must not hide behind the oscillating branches.
void warn_of_instability(const CampbellPoint& point, std::string& warning) {
    if (!warning.empty()) return;
    for (const CampbellMode& m : point.modes) {
        const Complex lambda = m.mode.eigenvalue;
        if (lambda.real() > 1e-6 * std::max(1.0, std::abs(lambda))) {
            warning = text("unstable at ", point.rotor_speed * 30 / pi, " rpm: a motion at ", lambda.imag() / (2 * pi),
                           " Hz grows with ", lambda.real(), " 1/s");
            return;
        }
    }
}

void append(std::string& warning, const std::string& more) {
    if (!more.empty()) warning += (warning.empty() ? "" : "; ") + more;
}

const char* method_name(CampbellMethod method, std::size_t blades) {
    if (blades < 2) return "rotating frame of the blade";
    return method == CampbellMethod::coleman ? "Coleman (fixed frame)" : "frozen azimuth (as published in 2007)";
}

}  // namespace

std::vector<int> rotor_multiples(int blades) {
    std::set<int> n{1, 2, 3};
    for (int k = 1; k <= 4 && blades > 0; ++k) n.insert(k * blades);
    return {n.begin(), n.end()};
}

std::vector<double> rpm_range(double first, double last, double step) {
    if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(step) || !(step > 0) || last < first)
        throw InputError("rotor speeds", "FIRST:LAST:STEP [rpm]", text(first, ":", last, ":", step),
                         "finite, STEP > 0, FIRST <= LAST");
    std::vector<double> speeds;
    const double intervals = std::floor((last - first) / step + 1e-9);
    if (!(intervals < 1e5))
        throw InputError("rotor speeds", "number of speeds in FIRST:LAST:STEP", intervals + 1, "at most 100000");
    const auto count = static_cast<std::size_t>(intervals);
    for (std::size_t i = 0; i <= count; ++i) speeds.push_back((first + static_cast<double>(i) * step) * pi / 30);
    return speeds;
}

Campbell campbell(const System& system, const RotorMap& rotor, std::span<const double> rotor_speed,
                  const CampbellOptions& options) {
    check_speeds(rotor_speed);
    if (!(options.max_frequency_hz > 0))
        throw InputError("Campbell diagram", "largest frequency [Hz]", options.max_frequency_hz, "> 0");
    PointSolver solver(system, rotor, options);
    Campbell diagram;
    diagram.machine = rotor.machine;
    diagram.source = rotor.description;
    diagram.spin = options.spin;
    diagram.blades = static_cast<int>(rotor.blades.size());
    diagram.method = method_name(options.method, rotor.blades.size());
    diagram.coordinates = system.model.coordinates();
    diagram.unknowns = solver.unknowns();
    diagram.rows = solver.row_names();
    const std::vector<FrameId> frames = recorded_frames(system, rotor, diagram);
    Tracker tracker;
    std::string instability;
    for (std::size_t i = 0; i < rotor_speed.size(); ++i) {
        if (options.cancelled && options.cancelled()) {
            diagram.complete = false;
            break;
        }
        solver.solve(rotor_speed[i], diagram.points.emplace_back());
        tracker.add(solver.system(), diagram.points.back());
        if (options.method == CampbellMethod::coleman) warn_of_instability(diagram.points.back(), instability);
        if (options.progress) options.progress(static_cast<int>(i) + 1, static_cast<int>(rotor_speed.size()));
    }
    if (const Identification* identification = solver.identification()) {
        diagram.components = identification->components();
        const bool whirl = options.method == CampbellMethod::coleman &&
                           std::any_of(diagram.points.begin(), diagram.points.end(),
                                       [](const CampbellPoint& p) { return p.rotor_speed != 0; });
        diagram.branches = tracker.branches(diagram.points, *identification, whirl);
        std::erase_if(diagram.branches,
                      [&](const Branch& b) { return lowest_frequency(diagram, b) > options.max_frequency_hz; });
        drop_high_modes(diagram, options.max_frequency_hz);
        if (options.keep_shapes)
            for (std::size_t i = 0; i < diagram.points.size(); ++i)
                diagram.motions.push_back(
                    motions(system, solver, diagram.points[i], modes_of_branches(diagram, i), frames));
    }
    if (options.method == CampbellMethod::frozen_azimuth && rotor.blades.size() > 2)
        diagram.warning =
            "frozen azimuth: these are eigenvalues of the equations at one azimuth, no motions of the machine; they "
            "show "
            "spurious damping. Use the Coleman result for design";
    append(diagram.warning, solver.warning());
    append(diagram.warning, instability);
    find_crossings(diagram);
    return diagram;
}

}  // namespace cardan::solvers
