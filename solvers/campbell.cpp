#include "solvers/campbell.hpp"

#include "mbs/error.hpp"
#include "solvers/tracking.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace cardan::solvers {

namespace {

// One rotor speed after the other; keeps what all have in common.
class Sweep {
public:
    Sweep(const System& system, const RotorMap& rotor, const CampbellOptions& options)
        : system_(system), rotor_(rotor), options_(options) {
        const std::size_t blades = rotor.blades.size();
        if (blades == 2)
            throw InputError(rotor.machine, "number of blades", blades,
                             "3 or more, or 1 (two blades have a periodic system, which is not available yet)");
        for (int i : system.model.coordinates().free())
            if (i != rotor.spin || (options.spin == RotorSpin::free && blades > 1)) unknowns.push_back(i);
        if (blades > 2)
            coleman_.emplace(rotor, unknowns);
        else
            plain_rows_.resize(unknowns.size());
    }

    CampbellPoint point(double rotor_speed) {
        SteadyOptions steady_options;
        steady_options.rotor_speed = rotor_speed;
        steady_options.initial = start_;
        SteadyState steady = steady_state(system_, rotor_.spin, steady_options);
        if (!steady.converged)
            throw NumericalError(text(rotor_.machine, " at ", rotor_speed * 30 / pi, " rpm: ", steady.message));
        start_ = steady.at.q;
        const Linearisation lin = linearise(system_, steady.at);
        if (!identification) identification.emplace(lin, system_.model, rotor_, unknowns, rows());
        current = in_fixed_frame(lin, rotor_speed);
        CampbellPoint point{rotor_speed, steady.at, {}};
        for (Mode& mode : modes(current)) {
            if (mode.natural_hz() > options_.max_frequency_hz) continue;
            std::vector<Share> shares = identification->shares(mode);
            Vector row_shares = energy_by_row(current, mode);
            point.modes.push_back({std::move(mode), std::move(shares), std::move(row_shares)});
        }
        return point;
    }

    /// Motions of frames: the shape in blade coordinates at azimuth 0 times the frame Jacobians.
    std::vector<std::vector<FrameMotion>> motions(const CampbellPoint& point,
                                                  const std::vector<FrameId>& frames) const {
        Workspace workspace(system_.model);
        const Kinematics kin = kinematics(system_.model, point.at.q, workspace);
        const auto n = static_cast<Eigen::Index>(unknowns.size());
        const Matrix T = coleman_ ? coleman_->matrix(0) : Matrix::Identity(n, n);
        Matrix jacobian(6, system_.model.size());
        std::vector<std::vector<FrameMotion>> motions(point.modes.size());
        for (FrameId frame : frames) {
            frame_jacobian(kin, frame, jacobian);
            const Matrix J = jacobian(Eigen::all, unknowns) * T;
            for (std::size_t m = 0; m < motions.size(); ++m) motions[m].push_back({J * point.modes[m].mode.shape});
        }
        return motions;
    }

    // Blade coordinates are named after blade 1, with the pattern that their row stands for.
    std::vector<std::string> row_names() const {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < unknowns.size(); ++i) {
            const MultiBladeRow& row = rows()[i];
            const bool blade = row.kind != MultiBlade::none;
            const int coordinate =
                blade ? rotor_.blades[0][static_cast<std::size_t>(row.blade_coordinate)] : unknowns[i];
            const std::string& name = system_.model.coordinates()[coordinate].name;
            names.push_back(blade ? text(name, " (", multi_blade_name(row), ")") : name);
        }
        return names;
    }

    std::vector<int> unknowns;
    std::optional<Identification> identification;
    SecondOrderSystem current;  ///< system of the last point
    std::string warning;

private:
    const std::vector<MultiBladeRow>& rows() const { return coleman_ ? coleman_->rows() : plain_rows_; }

    SecondOrderSystem in_fixed_frame(const Linearisation& lin, double rotor_speed) {
        SecondOrderSystem own = restrict_to(lin, unknowns, rotor_.spin);
        if (!coleman_) return own;
        if (options_.method == CampbellMethod::frozen_azimuth) return coleman_->transform(own, 0, 0);
        SecondOrderSystem z = coleman_->transform(own, 0, rotor_speed);
        if (rotor_speed != 0 && rotor_.spin >= 0) average_if_periodic(lin.at, rotor_speed, z);
        return z;
    }

    // The transformed matrices of an isotropic rotor are constant; else their mean over the azimuth is taken and said.
    void average_if_periodic(const OperatingPoint& at, double rotor_speed, SecondOrderSystem& z) {
        const auto at_azimuth = [&](double psi) {
            OperatingPoint turned = at;
            turned.q(rotor_.spin) += psi;
            return coleman_->transform(restrict_to(linearise(system_, turned), unknowns, rotor_.spin), psi,
                                       rotor_speed);
        };
        const SecondOrderSystem other = at_azimuth(1.0);
        const double remainder = (other.K - z.K).norm() / z.K.norm() + (other.M - z.M).norm() / z.M.norm();
        if (remainder < 1e-9) return;
        constexpr int azimuths = 24;
        for (int i = 1; i < azimuths; ++i) {
            const SecondOrderSystem next = at_azimuth(2 * pi * i / azimuths);
            z.M += next.M, z.C += next.C, z.K += next.K;
        }
        z.M /= azimuths, z.C /= azimuths, z.K /= azimuths;
        if (warning.empty())
            warning = text("the rotor is not isotropic: the multi-blade system keeps a periodic remainder of ",
                           remainder, " (relative); its mean over the azimuth is used, which is an approximation");
    }

    const System& system_;
    const RotorMap& rotor_;
    const CampbellOptions& options_;
    std::optional<ColemanTransform> coleman_;
    std::vector<MultiBladeRow> plain_rows_;
    Vector start_;
};

// Frames on the lines of the machine, each once; lines are renumbered to count in this list.
std::vector<FrameId> frames_on_lines(const System& system, const RotorMap& rotor, Campbell& diagram) {
    std::vector<FrameId> frames;
    diagram.lines = rotor.lines;
    for (Polyline& line : diagram.lines)
        for (FrameId& frame : line.points) {
            auto found = std::find(frames.begin(), frames.end(), frame);
            if (found == frames.end()) found = frames.insert(frames.end(), frame);
            frame = FrameId{static_cast<int>(found - frames.begin())};
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
        for (int n = 1; n <= std::max(6, 2 * diagram.blades); ++n)
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
        if (!std::isfinite(rotor_speed[i]))
            throw InputError("Campbell diagram", text("rotor speed number ", i + 1, " [rad/s]"), rotor_speed[i],
                             "finite");
}

const char* method_name(CampbellMethod method, std::size_t blades) {
    if (blades < 2) return "rotating frame of the blade";
    return method == CampbellMethod::coleman ? "Coleman (fixed frame)" : "frozen azimuth (as published in 2007)";
}

}  // namespace

std::vector<double> rpm_range(double first, double last, double step) {
    if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(step) || !(step > 0) || last < first)
        throw InputError("rotor speeds", "FIRST:LAST:STEP [rpm]", text(first, ":", last, ":", step),
                         "finite, STEP > 0, FIRST <= LAST");
    std::vector<double> speeds;
    const auto count = static_cast<std::size_t>(std::floor((last - first) / step + 1e-9));
    for (std::size_t i = 0; i <= count; ++i) speeds.push_back((first + static_cast<double>(i) * step) * pi / 30);
    return speeds;
}

Campbell campbell(const System& system, const RotorMap& rotor, std::span<const double> rotor_speed,
                  const CampbellOptions& options) {
    check_speeds(rotor_speed);
    Sweep sweep(system, rotor, options);
    Campbell diagram;
    diagram.machine = rotor.machine;
    diagram.blades = static_cast<int>(rotor.blades.size());
    diagram.method = method_name(options.method, rotor.blades.size());
    diagram.coordinates = system.model.coordinates();
    diagram.unknowns = sweep.unknowns;
    diagram.rows = sweep.row_names();
    const std::vector<FrameId> frames = frames_on_lines(system, rotor, diagram);
    Tracker tracker;
    for (std::size_t i = 0; i < rotor_speed.size(); ++i) {
        if (options.cancelled && options.cancelled()) {
            diagram.complete = false;
            break;
        }
        diagram.points.push_back(sweep.point(rotor_speed[i]));
        tracker.add(sweep.current, diagram.points.back());
        if (options.keep_shapes) diagram.motions.push_back(sweep.motions(diagram.points.back(), frames));
        if (options.progress) options.progress(static_cast<int>(i) + 1, static_cast<int>(rotor_speed.size()));
    }
    if (sweep.identification) {
        diagram.components = sweep.identification->components();
        const bool whirl = options.method == CampbellMethod::coleman &&
                           std::any_of(diagram.points.begin(), diagram.points.end(),
                                       [](const CampbellPoint& p) { return p.rotor_speed != 0; });
        diagram.branches = tracker.branches(diagram.points, *sweep.identification, whirl);
    }
    if (options.method == CampbellMethod::frozen_azimuth && rotor.blades.size() > 2)
        diagram.warning =
            "frozen azimuth: these are eigenvalues of the equations at one azimuth, no motions of the machine; they "
            "show "
            "spurious damping. Use the Coleman result for design";
    if (!sweep.warning.empty()) diagram.warning += (diagram.warning.empty() ? "" : "; ") + sweep.warning;
    find_crossings(diagram);
    return diagram;
}

}  // namespace cardan::solvers
