#include "solvers/hdf5/axis.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

namespace cardan::solvers {

namespace {

/// "a/b/" of "a/b/c", "" of "c".
std::string group_of(const std::string& name) {
    return name.substr(0, name.rfind('/') + 1);
}

Shape shape_of(const Hdf5Axes& axes) {
    Shape shape;
    for (const Hdf5Axis& axis : axes) shape.push_back(axis.size());
    return shape;
}

/// The attribute that names the labels; none if there are no labels.
Attributes coordinates_of(const Hdf5Axes& axes) {
    std::string names;
    for (const Hdf5Axis& axis : axes)
        for (const AxisLabel& label : axis.labels) names += (names.empty() ? "" : " ") + label.name;
    if (names.empty()) return {};
    return {{"coordinates", names}};
}

void write_axes(Hdf5File& file, const std::string& array, const Hdf5Axes& axes) {
    for (const Hdf5Axis& axis : axes) write_axis(file, group_of(array), axis);
}

void attach(Hdf5File& file, const std::string& array, const Hdf5Axes& axes) {
    for (std::size_t i = 0; i < axes.size(); ++i) file.attach(array, i, group_of(array) + axes[i].get().name);
}

Description with_coordinates(Description about, const Hdf5Axes& axes) {
    const Attributes more = coordinates_of(axes);
    about.more.insert(about.more.end(), more.begin(), more.end());
    return about;
}

template <class Value>
void write_numbers(Hdf5File& file, const std::string& name, std::span<const Value> values, const Hdf5Axes& axes,
                   const Description& about) {
    write_axes(file, name, axes);
    file.write(name, values, shape_of(axes), with_coordinates(about, axes));
    attach(file, name, axes);
}

void write_label(Hdf5File& file, const std::string& name, const AxisLabel& label) {
    std::visit(
        [&]<class Value>(const std::vector<Value>& values) {
            if constexpr (std::is_same_v<Value, std::string>)
                file.write(name, values, {values.size()}, label.about.long_name, label.about.more);
            else
                file.write(name, values, {values.size()}, label.about);
        },
        label.values);
}

}  // namespace

std::size_t Hdf5Axis::size() const {
    return std::visit([](const auto& all) { return all.size(); }, values);
}

Hdf5Axis counting_axis(std::string name, std::size_t count, std::string long_name, std::vector<AxisLabel> labels) {
    std::vector<std::int64_t> index(count);
    std::iota(index.begin(), index.end(), 0);
    return {std::move(name), std::move(index), {"1", std::move(long_name)}, std::move(labels)};
}

AxisLabel text_label(std::string name, std::vector<std::string> texts, std::string long_name) {
    return {std::move(name), std::move(texts), {"", std::move(long_name)}};
}

void write_axis(Hdf5File& file, const std::string& group, const Hdf5Axis& axis) {
    const std::string scale = group + axis.name;
    if (!file.has(scale)) {
        std::visit([&](const auto& values) { file.write(scale, values, {values.size()}, axis.about); }, axis.values);
        file.make_dimension(scale);
    }
    for (const AxisLabel& label : axis.labels) {
        const std::string name = group + label.name;
        if (file.has(name)) continue;
        write_label(file, name, label);
        file.attach(name, 0, scale);
    }
}

void write_array(Hdf5File& file, const std::string& name, std::span<const double> values, const Hdf5Axes& axes,
                 const Description& about) {
    write_numbers(file, name, values, axes, about);
}

void write_array(Hdf5File& file, const std::string& name, std::span<const int> values, const Hdf5Axes& axes,
                 const Description& about) {
    write_numbers(file, name, values, axes, about);
}

void write_array(Hdf5File& file, const std::string& name, std::span<const std::complex<double>> values,
                 const Hdf5Axes& axes, const Description& about) {
    write_axes(file, name, axes);
    file.write(name, values, shape_of(axes), with_coordinates(about, axes));
    for (const char* part : {real_part, imaginary_part}) attach(file, name + part, axes);
}

void write_array(Hdf5File& file, const std::string& name, std::span<const std::string> texts, const Hdf5Axes& axes,
                 const std::string& long_name) {
    write_axes(file, name, axes);
    file.write(name, texts, shape_of(axes), long_name, coordinates_of(axes));
    attach(file, name, axes);
}

}  // namespace cardan::solvers
