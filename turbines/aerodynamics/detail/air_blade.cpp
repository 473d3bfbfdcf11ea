#include "turbines/aerodynamics/detail/air_blade.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>

namespace cardan::turbines {

namespace {

constexpr double slack = 1e-3;  // of a blade's length: files round its ends

// A rigid segment of an element: what it covers of the reference line, and where it is in its body.
struct RigidSegment {
    const CardanBeam::Element* element;
    FrameId carrier;
    int body;
    Placement carrier_axes;  // in body axes
    Placement element_axes;  // in body axes
    double from, to;
};

std::vector<RigidSegment> segments_of(const CardanBeam& beam, const Model& model) {
    std::vector<RigidSegment> all;
    for (const CardanBeam::Element& element : beam.elements) {
        const std::array<double, 5> ends = element.hinges.ends();
        for (std::size_t j = 0; j < element.segments.size(); ++j) {
            const CardanBeam::Segment& segment = element.segments[j];
            const Model::Frame& frame = model.frame(segment.carrier);
            all.push_back({&element, segment.carrier, frame.body, frame.in_body,
                           frame.in_body * Placement::translation({-segment.x, 0, 0}),
                           element.start + ends[j] * element.arc, element.start + entry(ends, j + 1) * element.arc});
        }
    }
    return all;
}

// Place of the pitch joint's axis and distance of the blade's root from the hub's centre.
struct RootPlace {
    Vec3 axis;  // axes of the hub's body
    double distance;
};
RootPlace root_place(const Turbine& turbine, std::size_t k) {
    const Model& model = turbine.system().model;
    const MachineLayout& layout = turbine.layout();
    Workspace workspace(model);
    const Vector q = Vector::Zero(model.size());
    const Kinematics kin = kinematics(model, q, workspace);
    const Pose<double> hub = pose(kin, layout.hub), root = pose(kin, layout.pitch_axes[k]);
    const Mat3 body = kin.rotation(model.frame(layout.hub).body);
    return {body.transpose() * root.R.col(0), (root.p - hub.p).norm()};
}

// Sections of one blade, laid on its reference line.
class Layout {
public:
    Layout(const CardanBeam& beam, const AeroBlade& blade, const Model& model, double hub_distance)
        : beam_(beam), blade_(blade), segments_(segments_of(beam, model)) {
        for (std::size_t i = 0; i < blade.sections(); ++i) {
            places_.push_back(place_along(blade.position[i] - hub_distance, i));
            offsets_.push_back(offset(i, places_.back(), blade.position[i] - hub_distance));
        }
        breaks_ = beam.line.breaks;
        breaks_.insert(breaks_.end(), places_.begin(), places_.end());
        std::sort(breaks_.begin(), breaks_.end());
    }

    AirSection section(std::size_t i) const {
        const double s = places_[i];
        const auto holds = [s](const RigidSegment& one) { return s <= one.to; };
        const auto found = std::find_if(segments_.begin(), segments_.end(), holds);
        const RigidSegment& on = found == segments_.end() ? segments_.back() : *found;
        const Placement axes = on.element_axes * beam_.span(*on.element).pose(s);
        const double twist = blade_.twist[i];  // of the leading edge, from y of the blade upwind, against z
        return {on.body,
                axes * offsets_[i],
                axes.R.col(0),
                -std::cos(twist) * axes.R.col(1) + std::sin(twist) * axes.R.col(2),
                {}};
    }

    void add_points(std::size_t i, std::vector<AirPoint>& points) const {
        const double from = i > 0 ? places_[i - 1] : places_[i],
                     to = i + 1 < places_.size() ? places_[i + 1] : places_[i];
        for (const RigidSegment& on : segments_) {
            const double a = std::max(from, on.from), b = std::min(to, on.to);
            if (!(b > a)) continue;
            const ElementLine line = beam_.span(*on.element);
            const Eigen::Vector4d zero = Eigen::Vector4d::Zero();
            const Eigen::Vector4d sum = integrate(a, b, breaks_, zero, [&](double s) {
                const double N = share(i, s);
                Eigen::Vector4d out;
                out << N, N * (line.pose(s) * offset_at(s));
                return out;
            });
            if (!(sum(0) > 1e-9 * (to - from))) continue;
            const Vec3 place = on.element_axes * Vec3(sum.tail<3>() / sum(0));
            points.push_back({on.body, {on.carrier, on.carrier_axes.inverse() * place}, place, sum(0), i});
        }
    }

private:
    // Arc length where the line has this distance along the blade's axis from the root.
    double place_along(double x, std::size_t i) const {
        const BeamLine& line = beam_.line;
        const double last = line.pose(line.length).p.x(), tolerance = slack * line.length;
        if (x < -tolerance || x > last + tolerance)
            throw InputError(text("aerodynamic blade on ", beam_.name, ", section ", i + 1),
                             "distance from the blade's root [m]", x, text("0 ... ", last));
        if (line.is_straight()) return std::clamp(x, 0.0, line.length);
        double from = 0, to = line.length;
        for (int step = 0; step < 60; ++step) {
            const double middle = (from + to) / 2;
            (line.pose(middle).p.x() < x ? from : to) = middle;
        }
        return (from + to) / 2;
    }
    // Of the aerodynamic centre from the line, section axes.
    Vec3 offset(std::size_t i, double s, double x) const {
        if (blade_.prebend.empty() && blade_.sweep.empty()) return Vec3::Zero();
        const Vec3 centre(x, blade_.sweep.empty() ? 0.0 : -blade_.sweep[i],
                          blade_.prebend.empty() ? 0.0 : blade_.prebend[i]);
        Vec3 out = beam_.line.pose(s).inverse() * centre;
        out.x() = 0;
        return out;
    }
    std::size_t interval(double s) const {
        const auto next = std::upper_bound(places_.begin() + 1, places_.end() - 1, s);
        return static_cast<std::size_t>(next - places_.begin() - 1);
    }
    double share(std::size_t i, double s) const {
        const std::size_t j = interval(s);
        const double t = (s - places_[j]) / (places_[j + 1] - places_[j]);
        return i == j ? 1 - t : i == j + 1 ? t : 0;
    }
    Vec3 offset_at(double s) const {
        const std::size_t j = interval(s);
        const double t = share(j + 1, s);
        return (1 - t) * offsets_[j] + t * offsets_[j + 1];
    }

    const CardanBeam& beam_;
    const AeroBlade& blade_;
    std::vector<RigidSegment> segments_;
    std::vector<double> places_, breaks_;  // along the reference line
    std::vector<Vec3> offsets_;
};

}  // namespace

std::vector<int> path_to(const Model& model, int body) {
    std::vector<int> path;
    for (int at = body; at >= 0; at = model.body(at).parent) path.push_back(at);
    std::reverse(path.begin(), path.end());
    return path;
}

AirBlade air_blade(const Turbine& turbine, std::size_t k, const AeroBlade& blade) {
    const Model& model = turbine.system().model;
    const RootPlace root = root_place(turbine, k);
    const Layout layout(turbine.layout().blades[k], blade, model, root.distance);
    const auto B = static_cast<double>(turbine.layout().blades.size());
    AirBlade out;
    out.axis = root.axis;
    for (std::size_t i = 0; i < blade.sections(); ++i) {
        out.sections.push_back(layout.section(i));
        out.sections.back().annulus = blade.annulus(i, B);
        layout.add_points(i, out.points);
    }
    // Derivatives are gathered from the tip down.
    std::ranges::stable_sort(out.points, [](const AirPoint& a, const AirPoint& b) { return a.body > b.body; });
    out.path = path_to(model, model.frame(turbine.layout().blades[k].tip()).body);
    return out;
}

}  // namespace cardan::turbines
