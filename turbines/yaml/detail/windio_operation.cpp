#include "turbines/yaml/detail/windio_operation.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/controller_file.hpp"
#include "turbines/readers/detail/matrix_blade.hpp"

#include <filesystem>
#include <utility>

namespace cardan::turbines {

namespace {

using Paths = std::initializer_list<const char*>;

class OperationReader {
public:
    OperationReader(WindioFile& file, double radius, TurbineFile& out) : file_(file), radius_(radius), out_(out) {}

    void read() {
        read_rated_speed();
        read_power();
        // From 2.1 on; up to 2.0; of the first files, which counted in rad/s.
        if (const auto speed = positive({"control.min_rotor_speed", "control.torque.VS_minspd"}))
            out_.operation.min_rotor_speed = speed->number() * file_.rotor_speed();
        else if (const auto old = positive({"control.supervisory.minOmega"}))
            out_.operation.min_rotor_speed = old->number();
        if (const auto ratio = positive({"control.optimal_tsr", "control.torque.tsr"}))
            out_.operation.tip_speed_ratio = ratio->number();
        read_pitch();
        out_.operation.source = std::filesystem::path(file_.root().file()).filename().string();
    }

private:
    // Zero, of files that are filled in later, is as good as nothing.
    std::optional<YamlNode> positive(Paths paths) const {
        const auto node = file_.find(paths);
        if (!node) return std::nullopt;
        const double value = node->number();
        if (value < 0) node->fail(text(value, "; allowed: >= 0"));
        return value > 0 ? node : std::nullopt;
    }

    void take_speed(double speed, std::string source) {
        out_.rotor_speed = out_.description.rotor_speed = speed;
        out_.rotor_speed_source = std::move(source);
    }
    void read_rated_speed() {
        if (const auto rated = positive({"control.rated_rotor_speed"}))
            return take_speed(rated->number() * file_.rotor_speed(), rated->path());
        // The rotor turns as fast as it may.
        std::optional<YamlNode> limit;
        if (const auto max = positive({"control.torque.VS_maxspd"})) {
            limit = max;
            take_speed(max->number() * file_.rotor_speed(), max->path());
        }
        if (const auto old = positive({"control.supervisory.maxOmega"});  // in rad/s
            old && (!limit || old->number() < out_.rotor_speed)) {
            limit = old;
            take_speed(old->number(), old->path());
        }
        if (const auto tip = positive({"control.supervisory.maxTS"}); tip && radius_ > 0) limit_tip_speed(*tip, limit);
        if (out_.rotor_speed > 0) return;
        if (const auto max = positive({"control.max_rotor_speed"}))
            take_speed(max->number() * file_.rotor_speed(), max->path());
    }
    // Tip speeds are those of nominal radii: the IEA 15 MW machine's 95 m/s and 7.56 rpm belong to 120 m, and its axes
    // make 120.8 m.
    void limit_tip_speed(const YamlNode& tip, const std::optional<YamlNode>& limit) {
        constexpr double nominal = 0.01;
        if (limit && out_.rotor_speed * radius_ <= (1 + nominal) * tip.number()) return;
        if (limit)
            file_.note(*limit, text(limit->number()),
                       text("makes the tips faster than ", tip.path(), ", ", tip.number(), " m/s: this holds"));
        take_speed(tip.number() / radius_, text(tip.path(), " over the radius, ", radius_, " m"));
    }

    // windIO: "the rated electrical output of the generator".
    void read_power() {
        const auto power = positive({"control.rated_power", "assembly.rated_power", "control.supervisory.rated_power"});
        double efficiency = 1;
        if (const auto gearbox = positive(
                {"components.drivetrain.gearbox.efficiency", "components.nacelle.drivetrain.gearbox_efficiency"}))
            efficiency = fraction(*gearbox, gearbox->number());
        out_.controller.generator_efficiency = generator_efficiency();
        if (!power) return;
        if (out_.controller.generator_efficiency > 0)
            efficiency *= out_.controller.generator_efficiency;
        else
            file_.note(*power, text(power->number()),
                       "electrical; the file gives no efficiency of the generator, so that rated power on the rotor is "
                       "without its losses");
        out_.operation.rated_power = power->number() / efficiency;
    }
    static double fraction(const YamlNode& node, double value) {
        if (!(value > 0 && value <= 1)) node.fail(text("an efficiency of ", value, "; allowed: 0 ... 1, not 0"));
        return value;
    }
    // At rated speed, over the rev/min of the rotor, as WISDEM has it; 0: not given.
    double generator_efficiency() const {
        const auto curve = file_.find({"components.drivetrain.generator.rpm_efficiency",
                                       "components.drivetrain.generator.generator_rpm_efficiency_user",
                                       "components.nacelle.drivetrain.generator_rpm_efficiency_user",
                                       "components.nacelle.generator.generator_rpm_efficiency_user"});
        if (!curve) return 0;
        const std::vector<double> values = (*curve)["values"].numbers(),
                                  speeds = (*curve)["grid"].numbers(values.size());
        if (values.empty() || values.back() == 0) return 0;  // not filled in
        for (std::size_t i = 1; i < speeds.size(); ++i)
            if (!(speeds[i] > speeds[i - 1]))
                (*curve)["grid"].fail(text(speeds[i], " after ", speeds[i - 1], "; allowed: larger"));
        if (values.size() == 1) return fraction(*curve, values.front());
        return fraction(*curve, interpolated(speeds, values, out_.rotor_speed * units::to_rpm));
    }

    void read_pitch() {
        // Rated power is sought from here on.
        if (const auto fine = file_.find({"control.fine_pitch", "control.pitch.min_pitch"})) {
            out_.pitch = fine->number() * file_.angle();
            out_.pitch_source = fine->path();
        }
        const auto table = file_.find({"control.min_pitch_table"});
        if (!table) return;
        const std::vector<double> winds = (*table)["wind_speed"].numbers(),
                                  angles = (*table)["min_pitch"].numbers(winds.size());
        for (std::size_t i = 0; i < winds.size(); ++i) {
            if (i > 0 && !(winds[i] > winds[i - 1]))
                (*table)["wind_speed"].fail(text(winds[i], " after ", winds[i - 1], "; allowed: larger"));
            out_.operation.min_pitch.push_back({winds[i], angles[i] * file_.angle()});
        }
        const double ratio = out_.operation.tip_speed_ratio;
        if (!(ratio > 0 && radius_ > 0 && out_.rotor_speed > 0) || out_.operation.min_pitch.empty()) return;
        out_.pitch_schedule = pitch_over_speed(out_.operation.min_pitch, ratio, radius_, out_.operation.min_rotor_speed,
                                               out_.rotor_speed);
        out_.pitch_source = table->path();
    }

    WindioFile& file_;
    double radius_;
    TurbineFile& out_;
};

}  // namespace

void read_windio_operation(WindioFile& file, double radius, TurbineFile& out) {
    OperationReader(file, radius, out).read();
}

}  // namespace cardan::turbines
