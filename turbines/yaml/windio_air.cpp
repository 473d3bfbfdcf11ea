#include "turbines/yaml/windio_air.hpp"

#include "elements/aerodynamics/attached_flow.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/monotone_cubic.hpp"
#include "mbs/base/stations.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/yaml/detail/windio_airfoils.hpp"
#include "turbines/yaml/detail/windio_curve.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

constexpr double one_place = 1e-4;         // of the length: closer places are one section
constexpr std::size_t max_sections = 500;  // public files make up to 100

// An airfoil at a place of the blade.
struct PlacedAirfoil {
    double place;  // fraction of the length
    std::string name;
    WindioAirfoil airfoil;
};

// Two neighbouring airfoils, from root to tip, and how much of the second there is.
struct AirfoilPair {
    std::size_t first;
    double share;
};

// Airfoils along the span and the thickness in between.
class AirfoilRow {
public:
    AirfoilRow(std::vector<PlacedAirfoil> all, std::optional<WindioCurve> thickness)
        : all_(std::move(all)), given_(std::move(thickness)) {
        std::vector<double> thick;
        thick.reserve(all_.size());
        places_.reserve(all_.size());
        for (const PlacedAirfoil& one : all_) {
            places_.push_back(one.place);
            thick.push_back(one.airfoil.thickness);
        }
        // windIO's schema: "use rthick or use PCHIP based on the master airfoils".
        if (!given_ && all_.size() > 1) cubic_.emplace(places_, thick, MonotoneCubic::Ends::parabola);
    }

    AirfoilPair at(double place) const {
        if (all_.size() < 2) return {0, 0};
        const double inside = std::clamp(place, places_.front(), places_.back());
        const std::size_t near = place_among(places_, inside).left;
        const double thickness = given_ ? given_->at(place) : cubic_->at(inside).value;
        const std::size_t i = bracket(near, thickness);
        const double from = thick(i), to = thick(i + 1);
        const double share =
            from == to ? (inside - places_[i]) / (places_[i + 1] - places_[i]) : (thickness - from) / (to - from);
        return {i, std::clamp(share, 0.0, 1.0)};
    }
    double centre(const AirfoilPair& pair) const {
        const double first = all_[pair.first].airfoil.centre;
        return pair.share == 0 ? first : (1 - pair.share) * first + pair.share * all_[pair.first + 1].airfoil.centre;
    }
    Polar polar(const AirfoilPair& pair) const {
        const PlacedAirfoil& first = all_[pair.first];
        if (pair.share == 0) return first.airfoil.polar;
        const PlacedAirfoil& second = all_[pair.first + 1];
        if (pair.share == 1 || first.name == second.name) return second.airfoil.polar;
        return Polar::mixed(text(first.name, " ", 1 - pair.share, ", ", second.name, " ", pair.share),
                            first.airfoil.polar, second.airfoil.polar, pair.share);
    }
    const std::vector<double>& places() const { return places_; }

private:
    double thick(std::size_t i) const { return all_[i].airfoil.thickness; }
    bool holds(std::size_t i, double thickness) const {
        return thickness >= std::min(thick(i), thick(i + 1)) && thickness <= std::max(thick(i), thick(i + 1));
    }
    // The nearest interval with this thickness: a given thickness dominates over places (windIO's schema).
    std::size_t bracket(std::size_t near, double thickness) const {
        const std::size_t intervals = all_.size() - 1;
        for (std::size_t away = 0; away < intervals; ++away) {
            if (near + away < intervals && holds(near + away, thickness)) return near + away;
            if (away <= near && holds(near - away, thickness)) return near - away;
        }
        return near;
    }

    std::vector<PlacedAirfoil> all_;
    std::vector<double> places_;
    std::optional<WindioCurve> given_;
    std::optional<MonotoneCubic> cubic_;
};

// Fractions of the length, ascending, from 0 to 1, without those that are as good as one.
std::vector<double> section_places(const std::vector<double>& all) {
    std::vector<double> out{0};
    for (const double place : all)
        if (place > out.back() + one_place && place < 1 - one_place) out.push_back(place);
    out.push_back(1);
    return out;
}

class WindioAirReader {
public:
    WindioAirReader(YamlNode root, double hub_radius) : file_(std::move(root)), hub_radius_(hub_radius) {}

    WindioAir read() {
        read_environment();
        try {
            read_sections();
            out_.blade.check();
            out_.airfoils = unsteady_airfoils(out_.blade.polars);
        } catch (const InputError& error) {
            file_.root().fail(error.what());
        }
        out_.notes = std::move(file_.notes);
        return std::move(out_);
    }

private:
    double positive_number(const YamlNode& node) const {
        const double value = node.number();
        if (!(value > 0)) node.fail(text(value, "; allowed: > 0"));
        return value;
    }
    void read_environment() {
        if (const auto density = file_.find({"environment.air_density"})) out_.density = positive_number(*density);
        if (const auto dynamic = file_.find({"environment.air_dyn_viscosity"}))
            out_.blade.viscosity = positive_number(*dynamic) / out_.density;
    }

    std::optional<WindioCurve> curve(std::initializer_list<const char*> paths) const {
        const auto node = file_.find(paths);
        return node ? std::optional(whole_curve(*node)) : std::nullopt;
    }
    WindioCurve chord() const {
        const YamlNode node =
            file_.get({"components.blade.outer_shape.chord", "components.blade.outer_shape_bem.chord"});
        WindioCurve out = whole_curve(node);
        for (const double value : out.values)
            if (!(value > 0)) node.fail(text("chord of ", value, " m; allowed: > 0"));
        return out;
    }
    WindioCurve twist() const {
        const YamlNode node =
            file_.get({"components.blade.outer_shape.twist", "components.blade.outer_shape_bem.twist"});
        WindioCurve out = whole_curve(node);
        for (double& value : out.values) {
            if (std::abs(value * file_.angle()) > pi)
                node.fail(text("twist of ", value, "; allowed: half a turn at most (", file_.unit_of_angle(), ")"));
            value *= file_.angle();
        }
        return out;
    }

    // From the leading edge to the reference axis along the chord, m; version 1 counts in chords.
    struct Pinning {
        std::optional<WindioCurve> distance, fraction, across;
        double along(double place, double chord) const {
            return distance ? distance->at(place) : fraction->at(place) * chord;
        }
    };
    Pinning pinning() const {
        Pinning out{curve({"components.blade.outer_shape.section_offset_y"}),
                    curve({"components.blade.outer_shape_bem.pitch_axis", "components.blade.outer_shape.pitch_axis"}),
                    curve({"components.blade.outer_shape.section_offset_x"})};
        if (!out.distance && !out.fraction)
            file_.get({file_.version() == 2 ? "components.blade.outer_shape.section_offset_y"
                                            : "components.blade.outer_shape_bem.pitch_axis"});
        return out;
    }

    void read_sections() {
        const WindioCurve chords = chord(), twists = twist();
        const std::optional<WindioCurve> thickness =
            curve({"components.blade.outer_shape.rthick", "components.blade.outer_shape_bem.rthick"});
        const Pinning pinned = pinning();
        const YamlNode axis =
            file_.get({"components.blade.reference_axis", "components.blade.outer_shape_bem.reference_axis"});
        const WindioCurve x = whole_curve(axis["x"]), y = whole_curve(axis["y"]), z = whole_curve(axis["z"]);
        const AirfoilRow row(airfoils(thickness), thickness);
        std::vector<double> places = united(united(chords.grid, twists.grid), row.places());
        if (thickness) places = united(std::move(places), thickness->grid);
        places = section_places(places);
        if (places.size() > max_sections)
            axis.fail(text(places.size(), " sections of the blade; allowed: at most ", max_sections));
        AeroBlade& blade = out_.blade;
        for (const double place : places) {
            const AirfoilPair pair = row.at(place);
            const double c = chords.at(place), angle = twists.at(place),
                         along = row.centre(pair) * c - pinned.along(place, c),
                         across = pinned.across ? pinned.across->at(place) : 0;
            blade.position.push_back(hub_radius_ + z.at(place) - z.at(0));
            blade.chord.push_back(c);
            blade.twist.push_back(angle);
            // Along the chord to the trailing edge, and across it to the suction side, downwind.
            blade.prebend.push_back(x.at(place) - x.at(0) + along * std::sin(angle) + across * std::cos(angle));
            blade.sweep.push_back(y.at(place) - y.at(0) + along * std::cos(angle) - across * std::sin(angle));
            blade.airfoil.push_back(airfoil(row, pair));
            if (blade.sections() > 1 && !(blade.position.back() > blade.position[blade.sections() - 2]))
                axis["z"].fail(text(z.at(place), " m at ", place, " of the length; allowed: ascending"));
        }
    }

    std::size_t airfoil(const AirfoilRow& row, const AirfoilPair& pair) {
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            if (pairs_[i].first == pair.first && pairs_[i].share == pair.share) return i;
        pairs_.push_back(pair);
        out_.blade.polars.push_back(row.polar(pair));
        return pairs_.size() - 1;
    }

    std::vector<PlacedAirfoil> airfoils(const std::optional<WindioCurve>& thickness) {
        const auto newer = file_.find({"components.blade.outer_shape.airfoils"});
        return newer ? listed_airfoils(*newer, thickness) : labelled_airfoils();
    }

    // Version 1: labels over a grid.
    std::vector<PlacedAirfoil> labelled_airfoils() {
        const YamlNode node = file_.version() == 2 ? file_.get({"components.blade.outer_shape.airfoils"})
                                                   : file_.get({"components.blade.outer_shape_bem.airfoil_position"});
        const std::vector<YamlNode> labels = node["labels"].items();
        const std::vector<double> grid = increasing_grid(node["grid"], labels.size());
        std::vector<PlacedAirfoil> all;
        all.reserve(labels.size());
        for (std::size_t i = 0; i < labels.size(); ++i)
            all.push_back({grid[i], labels[i].word(), windio_airfoil(file_, labels[i])});
        return all;
    }

    // Version 2: a list of maps.
    std::vector<PlacedAirfoil> listed_airfoils(const YamlNode& list, const std::optional<WindioCurve>& thickness) {
        const std::vector<YamlNode> items = list.items();
        if (items.empty()) list.fail("no airfoil; allowed: at least 1");
        std::vector<PlacedAirfoil> all;
        all.reserve(items.size());
        for (const YamlNode& item : items) {
            const YamlNode name = item["name"];
            PlacedAirfoil one{0, name.word(), windio_airfoil(file_, name, polar_choice(item))};
            const double before = all.empty() ? -1 : all.back().place;
            one.place = place_of(item, one.airfoil.thickness, std::max(before, 0.0), thickness);
            if (!(one.place > before))
                item.fail(text("spanwise position ", one.place, " after ", before, "; allowed: larger"));
            all.push_back(std::move(one));
        }
        return all;
    }

    // Without a place of its own an airfoil is where the blade has its thickness.
    double place_of(const YamlNode& item, double thick, double from, const std::optional<WindioCurve>& thickness) {
        if (const auto given = item.find("spanwise_position")) {
            const double place = given->number();
            if (!(place >= 0 && place <= 1)) given->fail(text(place, "; allowed: 0 ... 1"));
            return place;
        }
        if (!thickness) item.fail("no spanwise_position, and the blade has no rthick");
        const WindioCurve& t = *thickness;
        for (std::size_t i = 1; i < t.grid.size(); ++i) {
            const double a = t.values[i - 1], b = t.values[i];
            if (a == b && a == thick && t.grid[i] >= from) return std::max(from, t.grid[i - 1]);
            if (a == b || (a - thick) * (b - thick) > 0) continue;
            const double place = t.grid[i - 1] + (t.grid[i] - t.grid[i - 1]) * (thick - a) / (b - a);
            if (place >= from) return place;
        }
        item.fail(text("thickness ", thick, " is nowhere in rthick from ", from, " of the length on"));
    }

    WindioPolarChoice polar_choice(const YamlNode& item) const {
        WindioPolarChoice out;
        const auto names = item.find("configuration");
        if (!names) return out;
        for (const YamlNode& one : names->items()) out.configurations.push_back(one.word());
        const auto weights = item.find("weight");
        out.weights =
            weights ? weights->numbers(out.configurations.size()) : std::vector<double>(out.configurations.size(), 1.0);
        double sum = 0;
        for (const double weight : out.weights) {
            if (!(weight >= 0)) weights->fail(text(weight, "; allowed: >= 0"));
            sum += weight;
        }
        constexpr double rounding = 1e-3;  // thirds, written with three digits
        if (!out.configurations.empty() && std::abs(sum - 1) > rounding)
            (weights ? *weights : *names).fail(text("weights with the sum ", sum, "; allowed: 1"));
        return out;
    }

    WindioFile file_;
    double hub_radius_;
    std::vector<AirfoilPair> pairs_;  // of the polars
    WindioAir out_;
};

}  // namespace

WindioAir parse_windio_air(const std::string& text, const std::string& file, double hub_radius,
                           const std::vector<ModelAddition>& additions) {
    WindioAir out = WindioAirReader(YamlNode::parse(text, file, additions), hub_radius).read();
    out.source = text;
    for (const ModelAddition& addition : additions)
        out.source += cardan::text("\n# ", addition.name, "\n", addition.text);
    return out;
}

WindioAir read_windio_air(const std::filesystem::path& path, double hub_radius,
                          const std::vector<ModelAddition>& additions) {
    return parse_windio_air(text_file(path), path.string(), hub_radius, additions);
}

}  // namespace cardan::turbines
