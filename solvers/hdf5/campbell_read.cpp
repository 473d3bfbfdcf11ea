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

    Campbell read() {
        header();
        axis();
        branches();
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
                                       mostly = file_.read_strings("branches/mostly");
        d_.branches.resize(names.size());
        require_size("branches/family", families.size(), names.size());
        require_size("branches/pattern", patterns.size(), names.size());
        const std::vector<double> real = by_branch("eigenvalue_real"), imag = by_branch("eigenvalue_imag"),
                                  mac = by_branch("mac"), doubtful = by_branch("doubtful");
        require_size("branches/kind", kinds.size(), real.size());
        require_size("branches/mostly", mostly.size(), real.size());
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

Campbell read_campbell(const std::filesystem::path& path) {
    return Reader(path).read();
}

}  // namespace cardan::solvers
