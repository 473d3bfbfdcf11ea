#include "examples/studies/nrel5mw_assumed_modes/shapes.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <cmath>

namespace cardan::paper2018 {

namespace {

using solvers::gnuplot_data;
using solvers::gnuplot_text;

constexpr int places = 120;
constexpr std::array<const char*, 4> mode_titles{"1st flap", "1st edge", "2nd flap", "2nd edge"};
// Rotor speeds from slow to fast; distinct by lightness, too.
constexpr std::array<const char*, 6> colours{"#000000", "#440154", "#3b528b", "#21918c", "#5ec962", "#e69f00"};

std::string curves(std::size_t set, std::size_t mode, const std::vector<double>& rpm) {
    std::string plots = "0 with lines lc rgb '#888888' lw 1 notitle";
    for (std::size_t s = 0; s < rpm.size(); ++s)
        plots += text(", $s", set, "m", mode, " using 1:", s + 2, " with lines lw 2 lc rgb '",
                      colours.at(s % colours.size()), "'", rpm[s] == 0 ? " dt 2" : "", " notitle");
    return plots;
}

std::string panel(const ShapeSet& shapes, std::size_t set, std::size_t mode, bool last) {
    return text(set == 0 ? "set title " + gnuplot_text(mode_titles.at(mode)) + "\n" : "unset title\n",
                last ? "set xlabel 'x/L'\n" : "unset xlabel\n",
                mode == 0 ? "set ylabel " + gnuplot_text(shapes.name) + "\n" : "unset ylabel\n", "set yrange [",
                mode < 2 ? "-0.05:1.05" : "-0.45:1.05", "]\nplot ", curves(set, mode, shapes.rpm), "\n");
}

std::string legend(const std::vector<double>& rpm, double height) {
    std::string plots;
    for (std::size_t s = 0; s < rpm.size(); ++s)
        plots += text(plots.empty() ? "" : ", ", "NaN with lines lw 2 lc rgb '", colours.at(s % colours.size()), "'",
                      rpm[s] == 0 ? " dt 2" : "", " title ", gnuplot_text(text(rpm[s], " rpm")));
    return text(
        "unset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nset lmargin at screen 0.01\nset rmargin at "
        "screen 0.99\nset bmargin at screen 0\nset tmargin at screen ",
        34 / height, "\nset key center center horizontal maxrows 1 Left reverse\nplot ", plots, "\n");
}

}  // namespace

ShapeSet shape_set(const std::string& name, const AssumedModesBlade& blade, const std::vector<double>& rpm,
                   const std::vector<NamedModes>& found) {
    constexpr std::array<Eigen::Index, 4> component{2, 1, 2, 1};  // of u, v, w, phi
    ShapeSet set{name, rpm, {}, std::vector<std::array<std::vector<double>, 4>>(rpm.size())};
    const Matrix tip = blade.shapes(blade.length());
    for (int i = 0; i <= places; ++i) {
        set.span.push_back(static_cast<double>(i) / places);
        const Matrix here = blade.shapes(blade.length() * i / places);
        for (std::size_t s = 0; s < rpm.size(); ++s)
            for (std::size_t k = 0; k < component.size(); ++k) {
                const Vector& shape = found[s].shape.at(k);
                const Eigen::Index row = component.at(k);
                set.deflection[s].at(k).push_back((here.row(row) * shape).value() / (tip.row(row) * shape).value());
            }
    }
    return set;
}

void draw(const std::vector<ShapeSet>& sets, const std::filesystem::path& path) {
    std::string script;
    for (std::size_t i = 0; i < sets.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            std::vector<std::span<const double>> columns{sets[i].span};
            for (const auto& at_speed : sets[i].deflection) columns.emplace_back(at_speed.at(k));
            script += gnuplot_data(text("s", i, "m", k), columns);
        }
    const double height = 330 * static_cast<double>(sets.size()) + 110;
    script += text("set multiplot layout ", sets.size(), ",4 margins 0.055,0.985,", 95 / height, ",", 1 - 70 / height,
                   " spacing 0.04,", 55 / height,
                   " title 'Mode shapes of the NREL 5 MW blade in rotation, deflection of the tip = 1' font ',15'\nset "
                   "xrange [0:1]\nset xtics 0.2\nset ytics 0.5\nunset key\n");
    for (std::size_t i = 0; i < sets.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) script += panel(sets[i], i, k, i + 1 == sets.size());
    static_cast<void>(solvers::Gnuplot::of_this_thread().write_picture(
        path, script + legend(sets.front().rpm, height) + "unset multiplot\n",
        {1300, static_cast<int>(std::lround(height))}));
}

void write_csv(const std::vector<ShapeSet>& sets, const std::filesystem::path& path) {
    std::string rows = "model,mode,rotor_speed[rpm],span_fraction[-],deflection[-]\n";
    for (const ShapeSet& set : sets)
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t s = 0; s < set.rpm.size(); ++s)
                for (std::size_t i = 0; i < set.span.size(); ++i)
                    rows += text(set.name, ",", mode_titles.at(k), ",", set.rpm[s], ",", set.span[i], ",",
                                 set.deflection[s].at(k)[i], "\n");
    write_file(path, rows);
}

}  // namespace cardan::paper2018
