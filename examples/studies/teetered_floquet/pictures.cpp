#include "examples/studies/teetered_floquet/pictures.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::teetered {

namespace {

using solvers::Branch;
using solvers::Campbell;
using solvers::FrameMotion;

constexpr int between = 8;      // points drawn per element
constexpr double enlarged = 4;  // largest displacement in a picture, m

// A place on a line of the machine.
struct Place {
    Vec3 at;  // undeformed, m
    Vec3T<Complex> moved, turned;
};

std::vector<Place> places(const Campbell& diagram, const std::vector<FrameMotion>& motion, const Polyline& line) {
    std::vector<Place> all;
    for (FrameId frame : line.points) {
        const Vec6T<Complex>& moved = entry(motion, frame.index).motion;
        all.push_back({entry(diagram.frame_positions, frame.index), moved.tail<3>(), moved.head<3>()});
    }
    return all;
}

// Between the nodes of a beam cubics with the slopes of the nodes, which turn with them.
std::vector<Place> refined(const std::vector<Place>& nodes) {
    std::vector<Place> all{nodes.front()};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        const Place &a = nodes[i - 1], &b = nodes[i];
        const Vec3T<Complex> along = (b.at - a.at).cast<Complex>();
        const Vec3T<Complex> slope_a = cross<Complex>(a.turned, along), slope_b = cross<Complex>(b.turned, along);
        for (int k = 1; k <= between; ++k) {
            const double s = static_cast<double>(k) / between, t = 1 - s;
            all.push_back({t * a.at + s * b.at,
                           t * t * (1 + 2 * s) * a.moved + s * t * t * slope_a + s * s * (3 - 2 * s) * b.moved -
                               s * s * t * slope_b,
                           t * a.turned + s * b.turned});
        }
    }
    return all;
}

struct DrawnLine {
    std::string_view colour;
    std::vector<Place> places;
};

std::string_view colour_of(const Polyline& line) {
    return line.blade == 0 ? std::string_view("#444444") : solvers::colour(line.blade == 1 ? 0 : 1).hex;
}

// The shaft carries the hub on a hinge: straight.
std::vector<DrawnLine> drawn_lines(const Campbell& diagram, const std::vector<FrameMotion>& motion) {
    std::vector<DrawnLine> all;
    for (const Polyline& line : diagram.lines) {
        const std::vector<Place> nodes = places(diagram, motion, line);
        all.push_back({colour_of(line), line.part == "shaft" ? nodes : refined(nodes)});
    }
    return all;
}

// Instant at which a quantity is largest, and its size there.
struct Largest {
    double size = 0, phase = 0;
    template <class Vectors>
    void look_at(const Vectors& x) {
        for (int step = 0; step < 180; ++step) {
            const double size_now = (x * std::polar(1.0, step * units::degree)).real().norm();
            if (size_now > size) size = size_now, phase = step * units::degree;
        }
    }
};

struct View {
    const char* horizontal;
    int axis;  // of the ground
    double low, high;
    bool mirrored;
};
constexpr View side{"x (downwind), m", 0, -8, 12, false}, from_upwind{"y, m (seen from upwind)", 1, -10, 10, true};

std::string shape_panel(const Campbell& diagram, const Branch& branch, const View& view, const std::string& title,
                        std::size_t number) {
    const std::vector<DrawnLine> lines = drawn_lines(diagram, diagram.motion(branch, 0));
    Largest largest;
    for (const DrawnLine& line : lines)
        for (const Place& p : line.places) largest.look_at(p.moved);
    const double scale = largest.size > 0 ? enlarged / largest.size : 0;
    const Complex now = std::polar(scale, largest.phase);
    std::string rest, moved, plots;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (const Place& p : lines[i].places) {
            const Vec3 there = p.at + (p.moved * now).real();
            rest += text(p.at(view.axis), " ", p.at(2), "\n");
            moved += text(there(view.axis), " ", there(2), "\n");
        }
        rest += "\n\n";
        moved += "\n\n";
        plots += text(", $moved", number, " index ", i, " using 1:2 with lines lc rgb '", lines[i].colour,
                      "' lw 2.5 notitle");
    }
    const double left = view.mirrored ? view.high : view.low, right = view.mirrored ? view.low : view.high;
    return text("$rest", number, " << EOD\n", rest, "EOD\n$moved", number, " << EOD\n", moved,
                "EOD\nset size ratio -1\nset xtics 5\nset ytics 10\nset xlabel '", view.horizontal,
                "' font ',11'\nset xrange [", left, ":", right, "]\nset yrange [-1:39]\nset title ",
                solvers::gnuplot_text(title), " font ',12'\nplot $rest", number,
                " using 1:2 with lines lc rgb '#b8b8b8' lw 1.5 notitle", plots, "\n");
}

// About the axis of each blade from root to tip; blade 2 to the left.
std::string twist_panel(const Campbell& diagram, const Branch& branch, const std::string& title, std::size_t number) {
    const std::vector<FrameMotion> motion = diagram.motion(branch, 0);
    std::vector<std::pair<double, Complex>> twist[2];  // by blade: span, negative for blade 2
    Largest largest;
    for (const Polyline& line : diagram.lines) {
        if (line.blade == 0) continue;
        const std::vector<Place> nodes = places(diagram, motion, line);
        const Vec3 centre = nodes.front().at, out = (nodes.back().at - centre).normalized();
        for (const Place& p : nodes) {
            const Complex about = (out.cast<Complex>().array() * p.turned.array()).sum();
            twist[line.blade - 1].emplace_back((p.at - centre).norm() * (line.blade == 1 ? 1 : -1), about);
            largest.look_at(Vec3T<Complex>(about, 0, 0));
        }
    }
    std::string rows, plots;
    for (int blade : {1, 2}) {
        for (const auto& [span, about] : twist[blade - 1])
            rows +=
                text(span, " ", (about * std::polar(1.0, largest.phase)).real() / std::max(largest.size, 1e-300), "\n");
        rows += "\n\n";
        plots += text(", $twist", number, " index ", blade - 1, " using 1:2 with linespoints pt 7 ps 0.5 lc rgb '",
                      solvers::colour(blade == 1 ? 0 : 1).hex, "' lw 2.5 notitle");
    }
    return text("$twist", number, " << EOD\n", rows,
                "EOD\nset size noratio\nset xtics 5\nset ytics 0.5\nset xlabel 'blade 2     radius, m     blade 1' "
                "font ',11'\nset xrange [-10.5:10.5]\nset yrange [-1.1:1.1]\nset title ",
                solvers::gnuplot_text(title), " font ',12'\nplot 0 lc rgb '#b8b8b8' lw 1.5 notitle", plots, "\n");
}

const Branch* find(const Campbell& diagram, const std::string& name) {
    const auto found = std::find_if(diagram.branches.begin(), diagram.branches.end(),
                                    [&](const Branch& b) { return b.name == name && b.mode.front() >= 0; });
    return found == diagram.branches.end() ? nullptr : &*found;
}

std::string per_rev(const Campbell& diagram, const Branch& branch) {
    const double f = diagram.damped_hz(branch, 0) * 2 * pi / diagram.points[0].rotor_speed;
    return text(std::round(1e3 * f) / 1e3, "/rev");
}

constexpr double width = 1240, height = 1480;

// Four columns; three rows with flap, torsion, lag.
std::string place(int row, int column) {
    constexpr double first = 80, panel = 250, gap = 40;
    constexpr double heights[] = {460, 170, 460}, tops[] = {76, 660, 950};
    const double left = first + column * (panel + gap);
    return text("set lmargin at screen ", left / width, "\nset rmargin at screen ", (left + panel) / width,
                "\nset tmargin at screen ", 1 - tops[row] / height, "\nset bmargin at screen ",
                1 - (tops[row] + heights[row]) / height, "\n");
}

}  // namespace

bool draw_figures(const Campbell& diagram, const std::vector<KnownMode>& modes, const std::filesystem::path& path) {
    std::string script =
        text("set multiplot title ",
             solvers::gnuplot_text(text("mode shapes at ", diagram.points[0].rotor_speed,
                                        " rad/s; blade 1 (up) blue, blade 2 vermilion; largest displacement drawn as ",
                                        enlarged, " m")),
             " font ',15'\n");
    std::size_t number = 0;
    for (const KnownMode& known : modes) {
        const Branch* branch = known.figure > 0 ? find(diagram, known.name) : nullptr;
        if (!branch) continue;
        const int row = (known.figure - 3) / 4, column = (known.figure - 3) % 4;
        const std::string title = text(known.in_paper, ", ", per_rev(diagram, *branch));
        script += place(row, column);
        script += column == 0 ? text("set ylabel '", row == 1 ? "twist" : "z (up), m", "' font ',11'\n")
                              : std::string("unset ylabel\n");
        script += row == 1 ? twist_panel(diagram, *branch, title, number)
                           : shape_panel(diagram, *branch, row == 0 ? side : from_upwind, title, number);
        ++number;
    }
    if (number == 0) return false;
    static_cast<void>(solvers::Gnuplot::of_this_thread().write_picture(
        path, script + "unset multiplot\n", {static_cast<int>(width), static_cast<int>(height)}));
    return true;
}

void draw_twist(const Campbell& diagram, const Branch& branch, const std::filesystem::path& path) {
    const std::string title = text(branch.name, ", ", per_rev(diagram, branch));
    static_cast<void>(solvers::Gnuplot::of_this_thread().write_picture(
        path,
        "set ylabel 'twist about the axis from root to tip, largest 1'\n" + twist_panel(diagram, branch, title, 0),
        {900, 420}));
}

}  // namespace cardan::teetered
