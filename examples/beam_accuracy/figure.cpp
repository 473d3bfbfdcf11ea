#include "examples/beam_accuracy/figure.hpp"

#include "mbs/error.hpp"
#include "solvers/plot_gnuplot.hpp"

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
    return text("with linespoints lc rgb '", solvers::colour(static_cast<std::size_t>(m.colour)).hex, "' lw 1.6 pt ",
                m.symbol, " ps 0.6");
}

struct Data {
    std::string script, plots;
    double low = 1e300, high = 0;
};

Data data_of(const Result& result, const Panel& panel, std::size_t number) {
    Data data;
    const Study& study = result.study;
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
        std::vector<double> n, error;
        for (std::size_t i = 0; i < study.elements.size(); ++i) {
            const double e = 100 * std::abs(result.error[m][panel.quantity][i]);
            if (!(e >= smallest)) continue;
            n.push_back(study.elements[i]), error.push_back(e);
            data.low = std::min(data.low, e), data.high = std::max(data.high, e);
        }
        const std::vector<std::span<const double>> columns{n, error};
        data.script += solvers::gnuplot_data(block(number, m), columns);
        data.plots += text(", $", block(number, m), " using 1:2 ", style(method(study.methods[m])), " notitle");
    }
    return data;
}

double legend_height(int rows) {
    return 20 * rows + 14;
}

// Lines of order 2 and 4 fan out from the upper left corner.
std::string guides(double high) {
    std::string plots;
    for (int order : {2, 4})
        plots += text(order == 2 ? "" : ", ", high, "*x**(-", order, ") with lines lc rgb '#999999' lw 1 dt ",
                      order == 2 ? "(10,6)" : "(3,5)", " notitle");
    return plots;
}

std::string panel_script(const Panel& panel, const Data& data, bool left, bool bottom) {
    const double low = std::pow(10, std::floor(std::log10(data.low))),
                 high = std::pow(10, std::ceil(std::log10(data.high)));
    return text("set title ", solvers::gnuplot_text(panel.title), "\nset yrange [", low, ":", high, "]\n",
                bottom ? "set xlabel 'elements' font ',12'\n" : "unset xlabel\n",
                left ? "set ylabel '|error|, %' font ',12'\n" : "unset ylabel\n", "plot ", guides(high), data.plots,
                "\n");
}

// One legend for all panels, across the foot of the picture, three entries to the row.
std::string legend(const std::vector<std::string>& keys, double height, int rows) {
    std::string plots;
    for (const std::string& key : keys)
        plots += text("NaN ", style(method(key)), " title ", solvers::gnuplot_text(method(key).label), ", ");
    return text(
        "unset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset logscale\nset xrange [0:1]\nset "
        "yrange [0:1]\nset lmargin at screen 0.03\nset rmargin at screen 0.97\nset bmargin at screen 0\nset tmargin at "
        "screen ",
        legend_height(rows) / height, "\nset key center center horizontal maxcols 3 maxrows ", rows,
        " Left reverse samplen 2.5 font ',11'\nplot ", plots,
        "NaN with lines lc rgb '#777777' lw 1.2 dt (10,6) title 'order 2', NaN with lines lc rgb '#777777' lw 1.2 dt "
        "(3,5) title 'order 4'\n");
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
        const Data data = data_of(*result, figure.panels[i], i);
        script += data.script;
        panels += panel_script(figure.panels[i], data, i % columns == 0, i + columns >= figure.panels.size());
        for (const std::string& key : result->study.methods)
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
    const int legend_rows = static_cast<int>(keys.size() + 2 + 2) / 3;
    const double width = 75 + 375 * static_cast<double>(columns), foot = 58 + legend_height(legend_rows),
                 height = 310 * static_cast<double>(rows) + 20 + foot;
    script += text("set multiplot layout ", rows, ",", columns, " margins ", 90 / width, ",", 1 - 14 / width, ",",
                   foot / height, ",", 1 - 62 / height, " spacing ", 70 / width, ",", 62 / height, " title ",
                   solvers::gnuplot_text(figure.title),
                   " font ',15'\nset logscale xy\nset xrange [0.9:36]\nset xtics (1,2,4,8,16,32) font ',11'\nset ytics "
                   "nomirror 100 font ',11'\nset format y '%g'\nset grid noxtics\nset samples 40\nset mytics 1\nset "
                   "ylabel offset 2.5,0\nset title "
                   "offset 0,-0.4 font ',12'\nunset key\n");
    static_cast<void>(solvers::Gnuplot().write_picture(
        path, script + panels + legend(keys, height, legend_rows) + "unset multiplot\n",
        {static_cast<int>(width), static_cast<int>(height)}));
}

}  // namespace cardan::accuracy
