#include "solvers/pictures/campbell.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/pictures/detail/campbell_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace cardan::solvers {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Only for vibrating or locked motions: motions that merely decay would set the scale.
double damping(const Campbell& diagram, const Branch& branch, std::size_t point) {
    const CampbellMode* mode = diagram.mode(branch, point);
    return mode && mode->kind() != FloquetKind::aperiodic ? diagram.damping_ratio(branch, point) : nan;
}

// One panel pair of one diagram as a gnuplot script.
class Panels {
public:
    Panels(const Campbell& diagram, const CampbellPlotOptions& options, const std::string& prefix)
        : d_(diagram),
          options_(options),
          prefix_(prefix),
          rpm_(abscissae(diagram)),
          low_(rpm_.front()),
          high_(rpm_.back()) {
        for (const Branch& branch : diagram.branches)
            if (shows(diagram, branch)) branches_.push_back(&branch);
        for (const Branch* branch : branches_) take_range(diagram, *branch);
        for (const OtherDiagram& other : options.others) {
            const std::vector<double> x = abscissae(*other.diagram);
            low_ = std::min(low_, x.front());
            high_ = std::max(high_, x.back());
            for (const Branch& branch : other.diagram->branches)
                if (shows(*other.diagram, branch)) take_range(*other.diagram, branch);
        }
        f_max_ = options.max_frequency_hz > 0 ? options.max_frequency_hz : 1.05 * f_max_;
        if (f_max_ == 0) f_max_ = 1;  // rigid motions only
        for (std::size_t i = 0; i < rpm_.size(); ++i) turns_.push_back({rpm_[i], d_.points[i].rotor_speed / (2 * pi)});
        // Of one point alone as far as the picture goes.
        if (turns_.size() == 1)
            turns_.push_back({last(), turns_[0].hz + (d_.parameters.empty() ? last() - rpm_[0] : 0) / units::minute});
    }

    std::string data() const {
        std::vector<double> x, hz;
        for (const Turning& at : turns_) x.push_back(at.x), hz.push_back(at.hz);
        std::string script = gnuplot_data(turns_name(), std::vector<std::span<const double>>{x, hz});
        for (std::size_t b = 0; b < branches_.size(); ++b) script += branch_data(d_, *branches_[b], name(b), rpm_);
        if (const Campbell* blade = options_.isolated_blade)
            for (std::size_t b = 0; b < blade->branches.size(); ++b) {
                script += branch_data(*blade, blade->branches[b], blade_name(b), abscissae(*blade));
            }
        for (std::size_t k = 0; k < options_.others.size(); ++k) {
            const Campbell& other = *options_.others[k].diagram;
            for (std::size_t b = 0; b < other.branches.size(); ++b)
                script += branch_data(other, other.branches[b], other_name(k, b), abscissae(other));
        }
        return script;
    }

    std::string frequency_panel(bool legend, bool x_label) const {
        std::string s = text(
            "set title ", gnuplot_text(title()), title().size() > 75 ? " font ',10'\n" : "\n", x_range(),
            "set yrange [0:", f_max_, "]\n", "set format y '%g'\nset ylabel 'damped frequency, Hz'\n",
            x_label_command(x_label), multiples_labels(),
            legend ? text("set key at screen 0.71,0.945 left top Left reverse", long_names() ? " font ',9'\n" : "\n")
                   : "set key at graph 0.5,-0.22 center top Left reverse font ',9'\n");
        std::string plots;
        for (int n : rotor_multiples(d_.blades))
            plots += text(plots.empty() ? "" : ", ", "$", turns_name(), " using 1:(", n,
                          "*$2) with lines lc rgb '#999999' dt 3 lw 1 notitle");
        for (std::size_t b = 0; b < branches_.size(); ++b) plots += curve(b, 2, 4, true);
        if (any_doubtful())
            plots += ", keyentry with points lc rgb '#000000' pt 6 ps 0.7 title 'name or frequency in doubt'";
        if (const Campbell* blade = options_.isolated_blade)
            for (std::size_t b = 0; b < blade->branches.size(); ++b) {
                const Branch& branch = blade->branches[b];
                if (!shows(*blade, branch)) continue;
                plots += text(", $", blade_name(b), " using 1:2 with lines lc rgb '#000000' dt 1 lw 1 title ",
                              gnuplot_text(text("isolated blade: ", branch.name)));
            }
        plots += other_curves(2);
        if (!options_.others.empty())
            plots += ", keyentry with lines lc rgb '#000000' lw 1.8 title " + gnuplot_text("lines: " + options_.name);
        for (std::size_t k = 0; k < options_.others.size(); ++k)
            plots += text(", keyentry with points lc rgb '#000000' pt ", symbol(k), " ps 0.9 title ",
                          gnuplot_text(options_.others[k].name));
        return s + "plot " + plots + "\nunset label\n";
    }

    std::string damping_panel() const {
        const double low = std::min(0.0, 1.1 * zeta_min_), high = zeta_max_ > 1e-6 ? 1.1 * zeta_max_ : 1.0;
        const bool decades = options_.log_damping && smallest_zeta_ > 0 && zeta_max_ > 30 * smallest_zeta_;
        const std::string range = decades
                                      ? text("set logscale y\nset yrange [", 0.8 * smallest_zeta_, ":", 1.3 * zeta_max_)
                                      : text("set yrange [", low, ":", high);
        std::string s = text("unset title\n", x_range(), range, "]\nset format y '%g'\nset ylabel 'damping ratio, %'\n",
                             x_label_command(true), "unset key\n");
        std::string plots;
        for (std::size_t b = 0; b < branches_.size(); ++b) plots += curve(b, 3, 5, false);
        plots += other_curves(3);
        return s + "plot " + (decades ? plots.substr(2) : "0 with lines lc rgb '#999999' lw 1 notitle" + plots) + "\n";
    }

private:
    std::string name(std::size_t b) const { return text("b", prefix_, "_", b); }
    std::string turns_name() const { return "turns_" + prefix_; }
    std::string blade_name(std::size_t b) const { return text("i", prefix_, "_", b); }
    std::string other_name(std::size_t k, std::size_t b) const { return text("o", prefix_, "_", k, "_", b); }
    static int symbol(std::size_t k) {
        constexpr std::array symbols{1, 2, 3, 8};  // +, x, *, triangle: doubtful points are circles
        return symbols[k];
    }
    // In the colour that their family has in the diagram.
    std::string other_curves(int column) const {
        std::string plots;
        for (std::size_t k = 0; k < options_.others.size(); ++k) {
            const Campbell& other = *options_.others[k].diagram;
            for (std::size_t b = 0; b < other.branches.size(); ++b) {
                const Branch& branch = other.branches[b];
                if (!shows(other, branch)) continue;
                plots += text(", $", other_name(k, b), " using 1:", column, " with points pt ", symbol(k),
                              " ps 0.9 lw 1.4 lc rgb '", colour(colour_index(d_, branch)).hex, "' notitle");
            }
        }
        return plots;
    }
    void take_range(const Campbell& d, const Branch& branch) {
        for (std::size_t i = 0; i < d.points.size(); ++i) {
            const double f = d.damped_hz(branch, i), zeta = damping(d, branch, i);
            if (std::isfinite(f)) f_max_ = std::max(f_max_, f);
            if (!std::isfinite(zeta)) continue;
            smallest_zeta_ = std::min(smallest_zeta_, 100 * zeta);
            zeta_min_ = std::min(zeta_min_, 100 * zeta);
            zeta_max_ = std::max(zeta_max_, 100 * zeta);
        }
    }
    bool shows(const Campbell& d, const Branch& branch) const {
        if (branch.of_states && !options_.states) return false;
        const auto& families = options_.families;
        if (!families.empty() && std::find(families.begin(), families.end(), branch.family) == families.end())
            return false;
        if (options_.ordinal > 0 &&
            (branch.component < 0 || entry(d.components, branch.component).ordinal != options_.ordinal))
            return false;
        double lowest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < d.points.size(); ++i) {
            const double f = d.damped_hz(branch, i);
            if (f < lowest) lowest = f;
        }
        return options_.max_frequency_hz <= 0 || lowest <= options_.max_frequency_hz;
    }
    std::string title() const {
        const std::string given = options_.title.empty() ? d_.machine : options_.title;
        const std::string method = d_.method.substr(0, d_.method.find(" ("));
        return options_.families.empty() && !d_.warning.empty() ? text(given, ": ", method, ", see warning") : given;
    }
    bool long_names() const {
        return std::any_of(branches_.begin(), branches_.end(), [](const Branch* b) { return b->name.size() > 30; });
    }

    bool any_doubtful() const {
        return std::any_of(branches_.begin(), branches_.end(), [](const Branch* branch) {
            return std::find(branch->doubtful.begin(), branch->doubtful.end(), true) != branch->doubtful.end();
        });
    }

    // Columns: rpm, frequency, damping in %, and both again where doubtful only.
    static std::string branch_data(const Campbell& d, const Branch& branch, const std::string& name,
                                   const std::vector<double>& rpm) {
        std::vector<double> f, zeta, f_doubtful, zeta_doubtful;
        for (std::size_t i = 0; i < rpm.size(); ++i) {
            f.push_back(d.damped_hz(branch, i));
            zeta.push_back(100 * damping(d, branch, i));
            f_doubtful.push_back(branch.doubtful[i] ? f.back() : nan);
            zeta_doubtful.push_back(branch.doubtful[i] ? zeta.back() : nan);
        }
        const std::vector<std::span<const double>> columns{rpm, f, zeta, f_doubtful, zeta_doubtful};
        return gnuplot_data(name, columns);
    }

    std::string curve(std::size_t b, int column, int doubtful_column, bool titled) const {
        const Branch& branch = *branches_[b];
        const std::string colour_name(colour(colour_index(d_, branch)).hex);
        const std::string line = text(", $", name(b), " using 1:", column, " with lines lc rgb '", colour_name, "' dt ",
                                      dash(branch.pattern), " lw ", branch.pattern == RotorPattern::none ? 2.4 : 1.8);
        return line + (titled ? " title " + gnuplot_text(branch.name) : std::string(" notitle")) +
               text(", $", name(b), " using 1:", doubtful_column, " with points lc rgb '", colour_name,
                    "' pt 6 ps 0.7 notitle");
    }

    // End of the axis.
    double last() const { return high_ > low_ ? high_ : low_ + 1; }
    std::string x_range() const {
        const double low = low_, high = last();
        // Over decades in decades.
        const bool decades = !d_.parameters.empty() && low > 0 && high > 50 * low;
        return text(decades ? "set logscale x\n" : "", "set xrange [", low, ":", high, "]\n");
    }
    std::string x_label_command(bool shown) const {
        if (!shown) return "unset xlabel\nset format x ''\n";
        return text("set xlabel ", gnuplot_text(abscissa_label(d_)), "\nset format x '%g'\n");
    }
    // Where the curve of a multiple ends, or leaves the picture on its top.
    std::string multiples_labels() const {
        std::string labels;
        for (int n : rotor_multiples(d_.blades)) {
            const auto inside = [&](const Turning& at) { return n * at.hz <= f_max_; };
            const auto found = std::find_if(turns_.rbegin(), turns_.rend(), inside);
            if (found == turns_.rend()) continue;
            Turning end = *found;
            const bool leaves_on_top = found != turns_.rbegin();
            if (leaves_on_top) {
                const Turning& beyond = *std::prev(found);
                const double part = (f_max_ / n - end.hz) / (beyond.hz - end.hz);
                end = {end.x + part * (beyond.x - end.x), f_max_ / n};
                if (end.x <= rpm_.front()) continue;
            }
            if (end.hz == 0) continue;
            labels +=
                text("set label '", n, "P' at ", end.x, ",", n * end.hz,
                     leaves_on_top ? " center offset 0,0.5" : " left offset 0.3,0", " font ',9' tc rgb '#666666'\n");
        }
        return labels;
    }

    // Rotor frequency along the axis.
    struct Turning {
        double x, hz;
    };

    const Campbell& d_;
    const CampbellPlotOptions& options_;
    std::string prefix_;
    std::vector<const Branch*> branches_;
    std::vector<double> rpm_;
    std::vector<Turning> turns_;
    double low_ = 0, high_ = 0;  // of the axis
    double f_max_ = 0, zeta_min_ = 0, zeta_max_ = 0;
    double smallest_zeta_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void plot(const Campbell& diagram, const std::filesystem::path& path, const CampbellPlotOptions& options) {
    require_points(diagram);
    constexpr std::size_t max = 4;
    if (options.others.size() > max)
        throw InputError("Campbell diagrams over each other", "others", options.others.size(), "at most 4");
    for (const OtherDiagram& other : options.others) {
        require_points(*other.diagram);
        if (other.diagram->parameter != diagram.parameter)
            throw InputError("Campbell diagrams over each other", "axis of " + other.name,
                             abscissa_label(*other.diagram), text(abscissa_label(diagram), ", as of the first"));
    }
    const Panels panels(diagram, options, "0");
    std::string script = panels.data() + "set multiplot\nset lmargin at screen 0.07\nset rmargin at screen 0.665\n";
    if (options.damping_panel) {
        script += "set tmargin at screen 0.94\nset bmargin at screen 0.36\n" + panels.frequency_panel(true, false);
        script += "set tmargin at screen 0.33\nset bmargin at screen 0.08\n" + panels.damping_panel();
    } else {
        script += "set tmargin at screen 0.94\nset bmargin at screen 0.09\n" + panels.frequency_panel(true, true);
    }
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, script + "unset multiplot\n", {1200, 860}));
}

void plot_panels(const Campbell& diagram, const std::filesystem::path& path,
                 const std::vector<CampbellPlotOptions>& panels) {
    require_points(diagram);
    if (panels.empty()) throw InputError("Campbell panels", "number of panels", 0, "at least one");
    const std::size_t rows = (panels.size() + 1) / 2;
    std::string script;
    for (std::size_t i = 0; i < panels.size(); ++i) script += Panels(diagram, panels[i], text(i)).data();
    script += text("set multiplot layout ", rows, ",2\nset lmargin 9\nset rmargin 4\nset bmargin 9\n");
    for (std::size_t i = 0; i < panels.size(); ++i)
        script += Panels(diagram, panels[i], text(i)).frequency_panel(false, true);
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, script + "unset multiplot\n",
                                                              {1200, static_cast<int>(520 * rows)}));
}

}  // namespace cardan::solvers
