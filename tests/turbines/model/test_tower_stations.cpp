// Channels at stations of a uniform tower: deflection, rotation and moment of beam theory, also by its linear model.
#include "mbs/base/decompositions.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/model/station_channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

namespace cardan::testing::tower_stations {

using namespace turbines;

namespace {

constexpr double height = 60, EI = 2e9;

// A uniform tower with a small force at its top.
struct Cantilever {
    Turbine turbine;
    MachineState state;

    Cantilever(int elements, const Vec3& F) : turbine(made(elements, F)), state(turbine) {
        const solvers::SteadyState found = solvers::steady_state(turbine.system(), -1);
        REQUIRE(found.converged);
        state.q = found.at.q;
    }

private:
    static Turbine made(int elements, const Vec3& F) {
        TurbineDescription d = wt600_description();
        EngineeringSection section;
        section.mass = 900, section.EI_flap = section.EI_edge = EI;
        d.tower.line = uniform_beam(height, section);
        d.tower.first_mode_damping = 0;
        d.tower.damping = {};
        AssemblyOptions options;
        options.tower_beam = {.elements = elements, .torsion = false};
        const Turbine bare = isolated_tower(d, options);
        ForceSet forces = bare.forces();
        forces.add_wrench({"top", bare.layout().tower_top, {F, Vec3::Zero()}, WrenchAxes::base});
        return bare.with_forces(forces);
    }
};

// Of the groups at stations alone: a tower has no rotor, which others sample.
Sampled of_stations(const Cantilever& tower, const std::vector<double>& at) {
    return {tower.turbine.system(), turbines::station_channels(tower.turbine, {.tower = at}), tower.state};
}

double deflection(double F, double z) {
    return F * z * z * (3 * height - z) / (6 * EI);
}
double rotation(double F, double z) {
    return F * z * (2 * height - z) / (2 * EI);
}

}  // namespace

TEST_CASE("stations: a cantilever's deflection, rotation and moment at nodes are those of beam theory", "[analytic]") {
    const double F = 10;  // deflects by less than 1e-6 of the height
    for (const bool sideways : {false, true}) {
        const Cantilever tower(3, sideways ? Vec3(0, F, 0) : Vec3(F, 0, 0));
        const Sampled now = of_stations(tower, {20, 40, 60, 33.3});
        for (int i = 1; i <= 3; ++i) {
            const double z = 20. * i;
            const Vec3 d = now.vector(text("TwHt", i, "TD"), "t"), turn = now.vector(text("TwHt", i, "RD"), "t"),
                       force = now.vector(text("TwHt", i, "FL"), "t"), moment = now.vector(text("TwHt", i, "ML"), "t");
            CAPTURE(sideways, z);
            CHECK(d(sideways ? 1 : 0) == Approx(deflection(F, z)).epsilon(1e-6));
            CHECK(turn(sideways ? 0 : 1) == Approx((sideways ? -1 : 1) * rotation(F, z)).epsilon(1e-6));
            CHECK(force(sideways ? 1 : 0) == Approx(F).epsilon(1e-6));
            CHECK(moment(sideways ? 0 : 1) ==
                  Approx((sideways ? -1 : 1) * F * (height - z)).epsilon(1e-6).margin(1e-6));
        }
        CHECK(now[sideways ? "TwHt4MLxt" : "TwHt4MLyt"] ==
              Approx((sideways ? -1 : 1) * F * (height - 33.3)).epsilon(1e-6));
    }
}

TEST_CASE("stations: between nodes a cantilever's deflection is as close as the rigid segments, of second order",
          "[analytic]") {
    const double F = 10, z = 30;
    std::vector<double> errors;
    for (int elements : {1, 3, 9}) {  // in the middle of an element
        const Sampled now = of_stations(Cantilever(elements, Vec3(F, 0, 0)), {z});
        errors.push_back(now["TwHt1TDxt"] - deflection(F, z));
        const double h = height / elements, curvature = F * (height - z) / EI;
        CHECK(std::abs(errors.back()) < 0.022 * curvature * h * h);
        CHECK(std::abs(now["TwHt1RDyt"] - rotation(F, z)) < 0.29 * curvature * h);
    }
    CHECK(std::log(errors[0] / errors[1]) / std::log(3) == Approx(2).margin(0.1));
    CHECK(std::log(errors[1] / errors[2]) / std::log(3) == Approx(2).margin(0.1));
}

TEST_CASE("stations: in a linear model a force at the tower's top bends a station, statically, with its lever",
          "[analytic]") {
    const Cantilever tower(3, Vec3::Zero());
    const std::vector<solvers::LinearInput> inputs{
        solvers::LinearInput::force("push", tower.turbine.layout().tower_top, Vec3::UnitX(), WrenchAxes::base)};
    solvers::StateSpaceOptions options;
    options.outputs = {"TwHt1MLyt", "TwHt1FLxt", "TwHt2TDxt", "TwHt2RDyt", "TwHt1ALxt"};
    const solvers::LinearModel model =
        solvers::state_space(tower.turbine.system(), tower.turbine.rotor(), tower.state, inputs,
                             turbines::station_channels(tower.turbine, {.tower = {14, 40}}), options);
    REQUIRE(model.samples.size() == 1);
    const auto& [A, B, C, D] = static_cast<const solvers::StateMatrices&>(model.samples[0]);
    const Vector gain = D - C * A.partialPivLu().solve(B);
    CHECK(gain(0) == Approx(height - 14).epsilon(1e-6));
    CHECK(gain(1) == Approx(1).epsilon(1e-6));
    CHECK(gain(2) == Approx(deflection(1, 40)).epsilon(1e-6));
    CHECK(gain(3) == Approx(rotation(1, 40)).epsilon(1e-6));
    CHECK(std::abs(gain(4)) < 1e-9);
}

}  // namespace cardan::testing::tower_stations
