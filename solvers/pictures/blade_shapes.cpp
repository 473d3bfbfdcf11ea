#include "solvers/pictures/blade_shapes.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

// The next of ..., 1, 2, 3, 4, 6, 8, 10, 20, ... not below the value: half of it is a good tic, too.
double round_up(double value) {
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (double factor : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0})
        if (factor * decade >= value * (1 - 1e-9)) return factor * decade;
    return 10 * decade;
}

struct Columns {
    std::vector<double> radius, flap, edge, twist;
    void add(double r, double w, double v, double phi) {
        radius.push_back(r), flap.push_back(w), edge.push_back(v), twist.push_back(phi);
    }
    std::string data(const std::string& name) const {
        const std::vector<std::span<const double>> columns{radius, flap, edge, twist};
        return gnuplot_data(name, columns);
    }
};

Columns nodes(const BladeShape& shape) {
    Columns c;
    for (std::size_t i = 0; i < shape.radius.size(); ++i)
        c.add(shape.radius[i], shape.displacement[i].z().real(), shape.displacement[i].y().real(),
              units::to_degrees * shape.rotation[i].x().real());
    return c;
}

// Cubics between the nodes with w' = -theta_y, v' = theta_z; the twist is linear.
Columns curves(const BladeShape& shape) {
    constexpr int pieces = 10;
    Columns c;
    for (std::size_t i = 0; i + 1 < shape.radius.size(); ++i) {
        const double h = shape.radius[i + 1] - shape.radius[i];
        const Vec3 u0 = shape.displacement[i].real(), u1 = shape.displacement[i + 1].real();
        const Vec3 t0 = shape.rotation[i].real(), t1 = shape.rotation[i + 1].real();
        for (int k = i == 0 ? 0 : 1; k <= pieces; ++k) {
            const double s = static_cast<double>(k) / pieces, r = 1 - s;
            const auto cubic = [&](double a, double slope_a, double b, double slope_b) {
                return r * r * (1 + 2 * s) * a + s * s * (1 + 2 * r) * b + h * s * r * (r * slope_a - s * slope_b);
            };
            c.add(shape.radius[i] + s * h, cubic(u0.z(), -t0.y(), u1.z(), -t1.y()),
                  cubic(u0.y(), t0.z(), u1.y(), t1.z()), units::to_degrees * (r * t0.x() + s * t1.x()));
        }
    }
    return c;
}

struct Quantity {
    const char* title;
    int column, dash, symbol;
    std::size_t colour;
    const char* axes;
};

constexpr std::array<Quantity, 3> quantities{{{"flap (+ downwind)", 2, 1, 7, 0, "x1y1"},
                                              {"edge (+ toward leading edge)", 3, 2, 5, 1, "x1y1"},
                                              {"twist (+ leading edge downwind)", 4, 4, 9, 2, "x1y2"}}};

std::string panel(const BladeShape& shape, std::size_t number, bool left, bool right, bool bottom) {
    // A mode that hardly twists should look that way: the right axis extends to at least 1 deg per m.
    double twist = 1;
    for (const auto& rotation : shape.rotation)
        twist = std::max(twist, units::to_degrees * std::abs(rotation.x().real()));
    twist = round_up(twist);
    std::string plots = "0 with lines lc rgb '#888888' lw 1 notitle";
    for (const Quantity& q : quantities) {
        const std::string hex(colour(q.colour).hex);
        plots += text(", $c", number, " using 1:", q.column, " axes ", q.axes, " with lines lc rgb '", hex, "' dt ",
                      q.dash, " lw 2 notitle, $n", number, " using 1:", q.column, " axes ", q.axes,
                      " with points lc rgb '", hex, "' pt ", q.symbol, " ps 0.55 notitle");
    }
    return text("set title ",
                gnuplot_text(text(shape.name, shape.doubtful ? " (doubtful)" : "", ", ",
                                  digits(shape.natural_hz, std::chars_format::fixed, 4), " Hz")),
                "\nset xrange [0:", 1.05 * shape.radius.back(), "]\nset y2range [", -1.1 * twist, ":", 1.1 * twist,
                "]\nset y2tics ", twist / 2, "\n", bottom ? "set xlabel 'radius, m'\n" : "unset xlabel\n",
                left ? "set ylabel 'displacement, largest = 1'\n" : "unset ylabel\n",
                right ? "set y2label 'twist, deg per m of largest displacement'\n" : "unset y2label\n", "plot ", plots,
                "\n");
}

// An empty plot across the foot of the picture: the legend in one row, line and symbol together.
std::string legend(double height) {
    std::string plots;
    for (const Quantity& q : quantities)
        plots += text(plots.empty() ? "" : ", ", "NaN with linespoints lc rgb '", colour(q.colour).hex, "' dt ", q.dash,
                      " lw 2 pt ", q.symbol, " ps 0.55 title ", gnuplot_text(q.title));
    return text(
        "unset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset y2label\nset lmargin at screen "
        "0.01\nset rmargin at screen 0.99\nset bmargin at screen 0\nset tmargin at screen ",
        34 / height, "\nset key center center horizontal maxrows 1 Left reverse\nplot ", plots, "\n");
}

}  // namespace

void plot(const BladeShapes& shapes, const std::filesystem::path& path) {
    if (shapes.modes.empty()) throw InputError(shapes.machine, "number of modes to draw", 0, "at least one");
    constexpr std::size_t per_row = 3;
    const std::size_t count = shapes.modes.size(), rows = (count + per_row - 1) / per_row;
    std::string script;
    for (std::size_t i = 0; i < count; ++i)
        script += nodes(shapes.modes[i]).data(text("n", i)) + curves(shapes.modes[i]).data(text("c", i));
    const double height = 380 * static_cast<double>(rows) + 90;
    script += text("set multiplot layout ", rows, ",", per_row, " margins 0.06,0.94,", 95 / height, ",",
                   1 - 75 / height, " spacing 0.065,", 75 / height, " title ",
                   gnuplot_text(text(shapes.machine, ": mode shapes at ", shapes.rotor_speed * units::to_rpm, " rpm")),
                   " font ',15'\nset yrange [-1.1:1.1]\nset ytics nomirror 0.5\nset xtics 10\nunset key\n");
    for (std::size_t i = 0; i < count; ++i)
        script += panel(shapes.modes[i], i, i % per_row == 0, i % per_row == per_row - 1 || i + 1 == count,
                        i + per_row >= count);
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, script + legend(height) + "unset multiplot\n",
                                                              {1300, static_cast<int>(std::lround(height))}));
}

}  // namespace cardan::solvers
