// Channels along directions of the state by central differences.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear_models/detail/state_space.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers::detail {

namespace {

Forces with_wrench(const System& system, FrameLoad load, double factor) {
    load.wrench.force *= factor;
    load.wrench.moment *= factor;
    return system.forces.with_load(std::move(load), system.model);
}

// Of the one entry that a direction has.
template <class Table, class Direction>
double scale_of(const Table& table, const Direction& direction) {
    Eigen::Index at = 0;
    direction.cwiseAbs().maxCoeff(&at);
    return table[static_cast<int>(at)].scale;
}

std::string listed(const std::vector<ChannelGroup>& groups) {
    std::string names;
    for (const ChannelGroup& group : groups)
        for (const Channel& channel : group.channels) names += text(names.empty() ? "" : ", ", "'", channel.name, "'");
    return names;
}

}  // namespace

OutputDifferences::OutputDifferences(const System& system, const std::vector<ChannelGroup>& groups,
                                     const std::vector<std::string>& wanted)
    : system_(system), values_(system, groups) {
    std::vector<const Channel*> all;
    for (const ChannelGroup& group : groups)
        for (const Channel& channel : group.channels) all.push_back(&channel);
    const auto take = [&](std::size_t i) {
        const Channel& c = *all[i];
        at_.push_back(i);
        angle_.push_back(c.units == "rad");
        signals_.push_back({c.name, c.units, c.long_name, c.alias, blade_number(c.name)});
    };
    if (wanted.empty())
        for (std::size_t i = 0; i < all.size(); ++i) take(i);
    for (const std::string& name : wanted) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const Channel* c) {
            return c->name == name || (!name.empty() && c->alias == name);
        });
        if (found == all.end())
            throw InputError("linear model", "output", text("'", name, "'"), text("one of ", listed(groups)));
        take(static_cast<std::size_t>(found - all.begin()));
    }
}

Vector OutputDifferences::at(const DynamicState& state, const Forces& forces) {
    const std::vector<double>& all = values_.at(state, forces);
    Vector values(std::ssize(at_));
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        values(i) = all[entry(at_, i)];
        if (!std::isfinite(values(i)))
            throw NumericalError(text("linear model: the channel '", entry(signals_, i).name, "' is ", values(i)));
    }
    return values;
}

Matrix OutputDifferences::along(const DynamicState& state, const Directions& directions, const Layout& layout,
                                Vector& error, Vector& size) {
    const auto rows = std::ssize(at_);
    Matrix slopes = Matrix::Zero(rows, layout.columns());
    if (size.size() == 0) error = size = Vector::Zero(rows);
    if (rows == 0) return slopes;
    for (Eigen::Index j = 0; j < layout.columns(); ++j) {
        const auto q = directions.q.col(j), qd = directions.qd.col(j), qdd = directions.qdd.col(j);
        const auto s = directions.s.col(j), u = directions.u.col(j);
        const std::optional<FrameLoad> load = layout.wrench_of(j);
        // Positions: the error of the extrapolated difference, h^4, and rounding, 1e-16 / h, are about alike. Channels
        // are quadratic in the rates and linear in accelerations and forces: a large step has the least rounding.
        // By the largest entry of the direction: the factor of an input of motion may be anything.
        const auto largest = [](const auto& direction) { return direction.cwiseAbs().maxCoeff(); };
        // States and inputs: a hundredth of what counts as much.
        const double h = !s.isZero(0)     ? 1e-2 * scale_of(system_.forces.states(), s)
                         : !u.isZero(0)   ? 1e-2 * scale_of(system_.forces.inputs(), u)
                         : !q.isZero(0)   ? 1e-3 / largest(q)
                         : !qd.isZero(0)  ? 1e-2 / largest(qd)
                         : !qdd.isZero(0) ? 100 / largest(qdd)
                                          : 1;
        const auto value = [&](double step) {
            DynamicState moved = state;
            moved.q += step * q;
            moved.qd += step * qd;
            moved.qdd += step * qdd;
            moved.s += step * s;
            moved.u += step * u;
            if (moved.lambda.size() > 0) moved.lambda += step * directions.lambda.col(j);
            moved.actuator += step * directions.actuator.col(j);
            return load ? at(moved, with_wrench(system_, *load, step)) : at(moved, system_.forces);
        };
        const auto difference = [&](double step) {
            Vector d = value(step) - value(-step);
            for (Eigen::Index i = 0; i < rows; ++i)
                if (entry(angle_, i)) d(i) = std::remainder(d(i), 2 * pi);
            return Vector(d / (2 * step));
        };
        const Vector fine = difference(h), coarse = difference(2 * h);
        slopes.col(j) = fine + (fine - coarse) / 3;
        error = error.cwiseMax(h / 3 * (fine - coarse).cwiseAbs());
        size = size.cwiseMax(h * slopes.col(j).cwiseAbs());
    }
    return slopes;
}

}  // namespace cardan::solvers::detail
