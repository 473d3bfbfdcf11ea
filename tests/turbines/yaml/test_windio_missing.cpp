// windIO files without what design programs compute: masses of hub and nacelle, sections of the blade, whole
// components.
//
// References: frequencies of uniform cantilevers (Euler and Bernoulli); the same machine with all that it has.
#include "elements/sections/beam_line.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/yaml/windio.hpp"

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::message_of;

namespace cardan::testing::windio_missing {

namespace {

using Part = MissingEntry::Part;

std::string bare() {
    return test::data_file("windio/bare_v2.yaml");
}

// First frequency of a cantilever, Hz (S. S. Rao, Mechanical Vibrations: beta L = 1.875104).
double cantilever_hz(double EI, double mass, double length) {
    return std::pow(1.87510407 / length, 2) * std::sqrt(EI / mass) / (2 * pi);
}

const ModelAddition masses{
    "components: {hub: {elastic_properties: {mass: 18000}}, drivetrain: {elastic_properties: {mass: 80000}}}",
    "masses"};

}  // namespace

TEST_CASE("windio: a model without the masses of hub and nacelle is read, and says what it lacks and how it is given",
          "[property]") {
    const TurbineDescription d = read_windio(bare()).description;
    const std::string words =
        "the model lacks: mass of the hub; mass of nacelle and drive train; remedy: --set "
        "components.hub.elastic_properties.mass=MASS_kg --set components.drivetrain.elastic_properties.mass=MASS_kg";
    CHECK(in_words(d.missing) == words);
    CHECK(d.has(Part::blade));
    CHECK(d.has(Part::tower));
    CHECK_FALSE(d.has(Part::hub));
    CHECK_FALSE(d.has(Part::nacelle));
    const std::string refusal = text(bare(), ": fictitious machine without masses: ", words);
    CHECK(message_of([&] { (void)assemble(d); }) == refusal);
    CHECK(message_of([&] { (void)converged_mesh(d); }) == refusal);
    CHECK(message_of([&] { (void)isolated_tower(d, {}, true); }) == refusal);
    CHECK(message_of([&] { (void)to_yaml(d); }) == refusal);
    CHECK(message_of([&] { d.check(); }) == refusal);
    const TurbineFile whole = read_windio(bare(), {masses});
    CHECK(whole.description.missing.empty());
    CHECK_NOTHROW(assemble(whole.description, {.tower_elements = 1, .blade_elements = 1}));
    // What is taken as zero is noted, in a model that has the masses.
    for (const char* zero : {"inertia of the hub", "mass centre of the hub", "inertia of the nacelle",
                             "mass centre of the nacelle", "inertia of the generator"})
        CHECK(test::has_note(whole.notes, zero, "taken as zero"));
}

TEST_CASE("windio: the keys of what is missing are those of the file's version", "[property]") {
    const test::ModelFolder model("windio");
    model.replace("small_v1.yaml", "      system_mass: 1200.0\n", "");
    model.replace("small_v1.yaml", "      system_mass: 4500.0\n", "");
    CHECK_THAT(in_words(read_windio(model / "small_v1.yaml").description.missing),
               Contains("--set components.hub.elastic_properties_mb.system_mass=MASS_kg --set "
                        "components.nacelle.elastic_properties_mb.system_mass=MASS_kg"));
}

TEST_CASE("windio: parts of a model that lacks masses have their frequencies by themselves", "[analytic]") {
    const TurbineDescription d = read_windio(bare()).description;
    const std::vector<double> blade = clamped_blade_hz(d), tower = clamped_tower_hz(d);
    CHECK(blade[0] == Approx(cantilever_hz(3e8, 180, 38.5)).epsilon(1e-4));
    CHECK(blade[1] == Approx(cantilever_hz(1.2e9, 180, 38.5)).epsilon(1e-4));
    CHECK(tower[0] == Approx(cantilever_hz(9e10, 2500, 78)).epsilon(1e-4));
    CHECK(tower[1] == Approx(tower[0]).epsilon(1e-9));
}

TEST_CASE("windio: a blade of layers alone is missing, the rest of the model is not", "[property]") {
    const test::ModelFolder model("windio");
    model.replace("small_v2.yaml", "      elastic_properties:\n        structural_damping", "      layers:\n        x");
    const TurbineFile file = read_windio(model / "small_v2.yaml");
    const TurbineDescription& d = file.description;
    CHECK_FALSE(d.has(Part::blade));
    CHECK(d.has(Part::tower));
    CHECK(d.blade.line.length == 10);
    CHECK_THAT(in_words(d.missing), Contains("which are not computed from layers; remedy: --with FILE, with "
                                             "components.blade.structure.elastic_properties"));
    CHECK_THAT(message_of([&] { (void)clamped_blade_hz(d); }), Contains("the model lacks: stiffness and inertia"));
    const TurbineDescription whole = read_windio(test::data_file("windio/small_v2.yaml")).description;
    CHECK(clamped_tower_hz(d) == clamped_tower_hz(whole));
}

TEST_CASE("windio: components that a file does not have are missing", "[property]") {
    const test::ModelFolder model("windio");
    for (const char* component : {"  blade:\n", "  hub: {", "  drivetrain:\n"})
        model.replace("bare_v2.yaml", component, text("  no_", std::string(component).substr(2)));
    const TurbineDescription d = read_windio(model / "bare_v2.yaml").description;
    CHECK(in_words(d.missing) ==
          "the model lacks: the blades; the hub; nacelle and drive train; remedy: --with FILE, with components.blade, "
          "components.hub, components.drivetrain");
    CHECK(clamped_tower_hz(d)[0] == Approx(cantilever_hz(9e10, 2500, 78)).epsilon(1e-4));
    model.replace("bare_v2.yaml", "  tower:\n", "  no_tower:\n");
    const TurbineDescription nothing = read_windio(model / "bare_v2.yaml").description;
    CHECK_FALSE(nothing.has(Part::tower));
    CHECK_THAT(message_of([&] { (void)isolated_tower(nothing); }), Contains("the model lacks: the tower"));
}

TEST_CASE("windio: moments of inertia that no body has are missing, with the line they stand in", "[property]") {
    const ModelAddition sixth{"components: {drivetrain: {elastic_properties: {inertia: [0, 0, 0, 0, 0, 2607890]}}}",
                              "sixth.yaml"};
    const TurbineDescription d = read_windio(bare(), {masses, sixth}).description;
    CHECK_THAT(
        in_words(d.missing),
        Contains("the model lacks: inertia of the nacelle that a body can have (that of line 1: nacelle: smallest "
                 "principal moment of inertia [kg m^2] = -2607890") &&
            Contains("--set components.drivetrain.elastic_properties.inertia=[JXX,JYY,JZZ]"));
    CHECK(read_windio(
              bare(),
              {masses, sixth, {"components: {drivetrain: {elastic_properties: {inertia: [0, 0, 2607890]}}}", "right"}})
              .description.missing.empty());
}

// Of public files of both versions: components.drivetrain and components.nacelle.drivetrain.
TEST_CASE("windio: masses are found under the keys of either version, wherever files have them", "[property]") {
    const auto mass = [](const char* keys) {
        const ModelAddition hub{"components: {hub: {elastic_properties_mb: {system_mass: 18000}}}", "hub"};
        return read_windio(bare(), {hub, {text("components: ", keys), "nacelle"}}).description.nacelle.inertia.mass;
    };
    CHECK(mass("{nacelle: {elastic_properties_mb: {system_mass: 8e4, yaw_mass: 100}}}") == 80100);
    CHECK(mass("{drivetrain: {elastic_properties_mb: {system_mass: 8e4, yaw_mass: 100}}}") == 80100);
    CHECK(mass("{nacelle: {drivetrain: {elastic_properties_mb: {system_mass: 8e4, yaw_mass: 100}}}}") == 80100);
    // A shaft without stiffness, as files have it that leave it open, is rigid.
    const ModelAddition soft{
        "components: {drivetrain: {elastic_properties: {spring_constant: 0.0, damping_coefficient: 0.0}}}", "soft"};
    CHECK(read_windio(bare(), {masses, soft}).description.drive_train.main_shaft.is_rigid());
}

// Files of older versions of WISDEM have the edgewise inertia in the place of the product, too, and none flapwise.
TEST_CASE("windio: a flapwise inertia of zero is the polar less the edgewise one, which is noted", "[crosscheck]") {
    const test::ModelFolder model("windio");
    // Its product of inertia, mass x y, is that of the mass centre.
    const BeamLine right = read_windio(test::data_file("windio/small_v2.yaml")).description.blade.line;
    model.replace("small_v2.yaml", "i_flap: [4.0, 0.9032, 0.030032]", "i_flap: [0.0, 0.0, 0.0]");
    model.replace("small_v2.yaml", "i_cp: [0.0, 0.016, 0.00048]", "i_cp: [-4.4, -2.68, -0.20720000000000002]");
    model.replace("small_v1.yaml", "4.4, -0.0, 0.0, 4.0,", "4.4, 4.4, 0.0, 0.0,");
    model.replace("small_v1.yaml", "2.68, -0.016, 0.0, 0.9032,", "2.68, 2.68, 0.0, 0.0,");
    model.replace("small_v1.yaml", "0.20720000000000002, -0.00048, 0.0, 0.030032,",
                  "0.20720000000000002, 0.20720000000000002, 0.0, 0.0,");
    for (const char* name : {"small_v1.yaml", "small_v2.yaml"}) {
        CAPTURE(name);
        const TurbineFile file = read_windio(model / name);
        CHECK(test::difference(file.description.blade.line, right) < 1e-12);
        CHECK(test::has_note(file.notes, "inertia_matrix", "and the edgewise stands in the place of the product"));
    }
    // At one station alone it is a mistake.
    model.replace("small_v2.yaml", "i_flap: [0.0, 0.0, 0.0]", "i_flap: [0.0, 0.9032, 0.030032]");
    CHECK_THAT(message_of([&] { (void)read_windio(model / "small_v2.yaml"); }), Contains("polar inertia per length"));
}

}  // namespace cardan::testing::windio_missing
