// Air that lags on machines: derivatives, states at rest, a frozen wake.
#include "mbs/base/error.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

namespace cardan::testing::air_lag_tests {

namespace {

using namespace turbines;

const SteadyWind sheared{.speed = 9, .shear = Shear::power, .exponent = 0.2, .direction = 0.2};

// A machine in lagging air, at a state.
class Lagging {
public:
    Lagging(const Turbine& machine, const MachineAir& air) : air_(air), windy_(air.on(machine)), state_(windy_) {
        Random random(5);
        const int spin = windy_.rotor().spin;
        for (Eigen::Index i = 0; i < state_.q.size(); ++i) {
            state_.q(i) += uniform(random, -0.02, 0.02);
            state_.qd(i) += uniform(random, -0.1, 0.1);
        }
        state_.q(spin) = 0.7;
        state_.qd(spin) = 1.1;
        workspace_.emplace(windy_.system().model);
        s = Vector::Zero(air.states());
        s = air.steady_states(at());
    }
    const Forces& forces() const { return windy_.system().forces; }
    StateView at() {
        kin_.emplace(kinematics(windy_.system().model, state_.q, *workspace_));
        state_.s = s;
        return {state_, *kin_};
    }
    // Q, then the rates.
    Vector response() {
        Vector Q(state_.q.size()), rates(s.size());
        forces().generalised_forces(at(), Q, rates);
        Vector out(Q.size() + rates.size());
        out << Q, rates;
        return out;
    }
    MachineState& state() { return state_; }
    Vector steady_states() { return air_.steady_states(at()); }

    Vector s;

private:
    MachineAir air_;
    Turbine windy_;
    MachineState state_;
    std::optional<Workspace> workspace_;
    std::optional<Kinematics> kin_;
};

MachineAir lagging_air_of(const Turbine& machine, Skew skew, bool airfoils = true) {
    RotorAirOptions options;
    options.skew = skew;
    UnsteadyAeroOptions lags{.dynamic_inflow = true, .inflow_time_constant = 8};
    if (airfoils) lags.airfoils = nrel5mw_unsteady_airfoils();
    return MachineAir(machine, nrel5mw_aero_blade(), sheared, options).lagging(lags);
}

}  // namespace

TEST_CASE("lagging air on a machine: derivatives are those of forces and rates", "[property]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    // At the other speed the induction is fading.
    for (const auto& at : {std::pair(Skew::none, 1.1), {Skew::pitt_peters, 1.1}, {Skew::pitt_peters, 0.22}}) {
        const Skew skew = at.first;
        const double speed = at.second;
        Lagging air(machine, lagging_air_of(machine, skew));
        air.state().qd(machine.rotor().spin) = speed;
        air.s = air.steady_states();
        Random random(8);
        for (Eigen::Index i = 0; i < air.s.size(); ++i) air.s(i) += uniform(random, -0.02, 0.02);
        ForceDerivatives own;
        air.forces().derivatives(air.at(), own);
        const StateDerivatives& states = own.states;
        const Eigen::Index n = air.state().q.size(), m = air.s.size();
        Matrix by_q(n + m, n), by_qd(n + m, n), by_s(n + m, m);
        by_q << -own.loads - own.elastic - own.gravity, states.f_q;
        by_qd << -own.damping, states.f_qd;
        by_s << states.Q_s, states.f_s;
        const double h = 1e-6;
        const auto difference = [&](double& value) {
            const double middle = value;
            value = middle + h;
            const Vector above = air.response();
            value = middle - h;
            const Vector below = air.response();
            value = middle;
            return Vector((above - below) / (2 * h));
        };
        // Forces and rates apart: their sizes differ.
        const auto check = [&](const Matrix& all, Eigen::Index column, double& value, double force, double rate) {
            const Vector expected = difference(value), mine = all.col(column);
            CAPTURE(column, skew == Skew::none, speed);
            CHECK((mine - expected).head(n).norm() < 2e-6 * expected.head(n).norm() + force);
            CHECK((mine - expected).tail(m).norm() < 2e-6 * expected.tail(m).norm() + rate);
        };
        const double force = 1e-8 * by_q.topRows(n).norm(), rate = 1e-8 * by_q.bottomRows(m).norm();
        for (Eigen::Index a = 0; a < n; ++a) {
            check(by_q, a, air.state().q(a), force, rate);
            check(by_qd, a, air.state().qd(a), force, rate);
        }
        for (Eigen::Index i = 0; i < m; i += 7)
            check(by_s, i, air.s(i), 1e-8 * by_s.topRows(n).norm(), 1e-8 * by_s.bottomRows(m).norm());
    }
}

TEST_CASE("lagging air on a machine: in equilibrium it is that without lags", "[crosscheck]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    for (const Skew skew : {Skew::none, Skew::pitt_peters}) {
        const MachineAir air = lagging_air_of(machine, skew, false);
        CHECK(air.states() == 3 * 17 * 4);
        Lagging lagging(machine, air);
        RotorAirOptions options;
        options.skew = skew;
        Lagging plain(machine, MachineAir(machine, nrel5mw_aero_blade(), sheared, options));
        const Eigen::Index n = lagging.state().q.size();
        const Vector own = lagging.response(), expected = plain.response();
        CHECK((own.head(n) - expected).norm() < 1e-10 * expected.norm());
        CHECK(own.tail(own.size() - n).norm() < 1e-9);
    }
}

// Of a wake that is out of equilibrium, with a constant time as large as that of the instant.
TEST_CASE("lagging air on a machine: the time constant of the instant is that of its induction and wind",
          "[crosscheck]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    const MachineAir air(machine, nrel5mw_aero_blade(), sheared);
    Lagging plain(machine, air);
    Lagging varying(machine, air.lagging({.dynamic_inflow = true}));
    for (const double speed : {1.1, 0.7, 1.6}) {
        plain.state().qd(machine.rotor().spin) = varying.state().qd(machine.rotor().spin) = speed;
        const double time = air.inflow_time_constant(plain.at());
        CHECK(time > 1);
        CHECK(time < 100);
        Lagging constant(machine, air.lagging({.dynamic_inflow = true, .inflow_time_constant = time}));
        constant.state().qd(machine.rotor().spin) = speed;
        constant.s = varying.s = 0.8 * varying.steady_states();
        const Vector own = varying.response(), expected = constant.response();
        CHECK((own - expected).norm() < 1e-12 * expected.norm());
        Lagging slower(machine, air.lagging({.dynamic_inflow = true, .inflow_time_constant = 2 * time}));
        slower.state().qd(machine.rotor().spin) = speed;
        slower.s = varying.s;
        const auto states = varying.s.size();
        CHECK((2 * slower.response().tail(states) - own.tail(states)).norm() < 1e-12 * own.tail(states).norm());
    }
}

TEST_CASE("lagging air on a machine: airfoils at rest have the loads of states that stay", "[crosscheck]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    const MachineAir air(machine, nrel5mw_aero_blade(), sheared);
    const std::vector<UnsteadyAirfoil> airfoils = nrel5mw_unsteady_airfoils();
    const MachineAir still = air.lagging({.airfoils = airfoils, .airfoils_at_rest = true});
    CHECK(still.states() == 0);
    Lagging at_rest(machine, still), lagging(machine, air.lagging({.airfoils = airfoils})), plain(machine, air);
    for (const double speed : {1.1, 0.3, 0.0, -0.5}) {
        for (Lagging* one : {&at_rest, &lagging, &plain}) one->state().qd(machine.rotor().spin) = speed;
        lagging.s = lagging.steady_states();
        const Vector own = at_rest.response(), expected = lagging.response().head(own.size());
        CHECK((own - expected).norm() < 1e-9 * expected.norm());
        // Blades are coned, and move.
        if (speed > 1) CHECK((own - plain.response()).norm() > 1e-4 * expected.norm());
    }
}

TEST_CASE("lagging air on a machine: a frozen wake holds the induced velocities", "[crosscheck]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    const MachineAir air(machine, nrel5mw_aero_blade(), sheared);
    Lagging plain(machine, air);
    const MachineAir frozen = air.with_frozen_wake(plain.at());
    CHECK(frozen.states() == 0);
    Lagging held(machine, frozen);
    CHECK((held.response() - plain.response()).norm() < 1e-10 * plain.response().norm());
    // Faster, each section has the induced velocity that it had.
    plain.state().qd(machine.rotor().spin) = held.state().qd(machine.rotor().spin) = 1.2;
    const auto before = air.sections(plain.at()), now = frozen.sections(held.at());
    held.state().qd(machine.rotor().spin) = 1.1;
    const auto first = frozen.sections(held.at());
    for (std::size_t i = 1; i + 1 < now[0].size(); ++i) {
        CHECK(now[0][i].induction.axial * now[0][i].V_x ==
              Approx(first[0][i].induction.axial * first[0][i].V_x).margin(1e-12));
        CHECK(now[0][i].induction.axial != before[0][i].induction.axial);
    }
}

TEST_CASE("lagging air on a machine: names and groups of the states; what is refused", "[property]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    Lagging air(machine, lagging_air_of(machine, Skew::none));
    const StateTable& states = air.forces().states();
    CHECK(states[states.index("blade 2 section 5 axial inflow")].blade == 2);
    CHECK(states.find("blade 1 section 1 axial inflow") < 0);         // no balance of momentum at the root
    CHECK(states.find("blade 1 section 2 point of separation") < 0);  // a cylinder
    CHECK(air.forces().state_groups().size() == 3 * 18);              // the tip's airfoil lags
    const MachineAir plain(machine, nrel5mw_aero_blade(), sheared);
    std::vector<UnsteadyAirfoil> one_state;
    for (const UnsteadyAirfoil& airfoil : nrel5mw_unsteady_airfoils())
        one_state.emplace_back(airfoil.polar(), airfoil.flow(), oye_lags);
    CHECK(plain.lagging({.airfoils = nrel5mw_unsteady_airfoils()}).states() ==
          4 * plain.lagging({.airfoils = one_state}).states());
    const Lagging oye(machine, plain.lagging({.airfoils = one_state}));
    CHECK(oye.forces().states()[0].name == "blade 1 section 5 point of separation");
    check_refused([&] { static_cast<void>(plain.lagging({.dynamic_inflow = true, .inflow_time_constant = -1})); },
                  {"time of the wake [s] = -1"});
    std::vector<UnsteadyAirfoil> few = nrel5mw_unsteady_airfoils();
    few.pop_back();
    check_refused([&] { static_cast<void>(plain.lagging({.airfoils = few})); }, {"number of airfoils = 7", "8"});
}

}  // namespace cardan::testing::air_lag_tests
