// Air that lags behind the motion: unsteady airfoils and dynamic inflow against AeroDyn's numbers.
#include "elements/aerodynamics/dynamic_inflow.hpp"
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/tables/csv.hpp"

#include <cmath>

namespace cardan::testing::unsteady_air_tests {

namespace {

using turbines::CsvTable;

CsvTable unsteady_reference(const std::string& name) {
    return CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/elements/aerodynamics/" + name);
}

// Of x' = f(t, x), by the classical method of Runge and Kutta in steps of at most `step`.
template <class State, class Rates>
State integrated(State x, double from, double to, double step, const Rates& f) {
    const int n = std::max(1, static_cast<int>(std::ceil((to - from) / step)));
    const double h = (to - from) / n;
    for (int i = 0; i < n; ++i) {
        const double t = from + i * h;
        const State k1 = f(t, x), k2 = f(t + h / 2, State(x + h / 2 * k1)), k3 = f(t + h / 2, State(x + h / 2 * k2)),
                    k4 = f(t + h, State(x + h * k3));
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return x;
}

UnsteadyAirfoil by_oye(const UnsteadyAirfoil& airfoil) {
    return {airfoil.polar(), airfoil.flow(), oye_lags};
}

}  // namespace

TEST_CASE("unsteady airfoils: separation at the points of the polars", "[discrete]") {
    const std::vector<UnsteadyAirfoil> airfoils = turbines::nrel5mw_unsteady_airfoils();
    const CsvTable table = unsteady_reference("separation.csv");
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const UnsteadyAirfoil& airfoil = airfoils[static_cast<std::size_t>(at("airfoil")) - 1];
        if (!airfoil.is_unsteady()) continue;
        const auto own = airfoil.separation(at("attack") * units::degree);
        CAPTURE(at("airfoil"), at("attack"));
        CHECK(own.f == Approx(at("f")).margin(3e-6));
        CHECK(own.lift == Approx(at("lift")).margin(3e-6));
    }
}

TEST_CASE("unsteady airfoils: loops of pitching airfoils, attached and stalled", "[discrete]") {
    const std::vector<UnsteadyAirfoil> airfoils = turbines::nrel5mw_unsteady_airfoils();
    const CsvTable table = unsteady_reference("aerodyn_unsteady_airfoil.csv");
    constexpr double speed = 50, chord = 3;
    REQUIRE(table.rows() == 5 * 24);
    UnsteadyAirfoil::States x;
    double time = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const UnsteadyAirfoil& airfoil = airfoils[static_cast<std::size_t>(at("airfoil")) - 1];
        const double mean = at("mean") * units::degree, amplitude = at("amplitude") * units::degree,
                     frequency = 2 * speed * at("reduced_frequency") / chord;
        if (i % 24 == 0) {
            time = 0;
            x = airfoil.steady({mean, speed, 0, chord});
        }
        x = integrated(x, time, at("time"), 1e-3, [&](double t, const UnsteadyAirfoil::States& now) {
            return airfoil.rates(now, {mean + amplitude * std::sin(frequency * t), speed,
                                       amplitude * frequency * std::cos(frequency * t), chord});
        });
        time = at("time");
        const auto own = airfoil.coefficients(x, {at("attack") * units::degree, speed, at("rate"), chord});
        CAPTURE(i, time);
        // 16 bit of output.
        CHECK(own.lift == Approx(at("lift")).margin(1.5e-5));
        CHECK(own.drag == Approx(at("drag")).margin(5e-6));
        CHECK(own.moment == Approx(at("moment")).margin(2e-6));
    }
}

TEST_CASE("unsteady airfoils: at rest they are steady, and their table's where f makes up its lift", "[property]") {
    const std::vector<UnsteadyAirfoil> airfoils = turbines::nrel5mw_unsteady_airfoils();
    for (const UnsteadyAirfoil& airfoil : {airfoils.back(), by_oye(airfoils.back())}) {
        for (const double degrees : {-4.0, 0.0, 5.0, 9.0, 14.0, 20.0}) {
            const AirfoilMotion motion{degrees * units::degree, 60, 0, 2};
            const auto x = airfoil.steady(motion);
            CHECK(airfoil.rates(x, motion).norm() < 1e-12);
            const auto own = airfoil.coefficients(x, motion);
            const Polar::Point table = airfoil.polar().at(motion.attack);
            CHECK(own.lift == Approx(table.lift).margin(1e-12));
            CHECK(own.drag == Approx(table.drag).margin(1e-12));
            CHECK(own.moment == Approx(table.moment).margin(1e-12));
        }
        // In steady rotation about the span too.
        const AirfoilMotion turning{0.1, 60, 0.4, 2};
        CHECK(airfoil.rates(airfoil.steady(turning), turning).norm() < 1e-12);
    }
}

TEST_CASE("unsteady airfoils: by Oye the point of separation follows a step of the angle exponentially", "[analytic]") {
    const UnsteadyAirfoil airfoil = by_oye(turbines::nrel5mw_unsteady_airfoils()[6]);
    CHECK(airfoil.own_states() == 1);
    constexpr double speed = 60, chord = 2.4, lag = 6 * chord / (2 * speed);
    const AirfoilMotion before{6 * units::degree, speed, 0, chord}, after{16 * units::degree, speed, 0, chord};
    const double from = airfoil.separation(before.attack).f, to = airfoil.separation(after.attack).f;
    REQUIRE(from - to > 0.3);
    UnsteadyAirfoil::States x = airfoil.steady(before);
    double time = 0;
    for (const double next : {0.05, 0.12, 0.3, 0.8}) {
        x = integrated(x, time, next, 1e-3,
                       [&](double, const UnsteadyAirfoil::States& now) { return airfoil.rates(now, after); });
        time = next;
        const double f = to + (from - to) * std::exp(-time / lag);
        CHECK(x(UnsteadyAirfoil::separation_point) == Approx(f).margin(1e-9));
        CHECK(x.head<3>().norm() == 0);
        const double attached = airfoil.flow().slope * (after.attack - airfoil.flow().zero_lift);
        const auto own = airfoil.coefficients(x, after);
        CHECK(own.lift == Approx(f * attached + (1 - f) * airfoil.separation(after.attack).lift).margin(1e-9));
        CHECK(own.drag == Approx(airfoil.polar().at(after.attack).drag));
    }
    // The angle is that at three quarters of the chord, and the rate acts in no other way.
    const double rate = 0.7, beside = std::atan2(speed * std::sin(0.1) + rate * chord / 2, speed * std::cos(0.1));
    const AirfoilMotion turning{0.1, speed, rate, chord}, still{beside, speed, 0, chord};
    CHECK(airfoil.coefficients(x, turning).lift == Approx(airfoil.coefficients(x, still).lift).margin(1e-12));
    CHECK(airfoil.coefficients(x, turning).moment == Approx(airfoil.coefficients(x, still).moment).margin(1e-12));
}

TEST_CASE("unsteady airfoils: derivatives are those of rates and coefficients", "[property]") {
    const std::vector<UnsteadyAirfoil> airfoils = turbines::nrel5mw_unsteady_airfoils();
    Random random(3);
    for (int i = 0; i < 400; ++i) {
        const UnsteadyAirfoil airfoil = i % 2 == 0 ? airfoils[6] : by_oye(airfoils[6]);
        const AirfoilMotion motion{uniform(random, -0.9, 0.9), uniform(random, 20, 80), uniform(random, -1, 1), 2.5};
        UnsteadyAirfoil::States x = airfoil.steady(motion);
        for (int k = 0; k < 3; ++k) x(k) += uniform(random, -0.05, 0.05);
        x(3) = uniform(random, 0.1, 0.9);
        const auto slopes = airfoil.slopes(x, motion);
        const auto moved = [&](int column, double h) {
            AirfoilMotion other = motion;
            UnsteadyAirfoil::States y = x;
            if (column < UnsteadyAirfoil::states) y(column) += h;
            if (column == UnsteadyAirfoil::Slopes::attack) other.attack += h;
            if (column == UnsteadyAirfoil::Slopes::speed) other.speed += h;
            if (column == UnsteadyAirfoil::Slopes::rate) other.rate += h;
            const auto c = airfoil.coefficients(y, other);
            Eigen::Matrix<double, 7, 1> out;
            out << airfoil.rates(y, other), c.lift, c.drag, c.moment;
            return out;
        };
        for (int column = 0; column < UnsteadyAirfoil::Slopes::columns; ++column) {
            constexpr double h = 1e-7;
            const Eigen::Matrix<double, 7, 1> above = (moved(column, h) - moved(column, 0)) / h,
                                              below = (moved(column, 0) - moved(column, -h)) / h;
            if ((above - below).norm() > 1e-3 * (1 + above.norm())) continue;  // at a point of a table
            Eigen::Matrix<double, 7, 1> own;
            own << slopes.rates.col(column), slopes.coefficients.col(column);
            CAPTURE(i, column);
            CHECK((own - (above + below) / 2).norm() < 1e-5 * (1 + own.norm()));
        }
    }
}

TEST_CASE("unsteady airfoils: what is refused", "[validation]") {
    const Polar polar = turbines::nrel5mw_aero_blade().polars.back();
    check_refused([&] { UnsteadyAirfoil(polar, {.slope = -1}); }, {"airfoil 8", "slope", "-1"});
    check_refused([&] { UnsteadyAirfoil(polar, {.slope = 6, .upper = -0.2, .lower = 0.1}); }, {"lower [rad] = 0.1"});
    check_refused([&] { UnsteadyAirfoil(polar, {.slope = 6}, {.b1 = 0}); }, {"b1 = 0"});
}

TEST_CASE("dynamic inflow: a step of the pitch of a rigid rotor", "[discrete]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    const CsvTable table = unsteady_reference("aerodyn_dynamic_inflow.csv");
    constexpr double wind = 10, speed = 11.431 * units::rpm;
    const std::size_t n = blade.sections();
    const double R = blade.position.back();
    std::vector<double> shares(n);
    for (std::size_t i = 0; i < n; ++i) shares[i] = blade.position[i] / R;
    using All = Eigen::Matrix<double, DynamicInflow::states, Eigen::Dynamic>;

    struct Instant {
        std::vector<Annulus> annuli;
        std::vector<Induction> steady;
    };
    const auto instant = [&](double pitch) {
        Instant out;
        for (std::size_t i = 0; i < n; ++i) {
            out.annuli.push_back(blade.annulus(i, 3));
            out.annuli.back().angle += pitch;
            out.steady.push_back(solve_induction(out.annuli[i], wind, speed * blade.position[i]));
        }
        return out;
    };
    const std::vector<double> weights = inflow_weights(shares);
    const auto times_of = [&](const Instant& now, double constant) {
        double mean = 0;
        for (std::size_t i = 0; i < n; ++i) mean += weights[i] * now.steady[i].axial;
        return constant > 0 ? constant : inflow_time(R, mean, wind);
    };
    // Loads between the sections are linear.
    const auto rotor = [&](const Instant& now, const All& x) {
        std::vector<SectionForce> f;
        for (std::size_t i = 0; i < n; ++i) {
            const double V_y = speed * blade.position[i];
            const Induction own = DynamicInflow::induction(x.col(static_cast<Eigen::Index>(i)), wind, V_y);
            f.push_back(section_force(now.annuli[i], wind, V_y, own, 1.225));
        }
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();  // thrust, torque
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const double r = blade.position[i], h = blade.position[i + 1] - r;
            sum(0) += 3 * h * (f[i].normal + f[i + 1].normal) / 2;
            sum(1) += 3 * h * (f[i].driving * (r / 2 + h / 6) + f[i + 1].driving * (r / 2 + h / 3));
        }
        return sum;
    };

    struct Case {
        int mod;
        double constant, tolerance;
    };
    for (const Case& one : {Case{2, 0, 4e-5}, {3, 4, 4e-5}, {3, 8, 4e-5}, {1, 4, 2e-4}}) {
        const int mod = one.mod;
        const double constant = one.constant, tolerance = one.tolerance;
        const auto pitch_at = [](double t) { return 2 * units::degree * std::clamp((t - 10) / 0.2, 0.0, 1.0); };
        All x(DynamicInflow::states, static_cast<Eigen::Index>(n));
        const Instant start = instant(0);
        for (std::size_t i = 0; i < n; ++i)
            x.col(static_cast<Eigen::Index>(i)) =
                DynamicInflow::steady(DynamicInflow::velocity(start.steady[i], wind, speed * blade.position[i]));
        double time = 0;
        int compared = 0;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const auto at = [&](const char* name) { return table.column(name)[row]; };
            if (at("dbemt_mod") != mod || (constant > 0 && at("tau1") != constant)) continue;
            const auto rates = [&](double t, const All& now) {
                const Instant here = instant(pitch_at(t));
                const double tau = times_of(here, constant);
                All out(now.rows(), now.cols());
                for (std::size_t i = 0; i < n; ++i) {
                    const auto k = static_cast<Eigen::Index>(i);
                    out.col(k) = DynamicInflow::rates(
                        now.col(k), DynamicInflow::velocity(here.steady[i], wind, speed * blade.position[i]),
                        inflow_times(tau, shares[i]));
                }
                return out;
            };
            // Nothing moves before the step; the kinks of the ramp are at its rows.
            if (at("time") > 9.98) x = integrated(x, std::max(time, 10.0), at("time"), 0.05, rates);
            time = at("time");
            const Instant now = instant(at("pitch") * units::degree);
            const Eigen::Vector2d own = rotor(now, x);
            CAPTURE(mod, constant, time);
            CHECK(own(0) == Approx(at("thrust")).epsilon(tolerance));
            CHECK(own(1) == Approx(at("torque")).epsilon(2 * tolerance));
            // AeroDyn's is that of the step before, by 0.02 s.
            if (mod == 2 && time > 9)
                CHECK(times_of(instant(pitch_at(time - 0.02)), 0) == Approx(at("tau1")).epsilon(1e-5));
            ++compared;
        }
        CHECK(compared == 17);
    }
}

TEST_CASE("dynamic inflow: the mean induction without a section near 70 % is that of the nearest", "[analytic]") {
    CHECK(inflow_weights(std::array{0.2, 0.55, 0.9, 0.55}) == std::vector{0.0, 0.5, 0.0, 0.5});
    CHECK(inflow_weights(std::array{0.65, 0.75})[1] == Approx(0.5));
    CHECK(inflow_time(60, 0.3, 0) == 100);
    CHECK(inflow_time(60, 0.9, 10) == Approx(66 / (0.35 * 10)));
}

}  // namespace cardan::testing::unsteady_air_tests
