#include "turbines/yaml/detail/windio_airfoils.hpp"

#include "mbs/base/error.hpp"
#include "turbines/readers/detail/matrix_blade.hpp"
#include "turbines/yaml/detail/windio_curve.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

constexpr double rounded_end = 0.01;      // rad; public files end at 3.14
constexpr std::size_t max_angles = 5000;  // public files have up to 400; every section may have its own polar

// An entry under the names of both versions.
YamlNode either(const YamlNode& node, const char* name, const char* older) {
    if (std::optional<YamlNode> found = node.find(name)) return *std::move(found);
    if (std::optional<YamlNode> found = node.find(older)) return *std::move(found);
    return node[name];  // which says what there is
}

double fraction(const YamlNode& node) {
    const double value = node.number();
    if (!(value >= 0 && value <= 1)) node.fail(text(value, "; allowed: 0 ... 1"));
    return value;
}

// A coefficient over the angle of attack, rad.
WindioCurve coefficient_curve(WindioFile& file, const YamlNode& node) {
    const YamlNode grid = node["grid"];
    WindioCurve curve{grid.numbers(), node["values"].numbers()};
    if (curve.grid.size() < 2 || curve.grid.size() != curve.values.size())
        grid.fail(
            text(curve.grid.size(), " angles for ", curve.values.size(), " values; allowed: as many, at least 2"));
    if (curve.grid.size() > max_angles) grid.fail(text(curve.grid.size(), " angles; allowed: at most ", max_angles));
    for (std::size_t i = 1; i < curve.grid.size(); ++i)
        if (!(curve.grid[i] > curve.grid[i - 1]))
            grid.fail(text(curve.grid[i], " after ", curve.grid[i - 1], "; allowed: larger"));
    const double first = curve.grid.front(), last = curve.grid.back();
    for (double& angle : curve.grid) angle *= file.angle();
    if (std::abs(curve.grid.front() + pi) > rounded_end || std::abs(curve.grid.back() - pi) > rounded_end)
        grid.fail(text("angles ", first, " ... ", last, "; allowed: -180 ... 180 deg (", file.unit_of_angle(), ")"));
    curve.grid.front() = -pi;
    curve.grid.back() = pi;
    return curve;
}

// On the angles of all three coefficients.
Polar::Table table_of(WindioFile& file, const YamlNode& set) {
    const WindioCurve lift = coefficient_curve(file, either(set, "cl", "c_l")),
                      drag = coefficient_curve(file, either(set, "cd", "c_d")),
                      moment = coefficient_curve(file, either(set, "cm", "c_m"));
    Polar::Table out;
    out.angles = united(united(lift.grid, drag.grid), moment.grid);
    for (auto* column : {&out.lift, &out.drag, &out.moment}) column->reserve(out.angles.size());
    for (const double angle : out.angles) {
        out.lift.push_back(lift.at(angle));
        out.drag.push_back(drag.at(angle));
        out.moment.push_back(moment.at(angle));
    }
    if (const auto number = set.find("re")) {
        out.reynolds = number->number();
        if (!(out.reynolds >= 0)) number->fail(text(out.reynolds, "; allowed: >= 0"));
    }
    return out;
}

// Sets at ascending Reynolds numbers. Of several at the same number the first one: the others are other surfaces.
Polar polar_of(WindioFile& file, const std::string& name, const std::vector<YamlNode>& sets, const YamlNode& where) {
    std::vector<Polar::Table> tables;
    tables.reserve(sets.size());
    bool doubled = false;
    for (const YamlNode& set : sets) {
        Polar::Table table = table_of(file, set);
        const auto same = [&](const Polar::Table& other) { return other.reynolds == table.reynolds; };
        if (std::any_of(tables.begin(), tables.end(), same))
            doubled = true;
        else
            tables.push_back(std::move(table));
    }
    if (doubled) file.note(where, "", "several polars at the same Reynolds number: the first one is taken");
    std::sort(tables.begin(), tables.end(),
              [](const Polar::Table& a, const Polar::Table& b) { return a.reynolds < b.reynolds; });
    try {
        return {name, std::move(tables)};
    } catch (const InputError& error) {
        where.fail(error.what());
    }
}

const YamlNode& configured(const std::vector<YamlNode>& polars, const std::string& configuration,
                           const YamlNode& where) {
    std::string known;
    for (const YamlNode& one : polars) {
        const auto given = one.find("configuration");
        const std::string own = given ? given->word() : "";
        if (own == configuration) return one;
        known += (known.empty() ? "'" : ", '") + own + "'";
    }
    where.fail(text("no configuration '", configuration, "'; there are: ", known));
}

// Version 2: sets over the Reynolds number within a configuration; a blade mixes configurations.
Polar chosen_polar(WindioFile& file, const std::string& name, const std::vector<YamlNode>& polars,
                   const WindioPolarChoice& choice, const YamlNode& where) {
    const auto one = [&](const YamlNode& polar) { return polar_of(file, name, polar["re_sets"].items(), polar); };
    if (choice.configurations.empty()) {
        if (polars.size() > 1) file.note(where, "", "several configurations: the first one is taken");
        return one(polars.front());
    }
    Polar out = one(configured(polars, choice.configurations.front(), where));
    double sum = choice.weights.front();
    for (std::size_t i = 1; i < choice.configurations.size(); ++i) {
        const double weight = choice.weights[i];
        if (weight == 0) continue;
        sum += weight;
        out = Polar::mixed(name, out, one(configured(polars, choice.configurations[i], where)), weight / sum);
    }
    return out;
}

YamlNode airfoil_named(WindioFile& file, const YamlNode& name) {
    const std::string wanted = name.word();
    std::string known;
    for (const YamlNode& one : file.get({"airfoils"}).items()) {
        const std::string own = one["name"].word();
        if (own == wanted) return one;
        known += (known.empty() ? "" : ", ") + own;
    }
    name.fail(text("no airfoil '", wanted, "'; there are: ", known));
}

}  // namespace

WindioAirfoil windio_airfoil(WindioFile& file, const YamlNode& name, const WindioPolarChoice& choice) {
    const YamlNode airfoil = airfoil_named(file, name), polars = airfoil["polars"];
    const std::vector<YamlNode> all = polars.items();
    if (all.empty()) polars.fail("no polar; allowed: at least 1");
    const double thickness = fraction(either(airfoil, "rthick", "relative_thickness")),
                 centre = fraction(airfoil["aerodynamic_center"]);
    // Version 1: every entry is a set.
    const bool sets = all.front().find("re_sets").has_value();
    return {thickness, centre,
            sets ? chosen_polar(file, name.word(), all, choice, polars) : polar_of(file, name.word(), all, polars)};
}

}  // namespace cardan::turbines
