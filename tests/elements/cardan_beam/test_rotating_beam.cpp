// Rotating uniform cantilever through the whole chain: tree, steady state, linearisation, modes.
#include "tests/elements/cardan_beam/rotating_cantilever.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

FlapLag rotating(int elements, double eta, double delta, Partition partition, double hub_radius = 0) {
    return testing::rotating(eta, bending_only(elements, delta, partition), hub_radius);
}

}  // namespace

TEST_CASE("rotating cantilever: discrete flap and lag frequencies", "[discrete]") {
    constexpr auto S = Partition::static_moment;
    const auto check = [](const FlapLag& f, double flap, double lag) {
        CHECK(f.flap1 == Approx(flap).margin(1e-6).epsilon(0));
        CHECK(f.lag1 == Approx(lag).margin(1e-6).epsilon(0));
    };
    check(rotating(2, 3, 1. / 6, S), 4.802759, 3.750532);
    check(rotating(4, 3, 1. / 6, S), 4.797642, 3.743977);
    check(rotating(16, 3, 1. / 6, S), 4.797280, 3.743514);
    check(rotating(4, 12, 1. / 6, S), 13.198580, 5.495680);
    check(rotating(16, 12, 1. / 6, S), 13.170318, 5.427456);
    check(rotating(4, 3, delta_gauss, Partition::segment_masses), 4.805412, 3.753930);
}

TEST_CASE("rotating cantilever: converges to Wright et al. (1982), S with order 4, G with order 2", "[analytic]") {
    constexpr auto S = Partition::static_moment;
    struct Exact {
        double eta, flap1, flap2, flap3, lag1;
    };
    for (const Exact& e : {Exact{1, 3.6816468, 22.1810112, 61.8417626, 3.5432363},
                           Exact{3, 4.7972785, 23.3202637, 62.9849675, 3.7435119},
                           Exact{12, 13.1701505, 37.6031123, 79.6144785, 5.4270493}}) {
        const FlapLag n8 = rotating(8, e.eta, 1. / 6, S), n16 = rotating(16, e.eta, 1. / 6, S);
        CHECK(n16.flap1 == Approx(e.flap1).epsilon(2e-5));
        CHECK(n16.flap2 == Approx(e.flap2).epsilon(2e-4));
        CHECK(n16.flap3 == Approx(e.flap3).epsilon(6e-4));
        CHECK(order(n8.flap1, n16.flap1, e.flap1) == Approx(4).margin(0.25));
        CHECK(order(n8.lag1, n16.lag1, e.lag1) == Approx(4).margin(0.25));
        // lag^2 = flap^2 - eta^2 holds for every mode of the continuum, and exactly for the discrete model
        CHECK(n8.lag1 * n8.lag1 == Approx(n8.flap1 * n8.flap1 - e.eta * e.eta).epsilon(1e-9));
    }
    const auto n8 = rotating(8, 3, delta_gauss, Partition::segment_masses);
    const auto n16 = rotating(16, 3, delta_gauss, Partition::segment_masses);
    CHECK(order(n8.flap1, n16.flap1, 4.7972785) == Approx(2).margin(0.1));
}

TEST_CASE("rotating cantilever: hub radius 0.1", "[analytic]") {
    const auto f = rotating(16, 3, 1. / 6, Partition::static_moment, 0.1);
    CHECK(f.flap1 == Approx(4.9411499).epsilon(2e-5));
    CHECK(f.flap2 == Approx(23.4862903).epsilon(2e-4));
    CHECK(f.flap3 == Approx(63.1624397).epsilon(1e-3));
}
