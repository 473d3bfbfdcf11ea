#include "elements/aerodynamics/lagging_section.hpp"

#include "elements/aerodynamics/detail/section_factors.hpp"

#include <cmath>

namespace cardan {

namespace {

using LagSlope = Dual<LaggingSlopes::columns>;

// Those that a profile does not have are zero.
UnsteadyProfile::States profile_states(const SectionStates& s, const SectionLags& lags) {
    UnsteadyProfile::States x = UnsteadyProfile::States::Zero();
    x.tail(lags.profile_states()) = s.segment(lags.inflow_states(), lags.profile_states());
    return x;
}

// What is left of the inflow when the wake has taken its share.
struct Reaching {
    double u_x, u_y;
    double attack(const Annulus& annulus) const { return std::atan2(u_x, u_y) - annulus.angle; }
    ProfileMotion motion(const Annulus& annulus, double rate) const {
        return {attack(annulus), std::hypot(u_x, u_y), rate, annulus.chord};
    }
};
Reaching reaching(const SectionMotion& motion, const Induction& induction) {
    return {motion.V_x * (1 - induction.axial), motion.V_y * (1 + induction.tangential)};
}

// Without limits: what the wake's skew has made of an induction may be beyond them.
Induction frozen_induction(const Eigen::Vector2d& velocity, double V_x, double V_y) {
    const double axial = V_x == 0 ? 0 : -velocity.x() / V_x, tangential = V_y == 0 ? 0 : velocity.y() / V_y;
    return {.axial = axial, .tangential = tangential, .phi = std::atan2(V_x * (1 - axial), V_y * (1 + tangential))};
}

Induction skewed(Induction induction, bool solved, const SectionMotion& motion) {
    if (!solved || motion.wake.lever == 0) return induction;
    induction.axial *= redistribution(induction.axial, motion.wake.angle, motion.wake.lever);
    induction.phi = std::atan2(motion.V_x * (1 - induction.axial), motion.V_y * (1 + induction.tangential));
    return induction;
}

// @param first, count  of the profile's states
LagSlope profile_value(double value, const Eigen::Matrix<double, 1, UnsteadyProfile::Slopes::columns>& slopes,
                       const LagSlope& attack, const LagSlope& speed, const LagSlope& rate, int first, int count) {
    LagSlope out(value);
    for (int i = 0; i < count; ++i) out.slopes(first + i) += slopes(UnsteadyProfile::states - count + i);
    using Column = UnsteadyProfile::Slopes;
    out.slopes += slopes(Column::attack) * attack.slopes + slopes(Column::speed) * speed.slopes +
                  slopes(Column::rate) * rate.slopes;
    return out;
}

// Derivatives of all that a section returns.
class Differentiation {
public:
    Differentiation(const Annulus& annulus, const LaggingAir& at, const SectionMotion& motion, const SectionStates& s,
                    const RotorAirOptions& options, double density, const SectionLags& lags)
        : annulus_(annulus),
          at_(at),
          motion_(motion),
          s_(s),
          options_(options),
          density_(density),
          lags_(lags),
          inflow_{velocity(motion.V_x, LaggingSlopes::V_x), velocity(motion.V_y, LaggingSlopes::V_y),
                  LagSlope::variable(annulus.angle, LaggingSlopes::angle),
                  LagSlope::variable(annulus.radius, LaggingSlopes::radius)},
          rate_(LagSlope::variable(motion.rate, LaggingSlopes::rate)) {}

    LaggingSlopes run() {
        Factors<LagSlope> factors = lags_.wake == WakeLag::frozen ? held_factors() : in_equilibrium();
        if (lags_.wake == WakeLag::dynamic) {
            follow_inflow(factors);
            factors = held_factors();
        }
        if (at_.solved && options_.skew != Skew::none)
            factors.axial *=
                redistribution(factors.axial, LagSlope::variable(motion_.wake.angle, LaggingSlopes::wake_angle),
                               LagSlope::variable(motion_.wake.lever, LaggingSlopes::wake_lever));
        if (lags_.has_profile())
            follow_profile(factors);
        else
            follow_table(factors);
        return out_;
    }

private:
    // Without any air speed nothing depends on it to first order but the angle of attack, which has no meaning then.
    LagSlope velocity(double value, int column) const {
        constexpr double still = 1e-9;  // m/s
        const bool moves = motion_.V_x != 0 || motion_.V_y != 0;
        return moves ? LagSlope::variable(value, column) : LagSlope(still);
    }
    static LagSlope state(double value, int i) { return LagSlope::variable(value, LaggingSlopes::first_state + i); }
    void set(int row, const LagSlope& value) { out_.by.row(row) = value.slopes.matrix().transpose(); }

    Factors<LagSlope> in_equilibrium() const {
        const Induction found{.axial = -at_.velocity.x() / (motion_.V_x == 0 ? 1 : motion_.V_x),
                              .tangential = at_.velocity.y() / (motion_.V_y == 0 ? 1 : motion_.V_y),
                              .root = at_.root,
                              .solved = at_.solved};
        return factors_of(annulus_, inflow_, found, options_.momentum, LaggingSlopes::wake_angle);
    }

    void follow_inflow(const Factors<LagSlope>& steady) {
        constexpr double kappa = DynamicInflow::kappa;
        const std::array<LagSlope, 2> velocity{-steady.axial * inflow_.V_x, steady.tangential * inflow_.V_y};
        for (int i = 0; i < 2; ++i) {
            const LagSlope &w = velocity[static_cast<std::size_t>(i)], early = state(s_(i), i),
                           late = state(s_(i + 2), i + 2);
            set(3 + i, ((1 - kappa) * w - early) / lags_.times.first);
            set(5 + i, (early + kappa * w - late) / lags_.times.second);
        }
    }

    // Of induced velocities that do not change with the motion.
    Factors<LagSlope> held_factors() const {
        const bool dynamic = lags_.wake == WakeLag::dynamic;
        const LagSlope axial = dynamic ? state(s_(2), 2) : LagSlope(lags_.velocity.x()),
                       tangential = dynamic ? state(s_(3), 3) : LagSlope(lags_.velocity.y());
        Factors<LagSlope> held{motion_.V_x == 0 ? LagSlope(0) : -axial / inflow_.V_x,
                               motion_.V_y == 0 ? LagSlope(0) : tangential / inflow_.V_y};
        if (!dynamic) return held;
        return {limited<LagSlope>(held.axial, -1, 1.5), limited<LagSlope>(held.tangential, -1, 1)};
    }

    void follow_table(const Factors<LagSlope>& factors) {
        const Loads<LagSlope> loads = loads_of(annulus_, inflow_, factors, density_);
        set(0, loads.normal);
        set(1, loads.driving);
        set(2, loads.moment);
    }

    void follow_profile(const Factors<LagSlope>& factors) {
        const LagSlope u_x = inflow_.V_x * (1 - factors.axial), u_y = inflow_.V_y * (1 + factors.tangential),
                       speed = sqrt(u_x * u_x + u_y * u_y), attack = atan2(u_x, u_y) - inflow_.angle;
        const ProfileMotion motion{attack.value, speed.value, motion_.rate, annulus_.chord};
        const UnsteadyProfile::States x = profile_states(s_, lags_);
        const UnsteadyProfile::Slopes slopes = lags_.profile->slopes(x, motion);
        const UnsteadyProfile::Coefficients c = lags_.profile->coefficients(x, motion);
        const int first = LaggingSlopes::first_state + lags_.inflow_states(), count = lags_.profile_states();
        const auto value = [&](double of, const auto& row) {
            return profile_value(of, row, attack, speed, rate_, first, count);
        };
        for (int i = 0; i < count; ++i)
            set(3 + lags_.inflow_states() + i, value(0, slopes.rates.row(UnsteadyProfile::states - count + i)));
        const LagSlope lift = value(c.lift, slopes.coefficients.row(0)),
                       drag = value(c.drag, slopes.coefficients.row(1)),
                       moment = value(c.moment, slopes.coefficients.row(2)),
                       pressure = density_ / 2 * annulus_.chord * speed;
        set(0, pressure * (lift * u_y + drag * u_x));
        set(1, pressure * (lift * u_x - drag * u_y));
        set(2, pressure * speed * annulus_.chord * moment);
    }

    const Annulus& annulus_;
    const LaggingAir& at_;
    const SectionMotion& motion_;
    const SectionStates& s_;
    const RotorAirOptions& options_;
    double density_;
    const SectionLags& lags_;
    Inflow<LagSlope> inflow_;
    LagSlope rate_;
    LaggingSlopes out_;
};

}  // namespace

LaggingAir lagging_air(const Annulus& annulus, const SectionMotion& motion, const SectionStates& s,
                       const RotorAirOptions& options, double density, const SectionLags& lags) {
    const bool balanced = options.induction && lags.wake != WakeLag::frozen;
    const Induction balance = balanced ? solve_induction(annulus, motion.V_x, motion.V_y, options.momentum)
                                       : Induction{.phi = std::atan2(motion.V_x, motion.V_y)};
    return lagging_air(balance, annulus, motion, s, density, lags);
}

LaggingAir lagging_air(const Induction& balance, const Annulus& annulus, const SectionMotion& motion,
                       const SectionStates& s, double density, const SectionLags& lags) {
    const double V_x = motion.V_x, V_y = motion.V_y;
    const bool frozen = lags.wake == WakeLag::frozen;
    LaggingAir out{.air = {.V_x = V_x, .V_y = V_y, .induction = balance, .force = {}},
                   .velocity = frozen ? lags.velocity : DynamicInflow::velocity(balance, V_x, V_y),
                   .root = frozen ? 0 : balance.root,
                   .solved = !frozen && balance.solved};
    Induction& now = out.air.induction;
    if (lags.wake == WakeLag::dynamic) {
        const DynamicInflow::States inflow = s.head<DynamicInflow::states>();
        out.rates.head<DynamicInflow::states>() = DynamicInflow::rates(inflow, out.velocity, lags.times);
        now = DynamicInflow::induction(inflow, V_x, V_y);
    } else if (frozen) {
        now = frozen_induction(lags.velocity, V_x, V_y);
    }
    now.solved = out.solved;
    now = skewed(now, out.solved, motion);
    if (lags.has_profile()) {
        const Reaching u = reaching(motion, now);
        const ProfileMotion moving = u.motion(annulus, motion.rate);
        const UnsteadyProfile::States x = profile_states(s, lags);
        out.rates.segment(lags.inflow_states(), lags.profile_states()) =
            lags.profile->rates(x, moving).tail(lags.profile_states());
        const UnsteadyProfile::Coefficients c = lags.profile->coefficients(x, moving);
        out.air.force = force_of(annulus, u.u_x, u.u_y, moving.attack, {c.lift, c.drag, c.moment}, density);
    } else {
        out.air.force = section_force(annulus, V_x, V_y, now, density);
    }
    return out;
}

SectionStates steady_states(const Annulus& annulus, const SectionMotion& motion, const RotorAirOptions& options,
                            const SectionLags& lags) {
    SectionLags still = lags;
    if (lags.wake == WakeLag::dynamic) still.wake = WakeLag::none;
    still.profile = nullptr;
    const LaggingAir at = lagging_air(annulus, motion, SectionStates::Zero(), options, 1, still);
    SectionStates out = SectionStates::Zero();
    if (lags.wake == WakeLag::dynamic) out.head<DynamicInflow::states>() = DynamicInflow::steady(at.velocity);
    if (lags.has_profile())
        out.segment(lags.inflow_states(), lags.profile_states()) =
            lags.profile->steady(reaching(motion, at.air.induction).motion(annulus, motion.rate))
                .tail(lags.profile_states());
    return out;
}

LaggingSlopes lagging_slopes(const Annulus& annulus, const LaggingAir& at, const SectionMotion& motion,
                             const SectionStates& s, const RotorAirOptions& options, double density,
                             const SectionLags& lags) {
    return Differentiation(annulus, at, motion, s, options, density, lags).run();
}

}  // namespace cardan
