/// @file
/// Arrays in HDF5 files with the axes they run over. netCDF knows an axis by the scale attached to it. xarray opens one
/// group at a time and has no values of an axis whose scale lies in a group above; as a tree it hides what has the name
/// of an axis above. So every group holds the scales of its own arrays and the names of what stands along them.
#pragma once

#include "solvers/hdf5/file.hpp"

#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cardan::solvers {

/// One value for each place on an axis, in a data set of its own: a coordinate in xarray, beside the scale.
struct AxisLabel {
    std::string name;  ///< of the data set, unique among those of a group
    std::variant<std::vector<std::string>, std::vector<double>, std::vector<int>> values;
    Description about;  ///< of texts the units are not used
};

/// An axis; its values are those of the scale.
struct Hdf5Axis {
    std::string name;  ///< of the scale
    std::variant<std::vector<double>, std::vector<std::int64_t>> values;
    Description about;
    std::vector<AxisLabel> labels = {};

    [[nodiscard]] std::size_t size() const;
    /// A copy with other labels.
    [[nodiscard]] Hdf5Axis with(std::vector<AxisLabel> other) const { return {name, values, about, std::move(other)}; }
};

/// An axis 0, 1, 2 ... over things that have names but no values of their own.
[[nodiscard]] Hdf5Axis counting_axis(std::string name, std::size_t count, std::string long_name,
                                     std::vector<AxisLabel> labels = {});
[[nodiscard]] AxisLabel text_label(std::string name, std::vector<std::string> texts, std::string long_name);

/// The axes of an array, slowest first. They outlive the call.
using Hdf5Axes = std::vector<std::reference_wrapper<const Hdf5Axis>>;

/// @name Arrays with axes
/// Writes an array and, if its group has not got them yet, scales and labels of its axes. The attribute `coordinates`
/// names the labels, as in the CF conventions. Axes of one name in one group are the same axis.
/// @throws InputError, FileError as Hdf5File::write() and attach()
///@{
void write_array(Hdf5File& file, const std::string& name, std::span<const double> values, const Hdf5Axes& axes,
                 const Description& about);
void write_array(Hdf5File& file, const std::string& name, std::span<const int> values, const Hdf5Axes& axes,
                 const Description& about);
void write_array(Hdf5File& file, const std::string& name, std::span<const std::complex<double>> values,
                 const Hdf5Axes& axes, const Description& about);
void write_array(Hdf5File& file, const std::string& name, std::span<const std::string> texts, const Hdf5Axes& axes,
                 const std::string& long_name);
///@}

/// Scale and labels of an axis in a group ("branches/", "" being the root), if they are not there yet.
void write_axis(Hdf5File& file, const std::string& group, const Hdf5Axis& axis);

}  // namespace cardan::solvers
