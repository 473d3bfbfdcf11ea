// Controllers in shared libraries with Bladed's interface: the records, failures, what cannot be loaded.
#include "elements/controllers/bladed_controller.hpp"
#include "mbs/base/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <filesystem>
#include <fstream>

namespace cardan::testing::bladed_controllers {

namespace {

BladedController loaded(const std::string& input, bool individual = false) {
    return {CARDAN_TEST_CONTROLLER, {.input = input, .period = 0.1, .individual_pitch = individual}};
}

BladedController::Measured at(double time, double speed = 100) {
    return {.time = time, .pitch = {0.1, 0.2, 0.3}, .generator_speed = speed, .generator_torque = 5};
}

}  // namespace

TEST_CASE("Bladed controller: demands are functions of what is measured, in single precision", "[property]") {
    BladedController controller = loaded("follow");
    const BladedController::Demand first = controller.step(at(0));
    CHECK(first.torque == 200);
    CHECK(first.message == "follow starts with a period of 0.1 s");
    const BladedController::Demand next = controller.step(at(0.3, 110));
    CHECK(next.torque == 220);
    for (const double pitch : next.pitch) CHECK(pitch == Approx(0.03).epsilon(1e-6));
    CHECK(next.message.empty());
    controller.finish();
    check_refused([&] { (void)controller.step(at(0.4)); }, {"call = after the last one"});
}

// The numbers of the records and their meanings are those of Bladed's manual, as OpenFAST's ServoDyn has them too.
TEST_CASE("Bladed controller: whether every blade has a pitch of its own is told before the first call", "[property]") {
    BladedController controller = loaded("individual", true);
    const BladedController::Demand demand = controller.step(at(0));
    CHECK(demand.pitch[0] == Approx(0.11).epsilon(1e-6));
    CHECK(demand.pitch[1] == Approx(0.22).epsilon(1e-6));
    CHECK(demand.pitch[2] == Approx(0.33).epsilon(1e-6));
    BladedController collective = loaded("individual");
    for (const double pitch : collective.step(at(0.2)).pitch) CHECK(pitch == Approx(0.02).epsilon(1e-6));
}

TEST_CASE("Bladed controller: contactor and brake are obeyed, and told as they stand", "[property]") {
    using Status = BladedController::Brake::Status;
    for (const std::string input : {"follow", "off", "brake", "half"}) {
        CAPTURE(input);
        BladedController controller = loaded(input);  // that fails if it is told otherwise
        for (const double time : {0.0, 0.4}) {
            const BladedController::Demand before = controller.step(at(time));
            CHECK(before.generator_connected);
            CHECK(before.torque == 200);
            CHECK(before.brake.status == Status::off);
        }
        for (const double time : {0.5, 0.6, 0.7}) {
            const BladedController::Demand after = controller.step(at(time));
            CHECK(after.generator_connected == (input != "off"));
            CHECK(after.torque == (input == "off" ? 0 : 200));
            CHECK(after.brake.status == (input == "brake"  ? Status::on
                                         : input == "half" ? Status::torque
                                                           : Status::off));
            CHECK(after.brake.torque == (input == "half" ? 300 : 0));
        }
    }
    for (const auto& [input, words] :
         {std::pair{"contactor", "a contactor of 2 (record 35); allowed: 1, the generator, or 0, none"},
          {"brakes", "a shaft brake of 3 (record 36); allowed: 0, off, 1, on, or 16"}}) {
        BladedController controller = loaded(input);
        (void)controller.step(at(0));
        CHECK_THROWS_WITH(controller.step(at(0.5)), Catch::Contains(words) && Catch::Contains("at 0.5 s"));
    }
}

TEST_CASE("Bladed controller: warnings and what cannot be obeyed are told once", "[property]") {
    BladedController warns = loaded("warn");
    std::vector<std::string> told;
    for (int i = 0; i < 12; ++i)
        for (const std::string& words : warns.step(at(0.1 * i)).remarks) told.push_back(words);
    CHECK(told == std::vector<std::string>{"the oil is cold", "the wind vane shakes"});
    BladedController overrides = loaded("override");
    const std::vector<std::string> remarks = overrides.step(at(0)).remarks;
    REQUIRE(remarks.size() == 2);
    CHECK_THAT(remarks[0], Catch::Contains("record 55"));
    CHECK_THAT(remarks[1], Catch::Contains("record 102"));
    CHECK(overrides.step(at(0.1)).remarks.empty());
    BladedController yaws = loaded("yaw");
    CHECK(yaws.step(at(0)).yaw_rate == Approx(0.02));
}

TEST_CASE("Bladed controller: failures and demands that are no numbers are errors with the time", "[property]") {
    BladedController fails = loaded("fail"), nan = loaded("nan");
    (void)fails.step(at(0));
    CHECK_THROWS_WITH(fails.step(at(0.6)), Catch::Contains("at 0.6 s it reports a failure (-1)") &&
                                               Catch::Contains("the pitch sensor is dead"));
    (void)nan.step(at(0));
    CHECK_THROWS_WITH(nan.step(at(0.7)), Catch::Contains("at 0.7 s it demands a generator torque of"));
}

TEST_CASE("Bladed controller: what cannot be loaded is refused with the system's reason", "[property]") {
    const auto message = [](const std::filesystem::path& path, BladedController::Options options) {
        try {
            const BladedController controller(path, std::move(options));
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("(accepted)");
    };
    CHECK_THAT(message("no/such/file.so", {.period = 0.1}),
               Catch::Contains("no/such/file.so") && Catch::Contains("No such file"));
    const test::Folder folder;
    std::ofstream(folder / "text.so") << "no library\n";
    CHECK_THAT(message(folder / "text.so", {.period = 0.1}), Catch::Contains("no controller"));
    CHECK_THAT(message(CARDAN_TEST_CONTROLLER, {.function = "DISCONN", .period = 0.1}),
               Catch::Contains("no function 'DISCONN'"));
    CHECK_THAT(message(CARDAN_TEST_CONTROLLER, {}), Catch::Contains("period [s] = 0"));
    CHECK_THAT(message(CARDAN_TEST_CONTROLLER, {.blades = 4, .period = 0.1}), Catch::Contains("number of blades = 4"));
}

}  // namespace cardan::testing::bladed_controllers
