// Joints that a machine does not have: left out, and the limit of very stiff ones.
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

namespace cardan::testing::rigid_joints {

using turbines::JointSupport;
using turbines::rigid_joint;
using D = turbines::TurbineDescription;

namespace {

template <class Change>
turbines::Turbine machine(Change change) {
    D d = turbines::wt600_description();
    change(d);
    return turbines::assemble(d, undamped());
}

template <class Change>
void check_limit(Change change, int fewer, double tolerance) {
    const turbines::Turbine rigid = machine([&](D&d) { change(d, [](JointSupport& b) { b = rigid_joint; }); }),
                            stiff = machine([&](D&d) { change(d, [](JointSupport& b) { b.stiffness *= 1e7; }); });
    CHECK(rigid.system().model.size() == 70 - fewer);
    const auto f = frequencies(rigid, 27 * rpm), g = frequencies(stiff, 27 * rpm);
    for (std::size_t i = 0; i < 12; ++i) CHECK(f.at(i) == Approx(g.at(i)).epsilon(tolerance));
}

}  // namespace

TEST_CASE("rigid joints: each is left out, and the machine is the limit of a very stiff joint", "[property]") {
    // Factors of ten million on the stiffness leave differences of the order of 1e-7.
    check_limit([](D& d, auto stiffen) { stiffen(d.yaw.translation); }, 2, 1e-6);
    check_limit([](D& d, auto stiffen) { stiffen(d.yaw.rotation); }, 1, 1e-6);
    check_limit([](D& d, auto stiffen) { stiffen(d.nacelle.tilt_bearing); }, 1, 1e-6);
    check_limit([](D& d, auto stiffen) { stiffen(d.drive_train.high_speed_shaft); }, 1, 1e-6);
    check_limit([](D& d, auto stiffen) { stiffen(d.drive_train.main_shaft); }, 1, 1e-6);
    check_limit([](D& d, auto stiffen) { stiffen(d.blade.pitch); }, 3, 1e-6);
}

TEST_CASE("rigid joints: a machine with none but its spin is tower and blades", "[property]") {
    const turbines::Turbine turbine = machine([](D& d) {
        d.yaw = {rigid_joint, rigid_joint};
        d.nacelle.tilt_bearing = d.drive_train.high_speed_shaft = d.drive_train.main_shaft = d.blade.pitch =
            rigid_joint;
    });
    CHECK(turbine.system().model.size() == 15 + 1 + 45);
    CHECK_FALSE(turbine.layout().yaw);
    CHECK(turbine.layout().azimuth == CoordinateSum{{*turbine.layout().generator, 1.0}});
    CHECK(frequencies(turbine, 27 * rpm).size() > 10);
}

TEST_CASE("rigid joints: a main shaft as a beam needs a stiffness", "[property]") {
    D d = turbines::wt600_description();
    d.drive_train.main_shaft = rigid_joint;
    turbines::AssemblyOptions options = undamped();
    options.shaft_beam = turbines::ShaftBeam{2e8};
    check_refused([&] { (void)turbines::assemble(d, options); }, {"600 kW", "main shaft", "rigid", "a spring"});
}

TEST_CASE("assembly: elements given in full take the place of the numbers of elements", "[property]") {
    turbines::AssemblyOptions options = undamped(), full = undamped(1);
    full.tower_beam = full.blade_beam = CardanBeamOptions{};
    CHECK(frequencies(turbines::wt600(full), 27 * rpm) == frequencies(turbines::wt600(options), 27 * rpm));
    full.blade_beam->damping = BeamDamping::ratio_at(0.01, 1);
    check_refused([&] { (void)turbines::wt600(full); }, {"damping", "blade", "description"});
    full.blade_beam->damping = {};
    full.tower_beam->elements = 2000;
    check_refused([&] { (void)turbines::wt600(full); }, {"number of elements = 2000", "1 ... 1000"});
}

TEST_CASE("assembly: damping of the description acts in the place of ratios of first modes, or beside them",
          "[property]") {
    D d = turbines::wt600_description(), none = d;
    none.blade.first_flap_damping = none.tower.first_mode_damping = 0;
    const auto first_ratio = [](const D& own) {
        const turbines::Turbine blade = turbines::isolated_blade(own, turbines::wt600_paper_assembly());
        const double at_rest[] = {0};
        const auto diagram = solvers::campbell(blade.system(), blade.rotor(), at_rest);
        return diagram.points[0].modes[0].mode.damping_ratio();
    };
    ModalRatios modes;
    modes.all = {0.02};
    CHECK(first_ratio(none) == Approx(0).margin(1e-12));
    none.blade.damping = d.blade.damping = BeamDamping::of_modes(modes);
    CHECK(first_ratio(none) == Approx(0.02).epsilon(1e-9));
    CHECK(first_ratio(d) == Approx(0.025).epsilon(1e-9));
}

}  // namespace cardan::testing::rigid_joints
