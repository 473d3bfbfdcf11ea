#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/pictures/campbell.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

// Largest displacement of any frame, and the phase at which it occurs.
struct Largest {
    double size = 0, phase = 0;
};

Largest largest_displacement(const std::vector<FrameMotion>& motion) {
    Largest largest;
    for (const FrameMotion& frame : motion)
        for (int step = 0; step < 180; ++step) {
            const double phase = step * units::degree;
            const double size = (frame.motion.tail<3>() * std::polar(1.0, phase)).real().norm();
            if (size > largest.size) largest = {size, phase};
        }
    return largest;
}

// Points of all lines, blank records between them: x, y, z.
std::string lines_data(const Campbell& d, const std::string& name, const std::vector<FrameMotion>& motion, double scale,
                       double phase) {
    std::string data = "$" + name + " << EOD\n";
    for (const Polyline& line : d.lines) {
        for (FrameId frame : line.points) {
            const Vec3 displacement = (entry(motion, frame.index).motion.tail<3>() * std::polar(1.0, phase)).real();
            const Vec3 moved = entry(d.frame_positions, frame.index) + scale * displacement;
            data += text(moved(0), " ", moved(1), " ", moved(2), "\n");
        }
        data += "\n\n";
    }
    return data + "EOD\n";
}

struct Box {
    Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
};

Box bounds(const Campbell& d, double margin) {
    Box box;
    for (const Vec3& p : d.frame_positions) {
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
    }
    box.low.array() -= margin;
    box.high.array() += margin;
    box.low(2) = std::min(box.low(2), 0.0);
    return box;
}

// The largest of 1, 2, 5, 10, 20 ... that leaves at least six steps.
double tick_step(double length) {
    if (!(length > 0)) return 1;
    const double max = length / 6, power = std::pow(10, std::floor(std::log10(max)));
    return power * (max >= 5 * power ? 5 : max >= 2 * power ? 2 : 1);
}

}  // namespace

void plot_mode(const Campbell& diagram, const Branch& branch, std::size_t point, const std::filesystem::path& path) {
    const std::vector<FrameMotion> motion = diagram.motion(branch, point);
    const Largest largest = largest_displacement(motion);
    const Box undeformed = bounds(diagram, 0);
    const double size = (undeformed.high - undeformed.low).maxCoeff();
    const double scale = largest.size > 0 ? 0.1 * size / largest.size : 0.0;
    Box box = bounds(diagram, 0.12 * size);
    for (int axis : {0, 1}) {  // wide enough to be read
        const double centre = (box.low(axis) + box.high(axis)) / 2,
                     half = std::max(box.high(axis) - centre, 0.3 * size);
        box.low(axis) = centre - half;
        box.high(axis) = centre + half;
    }
    std::string script = lines_data(diagram, "rest", motion, 0, 0) +
                         lines_data(diagram, "now", motion, scale, largest.phase) +
                         lines_data(diagram, "quarter", motion, scale, largest.phase + pi / 2);
    const double rpm = std::round(100 * diagram.points[point].rotor_speed * units::to_rpm) / 100;
    const char* about = diagram.mode(branch, point)->floquet ? " rpm, shape at azimuth 0 (displacements enlarged)"
                                                             : " rpm (displacements enlarged)";
    const std::string doubt =
        branch.doubtful[point] ? text("; the name is doubtful here: mostly ", branch.mostly[point]) : std::string();
    script += text("set multiplot layout 1,3 title ",
                   gnuplot_text(text(branch.name, ", ", std::round(1e4 * diagram.damped_hz(branch, point)) / 1e4,
                                     " Hz at ", rpm, about, doubt)),
                   "\nset size ratio -1\nset bmargin 7\nset xtics ", tick_step(size), "\nset ytics ", tick_step(size),
                   "\nset key at screen 0.5,0.07 center center horizontal maxrows 1 font ',11'\n");
    struct View {
        const char* title;
        const char* horizontal;
        const char* vertical;
        int x, y;
    };
    for (const View& view : {View{"side view", "x (downwind), m", "z (up), m", 0, 2},
                             View{"front view, seen from upwind", "y (lateral), m", "z (up), m", 1, 2},
                             View{"top view", "x (downwind), m", "y (lateral), m", 0, 1}}) {
        const bool keyed = view.x == 1;
        // Seen from upwind y (= z cross x) points to the left.
        const bool mirrored = view.x == 1;
        const double low = mirrored ? box.high(view.x) : box.low(view.x),
                     high = mirrored ? box.low(view.x) : box.high(view.x);
        script += text("set title ", gnuplot_text(view.title), "\nset xlabel ", gnuplot_text(view.horizontal),
                       "\nset ylabel ", gnuplot_text(view.vertical), "\nset xrange [", low, ":", high,
                       "]\nset yrange [", box.low(view.y), ":", box.high(view.y), "]\n");
        const std::string columns = text(" using ", view.x + 1, ":", view.y + 1, " with linespoints pt 7 ps 0.4 ");
        const auto titled = [&](const char* title) { return keyed ? text("title '", title, "'") : text("notitle"); };
        script += text("plot $rest", columns, "lc rgb '#bbbbbb' lw 1.5 ", titled("undeformed"), ", $quarter", columns,
                       "lc rgb '", colour(4).hex, "' lw 1 dt 2 ", titled("a quarter period later"), ", $now", columns,
                       "lc rgb '", colour(0).hex, "' lw 2 ", titled("largest displacement"), "\n");
    }
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, script + "unset multiplot\n", {1300, 620}));
}

}  // namespace cardan::solvers
