// Operating points in the wind, against ElastoDyn with AeroDyn; one solver against the other; the law of operation.
#include "mbs/base/units.hpp"
#include "solvers/linear/channel_values.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/iea22_rotor.hpp"
#include "tests/turbines/operation/level_machine.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/operation/wind_operation.hpp"
#include "turbines/tables/csv.hpp"

#include <map>

namespace cardan::testing::wind_operation_tests {

namespace {

using namespace turbines;

// Static deflection of the tower's top by the thrust at the hub, as a beam: int M (L - z) / EI dz, closed form of
// nothing but the table.
double tower_deflection(double thrust) {
    const BeamLine line = level_machine().tower.line;
    const double hub = 90;
    double sum = 0;
    constexpr int steps = 4000;
    const double h = line.length / steps;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) * h;
        sum += h * thrust * (hub - z) * (line.length - z) * line.section(z).compliance(5, 5);
    }
    return sum;
}

// Mean of channels over a revolution, by their names in OpenFAST.
std::map<std::string, double> means(const WindOperation& machine, const WindOperatingPoint& point) {
    const Turbine turbine = machine.machine(point.operation);
    const std::vector<ChannelGroup> groups = channels(turbine);
    solvers::ChannelValues values(turbine.system(), groups);
    std::map<std::string, double> out;
    for (const DynamicState& state : point.revolution) {
        const std::vector<double>& row = values.at(state);
        std::size_t next = 0;
        for (const ChannelGroup& group : groups)
            for (const Channel& channel : group.channels)
                out[channel.alias] += row[next++] / static_cast<double>(point.revolution.size());
    }
    return out;
}

CsvTable elastodyn() {
    return CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/turbines/operation/elastodyn_steady.csv");
}

}  // namespace

// What keeps the two apart, found by experiments on the model (docs/aerodynamics.md): AeroDyn's axes leave out the
// sweep of a bent section, which changes the angle of attack by the product of its two slopes (with such axes power
// agrees to 1e-4 at 11 m/s); ElastoDyn's three shapes of a blade give 0.977 and 0.943 of the static deflection of the
// same beam out of and in the plane, its two shapes of the tower 0.936.
TEST_CASE("operation in the wind: the level machine against ElastoDyn and AeroDyn", "[discrete]") {
    WindOperationOptions options;
    options.air.skew = Skew::none;
    options.harmonics = 2;  // the tower's bending tilts the rotor a little
    WindOperation machine(level_machine(), nrel5mw_assembly(Nrel5mwVariant::fast, 8, 4), nrel5mw_aero_blade(), options);
    const CsvTable table = elastodyn();
    int compared = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        if (at("tilt") != 0) continue;
        const WindOperatingPoint point =
            machine.at({at("wind"), at("rotor_speed") * units::rpm, at("pitch") * units::degree});
        CAPTURE(at("wind"), point.message);
        REQUIRE(point.converged);
        auto mean = means(machine, point);
        CHECK(point.power / 1e3 == Approx(at("power")).epsilon(0.01));
        CHECK(point.thrust / 1e3 == Approx(at("thrust")).epsilon(0.012));
        CHECK(mean["OoPDefl1"] == Approx(at("out_of_plane")).epsilon(0.02));
        CHECK(mean["IPDefl1"] == Approx(at("in_plane") / 0.943).epsilon(0.04));
        CHECK(mean["TTDspFA"] == Approx(at("tower_fore_aft") / 0.936).epsilon(0.012));
        CHECK(mean["TTDspFA"] == Approx(tower_deflection(point.thrust)).epsilon(0.01));
        CHECK(mean["RootMyc1"] / 1e3 == Approx(at("root_moment_y")).epsilon(0.02));
        CHECK(mean["RootMxc1"] / 1e3 == Approx(at("root_moment_x")).epsilon(0.02));
        ++compared;
    }
    CHECK(compared == 5);
}

TEST_CASE("operation in the wind: a constant state is the same by harmonic balance", "[crosscheck]") {
    TurbineDescription description = level_machine();
    description.tower.rigid = true;
    const AssemblyOptions assembly = nrel5mw_assembly(Nrel5mwVariant::fast, 3, 1);
    WindOperation constant(description, assembly, nrel5mw_aero_blade());
    WindOperationOptions options;
    options.harmonics = 2;
    options.azimuths = 3;
    options.wind.shear = Shear::power;
    options.wind.exponent = 1e-14;  // nothing changes but the solver
    WindOperation periodic(description, assembly, nrel5mw_aero_blade(), options);
    REQUIRE(!periodic.is_constant());
    const Operation operation{8, 9.156 * units::rpm, 0.02};
    const WindOperatingPoint a = constant.at(operation), b = periodic.at(operation);
    REQUIRE(a.converged);
    CAPTURE(b.message);
    REQUIRE(b.converged);
    CHECK(b.power == Approx(a.power).epsilon(1e-8));
    CHECK(b.thrust == Approx(a.thrust).epsilon(1e-8));
    CHECK(b.sections[9].attack == Approx(a.sections[9].attack).epsilon(1e-7));
    CHECK(a.sections[9].position == Approx(nrel5mw_aero_blade().position[9]));
}

TEST_CASE("operation in the wind: a tower that changes the wind makes states periodic, its drag does not",
          "[property]") {
    TurbineDescription description = level_machine();
    description.tower.rigid = true;
    const AssemblyOptions assembly = nrel5mw_assembly(Nrel5mwVariant::fast, 3, 1);
    WindOperationOptions options;
    options.harmonics = 3;
    options.azimuths = 80;  // 240 of a blade: the influence is narrow
    options.support.tower = {.height = {0, 87.6}, .diameter = {6, 3.87}, .drag = {1, 1}};
    WindOperation dragged(description, assembly, nrel5mw_aero_blade(), options);
    CHECK(dragged.is_constant());
    options.support.tower.influence = TowerInfluence::potential;
    WindOperation influenced(description, assembly, nrel5mw_aero_blade(), options);
    REQUIRE(!influenced.is_constant());
    const Operation operation{8, 9.156 * units::rpm, 0.02};
    const WindOperatingPoint a = dragged.at(operation), b = influenced.at(operation);
    REQUIRE(a.converged);
    CAPTURE(b.message);
    REQUIRE(b.converged);
    // On a line across the wind what the flow around the tower takes before the tower it gives beside it: the integral
    // of (y^2 - x^2)/(x^2 + y^2)^2 over y vanishes. Powers of the wind are left.
    CHECK(b.power == Approx(a.power).epsilon(0.005));
    CHECK(b.power != a.power);
    CHECK(b.sections[9].normal == Approx(a.sections[9].normal).epsilon(0.005));
}

// A wake is a few degrees wide. Both laws carry the drag of the tower, so that both cost the same power as long as the
// deficit is small: half of it is not in the cosine's tail, and the rotor is no line across the wind.
TEST_CASE("operation in the wind: what the tower's wake costs a downwind rotor", "[property]") {
    TurbineDescription description = level_machine();
    description.tower.rigid = true;
    description.nacelle.overhang *= -1;
    const AssemblyOptions assembly = nrel5mw_assembly(Nrel5mwVariant::fast, 3, 1);
    const Operation operation{8, 9.156 * units::rpm, 0.02};
    const auto power = [&](TowerShadow shadow, int azimuths) {
        WindOperationOptions options;
        options.harmonics = 3;
        options.azimuths = azimuths;
        options.support.tower = {
            .height = {0, 87.6}, .diameter = {6, 3.87}, .drag = {0.2, 0.2}, .turbulence = {0.2, 0.2}, .shadow = shadow};
        const WindOperatingPoint point =
            WindOperation(description, assembly, nrel5mw_aero_blade(), options).at(operation);
        CAPTURE(point.message);
        REQUIRE(point.converged);
        return point.power;
    };
    const double open = power(TowerShadow::none, 1), powles = power(TowerShadow::powles, 24),
                 eames = power(TowerShadow::eames, 24);
    CHECK(open - powles > 0.003 * open);
    CHECK(open - eames == Approx(open - powles).epsilon(0.1));
    // As many azimuths are taken as it needs, whatever is asked for.
    CHECK(power(TowerShadow::powles, 720) == Approx(powles).epsilon(1e-4));
    CHECK(power(TowerShadow::eames, 720) == Approx(eames).epsilon(1e-4));
}

TEST_CASE("operation in the wind: best tip-speed ratio, limits of speed and power", "[property]") {
    const AeroBlade blade = nrel5mw_aero_blade();
    const double best = best_tip_speed_ratio(blade, 3, 0, 0);
    const auto coefficient = [&](double ratio) {
        const double speed = ratio * 8 / 63;
        return rigid_rotor_air(blade, {}, {.speed = 8}, speed, 0, 0).moment.x() * speed;
    };
    CHECK(best == Approx(7.55).margin(0.3));  // 7.55 in the machine's report
    CHECK(coefficient(best) >= coefficient(best - 0.01));
    CHECK(coefficient(best) >= coefficient(best + 0.01));

    TurbineDescription description = level_machine();
    description.tower.rigid = true;
    WindOperation machine(description, nrel5mw_assembly(Nrel5mwVariant::fast, 3, 1), blade);
    REQUIRE(machine.is_constant());
    const VariableSpeed law{.tip_speed_ratio = best,
                            .min_rotor_speed = 6.9 * units::rpm,
                            .rated_speed = 12.1 * units::rpm,
                            .rated_power = 5.2966e6};
    const std::vector<WindOperatingPoint> points = machine.over(std::vector<double>{4, 8, 11, 12, 15, 24}, law);
    for (const WindOperatingPoint& point : points) {
        CAPTURE(point.operation.wind, point.message);
        REQUIRE(point.converged);
        CHECK(point.power <= law.rated_power * (1 + 2e-6));
        CHECK(point.operation.rotor_speed >= law.min_rotor_speed * (1 - 1e-12));
        if (point.operation.pitch > 0) CHECK(point.power == Approx(law.rated_power).epsilon(2e-6));
    }
    CHECK(points[0].operation.rotor_speed == Approx(law.min_rotor_speed));
    CHECK(points[1].tip_speed_ratio == Approx(best));
    CHECK(points[3].operation.pitch > 0);
    CHECK(points[5].operation.pitch > points[4].operation.pitch);
    // Downward from the high winds it comes to the same.
    const WindOperatingPoint back = machine.at(12, law);
    REQUIRE(back.converged);
    CHECK(back.operation.pitch == Approx(points[3].operation.pitch).epsilon(1e-4));
}

TEST_CASE("operation in the wind: schedules, what is refused", "[validation]") {
    const std::vector<Operation> schedule{{4, 0.7, 0.01}, {8, 0.9, 0.0}};
    const Operation between = operation_at(schedule, 5);
    CHECK(between.rotor_speed == Approx(0.75));
    CHECK(between.pitch == Approx(0.0075));
    CHECK(operation_at(schedule, 8).rotor_speed == Approx(0.9));
    check_refused([&] { operation_at(schedule, 9); }, {"wind speed [m/s] = 9", "4 ... 8"});
    check_refused([] { operation_at({}, 9); }, {"number of rows"});
    check_refused([] { operation_at({{5, 1, 0}, {4, 1, 0}}, 4.5); }, {"wind speed [m/s] = 4", "ascending"});
    check_refused([] { VariableSpeed{.tip_speed_ratio = 7, .rated_speed = 1}.check(); }, {"rated power [W] = 0"});
    check_refused(
        [] { VariableSpeed{.tip_speed_ratio = 7, .min_rotor_speed = 2, .rated_speed = 1, .rated_power = 1}.check(); },
        {"minimum rotor speed [rad/s] = 2"});
}

TEST_CASE("operation in the wind: tilt and gravity against ElastoDyn and AeroDyn", "[discrete][slow]") {
    TurbineDescription description = nrel5mw_description(nrel5mw_options(Nrel5mwVariant::fast));
    description.yaw.rotation = description.drive_train.main_shaft = rigid_joint;
    AssemblyOptions assembly = nrel5mw_assembly(Nrel5mwVariant::fast, 8, 4);
    assembly.gravity = nrel5mw_gravity;
    WindOperationOptions options;
    options.air.skew = Skew::none;
    WindOperation machine(description, assembly, nrel5mw_aero_blade(), options);
    const CsvTable table = elastodyn();
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        if (at("tilt") == 0) continue;
        const WindOperatingPoint point =
            machine.at({at("wind"), at("rotor_speed") * units::rpm, at("pitch") * units::degree});
        CAPTURE(at("wind"), point.message);
        REQUIRE(point.converged);
        auto mean = means(machine, point);
        CHECK(point.power / 1e3 == Approx(at("power")).epsilon(0.012));
        CHECK(mean["OoPDefl1"] == Approx(at("out_of_plane")).epsilon(0.02));
        CHECK(mean["TTDspFA"] == Approx(at("tower_fore_aft") / 0.936).epsilon(0.03));
        CHECK(mean["RootMyc1"] / 1e3 == Approx(at("root_moment_y")).epsilon(0.02));
    }
}

// The public model itself is not part of these sources: CARDAN_MODELS names a folder that holds its repository.
TEST_CASE("operation in the wind: IEA 22 MW machine from its files against OpenFAST and HAWC2", "[discrete][.models]") {
    const std::optional<Iea22Rotor> rotor = iea22_rotor();
    if (!rotor) return;
    const AeroDynFile& air = rotor->air;
    AssemblyOptions assembly;
    assembly.blade_beam = CardanBeamOptions{.elements = 10, .partition = Partition::mean_difference, .extension = true};
    WindOperationOptions options;
    options.air = air.options;
    options.wind.density = air.density;
    WindOperation machine(rotor->description, assembly, air.blade, options);
    const CsvTable table =
        CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/turbines/operation/iea22_steady.csv");
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const WindOperatingPoint point =
            machine.at({at("wind"), at("rotor_speed") * units::rpm, at("pitch") * units::degree});
        CAPTURE(at("program"), at("wind"), point.message);
        REQUIRE(point.converged);
        const Turbine turbine = machine.machine(point.operation);
        const Model& model = turbine.system().model;
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, point.revolution.front().q, workspace);
        const Pose<double> root = pose(kin, turbine.layout().blade_roots[0]),
                           tip = pose(kin, turbine.layout().blades[0].tip());
        const BeamLine& line = turbine.layout().blades[0].line;
        const double moved = (root.R.transpose() * (tip.p - root.p) - line.pose(line.length).p).z();
        const bool openfast = at("program") == 1;
        CHECK(point.power == Approx(at("power")).epsilon(openfast ? 0.01 : 0.035));
        CHECK(point.thrust == Approx(at("thrust")).epsilon(openfast ? 0.005 : 0.035));
        CHECK(std::abs(moved - at("tip_x")) < (openfast ? 0.12 : 0.4));
    }
}

}  // namespace cardan::testing::wind_operation_tests
