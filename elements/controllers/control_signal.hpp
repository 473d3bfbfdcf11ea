/// @file
/// Signals: what filters, controllers and actuators measure and hand on to one another.
#pragma once

#include "mbs/base/monotone_cubic.hpp"
#include "mbs/system/force_element.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cardan {

/// Source of a signal.
struct ControlSource {
    enum class Kind : std::uint8_t { position, rate, state, input };
    Kind kind = Kind::input;
    BodyId coordinate = {};  ///< of position and rate
    std::string name = {};   ///< of state and input
};

/// A number that depends on positions and rates of coordinates, on states and on inputs, with its exact derivatives.
/// Signals add and compose:
///
///     const ControlSignal speed = 97 * signal::rate(shaft) - signal::constant(122.9);
///
/// Nothing here has a memory: what has, is an element with states, and its state is a signal again.
class ControlSignal {
public:
    /// A function of all sources and its gradient, which it overwrites.
    using Function = std::function<double(const double* sources, double* gradient)>;
    static constexpr std::size_t max_sources = 64;

    /// @throws InputError for more than max_sources
    ControlSignal(std::vector<ControlSource> sources, Function function);

    const std::vector<ControlSource>& sources() const { return sources_; }
    double value(const double* sources, double* gradient) const { return function_(sources, gradient); }

    /// A smooth function of this signal, y = f(x), with its derivative.
    struct Point {
        double value, slope;
    };
    ControlSignal through(std::function<Point(double x)> f) const;
    /// A table of this signal: a schedule of gains, a curve of torques.
    ControlSignal through(const MonotoneCubic& table) const;

    friend ControlSignal operator+(const ControlSignal& a, const ControlSignal& b);
    friend ControlSignal operator-(const ControlSignal& a, const ControlSignal& b);
    /// Product of two signals, and with a number.
    friend ControlSignal operator*(const ControlSignal& a, const ControlSignal& b);
    friend ControlSignal operator*(double factor, const ControlSignal& a);

private:
    std::vector<ControlSource> sources_;
    Function function_;
};

namespace signal {

ControlSignal position(BodyId coordinate);  ///< rad or m
ControlSignal rate(BodyId coordinate);      ///< rad/s or m/s
ControlSignal state(std::string name);
ControlSignal input(std::string name);
ControlSignal constant(double value);

}  // namespace signal

/// Limits that a value does not exceed, rounded so that its slope is continuous: within `rounding` of the span from a
/// limit the curve bends. Integrators do not stumble over them.
struct SoftLimits {
    double lower = -1e300, upper = 1e300;
    double rounding = 0.02;  ///< of upper - lower; nothing where a limit is missing

    ControlSignal::Point operator()(double x) const;
    /// @throws InputError unless lower < upper and 0 < rounding < 0.5
    void check(const std::string& where, const std::string& quantity) const;
};

/// A signal as an element sees it: wires the sources into the element's coordinates, states and inputs.
class ControlWire {
public:
    /// Adds what the signal needs to the element, unless it is there.
    ControlWire(const ControlSignal& signal, ForceElement& element);

    /// @param gradient  of the sources, for add()
    double value(const ElementView& in, std::array<double, ControlSignal::max_sources>& gradient) const;
    /// Adds `factor` times the signal's derivatives to a row of Q or of f.
    void add_to_Q(ElementJacobian& d, Eigen::Index row, double factor,
                  const std::array<double, ControlSignal::max_sources>& gradient) const;
    void add_to_f(ElementJacobian& d, Eigen::Index row, double factor,
                  const std::array<double, ControlSignal::max_sources>& gradient) const;

private:
    void add(const std::array<MatrixOut*, 5>& blocks, Eigen::Index row, double factor,
             const std::array<double, ControlSignal::max_sources>& gradient) const;

    enum class Block : std::uint8_t { q, qd, s, others, u };
    struct End {
        Block block;
        Eigen::Index at;
    };
    ControlSignal signal_;
    std::vector<End> ends_;
};

}  // namespace cardan
