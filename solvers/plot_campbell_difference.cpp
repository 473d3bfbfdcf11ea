#include "mbs/error.hpp"
#include "solvers/campbell_difference.hpp"
#include "solvers/plot_campbell.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace cardan::solvers {

namespace {

struct Curves {
    std::string data, frequency, damping;
};

int dash(RotorPattern pattern) {
    return pattern == RotorPattern::backward ? 2 : pattern == RotorPattern::forward ? 4 : 1;
}

Curves curves(const std::vector<BranchDifference>& shown, const std::vector<double>& rpm) {
    Curves all;
    std::vector<std::string> families;
    for (std::size_t b = 0; b < shown.size(); ++b) {
        const BranchDifference& one = shown[b];
        const auto family = std::find(families.begin(), families.end(), one.family) - families.begin();
        if (family == static_cast<std::ptrdiff_t>(families.size())) families.push_back(one.family);
        std::vector<double> millihertz, percent;
        for (const double f : one.frequency_hz) millihertz.push_back(1e3 * f);
        for (const double zeta : one.damping_ratio) percent.push_back(100 * zeta);
        const std::string name = text("d", b);
        all.data += gnuplot_data(name, std::vector<std::span<const double>>{rpm, millihertz, percent});
        const int symbol = one.name.starts_with("2nd") ? 6 : 7;
        const std::string style = text(" with linespoints pt ", symbol, " ps 0.5 lw 1.8 lc rgb '",
                                       colour(static_cast<std::size_t>(family)).hex, "' dt ", dash(one.pattern));
        all.frequency += text(", $", name, " using 1:2", style, " title ", gnuplot_text(one.name));
        all.damping += text(", $", name, " using 1:3", style, " notitle");
    }
    return all;
}

}  // namespace

void plot_differences(const Campbell& diagram, const Campbell& reference, const std::filesystem::path& path) {
    std::vector<BranchDifference> shown = differences(diagram, reference);
    double largest = 0;
    for (const BranchDifference& one : shown) largest = std::max(largest, one.largest_hz);
    std::erase_if(shown, [&](const BranchDifference& one) { return one.largest_hz < largest / 100; });
    if (shown.empty())
        throw InputError(diagram.machine, "modes that both diagrams have", 0, "at least one, at one rotor speed");
    std::vector<double> rpm;
    for (std::size_t i = 0; i < shown[0].frequency_hz.size(); ++i)
        rpm.push_back(diagram.points[i].rotor_speed * 30 / pi);
    const Curves all = curves(shown, rpm);
    const double last = rpm.back() > rpm.front() ? rpm.back() : rpm.front() + 1;
    std::string script = all.data + "set multiplot\nset lmargin at screen 0.08\nset rmargin at screen 0.665\n";
    script +=
        text("set xrange [", rpm.front(), ":", last, "]\nset title ",
             gnuplot_text(text(diagram.machine, ": Floquet minus mean over the azimuth")),
             "\nset tmargin at screen 0.94\nset bmargin at screen 0.50\nset ylabel 'difference of frequency, mHz'\n"
             "set format x ''\nset key at screen 0.69,0.945 left top Left reverse\n"
             "plot 0 with lines lc rgb '#999999' lw 1 notitle",
             all.frequency, "\n");
    script += text(
        "unset title\nset tmargin at screen 0.46\nset bmargin at screen 0.08\nunset key\nset format x '%g'\n"
        "set xlabel 'rotor speed, rev/min'\nset ylabel 'difference of damping ratio, %'\n"
        "plot 0 with lines lc rgb '#999999' lw 1 notitle",
        all.damping, "\nunset multiplot\n");
    static_cast<void>(Gnuplot().write_picture(path, script, {1200, 860}));
}

}  // namespace cardan::solvers
