#include "examples/studies/beam_accuracy/figure.hpp"

#include "mbs/base/error.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::accuracy {

namespace {

constexpr double smallest = 1e-6;  // %; below it nothing is of interest

const Result* find(const std::vector<Result>& results, const std::string& study) {
    for (const Result& r : results)
        if (r.study.name == study) return &r;
    return nullptr;
}

std::string block(std::size_t panel, std::size_t method) {
    return text("p", panel, "m", method);
}

std::string style(const Method& m) {
    return text("with linespoints lc rgb '", solvers::colour(static_cast<std::size_t>(m.colour)).hex, "' lw 1.6 dt ",
                m.dashed ? "(7,5)" : "1", " pt ", m.symbol, " ps ", m.dashed ? 1 : 0.8);
}

struct Data {
    std::string script, plots, dashed;
    double low = 1e300, high = 0;
};

bool drawn(const Figure& figure, const std::string& method) {
    return std::find(figure.without.begin(), figure.without.end(), method) == figure.without.end();
}

Data data_of(const Figure& figure, const Result& result, std::size_t number) {
    const Panel& panel = figure.panels[number];
    Data data;
    const Study& study = result.study;
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
        if (!drawn(figure, study.methods[m])) continue;
        std::vector<double> n, error;
        for (std::size_t i = 0; i < study.elements.size(); ++i) {
            const double e = 100 * std::abs(result.error[m][panel.quantity][i]);
            if (!(e >= smallest)) continue;
            n.push_back(study.elements[i]), error.push_back(e);
            data.low = std::min(data.low, e), data.high = std::max(data.high, e);
        }
        const std::vector<std::span<const double>> columns{n, error};
        data.script += solvers::gnuplot_data(block(number, m), columns);
        const Method& how = method(study.methods[m]);
        (how.dashed ? data.dashed : data.plots) += text(", $", block(number, m), " using 1:2 ", style(how), " notitle");
    }
    return data;
}

double legend_height(int rows) {
    return 20 * rows + 14;
}

constexpr double panel_width = 330, panel_height = 290;  // pixels
constexpr double axis_begin = 0.9, guide_end = 34,
                 axis_end = 72;  // of the x axis; room for words beyond the last curve

// Lines of order 2 and 4 fan out from the upper left corner.
std::string guides(double high) {
    std::string plots;
    for (int order : {2, 4})
        plots += text(order == 2 ? "sample " : ", ", "[1:", guide_end, "] ", high, "*x**(-", order,
                      ") with lines lc rgb '#888888' lw 1.3 dt ", order == 2 ? "(14,7)" : "(2,6)", " notitle");
    return plots;
}

// Their names, where they end.
std::string guide_labels(double low, double high) {
    std::string labels;
    for (int order : {2, 4}) {
        const double end = std::min(guide_end, std::pow(high / low, 1. / order));
        const char* place = end < 30          ? "right offset -1.8,0.7"  // at the foot, away from the curves
                            : end < guide_end ? "left offset 0.9,0.7"
                                              : "left offset 0.4,0";
        labels += text("set label ", order, " 'order ", order, "' at ", end, ",", high * std::pow(end, -order), " ",
                       place, " font ',10' tc rgb '#666666'\n");
    }
    return labels;
}

std::string panel_script(const Panel& panel, const Data& data, bool left, bool bottom) {
    const double low = std::pow(10, std::floor(std::log10(data.low))),
                 high = std::pow(10, std::ceil(std::log10(data.high)));
    return text("set title ", solvers::gnuplot_text(panel.title), "\nset yrange [", low, ":", high, "]\n",
                bottom ? "set xlabel 'elements' font ',12'\n" : "unset xlabel\n",
                left ? "set ylabel '|error|, %' font ',12'\n" : "unset ylabel\n", guide_labels(low, high), "plot ",
                guides(high), data.plots, data.dashed, "\n");
}

// One legend for all panels, across the foot of the picture, three entries to the row.
std::string legend(const std::vector<std::string>& keys, double height, int rows) {
    std::string plots;
    for (const std::string& key : keys)
        plots += text("NaN ", style(method(key)), " title ", solvers::gnuplot_text(method(key).label), ", ");
    return text(
        "unset title\nunset label\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset logscale\n"
        "set xrange [0:1]\nset yrange [0:1]\nset lmargin at screen 0.03\nset rmargin at screen 0.97\n"
        "set bmargin at screen 0\nset tmargin at screen ",
        legend_height(rows) / height, "\nset key center center horizontal maxcols 3 maxrows ", rows,
        " Left reverse samplen 2.5 font ',11'\nplot ", plots, "NaN notitle\n");
}

}  // namespace

bool complete(const Figure& figure, const std::vector<Result>& results) {
    return std::all_of(figure.panels.begin(), figure.panels.end(),
                       [&](const Panel& p) { return find(results, p.study) != nullptr; });
}

void draw(const Figure& figure, const std::vector<Result>& results, const std::filesystem::path& path) {
    const std::size_t columns = std::min(static_cast<std::size_t>(figure.per_row), figure.panels.size());
    const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
    std::vector<std::string> keys;
    std::string script, panels;
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        const Result* result = find(results, figure.panels[i].study);
        if (!result) throw InputError(figure.name, "study", figure.panels[i].study, "one that was run");
        const Data data = data_of(figure, *result, i);
        script += data.script;
        panels += panel_script(figure.panels[i], data, i % columns == 0, i + columns >= figure.panels.size());
        for (const std::string& key : result->study.methods)
            if (drawn(figure, key) && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
    const int legend_rows = static_cast<int>(keys.size() + 2) / 3;
    const double width = 90 + 14 - 70 + (panel_width + 70) * static_cast<double>(columns),
                 foot = 52 + legend_height(legend_rows),
                 height = 68 + foot + panel_height * static_cast<double>(rows) + 62 * static_cast<double>(rows - 1);
    script += text("set multiplot layout ", rows, ",", columns, " margins ", 90 / width, ",", 1 - 14 / width, ",",
                   foot / height, ",", 1 - 68 / height, " spacing ", 70 / width, ",", 62 / height, " title ",
                   solvers::gnuplot_text(figure.title), " font ',15'\nset logscale xy\nset xrange [", axis_begin, ":",
                   axis_end,
                   "]\nset xtics (1,2,4,8,16,32) font ',11'\nset ytics "
                   "nomirror 100 font ',11'\nset format y '%g'\nset grid noxtics\nset samples 2\nset mytics 1\nset "
                   "ylabel offset 2.5,0\nset xlabel offset 0,0.6\nset title "
                   "offset 0,-0.4 font ',12'\nunset key\n");
    static_cast<void>(solvers::Gnuplot::of_this_thread().write_picture(
        path, script + panels + legend(keys, height, legend_rows) + "unset multiplot\n",
        {static_cast<int>(width), static_cast<int>(height)}));
}

}  // namespace cardan::accuracy
