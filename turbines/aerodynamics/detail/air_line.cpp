#include "turbines/aerodynamics/detail/air_line.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr double slack = 1e-3;  // of a line's length: files round its ends

}  // namespace

std::vector<RigidPiece> pieces_of(const CardanBeam& beam, const Model& model) {
    std::vector<RigidPiece> all;
    for (const CardanBeam::Element& element : beam.elements) {
        const std::array<double, 5> ends = element.hinges.ends();
        for (std::size_t j = 0; j < element.segments.size(); ++j) {
            const CardanBeam::Segment& segment = element.segments[j];
            const Model::Frame& frame = model.frame(segment.carrier);
            const Placement axes = frame.in_body * Placement::translation({-segment.x, 0, 0});
            all.push_back({element.start + ends[j] * element.arc, element.start + entry(ends, j + 1) * element.arc,
                           segment.carrier, frame.body, frame.in_body,
                           [axes, line = beam.span(element)](double s) { return axes * line.pose(s); }});
        }
    }
    return all;
}

double arc_at(const BeamLine& line, double x, const std::string& where, const char* quantity) {
    const double last = line.pose(line.length).p.x(), tolerance = slack * line.length;
    if (!(x >= -tolerance && x <= last + tolerance)) throw InputError(where, quantity, x, text("0 ... ", last));
    if (line.is_straight()) return std::clamp(x, 0.0, line.length);
    double from = 0, to = line.length;
    for (int step = 0; step < 60; ++step) {
        const double middle = (from + to) / 2;
        (line.pose(middle).p.x() < x ? from : to) = middle;
    }
    return (from + to) / 2;
}

AirLine::AirLine(std::vector<RigidPiece> pieces, std::vector<double> breaks, std::vector<double> places,
                 std::vector<Vec3> offsets)
    : pieces_(std::move(pieces)), breaks_(std::move(breaks)), places_(std::move(places)), offsets_(std::move(offsets)) {
    breaks_.insert(breaks_.end(), places_.begin(), places_.end());
    std::sort(breaks_.begin(), breaks_.end());
}

const RigidPiece& AirLine::piece(std::size_t section) const {
    const double s = places_[section];
    const auto found = std::ranges::find_if(pieces_, [s](const RigidPiece& one) { return s <= one.to; });
    return found == pieces_.end() ? pieces_.back() : *found;
}

void AirLine::add_points(std::size_t section, std::vector<AirPoint>& points) const {
    const std::size_t i = section;
    const double from = i > 0 ? places_[i - 1] : places_[i], to = i + 1 < places_.size() ? places_[i + 1] : places_[i];
    for (const RigidPiece& on : pieces_) {
        const double a = std::max(from, on.from), b = std::min(to, on.to);
        if (!(b > a)) continue;
        const Eigen::Vector4d zero = Eigen::Vector4d::Zero();
        const Eigen::Vector4d sum = integrate(a, b, breaks_, zero, [&](double s) {
            const double N = share(i, s);
            Eigen::Vector4d out;
            out << N, N * (on.pose(s) * offset_at(s));
            return out;
        });
        if (!(sum(0) > 1e-9 * (to - from))) continue;
        const Vec3 place = sum.tail<3>() / sum(0);
        points.push_back({on.body, {on.carrier, on.carrier_axes.inverse() * place}, place, sum(0), i});
    }
}

std::size_t AirLine::interval(double s) const {
    const auto next = std::upper_bound(places_.begin() + 1, places_.end() - 1, s);
    return static_cast<std::size_t>(next - places_.begin() - 1);
}

double AirLine::share(std::size_t section, double s) const {
    const std::size_t j = interval(s);
    const double t = (s - places_[j]) / (places_[j + 1] - places_[j]);
    return section == j ? 1 - t : section == j + 1 ? t : 0;
}

Vec3 AirLine::offset_at(double s) const {
    const std::size_t j = interval(s);
    const double t = share(j + 1, s);
    return (1 - t) * offsets_[j] + t * offsets_[j + 1];
}

void sort_by_body(std::vector<AirPoint>& points) {
    std::ranges::stable_sort(points, [](const AirPoint& a, const AirPoint& b) { return a.body > b.body; });
}

}  // namespace cardan::turbines
