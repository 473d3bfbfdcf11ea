#include "elements/cardan_beam/element_line.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

ElementLine::ElementLine(const BeamLine& line, double start, double end, const Vec3& hinge_line)
    : line_(&line), start_(start), end_(end), chord_(end - start), hinge_line_(hinge_line) {
    axes_ = line.pose(start);
    if (!line.is_straight()) {
        const Vec3 along = line.pose(end).p - axes_.p;
        chord_ = along.norm();
        const std::string where = text(line.name, ", element from ", start, " to ", end, " m");
        if (!(chord_ > 1e-6 * (end - start)))
            throw InputError(where, "distance of its ends [m]", chord_, "> 0: more elements are needed");
        if (chord_ > (1 + 1e-9) * (end - start))
            throw InputError(where, "distance of its ends [m]", chord_,
                             text("<= ", end - start, ", its length along the line (derivative of another curve?)"));
        const Mat3 middle = line.pose((start + end) / 2).R;
        axes_.R = shortest_rotation(middle.col(0), along / chord_, where) * middle;
    }
    axes_.p += axes_.R * hinge_line_;
}

Placement ElementLine::pose(double s) const {
    if (line_->is_straight()) return Placement::translation(Vec3(s - start_, 0, 0) - hinge_line_);
    return axes_.inverse() * line_->pose(s);
}

}  // namespace cardan
