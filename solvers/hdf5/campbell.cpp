#include "solvers/hdf5/campbell.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/version.hpp"
#include "solvers/hdf5/file.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

namespace cardan::solvers {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class Range, class F>
auto column(const Range& range, F value) {
    std::vector<decltype(value(*range.begin()))> values;
    values.reserve(static_cast<std::size_t>(std::distance(range.begin(), range.end())));
    for (const auto& item : range) values.push_back(value(item));
    return values;
}

class Writer {
public:
    Writer(const Campbell& diagram, const std::filesystem::path& path)
        : d_(diagram),
          file_(Hdf5File::create(path)),
          points_(diagram.points.size()),
          branches_(diagram.branches.size()) {
        for (const CampbellPoint& point : d_.points)
            if (point.periodic) harmonics_ = std::max(harmonics_, point.periodic->harmonics());
    }

    void write() {
        header();
        axes();
        branches();
        components();
        crossings();
        coordinates();
        if (!d_.motions.empty()) shapes();
        if (harmonics_ > 0) floquet();
        file_.finish();
    }

private:
    void header() {
        for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
                 {"title", "Campbell diagram: " + d_.machine},
                 {"machine", d_.machine},
                 {"method", d_.method},
                 {"method_reason", d_.method_reason},
                 {"warning", d_.warning},
                 {"remark", d_.remark},
                 {"accuracy", d_.accuracy},
                 {"rotor_spin", d_.spin == RotorSpin::free ? "free" : "prescribed"},
                 {"Conventions", "CF-1.8"},
                 {"program", "cardan"},
                 {"version", std::string(version())}})
            file_.set_attribute("/", {name, value});
        file_.set_attribute("/", {"complete", std::int64_t{d_.complete}});
        file_.set_attribute("/", {"number_of_blades", std::int64_t{d_.blades}});
        file_.write("input_description", std::vector<std::string>{d_.source}, {},
                    "the machine as assembled, what it was read from, and the machine that was computed");
    }

    void axes() {
        const std::vector<double> speed = d_.rotor_speeds();
        file_.write("rotor_speed", speed, {points_}, {"rad s-1", "rotor speed"});
        file_.make_dimension("rotor_speed");
        std::vector<double> margin;
        for (const CampbellPoint& point : d_.points) margin.push_back(point.stability_margin);
        file_.write("stability_margin", margin, {points_},
                    {"s-1", "how far the fastest growing motion is from growing; negative: unstable"});
        file_.attach("stability_margin", 0, "rotor_speed");
        if (!d_.parameters.empty()) {
            file_.write("parameter", d_.parameters, {points_}, {"1", d_.parameter});
            file_.attach("parameter", 0, "rotor_speed");
        }
        file_.make_index("branch", branches_,
                         "index of the branch (a mode followed over rotor speed); names in branches/name");
        file_.make_index("component", d_.components.size(), "index of the component mode; names in components/name");
        file_.make_index("row", d_.rows.size(), "index of the row of the linear system; names in rows/name");
        file_.make_index("coordinate", static_cast<std::size_t>(d_.coordinates.size()), "index of the coordinate");
    }

    // value(point, branch), rotor speed by branch
    template <class T, class F>
    void over_speed(const std::string& name, const Description& about, F value) {
        std::vector<T> values;
        for (std::size_t i = 0; i < points_; ++i)
            for (const Branch& branch : d_.branches) values.push_back(value(i, branch));
        file_.write(name, values, {points_, branches_}, about);
        file_.attach(name, 0, "rotor_speed");
        file_.attach(name, 1, "branch");
    }

    void names(const std::string& name, const std::vector<std::string>& values, const std::string& long_name,
               const std::string& axis) {
        file_.write(name, values, {values.size()}, long_name);
        if (!axis.empty()) file_.attach(name, 0, axis);
    }

    void branches() {
        const auto& b = d_.branches;
        names("branches/name", column(b, [](const Branch& x) { return x.name; }), "name of the mode", "branch");
        names("branches/family", column(b, [](const Branch& x) { return x.family; }), "family of the mode", "branch");
        names("branches/pattern", column(b, [](const Branch& x) { return std::string(pattern_name(x.pattern)); }),
              "rotor pattern", "branch");
        over_speed<double>("branches/natural_frequency", {"Hz", "natural frequency |lambda| / 2 pi"},
                           [&](std::size_t i, const Branch& x) { return d_.natural_hz(x, i); });
        over_speed<double>("branches/damped_frequency", {"Hz", "damped frequency Im lambda / 2 pi"},
                           [&](std::size_t i, const Branch& x) { return d_.damped_hz(x, i); });
        over_speed<double>("branches/damping_ratio", {"1", "damping ratio -Re lambda / |lambda|, of critical"},
                           [&](std::size_t i, const Branch& x) { return d_.damping_ratio(x, i); });
        over_speed<Complex>("branches/eigenvalue", {"s-1", "eigenvalue lambda"}, [&](std::size_t i, const Branch& x) {
            const CampbellMode* mode = mode_of(i, x);
            return mode ? mode->mode.eigenvalue : Complex(nan, nan);
        });
        over_speed<double>("branches/mac", {"1", "complex energy MAC with the rotor speed before"},
                           [](std::size_t i, const Branch& x) { return x.mac[i]; });
        over_speed<int>("branches/doubtful", {"1", "1 where name or tracking is doubtful"},
                        [](std::size_t i, const Branch& x) { return x.doubtful[i] ? 1 : 0; });
        texts("branches/mostly", "name that holds most of the elastic energy",
              [](std::size_t i, const Branch& x) { return x.mostly[i]; });
        texts("branches/kind", "kind of the motion, empty without a mode", [&](std::size_t i, const Branch& x) {
            const CampbellMode* mode = mode_of(i, x);
            return mode ? mode->kind_name() : std::string();
        });
        shares();
    }

    // value(point, branch), rotor speed by branch
    template <class F>
    void texts(const std::string& name, const std::string& long_name, F value) {
        std::vector<std::string> values;
        for (std::size_t i = 0; i < points_; ++i)
            for (const Branch& branch : d_.branches) values.push_back(value(i, branch));
        file_.write(name, values, {points_, branches_}, long_name);
        file_.attach(name, 0, "rotor_speed");
        file_.attach(name, 1, "branch");
    }

    const CampbellMode* mode_of(std::size_t point, const Branch& branch) const { return d_.mode(branch, point); }

    // value(mode, k) for k < count, NaN without a mode: rotor speed by branch by axis
    template <class F>
    void over_axis(const std::string& name, const std::string& axis, std::size_t count, const char* long_name,
                   F value) {
        std::vector<double> values;
        for (std::size_t i = 0; i < points_; ++i)
            for (const Branch& branch : d_.branches) {
                const CampbellMode* mode = mode_of(i, branch);
                for (std::size_t k = 0; k < count; ++k) values.push_back(mode ? value(*mode, k) : nan);
            }
        file_.write(name, values, {points_, branches_, count}, {"1", long_name});
        file_.attach(name, 0, "rotor_speed");
        file_.attach(name, 1, "branch");
        file_.attach(name, 2, axis);
    }

    void shares() {
        over_axis("branches/energy_share", "component", d_.components.size(),
                  "share of the elastic energy by component mode",
                  [](const CampbellMode& mode, std::size_t c) { return mode.shares[c].total(); });
        over_axis("branches/whirl", "component", d_.components.size(),
                  "(forward - backward) / (forward + backward) of the whirling part of the share",
                  [](const CampbellMode& mode, std::size_t c) { return mode.shares[c].whirl; });
        names("rows/name", d_.rows, "coordinate, blade coordinates with their rotor pattern", "row");
        over_axis(
            "branches/row_share", "row", d_.rows.size(), "share of the elastic energy by row (coordinate)",
            [](const CampbellMode& mode, std::size_t r) { return mode.row_shares(static_cast<Eigen::Index>(r)); });
    }

    void components() {
        const auto& c = d_.components;
        names("components/part", column(c, [](const Component& x) { return x.part; }), "part of the machine",
              "component");
        names("components/name", column(c, [](const Component& x) { return x.family; }), "family", "component");
        file_.write("components/ordinal", column(c, [](const Component& x) { return x.ordinal; }), {c.size()},
                    {"1", "number within the family, from 1"});
        file_.write("components/clamped_frequency", column(c, [](const Component& x) { return x.clamped_hz; }),
                    {c.size()}, {"Hz", "frequency with all other parts clamped"});
        for (const char* name : {"components/ordinal", "components/clamped_frequency"})
            file_.attach(name, 0, "component");
    }

    void crossings() {
        const auto& x = d_.crossings;
        if (x.empty()) return;
        file_.make_index("crossing", x.size(), "index of the crossing");
        file_.write("crossings/branch", column(x, [](const Crossing& c) { return c.branch; }), {x.size()},
                    {"1", "index of the branch"});
        file_.write("crossings/multiple", column(x, [](const Crossing& c) { return c.multiple; }), {x.size()},
                    {"1", "n of the line nP"});
        file_.write("crossings/rotor_speed", column(x, [](const Crossing& c) { return c.rotor_speed; }), {x.size()},
                    {"rad s-1", "rotor speed at the crossing"});
        file_.write("crossings/frequency", column(x, [](const Crossing& c) { return c.frequency_hz; }), {x.size()},
                    {"Hz", "frequency at the crossing"});
        for (const char* name : {"branch", "multiple", "rotor_speed", "frequency"})
            file_.attach(std::string("crossings/") + name, 0, "crossing");
    }

    void coordinates() {
        const auto& c = d_.coordinates;
        const std::size_t n = static_cast<std::size_t>(c.size());
        using Info = CoordinateInfo;
        names("coordinates/name", column(c, [](const Info& x) { return x.name; }), "name", "coordinate");
        names("coordinates/unit", column(c, [](const Info& x) { return x.unit; }), "unit", "coordinate");
        names("coordinates/part", column(c, [](const Info& x) { return x.part; }), "part", "coordinate");
        file_.write("coordinates/blade", column(c, [](const Info& x) { return x.blade; }), {n},
                    {"1", "blade number from 1, 0: no blade"});
        file_.attach("coordinates/blade", 0, "coordinate");
        std::vector<double> q;
        for (const CampbellPoint& point : d_.points) q.insert(q.end(), point.at.q.begin(), point.at.q.end());
        file_.write("steady_state/q", q, {points_, n}, {"rad or m", "coordinates in the steady state, azimuth 0"});
        file_.attach("steady_state/q", 0, "rotor_speed");
        file_.attach("steady_state/q", 1, "coordinate");
    }

    void shapes() {
        const std::size_t frames = d_.frames.size();
        file_.make_index("frame", frames, "index of the frame; names in frames/name");
        names("frames/name", d_.frames, "name of the frame", "frame");
        std::vector<double> position;
        for (const Vec3& p : d_.frame_positions) position.insert(position.end(), p.begin(), p.end());
        file_.write("frames/position", position, {frames, 3},
                    {"m", "position undeformed at azimuth 0, ground axes (x downwind, z up)"});
        file_.make_index("axis", 3, "ground axes: x downwind, y, z up");
        file_.attach("frames/position", 0, "frame");
        file_.attach("frames/position", 1, "axis");
        file_.make_index("motion", 6, "rotation about x, y, z and displacement along x, y, z, ground axes");
        std::vector<Complex> motion;
        for (std::size_t i = 0; i < points_; ++i)
            for (const Branch& branch : d_.branches) {
                const int mode = branch.mode[i];
                for (std::size_t f = 0; f < frames; ++f)
                    for (Eigen::Index k = 0; k < 6; ++k)
                        motion.push_back(mode < 0 ? Complex(nan, nan) : entry(d_.motions[i], mode)[f].motion(k));
            }
        file_.write("branches/frame_motion", motion, {points_, branches_, frames, 6},
                    {"rad or m",
                     "mode shape: complex rotation (x, y, z) and displacement (x, y, z) of every frame, ground axes, "
                     "azimuth 0, at 1 J of modal energy"});
        file_.attach("branches/frame_motion", 0, "rotor_speed");
        file_.attach("branches/frame_motion", 1, "branch");
        file_.attach("branches/frame_motion", 2, "frame");
        file_.attach("branches/frame_motion", 3, "motion");
        lines();
    }

    // Harmonics of the modes and of the steady state, and how exact the exponents are.
    void floquet() {
        constexpr int shown = 8;
        std::vector<int> harmonic(2 * shown + 1);
        std::iota(harmonic.begin(), harmonic.end(), -shown);
        file_.write("harmonic", harmonic, {harmonic.size()},
                    {"1", "multiple of the rotor speed beside the principal frequency of a mode"});
        file_.make_dimension("harmonic");
        over_axis("branches/participation", "harmonic", harmonic.size(), "share of the harmonic in the energy",
                  [](const CampbellMode& mode, std::size_t k) {
                      const int j = static_cast<int>(k) - shown;
                      return mode.floquet ? mode.floquet->share(j) : (j == 0 ? 1.0 : 0.0);
                  });
        over_speed<double>("branches/eigenvalue_error", {"s-1", "estimated error of the eigenvalue"},
                           [&](std::size_t i, const Branch& x) { return floquet_of(i, x, &FloquetMode::error); });
        over_speed<double>("branches/condition", {"1", "condition number of the eigenvalue"},
                           [&](std::size_t i, const Branch& x) { return floquet_of(i, x, &FloquetMode::condition); });
        const auto n = static_cast<std::size_t>(d_.coordinates.size()),
                   width = 2 * static_cast<std::size_t>(harmonics_) + 1;
        std::vector<double> series;
        for (const CampbellPoint& point : d_.points)
            for (std::size_t l = 0; l < width; ++l)
                for (std::size_t i = 0; i < n; ++i) series.push_back(coefficient(point, l, i));
        file_.write("steady_state/series", series, {points_, width, n},
                    {"rad or m",
                     "periodic steady state: mean, then cosine and sine coefficients of the multiples 1, 2, ... of the "
                     "azimuth"});
        file_.make_index("term", width, "of a Fourier series in the azimuth: mean, cosine 1, sine 1, cosine 2 ...");
        file_.attach("steady_state/series", 0, "rotor_speed");
        file_.attach("steady_state/series", 1, "term");
        file_.attach("steady_state/series", 2, "coordinate");
    }

    double floquet_of(std::size_t point, const Branch& branch, double FloquetMode::*value) const {
        const CampbellMode* mode = mode_of(point, branch);
        return mode && mode->floquet ? (*mode->floquet).*value : nan;
    }

    // At standstill the state is constant.
    static double coefficient(const CampbellPoint& point, std::size_t column, std::size_t coordinate) {
        const auto i = static_cast<Eigen::Index>(coordinate), l = static_cast<Eigen::Index>(column);
        if (!point.periodic) return column == 0 ? point.at.q(i) : 0.0;
        return l < point.periodic->coefficients.cols() ? point.periodic->coefficients(i, l) : 0.0;
    }

    void lines() {
        std::vector<int> line, frame;
        for (std::size_t l = 0; l < d_.lines.size(); ++l)
            for (FrameId point : d_.lines[l].points) {
                line.push_back(static_cast<int>(l));
                frame.push_back(point.index);
            }
        file_.make_index("line", d_.lines.size(), "index of the line; what it shows in lines/part");
        file_.make_index("line_point", line.size(), "index of the point, line by line");
        names("lines/part", column(d_.lines, [](const Polyline& x) { return x.part; }), "part that the line shows",
              "line");
        file_.write("lines/blade", column(d_.lines, [](const Polyline& x) { return x.blade; }), {d_.lines.size()},
                    {"1", "blade number from 1, 0: no blade"});
        file_.write("lines/point_line", line, {line.size()}, {"1", "line that the point belongs to, in order"});
        file_.write("lines/point_frame", frame, {frame.size()}, {"1", "index of the frame at the point"});
        file_.attach("lines/blade", 0, "line");
        for (const char* name : {"lines/point_line", "lines/point_frame"}) file_.attach(name, 0, "line_point");
    }

    const Campbell& d_;
    Hdf5File file_;
    std::size_t points_, branches_;
    int harmonics_ = 0;  // of the periodic steady states; 0: they are constant
};

}  // namespace

void write_hdf5(const Campbell& diagram, const std::filesystem::path& path) {
    Writer(diagram, path).write();
}

}  // namespace cardan::solvers
