/// @file
/// Equations of induction machines in axes that turn with the nominal frequency of the grid, for any scalar.
#pragma once

#include "elements/electric/detail/law.hpp"
#include "elements/electric/detail/phasor.hpp"
#include "elements/electric/induction_machine.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::detail {

struct MachineConstants {
    double R_s, R_r, L_s, L_r, L_m;  ///< ohm, H
    double D;                        ///< L_s L_r - L_m^2
    double pole_pairs, gear_ratio;
    double breaker;  ///< ohm, across the terminals of a machine that is cut off
    Grid grid;
    double omega;  ///< of the axes, rad/s

    MachineConstants(const EquivalentCircuit& circuit, const Grid& own, double ratio, double relative_breaker)
        : R_s(circuit.stator_resistance),
          R_r(circuit.rotor_resistance),
          L_s(circuit.stator_inductance()),
          L_r(circuit.rotor_inductance()),
          L_m(circuit.mutual_inductance()),
          D(L_s * L_r - L_m * L_m),
          pole_pairs(circuit.pole_pairs),
          gear_ratio(ratio),
          breaker(relative_breaker * std::max({circuit.magnetising, circuit.stator_leakage, circuit.rotor_leakage})),
          grid(own),
          omega(own.omega()) {}

    /// Zero when cut off.
    Phasor<double> voltage(double time) const {
        if (!grid.connected(time)) return {};
        const std::array<double, 2> v = grid.voltage(time);
        return {v[0], v[1]};
    }
    /// Resistance in series with the stator.
    double stator_resistance(double time) const { return grid.connected(time) ? R_s : R_s + breaker; }
    /// Electrical speed of the rotor relative to the axes, backwards.
    template <class S>
    S slip_speed(const S& rate) const {
        return omega - pole_pairs * gear_ratio * rate;
    }
};

/// Currents, fluxes and torque of a machine at an instant; currents into the machine.
template <class S>
struct MachineState {
    Phasor<S> voltage, stator_current, rotor_current, rotor_voltage;
    S torque{};           ///< braking positive
    Phasor<S> missing{};  ///< of controlled rotor currents: demanded less present
};

template <class S>
Phasor<S> pair(const S* x) {
    return {x[0], x[1]};
}
template <class S>
Phasor<S> lifted(const Phasor<double>& x) {
    return {S(x.d), S(x.q)};
}

/// Fluxes of stator and rotor.
struct FifthOrder {
    MachineConstants machine;

    template <class S>
    MachineState<S> state(const LawInput<S>& in) const {
        const MachineConstants& c = machine;
        const Phasor<S> stator = pair(in.s), rotor = pair(in.s + 2);
        MachineState<S> out;
        out.voltage = lifted<S>(c.voltage(in.time));
        out.stator_current = (1 / c.D) * (c.L_r * stator - c.L_m * rotor);
        out.rotor_current = (1 / c.D) * (c.L_s * rotor - c.L_m * stator);
        out.torque = -1.5 * c.pole_pairs * cross(stator, out.stator_current);
        return out;
    }
    template <class S>
    void flux_rates(const LawInput<S>& in, const MachineState<S>& at, S* Q, S* f) const {
        const MachineConstants& c = machine;
        const Phasor<S> stator = at.voltage - c.stator_resistance(in.time) * at.stator_current -
                                 c.omega * turned(pair(in.s)),
                        rotor = at.rotor_voltage - c.R_r * at.rotor_current -
                                c.slip_speed(in.qd[0]) * turned(pair(in.s + 2));
        Q[0] = -c.gear_ratio * at.torque;
        f[0] = stator.d;
        f[1] = stator.q;
        f[2] = rotor.d;
        f[3] = rotor.q;
    }
    template <class S>
    void operator()(const LawInput<S>& in, S* Q, S* f) const {
        flux_rates(in, state(in), Q, f);
    }
    ElementPower power(const LawInput<double>& in) const { return power(in, state(in)); }
    ElementPower power(const LawInput<double>& in, const MachineState<double>& at) const {
        return {.stored = 0.75 * (dot(pair(in.s), at.stator_current) + dot(pair(in.s + 2), at.rotor_current)),
                .supplied = 1.5 * (dot(at.voltage, at.stator_current) + dot(at.rotor_voltage, at.rotor_current)),
                .dissipated = 1.5 * (machine.stator_resistance(in.time) * dot(at.stator_current, at.stator_current) +
                                     machine.R_r * dot(at.rotor_current, at.rotor_current))};
    }
};

/// The stator at its steady state in axes that turn with the grid's voltage, v = R_s i + j w psi_s.
struct ThirdOrder {
    MachineConstants machine;

    template <class S>
    MachineState<S> state(const LawInput<S>& in) const {
        const MachineConstants& c = machine;
        const Phasor<S> rotor = pair(in.s);
        const double transient = c.D / c.L_r, share = c.L_m / c.L_r, w = c.omega + c.grid.angle_at(in.time).rate;
        MachineState<S> out;
        out.voltage = lifted<S>(c.voltage(in.time));
        if (c.grid.connected(in.time))
            out.stator_current =
                quotient(out.voltage - (w * share) * turned(rotor), Phasor<S>{S(c.R_s), S(w * transient)});
        out.rotor_current = (1 / c.L_r) * (rotor - c.L_m * out.stator_current);
        out.torque = -1.5 * c.pole_pairs * share * cross(rotor, out.stator_current);
        return out;
    }
    template <class S>
    void operator()(const LawInput<S>& in, S* Q, S* f) const {
        const MachineConstants& c = machine;
        const MachineState<S> at = state(in);
        const Phasor<S> rate = S(-c.R_r) * at.rotor_current - c.slip_speed(in.qd[0]) * turned(pair(in.s));
        Q[0] = -c.gear_ratio * at.torque;
        f[0] = rate.d;
        f[1] = rate.q;
    }
};

/// The torque behind the steady one.
struct FirstOrder {
    MachineConstants machine;

    /// Torque by Thevenin's equivalent of stator and magnetising branch; regular at synchronous speed.
    template <class S>
    S steady_torque(double time, const S& rate) const {
        const MachineConstants& c = machine;
        const Phasor<double> v = c.voltage(time);
        const double w = c.omega + c.grid.angle_at(time).rate, X_m = w * c.L_m, X_s = w * c.L_s,
                     size = c.R_s * c.R_s + X_s * X_s, V2 = dot(v, v) * X_m * X_m / size, R = c.R_s * X_m * X_m / size,
                     X = X_m - X_m * X_m * X_s / size + w * (c.L_r - c.L_m);
        const S slip = 1.0 - c.pole_pairs * c.gear_ratio * rate / w, real = R * slip + c.R_r;
        return -1.5 * c.pole_pairs / w * V2 * c.R_r * slip / (real * real + X * X * slip * slip);
    }
    template <class S>
    void operator()(const LawInput<S>& in, S* Q, S* f) const {
        const MachineConstants& c = machine;
        const double lag = c.D / (c.L_s * c.R_r);
        Q[0] = -c.gear_ratio * in.s[0];
        f[0] = (steady_torque(in.time, in.qd[0]) - in.s[0]) / lag;
    }
};

/// The rotor fed by a converter that controls its currents.
struct DoublyFed {
    FifthOrder induction;
    double bandwidth;  ///< rad/s

    /// Currents of the rotor that give torque and reactive power at a flux of the stator. Without flux (a tenth of the
    /// nominal one and less) they vanish with it; at the nominal one the demand is met to 5e-5.
    template <class S>
    Phasor<S> demanded(const Phasor<S>& flux, const S& torque, const S& reactive) const {
        using std::sqrt;
        const MachineConstants& c = induction.machine;
        const double min = std::pow(0.1 * c.grid.peak() / c.omega, 4);
        const S square = dot(flux, flux), floored = sqrt(square * square + min);
        const S along = (1.0 + reactive * c.L_s / (1.5 * c.omega * floored)) / c.L_m,
                across = torque * c.L_s / (1.5 * c.pole_pairs * c.L_m * floored);
        return product(Phasor<S>{along, across}, flux);
    }
    template <class S>
    MachineState<S> state(const LawInput<S>& in) const {
        const MachineConstants& c = induction.machine;
        MachineState<S> out = induction.state(in);
        out.missing = demanded(pair(in.s), in.demands[0], in.demands[1]) - out.rotor_current;
        out.rotor_voltage =
            (bandwidth * c.D / c.L_s) * out.missing + pair(in.s + 4) + c.slip_speed(in.qd[0]) * turned(pair(in.s + 2));
        return out;
    }
    template <class S>
    void operator()(const LawInput<S>& in, S* Q, S* f) const {
        const MachineState<S> at = state(in);
        induction.flux_rates(in, at, Q, f);
        f[4] = bandwidth * induction.machine.R_r * at.missing.d;
        f[5] = bandwidth * induction.machine.R_r * at.missing.q;
    }
    ElementPower power(const LawInput<double>& in) const { return induction.power(in, state(in)); }
};

}  // namespace cardan::detail
