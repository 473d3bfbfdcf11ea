#include "elements/aerodynamics/lagging_air.hpp"

#include "elements/aerodynamics/detail/section_factors.hpp"

#include <cmath>

namespace cardan {

namespace {

using LagSlope = Dual<LaggingSlopes::columns>;

// Those that an airfoil does not have are zero.
UnsteadyAirfoil::States airfoil_states(const SectionStates& s, const UnsteadySection& lags) {
    UnsteadyAirfoil::States x = UnsteadyAirfoil::States::Zero();
    x.tail(lags.airfoil_states()) = s.segment(lags.inflow_states(), lags.airfoil_states());
    return x;
}
UnsteadyAirfoil::States airfoil_states(const SectionStates& s, const UnsteadySection& lags,
                                       const AirfoilMotion& motion) {
    return lags.at_rest ? lags.airfoil->steady(motion) : airfoil_states(s, lags);
}

// Of an airfoil whose states follow the motion at once: by the motion alone.
UnsteadyAirfoil::Slopes at_rest(const UnsteadyAirfoil& airfoil, UnsteadyAirfoil::Slopes slopes) {
    constexpr int states = UnsteadyAirfoil::states, motions = UnsteadyAirfoil::Slopes::columns - states;
    Eigen::Matrix<double, states, states> by_states = slopes.rates.leftCols<states>();
    for (int i = 0; i < states - airfoil.own_states(); ++i) by_states(i, i) = 1;  // those that it does not have
    const Eigen::Matrix<double, states, motions> moved = -by_states.inverse() * slopes.rates.rightCols<motions>();
    slopes.coefficients.rightCols<motions>() += slopes.coefficients.leftCols<states>() * moved;
    return slopes;
}

AirfoilMotion motion_of(const Annulus& annulus, const Reaching<double>& u, double rate) {
    return {std::atan2(u.u_x, u.u_y) - annulus.angle, std::hypot(u.u_x, u.u_y), rate, annulus.chord};
}
Reaching<double> reaching(const SectionMotion& motion, const Induction& induction) {
    return {motion.V_x * (1 - induction.axial), motion.V_y * (1 + induction.tangential)};
}

// Without limits: what the wake's skew has made of an induction may be beyond them.
Induction frozen_induction(const Eigen::Vector2d& velocity, const SectionMotion& motion) {
    return {.axial = motion.V_x == 0 ? 0 : -velocity.x() / motion.V_x,
            .tangential = motion.V_y == 0 ? 0 : velocity.y() / motion.V_y,
            .phi = std::atan2(motion.V_x + velocity.x(), motion.V_y + velocity.y())};
}

RotorWake unskewed(const RotorWake& wake) {
    return {.share = wake.share};
}

// @param first, count  of the airfoil's states
LagSlope airfoil_value(double value, const Eigen::Matrix<double, 1, UnsteadyAirfoil::Slopes::columns>& slopes,
                       const LagSlope& attack, const LagSlope& speed, const LagSlope& rate, int first, int count) {
    LagSlope out(value);
    for (int i = 0; i < count; ++i) out.slopes(first + i) += slopes(UnsteadyAirfoil::states - count + i);
    using Column = UnsteadyAirfoil::Slopes;
    out.slopes += slopes(Column::attack) * attack.slopes + slopes(Column::speed) * speed.slopes +
                  slopes(Column::rate) * rate.slopes;
    return out;
}

// Derivatives of all that a section returns.
class Differentiation {
public:
    Differentiation(const Annulus& annulus, const LaggingAir& at, const SectionMotion& motion, const SectionStates& s,
                    const RotorAirOptions& options, double density, const UnsteadySection& lags)
        : annulus_(annulus),
          at_(at),
          motion_(motion),
          s_(s),
          options_(options),
          density_(density),
          lags_(lags),
          inflow_{LagSlope::variable(motion.V_x, LaggingSlopes::V_x),
                  LagSlope::variable(motion.V_y, LaggingSlopes::V_y),
                  LagSlope::variable(annulus.angle, LaggingSlopes::angle),
                  LagSlope::variable(annulus.radius, LaggingSlopes::radius)},
          rate_(LagSlope::variable(motion.rate, LaggingSlopes::rate)) {}

    LaggingSlopes run() {
        follow_airfoil_or_table(lags_.wake == Wake::frozen ? frozen_velocity()
                                                           : reaching<LagSlope>(inflow_, factors()));
        return out_;
    }

private:
    static LagSlope state(double value, int i) { return LagSlope::variable(value, LaggingSlopes::first_state + i); }
    void set(int row, const LagSlope& value) { out_.by.row(row) = value.slopes.transpose(); }

    Factors<LagSlope> factors() {
        const bool dynamic = lags_.wake == Wake::oye;
        const LagSlope none(0), all(1), share = LagSlope::variable(motion_.wake.share, LaggingSlopes::wake_share);
        Factors<LagSlope> own =
            in_wake<LagSlope>(factors_of(annulus_, inflow_, at_.solved, at_.root, options_, LaggingSlopes::wake_angle),
                              share, none, none, false);
        if (dynamic) {
            follow_inflow(own);
            own = held_factors();
        }
        return in_wake<LagSlope>(own, all, LagSlope::variable(motion_.wake.angle, LaggingSlopes::wake_angle),
                                 LagSlope::variable(motion_.wake.lever, LaggingSlopes::wake_lever),
                                 (dynamic || at_.solved) && options_.skew != Skew::none);
    }

    // Velocities that do not change with the motion.
    Reaching<LagSlope> frozen_velocity() const {
        return {inflow_.V_x + lags_.velocity.x(), inflow_.V_y + lags_.velocity.y()};
    }

    void follow_inflow(const Factors<LagSlope>& steady) {
        constexpr double kappa = DynamicInflow::kappa;
        const InflowTimes times = inflow_times(motion_.wake.time, lags_.share);
        const std::array<LagSlope, 2> velocity{-steady.axial * inflow_.V_x, steady.tangential * inflow_.V_y};
        for (int i = 0; i < 2; ++i) {
            const LagSlope &w = velocity[static_cast<std::size_t>(i)], early = state(s_(i), i),
                           late = state(s_(i + 2), i + 2);
            set(3 + i, ((1 - kappa) * w - early) / times.first);
            set(5 + i, (early + kappa * w - late) / times.second);
        }
    }

    Factors<LagSlope> held_factors() const {
        const Factors<LagSlope> held{motion_.V_x == 0 ? LagSlope(0) : -state(s_(2), 2) / inflow_.V_x,
                                     motion_.V_y == 0 ? LagSlope(0) : state(s_(3), 3) / inflow_.V_y};
        return {limited<LagSlope>(held.axial, -1, 1.5), limited<LagSlope>(held.tangential, -1, 1)};
    }

    void follow_airfoil_or_table(const Reaching<LagSlope>& u) {
        if (lags_.has_airfoil())
            follow_airfoil(u);
        else
            follow_table(u);
    }

    void follow_table(const Reaching<LagSlope>& u) {
        const Loads<LagSlope> loads = loads_of(annulus_, inflow_.angle, u, density_);
        set(0, loads.normal);
        set(1, loads.driving);
        set(2, loads.moment);
    }

    void follow_airfoil(const Reaching<LagSlope>& u) {
        // Without speed nothing depends on it to first order but the angle of attack, which has no meaning then.
        const bool flows = value_of(u.u_x) != 0 || value_of(u.u_y) != 0;
        const LagSlope speed = flows ? sqrt(u.u_x * u.u_x + u.u_y * u.u_y) : LagSlope(0),
                       attack = (flows ? atan2(u.u_x, u.u_y) : LagSlope(0)) - inflow_.angle;
        const AirfoilMotion motion{attack.value, speed.value, motion_.rate, annulus_.chord};
        const UnsteadyAirfoil::States x = airfoil_states(s_, lags_, motion);
        UnsteadyAirfoil::Slopes slopes = lags_.airfoil->slopes(x, motion);
        if (lags_.at_rest) slopes = at_rest(*lags_.airfoil, slopes);
        const UnsteadyAirfoil::Coefficients c = lags_.airfoil->coefficients(x, motion);
        const int first = LaggingSlopes::first_state + lags_.inflow_states(), count = lags_.airfoil_states();
        const auto value = [&](double of, const auto& row) {
            return airfoil_value(of, row, attack, speed, rate_, first, count);
        };
        for (int i = 0; i < count; ++i)
            set(3 + lags_.inflow_states() + i, value(0, slopes.rates.row(UnsteadyAirfoil::states - count + i)));
        const LagSlope lift = value(c.lift, slopes.coefficients.row(0)),
                       drag = value(c.drag, slopes.coefficients.row(1)),
                       moment = value(c.moment, slopes.coefficients.row(2)),
                       pressure = density_ / 2 * annulus_.chord * speed;
        set(0, pressure * (lift * u.u_y + drag * u.u_x));
        set(1, pressure * (lift * u.u_x - drag * u.u_y));
        set(2, pressure * speed * annulus_.chord * moment);
    }

    const Annulus& annulus_;
    const LaggingAir& at_;
    const SectionMotion& motion_;
    const SectionStates& s_;
    const RotorAirOptions& options_;
    double density_;
    const UnsteadySection& lags_;
    Inflow<LagSlope> inflow_;
    LagSlope rate_;
    LaggingSlopes out_;
};

}  // namespace

LaggingAir lagging_air(const Annulus& annulus, const SectionMotion& motion, const SectionStates& s,
                       const RotorAirOptions& options, double density, const UnsteadySection& lags) {
    const bool balanced = options.induction && lags.wake != Wake::frozen;
    const Induction balance = balanced ? solve_induction(annulus, motion.V_x, motion.V_y, options.momentum)
                                       : Induction{.phi = std::atan2(motion.V_x, motion.V_y)};
    return lagging_air(balance, annulus, motion, s, density, lags);
}

LaggingAir lagging_air(const Induction& balance, const Annulus& annulus, const SectionMotion& motion,
                       const SectionStates& s, double density, const UnsteadySection& lags) {
    const double V_x = motion.V_x, V_y = motion.V_y;
    const bool frozen = lags.wake == Wake::frozen, dynamic = lags.wake == Wake::oye;
    const Induction steady = with_wake(balance, V_x, V_y, unskewed(motion.wake));
    LaggingAir out{.air = {.V_x = V_x, .V_y = V_y, .induction = steady, .force = {}},
                   .velocity = frozen ? lags.velocity : DynamicInflow::velocity(steady, V_x, V_y),
                   .root = frozen ? 0 : balance.root,
                   .solved = !frozen && balance.solved};
    Induction& now = out.air.induction;
    if (frozen) {
        now = frozen_induction(lags.velocity, motion);
    } else {
        if (dynamic) {
            const DynamicInflow::States inflow = s.head<DynamicInflow::states>();
            out.rates.head<DynamicInflow::states>() =
                DynamicInflow::rates(inflow, out.velocity, inflow_times(motion.wake.time, lags.share));
            now = DynamicInflow::induction(inflow, V_x, V_y);
            now.solved = true;  // for the skew, which it has whatever the balance
        }
        now = with_wake(now, V_x, V_y, {motion.wake.angle, motion.wake.lever});
    }
    now.solved = out.solved;
    const Reaching<double> u =
        frozen ? Reaching<double>{V_x + lags.velocity.x(), V_y + lags.velocity.y()} : reaching(motion, now);
    if (lags.has_airfoil()) {
        const AirfoilMotion moving = motion_of(annulus, u, motion.rate);
        const UnsteadyAirfoil::States x = airfoil_states(s, lags, moving);
        out.rates.segment(lags.inflow_states(), lags.airfoil_states()) =
            lags.airfoil->rates(x, moving).tail(lags.airfoil_states());
        const UnsteadyAirfoil::Coefficients c = lags.airfoil->coefficients(x, moving);
        out.air.force = force_of(annulus, u.u_x, u.u_y, moving.attack, {c.lift, c.drag, c.moment}, density);
    } else {
        out.air.force = table_force(annulus, u, now.phi - annulus.angle, density);
    }
    return out;
}

SectionStates steady_states(const Annulus& annulus, const SectionMotion& motion, const RotorAirOptions& options,
                            const UnsteadySection& lags) {
    UnsteadySection still = lags;
    if (lags.wake == Wake::oye) still.wake = Wake::equilibrium;
    still.airfoil = nullptr;
    const LaggingAir at = lagging_air(annulus, motion, SectionStates::Zero(), options, 1, still);
    SectionStates out = SectionStates::Zero();
    if (lags.wake == Wake::oye) out.head<DynamicInflow::states>() = DynamicInflow::steady(at.velocity);
    const Reaching<double> reached =
        lags.wake == Wake::frozen ? Reaching<double>{motion.V_x + lags.velocity.x(), motion.V_y + lags.velocity.y()}
                                  : reaching(motion, at.air.induction);
    if (lags.has_airfoil())
        out.segment(lags.inflow_states(), lags.airfoil_states()) =
            lags.airfoil->steady(motion_of(annulus, reached, motion.rate)).tail(lags.airfoil_states());
    return out;
}

LaggingSlopes lagging_slopes(const Annulus& annulus, const LaggingAir& at, const SectionMotion& motion,
                             const SectionStates& s, const RotorAirOptions& options, double density,
                             const UnsteadySection& lags) {
    return Differentiation(annulus, at, motion, s, options, density, lags).run();
}

}  // namespace cardan
