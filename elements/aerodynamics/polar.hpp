/// @file
/// Coefficients of an airfoil over the full circle of the angle of attack, and over the Reynolds number.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cardan {

/// Lift, drag and moment coefficients: linear between the angles of a table, periodic; of several tables linear in the
/// logarithm of the Reynolds number, which friction follows, and constant beyond the first and the last one.
class Polar {
public:
    struct Table {
        std::vector<double> angles;  ///< rad, ascending, from -pi to pi
        std::vector<double> lift, drag, moment;
        double reynolds = 0;  ///< without meaning for a single table
    };
    /// Slopes per rad, and per unit of the Reynolds number; at a point of the tables those of the interval above it.
    struct Point {
        double lift = 0, drag = 0, moment = 0, lift_slope = 0, drag_slope = 0, moment_slope = 0;
        double lift_reynolds = 0, drag_reynolds = 0, moment_reynolds = 0;
        double room = 0;  ///< rad: so far to either side all are linear in the angle
    };

    /// @throws InputError naming airfoil, table and angle unless there is a table, all have at least two points,
    /// finite, ascending, and reach around the circle, and the Reynolds numbers of several tables are positive and
    /// ascend
    Polar(std::string name, std::vector<Table> tables);
    /// Makes a polar of one table.
    Polar(std::string name, std::vector<double> angles, std::vector<double> lift, std::vector<double> drag,
          std::vector<double> moment);
    /// A polar between those of two airfoils: (1 - share) a + share b, over the angles and Reynolds numbers of both.
    static Polar mixed(std::string name, const Polar& a, const Polar& b, double share);

    /// Coefficients of the first table.
    Point at(double angle) const;
    Point at(double angle, double reynolds) const;
    const std::string& name() const { return name_; }
    /// Whether the polar has several tables.
    bool over_reynolds() const { return tables_.size() > 1; }
    std::vector<double> reynolds() const;  ///< of the tables
    std::size_t tables() const { return tables_.size(); }
    const Table& table(std::size_t i = 0) const { return tables_[i].table; }  ///< by ascending Reynolds number
    /// Lift at small angles, slope * angle + offset: of the first table at 0.08 rad, where flow is attached.
    struct LiftLine {
        double slope = 0, offset = 0;
    };
    const LiftLine& lift_line() const { return lift_line_; }
    /// Whether the lift rises at half of its steepest slope, or more, all the way from no angle of attack to this one?
    /// Of an airfoil without lift everywhere. Of the first table, between -pi and pi.
    bool is_attached(double angle) const { return angle >= attached_from_ && angle <= attached_to_; }
    /// Points of the first table beyond, up to a right angle, at which the lift loses slope away from zero, rad.
    const std::vector<double>& stalls() const { return stalls_; }

private:
    static constexpr std::size_t cells = 512;
    struct IndexedTable {
        struct Interval {
            double from, lift, drag, moment, lift_slope, drag_slope, moment_slope;
        };
        Table table;
        std::vector<Interval> intervals;
        std::array<std::uint16_t, cells> first{};  ///< interval in which a cell of the circle begins

        explicit IndexedTable(Table of);
        Point at(double x) const;
    };
    Point between(double x, double reynolds) const;
    void find_stalls();

    std::string name_;
    std::vector<IndexedTable> tables_;
    LiftLine lift_line_;
    double attached_from_ = 0, attached_to_ = 0;
    std::vector<double> stalls_;
};

}  // namespace cardan
