#include "turbines/yaml/detail/description_reader.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

void YamlLevel::finish() const {
    std::string known;
    for (const std::string& key : asked_) known += (known.empty() ? "" : ", ") + key;
    for (const std::string& key : node_.keys())
        if (!asked_.contains(key)) node_[key].fail(text("not a key of the format; allowed: ", known));
}

void DescriptionReader::version() {
    const YamlNode node = at()["cardan_turbine"];
    const double given = node.number();
    std::string known;
    for (int one = 1; one <= description_yaml_version; ++one) {
        if (given == one) version_ = one;
        known += text(one == 1 ? "" : ", ", one);
    }
    if (given != version_) node.fail(text("version ", given, "; allowed: ", known));
}

Vec3 DescriptionReader::triple(const YamlNode& node) {
    const std::vector<double> v = node.numbers(std::size_t{3});
    return {v[0], v[1], v[2]};
}

void DescriptionReader::require_ascending(const YamlNode& node, const std::vector<double>& values) {
    if (values.empty()) node.fail("no numbers; allowed: at least 1");
    const auto place = std::ranges::adjacent_find(values, [](double a, double b) { return !(b > a); });
    if (place != values.end()) node.fail(text(place[1], " after ", place[0], "; allowed: ascending"));
}

std::vector<EngineeringSection> DescriptionReader::sections(const YamlNode& node, std::size_t count) {
    std::vector<EngineeringSection> all(count);
    YamlLevel level(node);
    for (const SectionColumn& column : section_columns()) {
        const YamlNode values = level[column.name];
        const std::vector<double> numbers = values.numbers(column.may_be_infinite);
        if (numbers.size() != count)
            values.fail(text(numbers.size(), " numbers; allowed: ", count, ", one per station"));
        for (std::size_t i = 0; i < count; ++i) column.of(all[i]) = numbers[i];
    }
    level.finish();
    return all;
}

BeamTable DescriptionReader::table(YamlLevel level) {
    BeamTable t;
    t.name = level["name"].word();
    t.stations = level["stations"].numbers();
    if (!t.stations.empty() && t.stations.front() != 0)
        throw InputError(t.name, "first station [m]", t.stations.front(), "0");
    if (const auto given = level.find("sections")) {
        t.interpolation = choice(level["interpolation"], {Interpolation::linear, Interpolation::log_linear_stiffness});
        t.sections = sections(*given, t.stations.size());
    } else {
        t.beta = level["beta"].numbers(t.stations.size());
        const YamlNode stiffness = level["stiffness"], mass = level["mass_matrix"];
        const std::vector<YamlNode> K = stiffness.items(), M = mass.items();
        for (const auto* list : {&K, &M})
            if (list->size() != t.stations.size())
                (list == &K ? stiffness : mass).fail(text(list->size(), " matrices; allowed: ", t.stations.size()));
        for (std::size_t i = 0; i < K.size(); ++i) t.matrices.push_back({square<Mat6>(K[i], true), square<Mat6>(M[i])});
    }
    if (const auto points = level.find("points")) {
        for (const YamlNode& point : points->items()) t.points.push_back(triple(point));
        t.shape = choice(level["shape"], {LineShape::spline, LineShape::polyline});
    }
    level.finish();
    return t;
}

void DescriptionReader::bearing(const char* key, JointSupport& b) {
    using Kind = JointSupport::Kind;
    b = rigid_joint;
    const YamlNode node = at()[key];
    if (!node.is_map()) {
        b.kind = choice(node, {Kind::free, Kind::rigid, Kind::prescribed});
        return;
    }
    group(key, [&] {
        const auto hold = at().find("hold");
        b.kind = hold ? choice(*hold, {Kind::free, Kind::spring}) : Kind::spring;
        if (b.kind == Kind::spring) b.stiffness = at()["stiffness"].number(version_ == 1);
        number("damping", b.damping);
    });
    if (version_ == 1 && std::isinf(b.stiffness)) b = rigid_joint;
    if (version_ == 1 && b.kind == Kind::spring && b.stiffness == 0) b.kind = Kind::free;
}

void DescriptionReader::inertia(const char* key, RigidInertia& i) {
    group(key, [&] {
        number("mass", i.mass);
        i.com = triple(at()["com"]);
        i.J = square<Mat3>(at()["J"]);
        i.reduced = at()["reduced"].flag();
    });
}

void DescriptionReader::damping(const char* key, BeamDamping& d) {
    group(key, [&] {
        const std::vector<double> tau = at()["time_constants"].numbers(std::size_t{6});
        std::copy(tau.begin(), tau.end(), d.time_constants.begin());
        number("mass_proportional", d.mass_proportional);
        d.modal.all = at()["all"].numbers();
        d.modal.bending_y = at()["bending_y"].numbers();
        d.modal.bending_z = at()["bending_z"].numbers();
        d.modal.torsion = at()["torsion"].numbers();
        d.modal.extension = at()["extension"].numbers();
    });
}

void DescriptionReader::line(const char* key, BeamLine& l) {
    make_of(key, [&] { l = beam_line(table(YamlLevel(at()[key]))); });
}

}  // namespace cardan::turbines
