#include "mbs/base/error.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan::solvers {

namespace {

RotorPattern pattern_of(const std::string& name) {
    constexpr std::array patterns{RotorPattern::none,         RotorPattern::collective, RotorPattern::backward,
                                  RotorPattern::forward,      RotorPattern::cosine,     RotorPattern::sine,
                                  RotorPattern::differential, RotorPattern::symmetric,  RotorPattern::antisymmetric,
                                  RotorPattern::single};
    const auto* const found = std::ranges::find(patterns, name, pattern_name);
    return found == patterns.end() ? RotorPattern::none : *found;
}

class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : file_(Hdf5File::open(path)) {
        if (!file_.has("branches/eigenvalue_real")) throw FileError(path.string(), "is no Campbell diagram");
    }

    Campbell read(CampbellShapes shapes) {
        header();
        axis();
        branches();
        if (shapes == CampbellShapes::read) read_shapes();
        crossings();
        state_motions();
        return std::move(d_);
    }

private:
    std::string attribute(const char* name) const {
        return file_.has_attribute("/", name) ? file_.string_attribute("/", name) : std::string();
    }

    void header() {
        d_.machine = attribute("machine");
        d_.method = attribute("method");
        d_.method_reason = attribute("method_reason");
        d_.warning = attribute("warning");
        d_.remark = attribute("remark");
        d_.accuracy = attribute("accuracy");
        d_.spin = attribute("rotor_spin") == "free" ? RotorSpin::free : RotorSpin::prescribed;
        d_.complete = file_.int_attribute("/", "complete") != 0;
        d_.blades = static_cast<int>(file_.int_attribute("/", "number_of_blades"));
        d_.source = file_.read_strings("input_description").front();
    }

    void axis() {
        const std::vector<double> speeds = file_.read_doubles("rotor_speed"),
                                  margins = file_.read_doubles("stability_margin");
        d_.points.resize(speeds.size());
        require_size("stability_margin", margins.size(), speeds.size());
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            d_.points[i].rotor_speed = speeds[i];
            d_.points[i].stability_margin = margins[i];
        }
        if (!file_.has("parameter")) return;
        d_.parameters = file_.read_doubles("parameter");
        d_.parameter = file_.string_attribute("parameter", "long_name");
    }

    void require_size(const std::string& name, std::size_t size, std::size_t wanted) const {
        if (size != wanted) throw FileError(file_.path(), text(name, " has ", size, " entries instead of ", wanted));
    }

    std::vector<double> by_branch(const std::string& name) const {
        std::vector<double> values = file_.read_doubles("branches/" + name);
        require_size("branches/" + name, values.size(), d_.points.size() * d_.branches.size());
        return values;
    }

    // Every branch has a mode of its own at every point where it has an eigenvalue.
    void branches() {
        const std::vector<std::string> names = file_.read_strings("branches/name"),
                                       families = file_.read_strings("branches/family"),
                                       patterns = file_.read_strings("branches/pattern"),
                                       kinds = file_.read_strings("branches/kind"),
                                       mostly = file_.read_strings("branches/mostly"),
                                       doubt = file_.has("branches/doubt") ? file_.read_strings("branches/doubt")
                                                                           : std::vector<std::string>();
        d_.branches.resize(names.size());
        require_size("branches/family", families.size(), names.size());
        require_size("branches/pattern", patterns.size(), names.size());
        const std::vector<double> real = by_branch("eigenvalue_real"), imag = by_branch("eigenvalue_imag"),
                                  mac = by_branch("mac"), doubtful = by_branch("doubtful");
        require_size("branches/kind", kinds.size(), real.size());
        require_size("branches/mostly", mostly.size(), real.size());
        // Files of earlier versions do not say why.
        if (file_.has("branches/doubt")) require_size("branches/doubt", doubt.size(), real.size());
        for (std::size_t b = 0; b < names.size(); ++b) {
            Branch& branch = d_.branches[b];
            branch.name = names[b];
            branch.family = families[b];
            branch.pattern = pattern_of(patterns[b]);
            for (std::size_t i = 0; i < d_.points.size(); ++i) {
                const std::size_t at = i * names.size() + b;
                branch.mac.push_back(mac[at]);
                branch.doubtful.push_back(doubtful[at] != 0);
                branch.mostly.push_back(mostly[at]);
                branch.doubt.push_back(doubt.empty() ? "" : doubt[at]);
                branch.mode.push_back(std::isfinite(real[at]) ? add_mode(i, {real[at], imag[at]}, kinds[at]) : -1);
            }
        }
    }

    int add_mode(std::size_t point, const Complex& eigenvalue, const std::string& kind) {
        CampbellMode mode;
        mode.mode.eigenvalue = eigenvalue;
        if (kind == "rigid") mode.floquet.emplace().kind = FloquetKind::rigid;
        d_.points[point].modes.push_back(std::move(mode));
        return static_cast<int>(d_.points[point].modes.size()) - 1;
    }

    // Which components the names are of, and how the lines of the machine move.
    void read_shapes() {
        for (const char* needed : {"branches/name_component", "branches/frame_displacement_real"})
            if (!file_.has(needed)) throw FileError(file_.path(), text("has no ", needed, ", to take names from"));
        components();
        lines();
        const std::vector<std::int64_t> component = file_.read_ints("branches/name_component"),
                                        harmonic = file_.read_ints("branches/name_harmonic");
        const std::size_t branches = d_.branches.size(), frames = d_.frames.size();
        require_size("branches/name_component", component.size(), branches);
        require_size("branches/name_harmonic", harmonic.size(), branches);
        for (std::size_t b = 0; b < branches; ++b) {
            if (component[b] >= std::ssize(d_.components))
                throw FileError(file_.path(), text("branches/name_component has the value ", component[b]));
            d_.branches[b].component = static_cast<int>(component[b]);
            d_.branches[b].harmonic = static_cast<int>(harmonic[b]);
        }
        const std::vector<Complex> rotation = file_.read_complex("branches/frame_rotation"),
                                   displacement = file_.read_complex("branches/frame_displacement");
        for (const auto* values : {&rotation, &displacement})
            require_size("branches/frame_rotation and displacement", values->size(),
                         d_.points.size() * branches * frames * 3);
        for (std::size_t i = 0; i < d_.points.size(); ++i) {
            auto& motions = d_.motions.emplace_back(d_.points[i].modes.size());
            for (std::size_t b = 0; b < branches; ++b) {
                if (d_.branches[b].mode[i] < 0) continue;
                std::vector<FrameMotion>& own = motions[static_cast<std::size_t>(d_.branches[b].mode[i])];
                own.resize(frames);
                for (std::size_t f = 0; f < frames; ++f)
                    for (std::size_t k = 0; k < 3; ++k) {
                        const std::size_t at = ((i * branches + b) * frames + f) * 3 + k;
                        const auto row = static_cast<Eigen::Index>(k);
                        own[f].motion(row) = rotation[at];
                        own[f].motion(row + 3) = displacement[at];
                    }
            }
        }
    }

    void components() {
        const std::vector<std::string> part = file_.read_strings("components/part"),
                                       family = file_.read_strings("components/name");
        const std::vector<std::int64_t> ordinal = file_.read_ints("components/ordinal");
        require_size("components/name", family.size(), part.size());
        require_size("components/ordinal", ordinal.size(), part.size());
        for (std::size_t i = 0; i < part.size(); ++i)
            d_.components.push_back({part[i], family[i], static_cast<int>(ordinal[i])});
    }

    void lines() {
        d_.frames = file_.read_strings("frames/name");
        const std::vector<double> position = file_.read_doubles("frames/position");
        require_size("frames/position", position.size(), 3 * d_.frames.size());
        for (std::size_t f = 0; f < d_.frames.size(); ++f)
            d_.frame_positions.emplace_back(position[3 * f], position[3 * f + 1], position[3 * f + 2]);
        const std::vector<std::string> part = file_.read_strings("lines/part");
        const std::vector<std::int64_t> blade = file_.read_ints("lines/blade"),
                                        line = file_.read_ints("lines/point_line"),
                                        frame = file_.read_ints("lines/point_frame");
        require_size("lines/blade", blade.size(), part.size());
        require_size("lines/point_frame", frame.size(), line.size());
        for (std::size_t l = 0; l < part.size(); ++l) d_.lines.push_back({part[l], static_cast<int>(blade[l]), {}});
        for (std::size_t k = 0; k < line.size(); ++k) {
            if (line[k] < 0 || line[k] >= std::ssize(part) || frame[k] < 0 || frame[k] >= std::ssize(d_.frames))
                throw FileError(file_.path(), text("point ", k, " of the lines is on no line, or no frame"));
            d_.lines[static_cast<std::size_t>(line[k])].points.push_back(FrameId{static_cast<int>(frame[k])});
        }
    }

    void crossings() {
        if (!file_.has("crossings/branch")) return;
        const std::vector<std::int64_t> branch = file_.read_ints("crossings/branch"),
                                        multiple = file_.read_ints("crossings/multiple");
        const std::vector<double> speed = file_.read_doubles("crossings/speed"),
                                  frequency = file_.read_doubles("crossings/frequency");
        for (std::size_t i = 0; i < std::min({branch.size(), multiple.size(), speed.size(), frequency.size()}); ++i)
            if (branch[i] >= 0 && branch[i] < std::ssize(d_.branches))
                d_.crossings.push_back(
                    {static_cast<int>(branch[i]), static_cast<int>(multiple[i]), speed[i], frequency[i]});
    }

    void state_motions() {
        if (!file_.has("state_motions/point")) return;
        const std::vector<std::int64_t> point = file_.read_ints("state_motions/point");
        const std::vector<double> real = file_.read_doubles("state_motions/eigenvalue_real"),
                                  imag = file_.read_doubles("state_motions/eigenvalue_imag"),
                                  share = file_.read_doubles("state_motions/share");
        const std::vector<std::string> name = file_.read_strings("state_motions/name");
        for (std::size_t i = 0; i < point.size(); ++i) {
            for (const std::size_t size : {real.size(), imag.size(), share.size(), name.size()})
                require_size("state_motions", size, point.size());
            if (point[i] < 0 || point[i] >= std::ssize(d_.points))
                throw FileError(file_.path(), text("state_motions/point has the value ", point[i]));
            StateMotion motion;
            motion.mode.eigenvalue = {real[i], imag[i]};
            motion.mode.state_share = share[i];
            const auto at = std::ranges::find(d_.states, name[i]);
            motion.state = static_cast<int>(at - d_.states.begin());
            if (at == d_.states.end()) d_.states.push_back(name[i]);
            d_.points[static_cast<std::size_t>(point[i])].state_motions.push_back(std::move(motion));
        }
    }

    Hdf5File file_;
    Campbell d_;
};

}  // namespace

Campbell read_campbell(const std::filesystem::path& path, CampbellShapes shapes) {
    return Reader(path).read(shapes);
}

}  // namespace cardan::solvers
