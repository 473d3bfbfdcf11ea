#include "solvers/campbell_data/blade_shapes.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/units.hpp"
#include "mbs/base/version.hpp"
#include "mbs/model/spatial.hpp"
#include "solvers/campbell_data/csv.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

// Divides by the flap or edge displacement of largest modulus, so that this one becomes 1.
void normalise(BladeShape& shape) {
    Complex largest = 0;
    for (const Vec3T<Complex>& u : shape.displacement)
        for (const Complex& component : {u.y(), u.z()})
            if (std::abs(component) > std::abs(largest)) largest = component;
    if (largest == Complex(0)) return;
    for (auto* vectors : {&shape.displacement, &shape.rotation})
        for (Vec3T<Complex>& vector : *vectors) vector /= largest;
}

}  // namespace

BladeShapes blade_shapes(const Campbell& diagram, std::span<const std::string> names, std::size_t point,
                         const Vec3& rotor_axis) {
    const auto line = std::find_if(diagram.lines.begin(), diagram.lines.end(),
                                   [](const Polyline& l) { return l.blade == 1 && l.points.size() > 1; });
    if (line == diagram.lines.end()) throw InputError(text(diagram.machine, ": no line of blade 1 for mode shapes"));
    const auto position = [&](FrameId frame) { return entry(diagram.frame_positions, frame.index); };
    const Vec3 centre = position(line->points.front());
    const Vec3 x = (position(line->points.back()) - centre).normalized();
    Mat3 to_blade;  // rows: blade axes in base axes
    to_blade.row(0) = x;
    to_blade.row(1) = cross<double>(rotor_axis, x).normalized();
    to_blade.row(2) = cross<double>(x, Vec3(to_blade.row(1)));

    BladeShapes shapes{diagram.machine, diagram.points.at(point).rotor_speed, {}};
    for (const std::string& name : names) {
        const auto branch = std::find_if(diagram.branches.begin(), diagram.branches.end(),
                                         [&](const Branch& b) { return b.name == name; });
        if (branch == diagram.branches.end() || branch->mode[point] < 0) continue;
        BladeShape shape{name, diagram.natural_hz(*branch, point), branch->doubtful[point], {}, {}, {}};
        const std::vector<FrameMotion> motion = diagram.motion(*branch, point);
        for (auto frame = line->points.begin() + 1; frame != line->points.end(); ++frame) {
            const Vec6T<Complex>& m = entry(motion, frame->index).motion;
            shape.radius.push_back(x.dot(position(*frame) - centre));
            shape.rotation.emplace_back(to_blade.cast<Complex>() * m.head<3>());
            shape.displacement.emplace_back(to_blade.cast<Complex>() * m.tail<3>());
        }
        normalise(shape);
        shapes.modes.push_back(std::move(shape));
    }
    return shapes;
}

void write_csv(std::span<const BladeShapes> shapes, const std::filesystem::path& path) {
    std::ostringstream out = text_stream();
    out.precision(10);
    if (!shapes.empty())
        out << csv_comment(text("Blade mode shapes: ", shapes.front().machine, "; cardan ", version()));
    out << "# Per metre of the largest flap or edge displacement of the mode, which is 1 and real. flap: along the "
           "rotor "
           "axis, downwind; edge: in the rotor plane, toward the leading edge; radial: outward; twist: leading edge "
           "downwind.\n"
           "rotor_speed[rpm],mode[-],natural_frequency[Hz],radius[m],flap[-],edge[-],radial[-],twist[deg/m],"
           "flap_imaginary[-],edge_imaginary[-],radial_imaginary[-],twist_imaginary[deg/m]\n";
    for (const BladeShapes& at : shapes)
        for (const BladeShape& mode : at.modes)
            for (std::size_t i = 0; i < mode.radius.size(); ++i) {
                const Vec3T<Complex>& u = mode.displacement[i];
                const Complex twist = mode.rotation[i].x() * units::to_degrees;
                out << at.rotor_speed * units::to_rpm << ',' << csv_field(mode.name) << ',' << mode.natural_hz << ','
                    << mode.radius[i] << ',' << u.z().real() << ',' << u.y().real() << ',' << u.x().real() << ','
                    << twist.real() << ',' << u.z().imag() << ',' << u.y().imag() << ',' << u.x().imag() << ','
                    << twist.imag() << '\n';
            }
    write_file(path, out.str());
}

}  // namespace cardan::solvers
