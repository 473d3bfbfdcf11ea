// Blades that are held: as they are at rest, whatever their sections, and in the wind those of a rigid rotor.
#include "mbs/base/outcome.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/aerodynamics/field_at_state.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/openfast.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

namespace cardan::testing::rigid_blades {

namespace {

using namespace turbines;

struct Case {
    TurbineDescription description;
    AssemblyOptions options;
    AeroBlade air;
    double speed;  // rad/s
};

// Sections as 6 x 6 matrices, with torsion, extension, shear and what couples them: of BeamDyn's files, and built in.
Case small_beamdyn(bool straight) {
    const test::ModelFolder model("openfast");
    if (straight)
        for (const char* key_point :
             {"   -0.0200      0.0100", "   -0.0800      0.0500", "   -0.2000      0.1400", "   -0.4000      0.3000"})
            model.replace("small_BeamDyn.dat", key_point, "    0.0000      0.0000");
    Case out{read_openfast(model / "small_BeamDyn.fst").description, {}, {}, 4.2};
    out.description.blade.pitch = rigid_joint;
    out.air = read_aerodyn(test::data_file("aerodyn/small_AeroDyn.dat"), out.description.hub.radius).blade;
    out.options.blade_beam = {.elements = 4, .partition = Partition::mean_difference, .extension = true};
    return out;
}
Case nrel5mw_matrices() {
    Case out{nrel5mw_description(nrel5mw_options(Nrel5mwVariant::beamdyn)), {}, nrel5mw_aero_blade(), 1.1};
    out.options = nrel5mw_assembly(Nrel5mwVariant::beamdyn, 4, 2);
    if (!out.options.blade_beam) out.options.blade_beam = {.elements = 4};
    out.options.blade_beam->extension = true;
    return out;
}

// Of the tip against the root, beyond what it is at rest: turn, rad, and displacement, m.
std::pair<double, double> deflection(const Turbine& machine, const Vector& q) {
    const CardanBeam& blade = machine.layout().blades[0];
    Workspace workspace(machine.system().model);
    const Kinematics kin = kinematics(machine.system().model, q, workspace);
    const Pose<double> root = pose(kin, machine.layout().blade_roots[0]), tip = pose(kin, blade.tip());
    const Placement rest = blade.line.pose(blade.line.length);
    return {(root.R.transpose() * tip.R - rest.R).norm(), (root.R.transpose() * (tip.p - root.p) - rest.p).norm()};
}

}  // namespace

TEST_CASE("rigid blades: no load turns, bends or stretches them", "[analytic]") {
    for (Case own : {small_beamdyn(false), nrel5mw_matrices()}) {
        CAPTURE(own.description.name);
        for (const bool held : {true, false}) {
            if (held) own.options.blade_beam->hold_all();
            if (!held) own.options.blade_beam = {.elements = 4, .extension = true};
            own.description.tower.rigid = true;
            own.description.nacelle.tilt = 0;  // so that what acts does not change within a revolution
            const Turbine machine = assemble(own.description, own.options);
            const Turbine windy = MachineAir(machine, own.air, SteadyWind{.speed = 9}).on(machine);
            const solvers::SteadyState state =
                solvers::steady_state(windy.system(), windy.rotor().spin, {.rotor_speed = own.speed});
            require_result(state);
            const auto [turn, displacement] = deflection(windy, state.at.q);
            CAPTURE(held, turn, displacement);
            if (held) {
                CHECK(turn < 1e-14);
                CHECK(displacement < 1e-12 * windy.layout().blades[0].line.length);
                CHECK(windy.warnings().empty());  // of what is lost where beams bend
            } else {
                CHECK(turn > 1e-3);
            }
        }
    }
}

// On straight axes: a rigid rotor knows no others.
TEST_CASE("rigid blades: in the wind they are those of a rigid rotor", "[crosscheck]") {
    for (Case own : {small_beamdyn(true), nrel5mw_matrices()}) {
        CAPTURE(own.description.name);
        TurbineDescription& d = own.description;
        own.options.blade_beam->hold_all();
        own.options.pitch = 0.03;
        d.tower.rigid = true;
        d.nacelle.tilt = 0;
        d.individual_blades.clear();
        own.air.prebend.assign(own.air.sections(), 0);
        own.air.sweep = own.air.prebend;
        const Turbine machine = assemble(d, own.options);
        const SteadyWind wind{.speed = 9};
        const MachineAir air(machine, own.air, wind);
        const solvers::SteadyState state =
            solvers::steady_state(air.on(machine).system(), machine.rotor().spin, {.rotor_speed = own.speed});
        require_result(state);
        Workspace workspace(machine.system().model);
        const Kinematics kin = kinematics(machine.system().model, state.at.q, workspace);
        const Pose<double> hub = pose(kin, machine.layout().rotor_centre);
        const RotorPose rotor{.tilt = d.nacelle.tilt, .cone = d.blade.cone, .hub = hub.p};
        // The shaft twists: the rotor stands a little ahead or behind, which nothing here depends on but the tilt.
        const Vec3 up = hub.R.col(0), axis = hub.R.col(2);
        const Mat3 shaft = rot_y(d.nacelle.tilt);
        const double azimuth = std::atan2(-(shaft.transpose() * up).y(), (shaft.transpose() * up).z());
        CHECK((axis - shaft.col(0)).norm() < 1e-12);
        const RotorAir expected = rigid_rotor_air(own.air, rotor, wind, own.speed, azimuth, own.options.pitch);
        const MachineAir::Rotor found = air.rotor(StateView(state.at, kin));
        CHECK(found.moment.x() == Approx(expected.moment.x()).epsilon(1e-9));
        CHECK((found.force - expected.force).norm() < 1e-9 * expected.force.norm());
    }
}

}  // namespace cardan::testing::rigid_blades
