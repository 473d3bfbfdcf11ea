#include "mbs/base/error.hpp"
#include "solvers/campbell_data/difference.hpp"
#include "solvers/pictures/campbell.hpp"
#include "solvers/pictures/detail/campbell_style.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace cardan::solvers {

namespace {

struct Curves {
    std::string data, frequency, damping;
};

Curves curves(const std::vector<BranchDifference>& shown, const std::vector<double>& abscissae) {
    Curves all;
    std::vector<std::string> families;
    for (std::size_t b = 0; b < shown.size(); ++b) {
        const BranchDifference& one = shown[b];
        const auto family = std::find(families.begin(), families.end(), one.family) - families.begin();
        if (family == std::ssize(families)) families.push_back(one.family);
        std::vector<double> millihertz, percent;
        for (const double f : one.frequency_hz) millihertz.push_back(1e3 * f);
        for (const double zeta : one.damping_ratio) percent.push_back(100 * zeta);
        const std::string name = text("d", b);
        all.data += gnuplot_data(name, std::vector<std::span<const double>>{abscissae, millihertz, percent});
        const int symbol = one.name.starts_with("2nd") ? 6 : 7;
        const std::string style = text(" with linespoints pt ", symbol, " ps 0.5 lw 1.8 lc rgb '",
                                       colour(static_cast<std::size_t>(family)).hex, "' dt ", dash(one.pattern));
        all.frequency += text(", $", name, " using 1:2", style, " title ", gnuplot_text(one.name));
        all.damping += text(", $", name, " using 1:3", style, " notitle");
    }
    return all;
}

}  // namespace

void plot_differences(const Campbell& diagram, const Campbell& reference, const std::filesystem::path& path,
                      const std::string& what) {
    std::vector<BranchDifference> shown = differences(diagram, reference);
    double largest = 0;
    for (const BranchDifference& one : shown) largest = std::max(largest, one.largest_hz);
    std::erase_if(shown, [&](const BranchDifference& one) { return one.largest_hz < largest / 100; });
    if (shown.empty())
        throw InputError(diagram.machine, "modes that both diagrams have", 0, "at least one, at one rotor speed");
    std::vector<double> x = abscissae(diagram);
    x.resize(shown[0].frequency_hz.size());  // the reference may have fewer
    const Curves all = curves(shown, x);
    const double last = x.back() > x.front() ? x.back() : x.front() + 1;
    std::string script = all.data + "set multiplot\nset lmargin at screen 0.115\nset rmargin at screen 0.665\n";
    script +=
        text("set xrange [", x.front(), ":", last, "]\nset title ", gnuplot_text(diagram.machine),
             " offset 0,0.9\nset label 1 ",
             gnuplot_text(what.empty() ? text(diagram.method, " minus ", reference.method) : what),
             " at graph 0.5,1.045 center font ',9'",
             "\nset tmargin at screen 0.92\nset bmargin at screen 0.50\nset ylabel 'difference of frequency, mHz'\n"
             "set format x ''\nset key at screen 0.69,0.925 left top Left reverse font ',9' maxrows 40\n"
             "plot 0 with lines lc rgb '#999999' lw 1 notitle",
             all.frequency, "\n");
    script += text(
        "unset title\nunset label 1\nset tmargin at screen 0.46\nset bmargin at screen 0.08\nunset key\nset format x "
        "'%g'\n"
        "set xlabel ",
        gnuplot_text(abscissa_label(diagram)),
        "\nset ylabel 'difference of damping ratio, %'\n"
        "plot 0 with lines lc rgb '#999999' lw 1 notitle",
        all.damping, "\nunset multiplot\n");
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, script, {1200, 860}));
}

}  // namespace cardan::solvers
