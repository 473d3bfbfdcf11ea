#include "programs/cardan/turbulence_pictures.hpp"

#include "elements/turbulence/box_spectra.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <span>
#include <sstream>

namespace cardan::program {

namespace {

using solvers::gnuplot_data;
using solvers::gnuplot_text;

// In pixels, and places of the panels in shares of the picture.
constexpr solvers::PictureSize picture_size{1200, 1330};

struct Panel {
    double left, right, bottom, top;
};
constexpr double left_edge = 0.07, left_end = 0.475, right_edge = 0.57, right_end = 0.965;
constexpr Panel over_time{left_edge, right_end, 0.815, 0.93}, spectra_panel{left_edge, left_end, 0.45, 0.735},
    turning_panel{right_edge, right_end, 0.45, 0.735}, coherence_panel{left_edge, left_end, 0.06, 0.355},
    plane_panel{right_edge, 0.915, 0.06, 0.355};

std::string begin_panel(const Panel& at, const std::string& title) {
    return text(
        "unset label\nunset arrow\nunset object\nunset logscale\nset autoscale\nset format '% h'\nset lmargin at "
        "screen ",
        at.left, "\nset rmargin at screen ", at.right, "\nset bmargin at screen ", at.bottom,
        "\nset tmargin at screen ", at.top, "\nset title ", gnuplot_text(title), " font ',12' offset 0,-0.3\n");
}

template <class... Columns>
std::string data_block(const std::string& name, const Columns&... columns) {
    const std::array all{std::span<const double>(columns)...};
    return gnuplot_data(name, all);
}

// For people: files have times in single precision.
std::string rounded(double value) {
    std::ostringstream out = text_stream();
    out << std::setprecision(6) << (std::abs(value) < 1e-9 ? 0 : value);
    return out.str();
}

std::string hex(std::size_t index) {
    return text("'", solvers::colour(index).hex, "'");
}

// From the first line of the spectrum to half the sampling rate.
std::vector<double> frequencies(const BoxGrid& grid, int count) {
    const double first = 1 / grid.duration(), last = 0.5 / grid.time_step;
    std::vector<double> out;
    out.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) out.push_back(first * std::pow(last / first, i / (count - 1.0)));
    return out;
}

std::string frequency_axis(const BoxGrid& grid) {
    return text("set logscale x\nset format x '10^{%L}'\nset xrange [", 1 / grid.duration(), ":", 0.5 / grid.time_step,
                "]\nset xlabel 'frequency in Hz'\n");
}

std::pair<int, int> hub_point(const BoxView& view) {
    const BoxGrid& grid = view.box->grid();
    return {grid.row_near(view.hub_height), grid.column_near(0)};
}

double mean_at(const BoxView& view, double height) {
    return view.mean.speed != 0 ? view.mean.at({0, 0, height}).x() : 0;
}

std::string time_panel(const BoxView& view) {
    const auto [row, column] = hub_point(view);
    TimeSeries u = series_at(*view.box, 0, row, column);
    const double added = mean_at(view, view.hub_height);
    std::vector<double> times;
    for (std::size_t i = 0; i < u.values.size(); ++i) {
        times.push_back(static_cast<double>(i) * u.step);
        u.values[i] += added;
    }
    return data_block("series", times, u.values) + begin_panel(over_time, "downwind component u at the hub") +
           text("set key off\nset xrange [0:", times.back(),
                "]\nset xlabel 'time in s' offset 0,0.5\nset ylabel 'u in m/s'\nplot $series using 1:2 with lines lw "
                "0.8 lc rgb ",
                hex(0), " notitle\n");
}

// Spectra of a point over those of the target; their axis begins a decade below the least of the target.
std::string point_spectra(const BoxView& view) {
    const auto [row, column] = hub_point(view);
    const BoxGrid& grid = view.box->grid();
    const std::vector<double> f = frequencies(grid, 60);
    constexpr std::array names{"u", "v", "w"};
    std::vector<Vec3> targets;
    targets.reserve(f.size());
    for (const double at : f) targets.push_back(view.target.spectra(at));
    std::string data, plots;
    double least = HUGE_VAL, most = 0;
    for (int c = 0; c < 3; ++c) {
        const PowerSpectrum found = in_bands(power_spectrum(spectrum_lines(series_at(*view.box, c, row, column))), 10);
        std::vector<double> target;
        target.reserve(targets.size());
        for (const Vec3& all : targets) target.push_back(all[c]);
        least = std::min(least, *std::ranges::min_element(target));
        most = std::max(most, *std::ranges::max_element(target));
        data += data_block(text("s", c), found.frequency, found.density) + data_block(text("t", c), f, target);
        plots += text(c == 0 ? "plot " : ", ", "$t", c, " with lines lw 1.4 dt ",
                      c == 0   ? "1"
                      : c == 1 ? "2"
                               : "3",
                      " lc rgb '#000000' title ", gnuplot_text(text(entry(names, c), ", ", view.target_name)), ", $s",
                      c, " with linespoints lw 1.2 pt 7 ps 0.35 lc rgb ", hex(static_cast<std::size_t>(c)), " title '",
                      entry(names, c), " of the box'");
    }
    return data + begin_panel(spectra_panel, "spectra at the hub") + frequency_axis(grid) +
           text("set logscale y\nset format y '10^{%L}'\nset yrange [", least / 3, ":", most * 5,
                "]\nset ylabel 'density in (m/s)^2/Hz'\nset key left bottom Left reverse samplen 2 font ',10'\n", plots,
                "\n");
}

std::string turning_spectra(const BoxView& view) {
    const WindBox& box = *view.box;
    const auto [row, column] = hub_point(view);
    const TurningPoint point{
        .hub_height = view.hub_height, .radius = turning_radius(view), .rotor_speed = *view.rotor_speed};
    const double P = point.rotor_speed / (2 * pi);
    const PowerSpectrum fixed = in_bands(power_spectrum(spectrum_lines(series_at(box, 0, row, column))), 10),
                        turning = in_bands(turning_spectrum(box, 0, point), 30);
    std::string data =
        data_block("fixed", fixed.frequency, fixed.density) + data_block("turning", turning.frequency, turning.density);
    std::string plots = text("plot $fixed with lines lw 1.2 lc rgb ", hex(5),
                             " title 'fixed, at the hub', $turning with lines lw 1.2 lc rgb ", hex(1), " title ",
                             gnuplot_text(text("turning, with the shear")));
    const double top =
        3 * std::max(*std::ranges::max_element(turning.density), *std::ranges::max_element(fixed.density));
    double least = top / 1e6;
    if (std::holds_alternative<Kaimal>(view.target.model)) {
        const std::vector<double> f = frequencies(box.grid(), 250);
        std::vector<double> target;
        target.reserve(f.size());
        for (const double at : f)
            target.push_back(turning_spectrum([&](double s) { return view.target.spectra(s)[0]; },
                                              [&](double s, double d) { return view.target.coherence(0, s, d); },
                                              point.radius, point.rotor_speed, at));
        data += data_block("model", f, target);
        plots += ", $model with lines lw 1.4 lc rgb '#000000' title " +
                 gnuplot_text(text("turning, ", view.target_name, " alone"));
        least = std::min(least * 10, *std::ranges::min_element(target) / 3);
    }
    std::string marks;
    for (int n = 1; n <= 3; ++n)
        marks += text("set arrow ", n, " from ", n * P, ", graph 0 to ", n * P,
                      ", graph 0.93 nohead dt 3 lc rgb '#888888'\nset label ", n, " '", n, "P' at ", n * P,
                      ", graph 0.96 center font ',10'\n");
    return data +
           begin_panel(turning_panel,
                       text("u seen from a blade: radius ", rounded(std::round(point.radius * 10) / 10), " m, ",
                            rounded(std::round(point.rotor_speed * units::to_rpm * 100) / 100), " rpm")) +
           frequency_axis(box.grid()) + marks +
           text("set logscale y\nset format y '10^{%L}'\nset yrange [", least, ":", top,
                "]\nset ylabel 'density in (m/s)^2/Hz'\nset key left bottom Left reverse samplen 2 font ',10'\n", plots,
                "\n");
}

// Mean and deviation of u over the height, in the middle column.
std::string height_panel(const BoxView& view) {
    const BoxGrid& grid = view.box->grid();
    std::vector<double> heights, means, low, high;
    for (int row = 0; row < grid.rows; ++row) {
        const double z = grid.lowest + row * grid.row_spacing;
        const WindBox::Statistics u = view.box->statistics(row, grid.column_near(0));
        heights.push_back(z);
        means.push_back(u.mean[0] + mean_at(view, z));
        low.push_back(means.back() - u.deviation[0]);
        high.push_back(means.back() + u.deviation[0]);
    }
    return data_block("over_height", heights, means, low, high) + begin_panel(turning_panel, "u over the height") +
           text(
               "set xlabel 'u in m/s'\nset ylabel 'height in m'\nset key right bottom font ',10'\n"
               "plot $over_height using 2:1 with linespoints pt 7 ps 0.4 lw 1.4 lc rgb ",
               hex(0), " title 'mean', $over_height using 3:1 with lines dt 2 lc rgb ", hex(1),
               " title 'less and more by its deviation', $over_height using 4:1 with lines dt 2 lc rgb ", hex(1),
               " notitle\n");
}

// Three distances: about an eighth, a quarter and half of the width.
std::vector<int> distances(const BoxGrid& grid) {
    std::vector<int> out;
    for (const int part : {8, 4, 2})
        if (const int apart = std::max(1, (grid.columns - 1) / part); out.empty() || out.back() != apart)
            out.push_back(apart);
    return out;
}

// Empty: cancelled.
std::string coherence_curves(const BoxView& view) {
    const BoxGrid& grid = view.box->grid();
    const std::vector<int> apart = distances(grid);
    const std::vector<Coherence> found = coherences_across(*view.box, 0, apart, {.cancelled = view.cancelled});
    if (found.empty()) return "";
    const std::vector<double> f = frequencies(grid, 40);
    std::string data, plots;
    double least = -0.05;
    // Kaimal's are the spectra alone.
    const std::string target_name =
        std::holds_alternative<Kaimal>(view.target.model) ? "exponential, of IEC 61400-1" : view.target_name;
    for (std::size_t i = 0; i < apart.size(); ++i) {
        const double distance = apart[i] * grid.column_spacing;
        std::vector<double> real, target;
        for (const Complex& value : found[i].value) real.push_back(value.real());
        for (const double at : f) target.push_back(view.target.coherence(0, at, distance));
        least = std::min(least, std::min(*std::ranges::min_element(real), *std::ranges::min_element(target)) - 0.05);
        data += data_block(text("c", i), found[i].frequency, real) + data_block(text("m", i), f, target);
        plots += text(i == 0 ? "plot " : ", ", "$m", i, " with lines lw 1.4 lc rgb '#000000' ",
                      i == 0 ? text("title ", gnuplot_text(target_name)) : "notitle", ", $c", i,
                      " with linespoints lw 1.2 pt 7 ps 0.35 lc rgb ", hex(i), " title ",
                      gnuplot_text(text(rounded(std::round(distance * 10) / 10), " m across")));
    }
    return data + begin_panel(coherence_panel, "coherence of u, real part") + frequency_axis(grid) +
           text("set yrange [", least,
                ":1.02]\nset ylabel 'coherence, not squared'\nset key right top samplen 2 font ',10'\n", plots, "\n");
}

std::string plane_map(const BoxView& view) {
    const BoxGrid& grid = view.box->grid();
    const int step = grid.steps / 2;
    std::vector<double> y, z, u;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            y.push_back(column * grid.column_spacing - grid.width() / 2);
            z.push_back(grid.lowest + row * grid.row_spacing);
            u.push_back(view.box->at_point(step, row, column)[0] + mean_at(view, z.back()));
        }
    std::string circle;
    if (view.diameter)
        circle = text("set object 1 circle at 0,", view.hub_height, " size ", *view.diameter / 2,
                      " front fillstyle empty border lc rgb '#000000' lw 1.5\n");
    const double top = grid.lowest + grid.height() + grid.row_spacing / 2,
                 half = (grid.width() + grid.column_spacing) / 2;
    return data_block("plane", y, z, u) +
           begin_panel(plane_panel, text("u in m/s at ", rounded(step * grid.time_step), " s, seen along the wind")) +
           circle +
           text("set palette defined (0 '#08306b', 1 '#4292c6', 2 '#f0f0f0', 3 '#f16913', 4 '#7f2704')\nset xrange [",
                half, ":", -half, "]\nset yrange [", grid.lowest - grid.row_spacing / 2, ":", top,
                "]\nset size ratio -1\nset xlabel 'to the left in m'\nset ylabel 'height in m'\nset key off\n"
                "plot $plane using 1:2:3 with image notitle\n");
}

}  // namespace

double turning_radius(const BoxView& view) {
    const BoxGrid& grid = view.box->grid();
    const double room =
        std::min({grid.width() / 2, view.hub_height - grid.lowest, grid.lowest + grid.height() - view.hub_height});
    const double radius = view.diameter ? 0.375 * *view.diameter : 0.75 * room;
    return std::max(0.0, std::min(radius, room));
}

void print_velocities(const std::string& what, const Vec3& values) {
    const auto shown = [](double value) { return std::abs(value) < 5e-5 ? 0.0 : value; };  // without a sign
    std::printf("%-34s %9.4f %9.4f %9.4f\n", what.c_str(), shown(values[0]), shown(values[1]), shown(values[2]));
}

void print_box(const BoxView& view) {
    const WindBoxData& data = view.box->data();
    const BoxGrid& grid = data.grid;
    const auto [row, column] = hub_point(view);
    const WindBox::Statistics hub = view.box->statistics(row, column);
    const double top = grid.lowest + grid.height();
    const auto by = [](double across, double upward) { return text(rounded(across), " x ", rounded(upward), " m"); };
    std::printf("grid          %d x %d points, %s, %s apart; heights %s to %s m\n", grid.columns, grid.rows,
                by(grid.width(), grid.height()).c_str(), by(grid.column_spacing, grid.row_spacing).c_str(),
                rounded(grid.lowest).c_str(), rounded(top).c_str());
    std::printf("time          %d planes %s s apart: %s s, %s; carried at %s m/s\n", grid.steps,
                rounded(grid.time_step).c_str(), rounded(grid.duration()).c_str(),
                data.periodic ? "periodic" : "not periodic", rounded(data.speed).c_str());
    std::printf("below it      %s\n", data.below == BelowBox::tower       ? "points of the tower"
                                      : data.below == BelowBox::to_ground ? "linear to zero at the ground"
                                                                          : "nothing");
    if (!data.origin.checksum.empty()) std::printf("checksum      %s\n", data.origin.checksum.c_str());
    if (!data.origin.note.empty()) std::printf("note          %s\n", data.origin.note.c_str());
    std::printf("\n%-34s %9s %9s %9s\n", "m/s", "u", "v", "w");
    const double height = grid.height_of(row), left = grid.place_of(column);
    const bool at_hub = std::abs(height - view.hub_height) < 1e-3 * grid.row_spacing && std::abs(left) < 1e-3;
    print_velocities(at_hub ? text("mean at the hub, ", rounded(view.hub_height), " m")
                            : text("mean next to the hub, ", rounded(height), " m, y ", rounded(left), " m"),
                     hub.mean + Vec3(mean_at(view, height), 0, 0));
    print_velocities("standard deviation there", hub.deviation);
}

bool draw_box(const BoxView& view, const std::filesystem::path& path) {
    const auto [row, column] = hub_point(view);
    if (const double u = view.box->statistics(row, column).deviation.x(); !(u > 1e-6))
        throw InputError(view.title, "standard deviation of u at the hub [m/s]", u,
                         "above 1e-6 for pictures; --no-picture draws none");
    const auto cancelled = [&] { return view.cancelled && view.cancelled(); };
    // The heading belongs to the first panel, as the others begin without labels.
    std::string first = time_panel(view);
    first.insert(first.find("plot $series"),
                 text("set label 1 ", gnuplot_text(view.title), " at screen ", left_edge, ",0.975 left font ',14'\n"));
    std::string script = "set multiplot\nset tics nomirror\nset border 3\n" + first;
    for (const auto& panel :
         {point_spectra, view.rotor_speed ? turning_spectra : height_panel, coherence_curves, plane_map}) {
        if (cancelled()) return false;
        const std::string part = panel(view);
        if (part.empty()) return false;
        script += part;
    }
    script += "unset multiplot\n";
    static_cast<void>(solvers::Gnuplot::of_this_thread().write_picture(path, script, picture_size));
    return true;
}

}  // namespace cardan::program
