#include "solvers/mode_names/detail/neighbour_names.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/assignment.hpp"
#include "solvers/mode_names/detail/floquet_mac.hpp"
#include "solvers/mode_names/detail/tracking.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

constexpr double rival_part = 0.8;  // of the MAC: above it another mode competes

// Index of the point at a rotor speed; -1: none.
int point_at_speed(const Campbell& diagram, double speed) {
    const auto same = [&](const CampbellPoint& p) { return std::abs(p.rotor_speed - speed) <= 1e-9 * speed; };
    const auto found = std::find_if(diagram.points.begin(), diagram.points.end(), same);
    return found == diagram.points.end() ? -1 : static_cast<int>(found - diagram.points.begin());
}

}  // namespace

// A file has none, but the motions of frames.
bool NeighbourNames::has_shapes(std::size_t rows) const {
    for (std::size_t i = 0; i < neighbour_.points.size(); ++i)
        for (const Branch& branch : neighbour_.branches)
            if (const CampbellMode* m = neighbour_.mode(branch, i);
                m && m->mode.shape.size() != static_cast<Eigen::Index>(rows))
                return false;
    return true;
}

void NeighbourNames::set_machine(const Campbell& diagram) {
    constexpr auto place = "neighbouring Campbell diagram";
    if (!neighbour_.parameter.empty())
        throw InputError(place, "parameter", neighbour_.parameter, "none: a diagram over the rotor speed");
    if (neighbour_.method != diagram.method)
        throw InputError(place, "method", neighbour_.method, text("'", diagram.method, "', as the other"));
    if (neighbour_.blades != diagram.blades)
        throw InputError(place, "number of blades", neighbour_.blades, text(diagram.blades, ", as the other"));
    const auto [own, other] =
        std::mismatch(diagram.rows.begin(), diagram.rows.end(), neighbour_.rows.begin(), neighbour_.rows.end());
    const bool same_rows = own == diagram.rows.end() && other == neighbour_.rows.end();
    if (same_rows && has_shapes(diagram.rows.size())) return;
    lines_.emplace(neighbour_, diagram);
    if (lines_->has_lines() && !neighbour_.motions.empty()) return;
    const std::string else_lines = "; else both with lines of the same parts, and with their motions (keep_shapes)";
    if (same_rows) throw InputError(place, "shapes of its modes", "none", "over the rows of the other" + else_lines);
    throw InputError(
        place, text("row ", own - diagram.rows.begin() + 1, " of the modes"),
        other == neighbour_.rows.end() ? "none" : *other,
        text(own == diagram.rows.end() ? "none, as the other" : text("'", *own, "', as the other"), else_lines));
}

void NeighbourNames::add(const SecondOrderSystem& system, const CampbellPoint& point,
                         const std::function<std::vector<std::vector<FrameMotion>>()>& motions) {
    Matrix& mac = mac_.emplace_back();
    const int there = point_at_speed(neighbour_, point.rotor_speed);
    if (there < 0) return;
    std::vector<const CampbellMode*> modes;
    std::vector<const std::vector<FrameMotion>*> moving;
    std::vector<Eigen::Index> branches;
    for (Eigen::Index b = 0; b < std::ssize(neighbour_.branches); ++b) {
        const Branch& branch = entry(neighbour_.branches, b);
        const int mode = entry(branch.mode, there);
        if (mode < 0) continue;
        modes.push_back(&entry(entry(neighbour_.points, there).modes, mode));
        if (lines_) moving.push_back(&entry(entry(neighbour_.motions, there), mode));
        branches.push_back(b);
    }
    const Matrix found = lines_ ? lines_->mac(moving, motions()) : periodic_mac(system, modes, point.modes).mac;
    mac = Matrix::Zero(std::ssize(neighbour_.branches), found.cols());
    for (Eigen::Index i = 0; i < found.rows(); ++i) mac.row(entry(branches, i)) = found.row(i);
}

void NeighbourNames::pair(const std::vector<Branch>& branches) {
    const auto others = std::ssize(neighbour_.branches);
    Matrix sum = Matrix::Zero(std::ssize(branches), others);
    Vector count = Vector::Zero(sum.rows());
    bool common = mac_.empty();
    for (std::size_t i = 0; i < mac_.size(); ++i) {
        if (mac_[i].size() == 0) continue;
        common = true;
        for (Eigen::Index b = 0; b < sum.rows(); ++b) {
            const int mode = entry(branches, b).mode[i];
            if (mode < 0) continue;
            sum.row(b) += mac_[i].col(mode).transpose();
            ++count(b);
        }
    }
    if (!common)
        throw InputError("neighbouring Campbell diagram", "number of rotor speeds that both diagrams have", 0,
                         "at least one with modes");
    partner_ = assign(sum);
    for (Eigen::Index b = 0; b < sum.rows(); ++b) {
        int& found = entry(partner_, b);
        if (found >= 0 && !(sum(b, found) >= min_score * std::max(1.0, count(b)))) found = -1;
    }
}

const Branch* NeighbourNames::partner(std::size_t branch) const {
    const int index = partner_.at(branch);
    return index < 0 ? nullptr : &entry(neighbour_.branches, index);
}

bool NeighbourNames::doubtful(std::size_t branch, std::size_t point, int mode) const {
    const int index = partner_.at(branch);
    if (index < 0) return true;
    const Matrix& mac = mac_.at(point);
    if (mac.size() == 0 || mac.row(index).isZero(0)) return false;  // the neighbour has nothing there
    return !fits(index, point, mode);
}

const Branch* NeighbourNames::certain(std::size_t point, int mode) const {
    const Matrix& mac = mac_.at(point);
    if (mac.size() == 0) return nullptr;
    Eigen::Index most = 0;
    mac.col(mode).maxCoeff(&most);
    return fits(static_cast<int>(most), point, mode) ? &entry(neighbour_.branches, most) : nullptr;
}

// Of the neighbour's branch.
bool NeighbourNames::fits(int branch, std::size_t point, int mode) const {
    const Matrix& mac = mac_.at(point);
    const double own = mac(branch, mode);
    if (own < min_reliable_mac) return false;
    double rival = 0;
    for (Eigen::Index b = 0; b < mac.rows(); ++b)
        if (b != branch) rival = std::max(rival, mac(b, mode));
    for (Eigen::Index m = 0; m < mac.cols(); ++m)
        if (m != mode) rival = std::max(rival, mac(branch, m));
    return !(rival > rival_part * own);
}

}  // namespace cardan::solvers
