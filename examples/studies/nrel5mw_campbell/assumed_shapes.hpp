/// @file
/// A multi-blade system whose tower and blades are limited to the shapes of FAST's ElastoDyn.
#pragma once

#include "mbs/base/entry.hpp"
#include "solvers/periodic/azimuth_average.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/reference_turbines/nrel5mw_shapes.hpp"

namespace cardan::nrel5mw_campbell {

enum class Limited : std::uint8_t { nothing, tower, tower_and_blades };

/// Columns: what is left to move, in the rows of the multi-blade system.
/// @param mean  of this machine (pitch rigid, no extension or torsion where it is limited)
inline Matrix shapes_left(const turbines::Turbine& machine, const solvers::AzimuthAverage& mean, Limited limited) {
    const Model& model = machine.system().model;
    const auto rows = std::ssize(mean.rows);
    const auto row_of = [&](int coordinate) {
        for (Eigen::Index i = 0; i < rows; ++i)
            if (entry(mean.system.coordinates, i) == coordinate) return i;
        return Eigen::Index(-1);
    };
    std::vector<Vector> columns;
    std::vector<bool> taken(mean.rows.size(), false);
    if (limited != Limited::nothing) {
        const CardanBeam& tower = *machine.layout().tower;
        const Matrix shapes = turbines::elastodyn_tower_shapes(tower);
        for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
            Vector column = Vector::Zero(rows);
            Eigen::Index at = 0;
            for (const CardanBeam::Element& element : tower.elements)
                for (const BodyId body : element.bodies) {
                    const Eigen::Index row = row_of(model.index(body));
                    column(row) = shapes(at++, k);
                    entry(taken, row) = true;
                }
            columns.push_back(column);
        }
    }
    if (limited == Limited::tower_and_blades) {
        const CardanBeam& blade = machine.layout().blades[0];
        const Matrix along = turbines::elastodyn_blade_shapes(blade);
        Matrix shapes = Matrix::Zero(model.size(), along.cols());  // by the coordinates of blade 1
        Eigen::Index at = 0;
        for (const CardanBeam::Element& element : blade.elements)
            for (const BodyId body : element.bodies) shapes.row(model.index(body)) = along.row(at++);
        for (const auto pattern :
             {solvers::MultiBlade::collective, solvers::MultiBlade::cosine, solvers::MultiBlade::sine})
            for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
                Vector column = Vector::Zero(rows);
                for (Eigen::Index i = 0; i < rows; ++i)
                    if (const solvers::MultiBladeRow& row = entry(mean.rows, i); row.kind == pattern) {
                        column(i) = shapes(entry(machine.rotor().blades[0], row.blade_coordinate), k);
                        entry(taken, i) = true;
                    }
                columns.push_back(column);
            }
    }
    for (Eigen::Index i = 0; i < rows; ++i)
        if (!entry(taken, i)) columns.emplace_back(Vector::Unit(rows, i));
    Matrix all(rows, std::ssize(columns));
    for (Eigen::Index j = 0; j < all.cols(); ++j) all.col(j) = entry(columns, j);
    return all;
}

/// Modes of the limited system, their shapes in the rows of the whole one.
inline std::vector<solvers::Mode> limited_modes(const turbines::Turbine& machine, const solvers::AzimuthAverage& mean,
                                                Limited limited) {
    if (limited == Limited::nothing) return solvers::modes(mean.system);
    const Matrix R = shapes_left(machine, mean, limited);
    solvers::SecondOrderSystem left = mean.system;
    for (Matrix* m : {&left.M, &left.C, &left.K, &left.K_elastic}) *m = (R.transpose() * *m * R).eval();
    std::vector<solvers::Mode> found = solvers::modes(left);
    for (solvers::Mode& mode : found) mode.shape = (R * mode.shape).eval();
    return found;
}

}  // namespace cardan::nrel5mw_campbell
