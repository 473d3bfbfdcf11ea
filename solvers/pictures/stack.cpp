#include "solvers/pictures/stack.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/pictures/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan::solvers {

namespace {

// All in pixels.
constexpr double left_margin = 100, right_margin = 24, top_margin = 12, bottom_margin = 64;
constexpr double title_height = 32, legend_row = 22, mark_row = 18, gap = 16;
constexpr double legend_sample = 30, legend_space = 26;  // line before an entry, distance to the next one
constexpr double letter = 8.7, small_letter = 7;         // mean width in the legend and at marks, on the safe side

std::size_t letters(std::string_view shown) {
    return static_cast<std::size_t>(
        std::count_if(shown.begin(), shown.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string shortened(std::string shown, std::size_t max) {
    if (letters(shown) <= max) return shown;
    std::size_t end = 0;
    for (std::size_t seen = 0; end < shown.size(); ++end)
        if ((shown[end] & 0xC0) != 0x80 && ++seen == max) break;
    return shown.substr(0, end) + "…";
}

struct Range {
    double low, high;
};

Range finite_range(const StackPanel& panel) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const StackCurve& curve : panel.curves)
        for (double y : curve.y) {
            if (!std::isfinite(y) || (panel.logarithmic && y <= 0)) continue;
            range.low = std::min(range.low, y);
            range.high = std::max(range.high, y);
        }
    return range;
}

std::string superscript(int number) {
    constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string shown = number < 0 ? "⁻" : "";
    for (const char c : text(std::abs(number))) shown += entry(digits, c - '0');
    return shown;
}

// What the numbers of a panel become so that tics are short: shown = (y - offset)*factor.
struct Axis {
    double low = -1, high = 1, offset = 0, factor = 1;
    std::string label, format = "%.6g";
    double shown(double y) const { return (y - offset) * factor; }
};

Axis logarithmic_axis(const StackPanel& panel, Range values) {
    Axis axis{0.1, 10, 0, 1, panel.y_label, "10^{%L}"};
    if (!(values.low <= values.high)) return axis;
    axis.low = std::max(values.low, 1e-6 * values.high) / 1.5;
    axis.high = 2 * values.high;
    return axis;
}

// With some air above and below, constants in the middle. A number that all values have in common is taken from them
// and a power of ten as well, where the units had no prefix for it; the label says so.
Axis axis_of(const StackPanel& panel) {
    const Range values = finite_range(panel);
    if (panel.logarithmic) return logarithmic_axis(panel, values);
    Axis axis;
    axis.label = panel.y_label;
    if (!(values.low <= values.high)) return axis;
    double size = std::max(std::abs(values.low), std::abs(values.high));
    double range = values.high - values.low;
    if (range <= 1e-9 * size || size == 0) {
        range = size > 0 ? size : 1.0;  // constant
    } else if (range < 1e-3 * size) {
        const double decade = std::pow(10, std::floor(std::log10(range)) + 1);
        axis.offset = std::round((values.low + values.high) / 2 / decade) * decade;
        size = std::max(values.high - axis.offset, axis.offset - values.low);
        axis.label += text(" above ", axis.offset);
    }
    if (size > 0 && (size < 0.01 || size >= 1e5)) {
        const int power = 3 * static_cast<int>(std::floor(std::log10(size) / 3));
        axis.factor = std::pow(10.0, -power);
        axis.label = text("10", superscript(power), " ", axis.label);
    }
    axis.low = axis.shown(values.low - 0.07 * range);
    axis.high = axis.shown(values.high + 0.07 * range);
    return axis;
}

struct PlacedMark {
    double x;  // on the axis
    std::string label;
    bool to_the_left = false;
    double begin = 0, end = 0;  // of line and label, in pixels
    int row = 0;
};

class Picture {
public:
    explicit Picture(const PanelStack& stack)
        : stack_(stack),
          plot_height_(stack.panels.size() == 1   ? 380
                       : stack.panels.size() == 2 ? 250
                                                  : 170) {
        check();
        place_marks();
        for (const StackPanel& panel : stack.panels) height_ += legend_rows(panel) * legend_row + plot_height_ + gap;
        height_ += mark_rows_ * mark_row + (stack.title.empty() ? 0 : title_height) - gap;
        if (height_ > 20000)
            throw InputError("picture", "panels", stack.panels.size(), "fewer: it would be higher than 20000 pixels");
    }

    PictureSize size() const { return {stack_.width, static_cast<int>(std::lround(height_))}; }

    std::string script() const {
        std::string s;
        for (std::size_t p = 0; p < stack_.panels.size(); ++p) s += data(p);
        s += text("set multiplot\nset xrange [", stack_.x_low, ":", stack_.x_high, "]\nset lmargin at screen ",
                  across(left_margin), "\nset rmargin at screen ", across(stack_.width - right_margin),
                  "\nset key off\nunset mytics\nset tics nomirror\nset border 3\nset xtics font ',11'\nset ytics font "
                  "',11'\n");
        double y = top_margin;
        if (!stack_.title.empty()) {
            s += text("set label 1 ", gnuplot_text(shortened(stack_.title, title_letters())), " at screen ",
                      across(left_margin), ",", down(y + title_height / 2 - 4), " left font ',14'\n");
            y += title_height;
        }
        for (std::size_t p = 0; p < stack_.panels.size(); ++p) s += panel(p, y);
        return s + "unset multiplot\n";
    }

private:
    double across(double pixels) const { return pixels / stack_.width; }
    double down(double pixels) const { return 1 - pixels / height_; }
    double inner_width() const { return stack_.width - left_margin - right_margin; }
    std::size_t title_letters() const { return static_cast<std::size_t>(inner_width() / (letter * 14 / 12)); }
    std::size_t letters_across() const { return static_cast<std::size_t>((inner_width() - legend_sample) / letter); }

    void check() const {
        constexpr const char* place = "picture";
        if (stack_.panels.empty()) throw InputError(place, "number of panels", 0, "at least one");
        if (stack_.width < 400 || stack_.width > 20000)
            throw InputError(place, "width in pixels", stack_.width, "400 to 20000");
        if (!(stack_.x_high > stack_.x_low) || !std::isfinite(stack_.x_high - stack_.x_low))
            throw InputError(place, text("end of the axis '", stack_.x_label, "'"), stack_.x_high,
                             text("finite and > ", stack_.x_low));
        for (const StackPanel& panel : stack_.panels)
            if (panel.curves.empty() || panel.curves.size() > palette.size())
                throw InputError(place, text("curves in the panel '", panel.y_label, "'"), panel.curves.size(),
                                 text("1 to ", palette.size()));
    }

    // Labels stand to the right of the tops of their lines, near the right border to the left. Overlapping labels go
    // into higher rows: those right of their lines first, from the right on, then those left of them from the left on,
    // so that no line crosses a label.
    void place_marks() {
        for (const StackMark& mark : stack_.marks)
            if (mark.x >= stack_.x_low && mark.x <= stack_.x_high)
                marks_.push_back({mark.x, shortened(mark.label, letters_across() / 2)});
        std::stable_sort(marks_.begin(), marks_.end(),
                         [](const PlacedMark& a, const PlacedMark& b) { return a.x > b.x; });
        double border = inner_width() + right_margin;
        for (PlacedMark& mark : marks_) {
            const double at = (mark.x - stack_.x_low) / (stack_.x_high - stack_.x_low) * inner_width();
            const double length = small_letter * static_cast<double>(letters(mark.label)) + 12;
            mark.to_the_left = at + length > border;
            if (mark.to_the_left) border = at;
            mark.begin = mark.to_the_left ? at - length : at - 2;
            mark.end = mark.to_the_left ? at + 2 : at + length;
        }
        std::stable_partition(marks_.begin(), marks_.end(), [](const PlacedMark& m) { return !m.to_the_left; });
        const auto lefts =
            std::find_if(marks_.begin(), marks_.end(), [](const PlacedMark& m) { return m.to_the_left; });
        std::reverse(lefts, marks_.end());
        for (std::size_t i = 0; i < marks_.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (marks_[k].begin < marks_[i].end && marks_[i].begin < marks_[k].end)
                    marks_[i].row = std::max(marks_[i].row, marks_[k].row + 1);
        for (const PlacedMark& mark : marks_) mark_rows_ = std::max(mark_rows_, mark.row + 1.0);
    }

    double entry_width(const StackPanel& panel) const {
        std::size_t longest = 0;
        for (const StackCurve& curve : panel.curves)
            longest = std::max(longest, std::min(letters(curve.label), letters_across()));
        return legend_sample + legend_space + letter * static_cast<double>(longest);
    }
    std::size_t legend_columns(const StackPanel& panel) const {
        const double fit = std::floor((inner_width() + legend_space) / entry_width(panel));
        return std::clamp<std::size_t>(static_cast<std::size_t>(fit), 1, panel.curves.size());
    }
    double legend_rows(const StackPanel& panel) const {
        const std::size_t columns = legend_columns(panel);
        const std::size_t rows = (panel.curves.size() + columns - 1) / columns;
        return static_cast<double>(rows);
    }

    static std::string name(std::size_t p, std::size_t c) { return text("c", p, "_", c); }
    std::string data(std::size_t p) const {
        std::string blocks;
        const Axis axis = axis_of(stack_.panels[p]);
        for (std::size_t c = 0; c < stack_.panels[p].curves.size(); ++c) {
            const StackCurve& curve = stack_.panels[p].curves[c];
            std::vector<double> y = curve.y;
            for (double& value : y) {
                value = axis.shown(value);
                // A logarithmic axis has no place for zeros: lines go down to its foot instead of ending.
                if (stack_.panels[p].logarithmic && value < axis.low / 10) value = axis.low / 10;
            }
            const std::vector<std::span<const double>> columns{curve.x, y};
            blocks += gnuplot_data(name(p, c), columns);
        }
        return blocks;
    }

    // Lines and names in rows from y on; y moves below them.
    std::string legend(const StackPanel& panel, double& y) const {
        std::string s = "unset arrow\n";
        const std::size_t columns = legend_columns(panel);
        for (std::size_t c = 0; c < panel.curves.size(); ++c) {
            const double x = left_margin + static_cast<double>(c % columns) * entry_width(panel);
            const std::size_t row = c / columns;
            const double middle = y + legend_row * (static_cast<double>(row) + 0.5) - 2;
            s += text("set arrow from screen ", across(x), ",", down(middle), " to screen ",
                      across(x + legend_sample - 6), ",", down(middle), " nohead lw 2.4 lc rgb '", colour(c).hex,
                      "'\nset label ", c + 2, " ", gnuplot_text(shortened(panel.curves[c].label, letters_across())),
                      " at screen ", across(x + legend_sample), ",", down(middle), " left font ',12'\n");
        }
        y += legend_rows(panel) * legend_row;
        return s;
    }

    std::string mark_lines(bool first, double top) const {
        std::string s;
        int tag = 100;
        for (const PlacedMark& mark : marks_) {
            const double middle = top - (mark.row + 0.5) * mark_row;
            s += text("set arrow from first ", mark.x, ", graph 0 to first ", mark.x, ", ",
                      first ? text("screen ", down(middle - mark_row / 2 + 2)) : std::string("graph 1"),
                      " nohead back lw 1 dt 2 lc rgb '#888888'\n");
            if (!first || mark.label.empty()) continue;
            s += text("set label ", tag++, " ", gnuplot_text(mark.label), " at first ", mark.x, ", screen ",
                      down(middle), mark.to_the_left ? " right offset -0.5,0" : " left offset 0.5,0",
                      " font ',10' tc rgb '#444444'\n");
        }
        return s;
    }

    std::string panel(std::size_t p, double& y) const {
        const StackPanel& panel = stack_.panels[p];
        const bool first = p == 0, last = p + 1 == stack_.panels.size();
        std::string s = legend(panel, y);
        if (first) y += mark_rows_ * mark_row;
        s += mark_lines(first, y);
        const Axis axis = axis_of(panel);
        s += text("set tmargin at screen ", down(y), "\nset bmargin at screen ", down(y + plot_height_), "\n",
                  panel.logarithmic ? "set logscale y\n" : "unset logscale y\n", "set yrange [", axis.low, ":",
                  axis.high, "]\nset format y '", axis.format, "'\nset label 99 ", gnuplot_text(axis.label),
                  " at screen ", across(20), ",", down(y + plot_height_ / 2), " center rotate font ',12'\n",
                  last ? text("set format x '%.12g'\nset xlabel ", gnuplot_text(stack_.x_label), " font ',12'\n")
                       : std::string("set format x ''\nunset xlabel\n"));
        y += plot_height_ + gap;
        std::string plots = "NaN notitle";
        if (!panel.logarithmic && axis.offset == 0) plots += ", 0 with lines lw 1 lc rgb '#c0c0c0'";
        for (std::size_t c = 0; c < panel.curves.size(); ++c)
            plots += text(", $", name(p, c), " using 1:2 with lines lw 1.5 lc rgb '", colour(c).hex, "'");
        return s + "plot " + plots + "\nunset label\n";
    }

    const PanelStack& stack_;
    std::vector<PlacedMark> marks_;
    double plot_height_;
    double mark_rows_ = 0, height_ = top_margin + bottom_margin;
};

}  // namespace

void draw(const PanelStack& stack, const std::filesystem::path& path) {
    const Picture picture(stack);
    static_cast<void>(Gnuplot::of_this_thread().write_picture(path, picture.script(), picture.size()));
}

}  // namespace cardan::solvers
