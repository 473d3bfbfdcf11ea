#include "solvers/pictures/roots.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/pictures/detail/campbell_style.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

// Growth rate in 1/s and damped frequency in Hz, by point; NaN where there is no vibration.
struct Locus {
    std::vector<double> rate, hz;
};

Locus locus(const Campbell& diagram, const Branch& branch) {
    Locus out;
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        const CampbellMode* mode = diagram.mode(branch, i);
        const bool there = mode != nullptr && mode->mode.oscillates() && mode->kind() != FloquetKind::rigid;
        out.rate.push_back(there ? mode->mode.eigenvalue.real() : std::numeric_limits<double>::quiet_NaN());
        out.hz.push_back(there ? mode->mode.damped_hz() : std::numeric_limits<double>::quiet_NaN());
    }
    return out;
}

Locus state_roots(const Campbell& diagram) {
    Locus out;
    for (const CampbellPoint& point : diagram.points)
        for (const StateMotion& motion : point.state_motions) {
            out.rate.push_back(motion.mode.eigenvalue.real());
            out.hz.push_back(motion.mode.oscillates() ? motion.mode.damped_hz() : 0);
        }
    return out;
}

// Ends of a locus that are there.
std::pair<std::size_t, std::size_t> ends_of(const Locus& of) {
    std::size_t first = 0, last = of.hz.size();
    while (first < last && std::isnan(of.hz[first])) ++first;
    while (last > first && std::isnan(of.hz[last - 1])) --last;
    return {first, last};
}

struct RootWindow {
    double left = 0, right = 0, top = 0;
    void take(const Locus& of, double limit) {
        for (std::size_t i = 0; i < of.hz.size(); ++i) {
            if (!(of.hz[i] <= limit)) continue;
            left = std::min(left, of.rate[i]);
            right = std::max(right, of.rate[i]);
            top = std::max(top, of.hz[i]);
        }
    }
};

std::string locus_data(const std::string& name, const Locus& of) {
    const std::vector<std::span<const double>> columns{of.rate, of.hz};
    return gnuplot_data(name, columns);
}

}  // namespace

void plot_roots(const Campbell& diagram, const std::filesystem::path& path, const RootPlotOptions& options) {
    require_points(diagram);
    const double limit =
        options.max_frequency_hz > 0 ? options.max_frequency_hz : std::numeric_limits<double>::infinity();
    std::string script, plots;
    RootWindow window;
    for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
        const Branch& branch = diagram.branches[b];
        if (branch.of_states && !options.states) continue;
        const Locus own = locus(diagram, branch);
        const auto [first, last] = ends_of(own);
        if (first == last) continue;
        window.take(own, limit);
        const std::string name = text("r", b), hex(colour(colour_index(diagram, branch)).hex);
        script += locus_data(name, own);
        plots +=
            text(", $", name, " using 1:2 with lines lc rgb '", hex, "' dt ", dash(branch.pattern), " lw 1.8 title ",
                 gnuplot_text(branch.name), ", $", name, " using 1:2 every ::", first, "::", first,
                 " with points lc rgb '", hex, "' pt 6 ps 0.9 notitle, $", name, " using 1:2 every ::", last - 1,
                 "::", last - 1, " with points lc rgb '", hex, "' pt 7 ps 0.9 notitle");
    }
    const Locus states = state_roots(diagram);
    if (options.states && !states.hz.empty()) {
        script += locus_data("states", states);
        plots += ", $states using 1:2 with points lc rgb '#aaaaaa' pt 2 ps 0.4 title 'motions of states'";
    }
    const double width = std::max(window.right - window.left, 1e-6), right = std::max(window.right, 0.0) + 0.06 * width;
    const std::string title = options.title.empty() ? diagram.machine : options.title;
    script += text("set title ", gnuplot_text(title), title.size() > 75 ? " font ',10'\n" : "\n", "set xrange [",
                   window.left - 0.04 * width, ":", right,
                   "]\nset yrange [0:", options.max_frequency_hz > 0 ? options.max_frequency_hz : 1.05 * window.top,
                   "]\nset xlabel 'growth rate, 1/s (negative: decay)'\nset ylabel 'damped frequency, Hz'\n"
                   "set lmargin at screen 0.07\nset rmargin at screen 0.665\n"
                   "set key at screen 0.685,0.945 left top Left reverse font ',9'\n"
                   "set object 1 rectangle from 0, graph 0 to ",
                   right, ", graph 1 behind fillcolor rgb '#fbe3d6' fillstyle solid noborder\n", "set label 1 ",
                   gnuplot_text(text(abscissa_label(diagram), ": from ", abscissae(diagram).front(), " (circle) to ",
                                     abscissae(diagram).back(), " (dot)")),
                   " at graph 0.01, 0.03 font ',9'\n");
    script += "plot 0 with lines lc rgb '#999999' lw 1 notitle" + plots + "\n";
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, script, {1200, 800}));
}

}  // namespace cardan::solvers
