#include "mbs/geometry/change_of_chart.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/kinematics.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace cardan {

namespace {

constexpr const char* in_change_of_chart = "change of chart";

void check_size(const Vector& v, const Model& model, const char* what) {
    if (v.size() != model.size())
        throw InputError(in_change_of_chart, what, v.size(), text(model.size(), ", one per coordinate"));
}

// The smallest rotation vector, base axes, that takes R to `target`.
Vec3 turn(const Mat3& R, const Mat3& target) {
    const Eigen::AngleAxisd rest(target * R.transpose());
    return rest.angle() * rest.axis();
}

// Which coordinates of `to` are known, and the poses and twists from which the others follow.
class Transition {
public:
    Transition(const Model& from, const ChartState& state, const Model& to, const std::vector<std::string>& frames)
        : to_(to), workspace_(to), known_(Vector::Zero(to.size())), known_rate_(Vector::Zero(to.size())) {
        for (int i = 0; i < to.size(); ++i) {
            const CoordinateTable& old = from.coordinates();
            const auto same = std::find_if(old.begin(), old.end(),
                                           [&](const CoordinateInfo& c) { return c.name == to.coordinates()[i].name; });
            if (same == old.end()) {
                unknown_.push_back(i);
                continue;
            }
            known_(i) = state.q(same - old.begin());
            known_rate_(i) = state.qd(same - old.begin());
        }
        if (6 * frames.size() < unknown_.size())
            throw InputError(in_change_of_chart, "number of frames", frames.size(),
                             text(">= 1 for every six of the ", unknown_.size(), " coordinates that are new, as '",
                                  to.coordinates()[unknown_.front()].name, "'"));
        Workspace workspace(from);
        const Kinematics kin = kinematics(from, state.q, workspace);
        Matrix J(6, from.size());
        for (const std::string& name : frames) {
            frame_jacobian<double>(kin, from.frame(name), J);
            targets_.push_back({to.frame(name), pose(kin, from.frame(name)), J * state.qd});
            size_ = std::max(size_, targets_.back().pose.p.norm());
        }
    }

    ChartState solve(const Vector& near) {
        ChartState out{known_, known_rate_};
        if (unknown_.empty()) return out;
        double best = std::numeric_limits<double>::infinity();
        for (int attempt = 0; attempt < attempts(); ++attempt) {
            Vector q = start(near, attempt);
            const double left = iterate(q);
            if (!(left < best)) continue;
            best = left;
            out.q = q;
            if (best < 1e-11) break;
        }
        if (best > 1e-8)
            throw NumericalError(text(in_change_of_chart, ": no position of the new coordinates ('",
                                      to_.coordinates()[unknown_.front()].name,
                                      "' ...) carries the frames to where they are; the nearest found is off by ", best,
                                      " rad, or by this part of a distance of ", size_, " m"));
        out.qd(unknown_) = solve_rates(out.q);
        return out;
    }

private:
    struct Target {
        FrameId frame;
        Pose<double> pose;
        Vec6 twist;
    };

    Eigen::Index rows() const { return 6 * std::ssize(targets_); }
    // Quarter turns of the first three revolute joints.
    int attempts() const {
        int all = 1, joints = 0;
        for (int i : unknown_)
            if (to_.body(i).revolute && joints++ < 3) all *= 4;
        return all;
    }
    Vector start(const Vector& near, int attempt) const {
        Vector q = known_;
        int joints = 0;
        for (int i : unknown_) {
            q(i) = near.size() > 0 ? near(i) : 0;
            if (!to_.body(i).revolute || joints++ >= 3) continue;
            constexpr double turns[] = {0, pi / 2, -pi / 2, pi};
            q(i) += turns[attempt % 4];
            attempt /= 4;
        }
        return q;
    }
    // Residual of the poses, lengths scaled by the size, and its Jacobian.
    Vector miss(const Vector& q, Matrix* J) {
        const Kinematics kin = kinematics(to_, q, workspace_);
        Vector e(rows());
        Matrix all(6, to_.size());
        for (Eigen::Index row = 0; row < rows(); row += 6) {
            const Target& target = entry(targets_, row / 6);
            const Pose<double> now = pose(kin, target.frame);
            e.segment<3>(row) = turn(now.R, target.pose.R);
            e.segment<3>(row + 3) = (target.pose.p - now.p) / size_;
            if (!J) continue;
            frame_jacobian<double>(kin, target.frame, all);
            all.bottomRows<3>() /= size_;
            J->middleRows(row, 6) = all(Eigen::all, unknown_);
        }
        return e;
    }
    // Newton steps of at most half a radian, halved until the residual falls. Returns the final residual.
    double iterate(Vector& q) {
        Matrix J(rows(), std::ssize(unknown_));
        double left = miss(q, &J).norm();
        for (int i = 0; i < 60; ++i) {
            Vector step = J.completeOrthogonalDecomposition().solve(miss(q, &J));
            double largest = 0;
            for (Eigen::Index k = 0; k < step.size(); ++k)
                if (to_.body(entry(unknown_, k)).revolute) largest = std::max(largest, std::abs(step(k)));
            if (largest > 0.5) step *= 0.5 / largest;
            Vector trial = q;
            double now = left;
            for (int halvings = 0; halvings < 10; ++halvings, step /= 2) {
                trial(unknown_) = q(unknown_) + step;
                now = miss(trial, nullptr).norm();
                if (now < left) break;
            }
            if (!(now < left)) break;
            q = trial;
            left = now;
        }
        return left;
    }
    Vector solve_rates(const Vector& q) {
        Matrix J(rows(), std::ssize(unknown_));
        miss(q, &J);
        const Kinematics kin = kinematics(to_, q, workspace_);
        Vector twist(rows());
        Matrix all(6, to_.size());
        for (Eigen::Index row = 0; row < rows(); row += 6) {
            const Target& target = entry(targets_, row / 6);
            frame_jacobian<double>(kin, target.frame, all);
            twist.segment<6>(row) = target.twist - all * known_rate_;
            twist.segment<3>(row + 3) /= size_;
        }
        const Vector length = J.colwise().norm();
        for (Eigen::Index k = 0; k < length.size(); ++k)
            if (length(k) > 0) J.col(k) /= length(k);
        Eigen::ColPivHouseholderQR<Matrix> qr(J);
        qr.setThreshold(1e-7);
        if (qr.rank() < J.cols())
            throw NumericalError(
                text(in_change_of_chart, ": the new coordinates are singular at this state, '",
                     to_.coordinates()[entry(unknown_, qr.colsPermutation().indices()(qr.rank()))].name,
                     "' first; change where they are not, or choose others"));
        return Vector(qr.solve(twist)).cwiseQuotient(length);
    }

    const Model& to_;
    Workspace workspace_;
    Vector known_, known_rate_;
    std::vector<int> unknown_;
    std::vector<Target> targets_;
    double size_ = 1;  ///< of the distances of the frames from the base, m
};

}  // namespace

ChartState change_of_chart(const Model& from, const ChartState& state, const Model& to,
                           const std::vector<std::string>& frames, const Vector& near) {
    check_size(state.q, from, "number of positions");
    check_size(state.qd, from, "number of rates");
    if (near.size() > 0) check_size(near, to, "number of positions to begin at");
    return Transition(from, state, to, frames).solve(near);
}

double chart_quality(const Model& model, const Vector& q, std::string_view frame, const std::vector<int>& coordinates) {
    check_size(q, model, "number of positions");
    if (coordinates.empty()) throw InputError(in_change_of_chart, "number of coordinates", 0, ">= 1");
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    Matrix all(6, model.size());
    frame_jacobian<double>(kin, model.frame(frame), all);
    Matrix J(6, std::ssize(coordinates));
    for (Eigen::Index k = 0; k < J.cols(); ++k) {
        const int i = entry(coordinates, k);
        if (i < 0 || i >= model.size())
            throw InputError(in_change_of_chart, "index of a coordinate", i, text("0 ... ", model.size() - 1));
        const double length = all.col(i).norm();
        if (length == 0)
            throw InputError(text(in_change_of_chart, ": frame '", frame, "'"), "coordinate",
                             model.coordinates()[i].name, "one that moves it");
        J.col(k) = all.col(i) / length;
    }
    return Eigen::JacobiSVD<Matrix>(J).singularValues().tail<1>()(0);
}

}  // namespace cardan
