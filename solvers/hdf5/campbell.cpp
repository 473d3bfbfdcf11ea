#include "solvers/hdf5/campbell.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/version.hpp"
#include "solvers/hdf5/axis.hpp"
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

/// "N m/rad" of "stiffness of the hinges, N m/rad".
std::string unit_of(const std::string& parameter) {
    const std::size_t comma = parameter.rfind(", ");
    return comma == std::string::npos ? "1" : parameter.substr(comma + 2);
}

/// rotor_speed, or the parameter with the rotor speeds beside it.
Hdf5Axis axis_of_points(const Campbell& d) {
    Hdf5Axis speed{"rotor_speed", d.rotor_speeds(), {"rad s-1", "rotor speed"}};
    if (d.parameters.empty()) return speed;
    return {"parameter",
            d.parameters,
            {unit_of(d.parameter), d.parameter},
            {{speed.name, std::get<std::vector<double>>(speed.values), speed.about}}};
}

Hdf5Axis axis_of_branches(const Campbell& d) {
    const auto& b = d.branches;
    return counting_axis(
        "branch", b.size(), "index of the branch, a mode followed over rotor speed",
        {text_label("name", column(b, [](const Branch& x) { return x.name; }), "name of the mode"),
         text_label("family", column(b, [](const Branch& x) { return x.family; }), "family of the mode"),
         text_label("pattern", column(b, [](const Branch& x) { return std::string(pattern_name(x.pattern)); }),
                    "rotor pattern")});
}

Hdf5Axis axis_of_components(const Campbell& d) {
    const auto& c = d.components;
    return counting_axis(
        "component", c.size(), "index of the component mode",
        {text_label("component_part", column(c, [](const Component& x) { return x.part; }), "part of the machine"),
         text_label("component_name", column(c, [](const Component& x) { return text(x.family, ' ', x.ordinal); }),
                    "family of the component mode and number within it")});
}

Hdf5Axis axis_of_coordinates(const Campbell& d) {
    const auto& c = d.coordinates;
    using Info = CoordinateInfo;
    return counting_axis(
        "coordinate", static_cast<std::size_t>(c.size()), "index of the coordinate",
        {text_label("name", column(c, [](const Info& x) { return x.name; }), "name of the coordinate"),
         text_label("unit", column(c, [](const Info& x) { return x.unit; }), "unit of the coordinate, rad or m"),
         text_label("part", column(c, [](const Info& x) { return x.part; }), "part that the coordinate belongs to")});
}

Hdf5Axis axis_of_harmonics(int first, int last, std::string long_name) {
    std::vector<std::int64_t> harmonics(static_cast<std::size_t>(last - first + 1));
    std::iota(harmonics.begin(), harmonics.end(), first);
    return {"harmonic", std::move(harmonics), {"1", std::move(long_name)}};
}

class Writer {
public:
    Writer(const Campbell& diagram, const std::filesystem::path& path)
        : d_(diagram),
          file_(Hdf5File::create(path)),
          point_(axis_of_points(diagram)),
          branch_(axis_of_branches(diagram)),
          component_(axis_of_components(diagram)),
          row_(counting_axis("row", diagram.rows.size(), "index of the row of the linear system",
                             {text_label("row_name", diagram.rows,
                                         "coordinate of the row, blade coordinates with their rotor pattern")})),
          coordinate_(axis_of_coordinates(diagram)) {
        for (const CampbellPoint& point : d_.points)
            if (point.periodic) harmonics_ = std::max(harmonics_, point.periodic->harmonics());
    }

    void write() {
        header();
        points();
        branches();
        components();
        crossings();
        state_motions();
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

    // The axis of the points stands in the root in any case; the others where there are arrays over them.
    void points() {
        write_array(file_, "stability_margin",
                    column(d_.points, [](const CampbellPoint& x) { return x.stability_margin; }), {point_},
                    {"s-1", "how far the fastest growing motion is from growing; negative: unstable"});
    }

    // value(point, branch), rotor speed by branch
    template <class F>
    void over_speed(const std::string& name, const Description& about, F value) {
        write_array(file_, "branches/" + name, at_points(value), {point_, branch_}, about);
    }

    template <class F>
    auto at_points(F value) const {
        std::vector<decltype(value(std::size_t{}, d_.branches.front()))> values;
        for (std::size_t i = 0; i < d_.points.size(); ++i)
            for (const Branch& branch : d_.branches) values.push_back(value(i, branch));
        return values;
    }

    void branches() {
        over_speed("natural_frequency", {"Hz", "natural frequency |lambda| / 2 pi"},
                   [&](std::size_t i, const Branch& x) { return d_.natural_hz(x, i); });
        over_speed("damped_frequency", {"Hz", "damped frequency Im lambda / 2 pi"},
                   [&](std::size_t i, const Branch& x) { return d_.damped_hz(x, i); });
        over_speed("damping_ratio", {"1", "damping ratio -Re lambda / |lambda|, of critical"},
                   [&](std::size_t i, const Branch& x) { return d_.damping_ratio(x, i); });
        over_speed("eigenvalue", {"s-1", "eigenvalue lambda"}, [&](std::size_t i, const Branch& x) {
            const CampbellMode* mode = mode_of(i, x);
            return mode ? mode->mode.eigenvalue : Complex(nan, nan);
        });
        over_speed("mac", {"1", "complex energy MAC with the rotor speed before"},
                   [](std::size_t i, const Branch& x) { return x.mac[i]; });
        over_speed("doubtful", {"1", "1 where name or tracking is doubtful"},
                   [](std::size_t i, const Branch& x) { return x.doubtful[i] ? 1 : 0; });
        texts("doubt", "why name or tracking is doubtful; empty where it is not",
              [](std::size_t i, const Branch& x) { return x.doubt[i]; });
        texts("mostly", "name that holds most of the elastic energy",
              [](std::size_t i, const Branch& x) { return x.mostly[i]; });
        texts("kind", "kind of the motion, empty without a mode", [&](std::size_t i, const Branch& x) {
            const CampbellMode* mode = mode_of(i, x);
            return mode ? mode->kind_name() : std::string();
        });
        write_array(file_, "branches/name_component", column(d_.branches, [](const Branch& x) { return x.component; }),
                    {branch_}, {"1", "index of the component that names the branch, -1: none"});
        write_array(file_, "branches/name_harmonic", column(d_.branches, [](const Branch& x) { return x.harmonic; }),
                    {branch_}, {"1", "harmonic of the azimuth of the pattern; of a single blade its place, from 1"});
        shares();
    }

    // value(point, branch), rotor speed by branch
    template <class F>
    void texts(const std::string& name, const std::string& long_name, F value) {
        write_array(file_, "branches/" + name, at_points(value), {point_, branch_}, long_name);
    }

    const CampbellMode* mode_of(std::size_t point, const Branch& branch) const { return d_.mode(branch, point); }

    // value(mode, k) for k < size of the axis, NaN without a mode: rotor speed by branch by axis
    template <class F>
    void over_axis(const std::string& name, const Hdf5Axis& axis, const char* long_name, F value) {
        std::vector<double> values;
        for (std::size_t i = 0; i < d_.points.size(); ++i)
            for (const Branch& branch : d_.branches) {
                const CampbellMode* mode = mode_of(i, branch);
                for (std::size_t k = 0; k < axis.size(); ++k) values.push_back(mode ? value(*mode, k) : nan);
            }
        write_array(file_, "branches/" + name, values, {point_, branch_, axis}, {"1", long_name});
    }

    void shares() {
        over_axis("energy_share", component_, "share of the elastic energy by component mode",
                  [](const CampbellMode& mode, std::size_t c) { return mode.shares[c].total(); });
        over_axis("whirl", component_, "(forward - backward) / (forward + backward) of the whirling part of the share",
                  [](const CampbellMode& mode, std::size_t c) { return mode.shares[c].whirl; });
        over_axis(
            "row_share", row_, "share of the elastic energy by row (coordinate)",
            [](const CampbellMode& mode, std::size_t r) { return mode.row_shares(static_cast<Eigen::Index>(r)); });
    }

    void components() {
        const auto& c = d_.components;
        const Hdf5Axis component = component_.with(
            {text_label("part", column(c, [](const Component& x) { return x.part; }), "part of the machine"),
             text_label("name", column(c, [](const Component& x) { return x.family; }), "family")});
        write_array(file_, "components/ordinal", column(c, [](const Component& x) { return x.ordinal; }), {component},
                    {"1", "number within the family, from 1"});
        write_array(file_, "components/clamped_frequency", column(c, [](const Component& x) { return x.clamped_hz; }),
                    {component}, {"Hz", "frequency with all other parts clamped"});
    }

    void crossings() {
        const auto& x = d_.crossings;
        if (x.empty()) return;
        const auto name = [&](const Crossing& c) { return entry(d_.branches, c.branch).name; };
        const Hdf5Axis crossing = counting_axis("crossing", x.size(), "index of the crossing",
                                                {text_label("name", column(x, name), "name of the mode")});
        const auto put = [&](const char* what, const auto& values, const Description& about) {
            write_array(file_, std::string("crossings/") + what, values, {crossing}, about);
        };
        put("branch", column(x, [](const Crossing& c) { return c.branch; }), {"1", "index of the branch"});
        put("multiple", column(x, [](const Crossing& c) { return c.multiple; }), {"1", "n of the line nP"});
        // Not rotor_speed, an axis of the root: xarray would show its values in the place of these.
        put("speed", column(x, [](const Crossing& c) { return c.rotor_speed; }),
            {"rad s-1", "rotor speed at the crossing"});
        put("frequency", column(x, [](const Crossing& c) { return c.frequency_hz; }),
            {"Hz", "frequency at the crossing"});
    }

    // A list over all points: their number changes from one to the next.
    void state_motions() {
        struct Row {
            std::size_t point;
            const StateMotion* motion;
        };
        std::vector<Row> rows;
        for (std::size_t i = 0; i < d_.points.size(); ++i)
            for (const StateMotion& motion : d_.points[i].state_motions) rows.push_back({i, &motion});
        if (rows.empty()) return;
        std::ranges::stable_sort(rows, {}, [](const Row& row) { return std::pair(row.point, row.motion->state); });
        const auto name = [&](const Row& row) { return entry(d_.states, row.motion->state); };
        const Hdf5Axis axis = counting_axis("state_motion", rows.size(), "index of the motion",
                                            {text_label("name", column(rows, name), "state that moves most")});
        const auto put = [&](const char* what, const auto& values, const Description& about) {
            write_array(file_, std::string("state_motions/") + what, values, {axis}, about);
        };
        put("point", column(rows, [](const Row& row) { return static_cast<int>(row.point); }),
            {"1", "index of the point, from 0"});
        put("eigenvalue", column(rows, [](const Row& row) { return row.motion->mode.eigenvalue; }),
            {"s-1", "eigenvalue lambda of a motion of states of first order"});
        put("share", column(rows, [](const Row& row) { return row.motion->mode.state_share; }),
            {"1", "share of the states in the motion"});
    }

    void coordinates() {
        write_array(file_, "coordinates/blade", column(d_.coordinates, [](const CoordinateInfo& x) { return x.blade; }),
                    {coordinate_}, {"1", "blade number from 1, 0: no blade"});
        std::vector<double> q;
        for (const CampbellPoint& point : d_.points) q.insert(q.end(), point.at.q.begin(), point.at.q.end());
        write_array(file_, "steady_state/q", q, {point_, coordinate_},
                    {"rad or m", "coordinates in the steady state, azimuth 0; the unit of each is in unit"});
    }

    void shapes() {
        const Hdf5Axis frame = counting_axis("frame", d_.frames.size(), "index of the frame",
                                             {text_label("frame_name", d_.frames, "name of the frame")});
        const Hdf5Axis axis =
            counting_axis("axis", 3, "axis of the ground: x downwind, y, z up",
                          {text_label("axis_name", {"x", "y", "z"}, "name of the axis of the ground")});
        std::vector<double> position;
        for (const Vec3& p : d_.frame_positions) position.insert(position.end(), p.begin(), p.end());
        const Hdf5Axis named = frame.with({text_label("name", d_.frames, "name of the frame")});
        write_array(file_, "frames/position", position, {named, axis},
                    {"m", "position undeformed at azimuth 0, ground axes (x downwind, z up)"});
        const auto part = [&](Eigen::Index first) {
            std::vector<Complex> motion;
            for (std::size_t i = 0; i < d_.points.size(); ++i)
                for (const Branch& branch : d_.branches)
                    for (std::size_t f = 0; f < d_.frames.size(); ++f)
                        for (Eigen::Index k = first; k < first + 3; ++k)
                            motion.push_back(branch.mode[i] < 0 ? Complex(nan, nan)
                                                                : entry(d_.motions[i], branch.mode[i])[f].motion(k));
            return motion;
        };
        const Hdf5Axes axes{point_, branch_, frame, axis};
        const std::string how = " of every frame in the mode, ground axes, azimuth 0, at 1 J of modal energy";
        write_array(file_, "branches/frame_rotation", part(0), axes, {"rad", "complex rotation" + how});
        write_array(file_, "branches/frame_displacement", part(3), axes, {"m", "complex displacement" + how});
        lines();
    }

    // Harmonics of the modes and of the steady state, and how exact the exponents are.
    void floquet() {
        constexpr int shown = 8;
        over_axis(
            "participation",
            axis_of_harmonics(-shown, shown, "multiple of the rotor speed beside the principal frequency of a mode"),
            "share of the harmonic in the energy", [](const CampbellMode& mode, std::size_t k) {
                const int j = static_cast<int>(k) - shown;
                return mode.floquet ? mode.floquet->share(j) : (j == 0 ? 1.0 : 0.0);
            });
        over_speed("eigenvalue_error", {"s-1", "estimated error of the eigenvalue"},
                   [&](std::size_t i, const Branch& x) { return floquet_of(i, x, &FloquetMode::error); });
        over_speed("condition", {"1", "condition number of the eigenvalue"},
                   [&](std::size_t i, const Branch& x) { return floquet_of(i, x, &FloquetMode::condition); });
        series();
    }

    // The periodic steady state: mean, cosines, sines.
    void series() {
        const auto part = [&](int first, int count) {
            std::vector<double> values;
            for (const CampbellPoint& point : d_.points)
                for (int k = 0; k < count; ++k)
                    for (Eigen::Index i = 0; i < d_.coordinates.size(); ++i)
                        values.push_back(coefficient(point, first + 2 * k, i));
            return values;
        };
        const Hdf5Axis harmonic = axis_of_harmonics(1, harmonics_, "multiple of the azimuth");
        const std::string of = " of the coordinates in the periodic steady state; the unit of each is in unit";
        write_array(file_, "steady_state/mean", part(0, 1), {point_, coordinate_}, {"rad or m", "mean" + of});
        write_array(file_, "steady_state/cosine", part(1, harmonics_), {point_, harmonic, coordinate_},
                    {"rad or m", "cosine coefficients" + of});
        write_array(file_, "steady_state/sine", part(2, harmonics_), {point_, harmonic, coordinate_},
                    {"rad or m", "sine coefficients" + of});
    }

    double floquet_of(std::size_t point, const Branch& branch, double FloquetMode::*value) const {
        const CampbellMode* mode = mode_of(point, branch);
        return mode && mode->floquet ? (*mode->floquet).*value : nan;
    }

    // At standstill the state is constant.
    static double coefficient(const CampbellPoint& point, Eigen::Index column, Eigen::Index coordinate) {
        if (!point.periodic) return column == 0 ? point.at.q(coordinate) : 0.0;
        return column < point.periodic->coefficients.cols() ? point.periodic->coefficients(coordinate, column) : 0.0;
    }

    void lines() {
        std::vector<int> line_of_point, frame_of_point;
        for (std::size_t l = 0; l < d_.lines.size(); ++l)
            for (FrameId point : d_.lines[l].points) {
                line_of_point.push_back(static_cast<int>(l));
                frame_of_point.push_back(point.index);
            }
        const Hdf5Axis line =
            counting_axis("line", d_.lines.size(), "index of the line",
                          {text_label("part", column(d_.lines, [](const Polyline& x) { return x.part; }),
                                      "part that the line shows")});
        const Hdf5Axis point = counting_axis("line_point", line_of_point.size(), "index of the point, line by line");
        write_array(file_, "lines/blade", column(d_.lines, [](const Polyline& x) { return x.blade; }), {line},
                    {"1", "blade number from 1, 0: no blade"});
        write_array(file_, "lines/point_line", line_of_point, {point},
                    {"1", "index of the line that the point belongs to"});
        write_array(file_, "lines/point_frame", frame_of_point, {point}, {"1", "index of the frame at the point"});
    }

    const Campbell& d_;
    Hdf5File file_;
    Hdf5Axis point_, branch_, component_, row_, coordinate_;
    int harmonics_ = 0;  // of the periodic steady states; 0: they are constant
};

}  // namespace

void write_hdf5(const Campbell& diagram, const std::filesystem::path& path) {
    Writer(diagram, path).write();
}

}  // namespace cardan::solvers
