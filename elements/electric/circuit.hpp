/// @file
/// Electric circuits whose windings see the motion of bodies: sources, resistors, capacitors and windings between named
/// nodes.
///
///     Circuit coil({.name = "magnet", .current = 2, .voltage = 24});
///     coil.add_source({.name = "supply", .from = "ground", .to = "plus", .over_time = [](double) { return 24.0; }});
///     coil.add_winding({.name = "coil", .from = "plus", .to = "ground", .inductance = 0.05, .resistance = 6});
///     coil.vary("coil", "coil", plunger, [](double x) { ... });
///     forces.add_element(coil.element());
#pragma once

#include "elements/controllers/control_signal.hpp"
#include "elements/electric/inductance.hpp"
#include "mbs/system/channel.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cardan {

namespace detail {
class CircuitEquations;
struct CircuitLoops;
}  // namespace detail

/// Raises the potential by v = over_time(t) + signal from `from` to `to`; its current is positive in this direction,
/// and v i the power it supplies.
struct VoltageSource {
    std::string name, from, to;
    std::function<double(double time)> over_time = {};  ///< V; empty: zero
    ControlSignal signal = signal::constant(0);         ///< V
    std::vector<double> breaks = {};                    ///< times, s, at which over_time is not smooth
};
/// A resistor; its current, as that of every element below, is positive from `from` to `to`.
struct Resistor {
    std::string name, from, to;
    double resistance = 0;  ///< ohm, > 0
};
struct Capacitor {
    std::string name, from, to;
    double capacitance = 0;      ///< F, > 0
    double initial_voltage = 0;  ///< V, positive at `from`
};
/// A winding with a resistance in series.
struct Winding {
    std::string name, from, to;
    double inductance = 0;  ///< H; what depends on coordinates: Circuit::vary()
    double resistance = 0;  ///< ohm, >= 0
};

/// Kirchhoff's laws are met by loop currents j: a normal tree of the circuit takes up sources, capacitors, resistors
/// and windings in this order; the windings that are left, its links, carry j, and i = B j. States are the flux
/// linkages of the loops that these windings close, lambda = B^T L(q) B j [V s], and the voltages of capacitors;
/// resistors that are links are solved within. With the flux phi(q) of permanent magnets
///
///     d lambda / dt = B^T (v - u - R i - dphi/dq qd),   C du/dt = i,   Q = 1/2 dL/dq i i + dphi/dq i.
///
/// The voltages of motion of L are in d lambda / dt; see InductanceMetric.
class Circuit {
public:
    struct Options {
        std::string name;
        double current = 0, voltage = 0;  ///< what counts as much, A and V: the scales of the states
        std::string part = {};            ///< as of coordinates
        int blade = 0;
    };

    /// @throws InputError for an empty name and for scales that are not positive
    explicit Circuit(Options options);

    /// Every add_...() throws InputError for a name that is taken, equal nodes, and values out of range.
    void add_source(VoltageSource source);
    void add_resistor(const Resistor& resistor);
    void add_capacitor(const Capacitor& capacitor);
    void add_winding(const Winding& winding);
    /// A mutual inductance, H, constant.
    void couple(std::string_view a, std::string_view b, double inductance);
    /// Adds curve(q) to the inductance of two windings with one another, or to that of one.
    void vary(std::string_view a, std::string_view b, BodyId coordinate, CurveOf curve);
    /// Adds a term over all windings in the order in which they were added, and a constant part.
    void add_inductance(const Inductance& inductance);
    /// Flux linkage curve(q), V s, of a winding with permanent magnets that move. Of a motor with a commutator:
    /// constant slope, N m/A.
    void add_magnet(std::string_view winding_name, BodyId coordinate, CurveOf curve);

    /// The equations, to be added to a ForceSet.
    /// @throws InputError naming the place: loops of sources alone or with capacitors, an inductance matrix of the
    /// loops that is not positive definite with all coordinates zero (in a motion: as soon as that happens)
    ForceElement element() const;
    /// "<name> current" of every source, resistor, capacitor and winding, A, and "<circuit> force on <k>", k counted
    /// from 1 over the coordinates of the inductances (N m or N), where there are any.
    ChannelGroup channels() const;

    const std::string& name() const { return options_.name; }
    const Inductance& inductance() const { return inductance_; }
    /// Names of the states: "<winding> flux" of the windings that are links, "<capacitor> voltage".
    std::vector<std::string> states() const;

private:
    enum class Kind : std::uint8_t { source, capacitor, resistor, winding };
    struct Branch {
        std::string name;
        Kind kind;
        int from, to;
        std::size_t at;         ///< within its kind
        double resistance = 0;  ///< ohm
    };
    struct Magnet {
        Eigen::Index winding;
        BodyId coordinate;
        CurveOf flux;
    };

    void add_branch(Kind kind, const std::string& name, const std::string& from, const std::string& to, std::size_t at,
                    double resistance);
    Eigen::Index winding(std::string_view name) const;
    /// The coordinates of inductances and magnets, in the order in which they came.
    std::vector<BodyId> coordinates() const;
    detail::CircuitLoops loops() const;
    /// The element without its functions, and what these call.
    struct Built {
        ForceElement element;
        std::shared_ptr<const detail::CircuitEquations> equations;
    };
    Built build() const;
    /// @param element  gets what the sources' signals need
    detail::CircuitEquations equations(ForceElement& element) const;

    Options options_;
    std::vector<std::string> nodes_;
    std::vector<Branch> branches_;
    std::vector<VoltageSource> sources_;
    std::vector<Capacitor> capacitors_;
    std::vector<std::size_t> windings_;  ///< branches
    Inductance inductance_;
    std::vector<Magnet> magnets_;
};

}  // namespace cardan
