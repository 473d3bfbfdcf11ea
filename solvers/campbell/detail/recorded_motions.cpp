#include "solvers/campbell/detail/recorded_motions.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

// Shapes in blade coordinates at azimuth 0.
ComplexMatrix shapes_at_azimuth_0(const PointSolver& solver, const CampbellPoint& point,
                                  const std::vector<int>& modes) {
    const Matrix T = solver.rotating_coordinates();
    ComplexMatrix shapes(T.rows(), std::ssize(modes));
    for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
        const CampbellMode& m = entry(point.modes, entry(modes, j));
        if (m.floquet)
            shapes.col(j) = T * m.floquet->shape(0);
        else
            shapes.col(j) = T * m.mode.shape;
    }
    return shapes;
}

}  // namespace

std::vector<std::vector<FrameMotion>> motions(const System& system, const PointSolver& solver,
                                              const CampbellPoint& point, const std::vector<int>& modes,
                                              const std::vector<FrameId>& frames) {
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, point.at.q, workspace);
    const ComplexMatrix shapes = shapes_at_azimuth_0(solver, point, modes);
    const Matrix followers = solver.followers(point.at);
    Matrix jacobian(6, system.model.size());
    std::vector<std::vector<FrameMotion>> motions(point.modes.size());
    for (FrameId frame : frames) {
        frame_jacobian(kin, frame, jacobian);
        const Matrix moved =
            followers.size() > 0 ? Matrix(jacobian * followers) : Matrix(jacobian(Eigen::all, solver.unknowns()));
        const ComplexMatrix all = moved * shapes;
        for (Eigen::Index j = 0; j < all.cols(); ++j) entry(motions, entry(modes, j)).push_back({all.col(j)});
    }
    return motions;
}

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

}  // namespace cardan::solvers
