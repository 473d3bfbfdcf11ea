#include "turbines/readers/servodyn.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/controller_file.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

struct GeneratorSpeed {
    double value = 0;  // rad/s
    std::string source;
};

std::string in_file(const char* keywords, const std::filesystem::path& file) {
    return text(keywords, " of ", file.filename().string());
}

// None: there is no file, or it cannot be read.
std::optional<ControllerFile> controller_file(OpenFastFile& file) {
    if (!file.has("DLL_InFile") || file.word("DLL_InFile").empty()) return std::nullopt;
    try {
        return ControllerFile(text_file(file.path("DLL_InFile")));
    } catch (const FileError& error) {
        file.left_out("DLL_InFile", text("not read (", error.what(), "); it may have the rated speed and the pitch"));
    }
    return std::nullopt;
}

GeneratorSpeed of_induction_generator(OpenFastFile& file) {
    if (file.number_or("GenModel", 0) == 1)
        return {file.number("SIG_SySp") * (1 + file.number("SIG_SlPc") / 100) * units::rpm,
                in_file("SIG_SySp and SIG_SlPc", file.name())};
    if (file.number_or("GenModel", 0) == 2 && file.number("TEC_NPol") > 0)
        return {4 * pi * file.number("TEC_Freq") / file.number("TEC_NPol"),
                in_file("TEC_Freq and TEC_NPol", file.name())};
    return {};
}

// Near the synchronous speed: the simple one (GenModel 1), or by Thevenin's equivalent circuit (2). Without its numbers
// there is none.
SlippingGenerator slipping_generator(OpenFastFile& file) {
    const auto of = [&file](const char* keyword) { return file.number_or(keyword, 0); };
    const double model = of("GenModel");
    if (model == 1 && of("SIG_SySp") > 0 && of("SIG_SlPc") > 0) {
        const double speed = of("SIG_SySp") * units::rpm;
        return {speed, of("SIG_RtTq") / (speed * of("SIG_SlPc") / 100)};
    }
    if (model != 2 || !(of("TEC_NPol") > 0) || !(of("TEC_Freq") > 0) || !(of("TEC_RRes") > 0)) return {};
    const double speed = 4 * pi * of("TEC_Freq") / of("TEC_NPol"), magnetising = of("TEC_MR"),
                 circuit = std::hypot(of("TEC_SRes"), of("TEC_SLR") + magnetising);
    if (!(circuit > 0)) return {};
    const double voltage = of("TEC_VLL") * magnetising / circuit;  // line to line, behind the circuit
    return {speed, voltage * voltage / (speed * speed * of("TEC_RRes"))};
}

// 3 and others are routines of the user's.
enum class Control : std::uint8_t { generator_model = 0, torque_law = 1, controller = 5 };

GeneratorSpeed generator_speed(OpenFastFile& file, const std::optional<ControllerFile>& controller) {
    const int control = file.integer("VSContrl", 0, 5);
    if (control == static_cast<int>(Control::generator_model)) return of_induction_generator(file);
    if (control == static_cast<int>(Control::torque_law))
        return {file.number("VS_RtGnSp") * units::rpm, in_file("VS_RtGnSp", file.name())};
    if (control != static_cast<int>(Control::controller) || !controller) return {};
    return {controller->number("PC_RefSpd").value_or(0), in_file("PC_RefSpd", file.path("DLL_InFile"))};
}

void read_pitch(OpenFastFile& file, const std::optional<ControllerFile>& controller, ServoDyn& servo) {
    if (file.number_or("PCMode", 0) != static_cast<int>(Control::controller) || !controller) return;
    servo.fine_pitch = controller->number("PC_FinePit");
    if (!servo.fine_pitch) return;
    servo.pitch_schedule = minimum_pitch(*controller);
    servo.pitch_source =
        in_file(servo.pitch_schedule.empty() ? "PC_FinePit" : "PS_BldPitchMin", file.path("DLL_InFile"));
}

// @param acts  a library sets pitch or torque
ModelController controller_of(OpenFastFile& file, bool acts) {
    ModelController controller;
    const double efficiency = file.number_or("GenEff", 0) / 100;
    if (efficiency > 0 && efficiency <= 1) controller.generator_efficiency = efficiency;
    controller.individual_pitch = file.has("Ptch_Cntrl") && file.integer("Ptch_Cntrl", 0, 1) == 1;
    if (file.number_or("VSContrl", 0) == 0) controller.generator = slipping_generator(file);
    if (!acts) return controller;
    const auto path = [&file](const char* keyword) {
        if (!file.has(keyword) || file.word(keyword).empty()) return std::string();
        return std::filesystem::absolute(file.path(keyword)).lexically_normal().string();
    };
    controller.library = path("DLL_FileName");
    controller.input = path("DLL_InFile");
    controller.period = std::max(0.0, file.number_or_default("DLL_DT", 0));
    return controller;
}

Bearing yaw_drive(OpenFastFile& file) {
    const Bearing drive{file.number("YawSpr"), file.number("YawDamp")};
    if (drive.damping < 0) file.fail("YawDamp", text("YawDamp = ", drive.damping, "; allowed: >= 0"));
    if (drive.stiffness < 0) file.fail("YawSpr", text("YawSpr = ", drive.stiffness, "; allowed: >= 0"));
    file.left_out_unless("YawNeut", 0, "the nacelle points into the wind here");
    return drive.stiffness == 0 ? Bearing{0, drive.damping, Bearing::Hold::free} : drive;
}

}  // namespace

ServoDyn read_servodyn(const std::filesystem::path& path) {
    OpenFastFile file = OpenFastFile::read(path);
    ServoDyn servo;
    servo.yaw = yaw_drive(file);
    const bool needed = file.number_or("VSContrl", 0) == static_cast<int>(Control::controller) ||
                        file.number_or("PCMode", 0) == static_cast<int>(Control::controller);
    const std::optional<ControllerFile> controller = needed ? controller_file(file) : std::nullopt;
    const GeneratorSpeed speed = generator_speed(file, controller);
    read_pitch(file, controller, servo);
    if (controller) {
        servo.operation = operation_of(*controller);
        servo.operation.source = file.path("DLL_InFile").filename().string();
    }
    if (speed.value > 0) {
        servo.rated_generator_speed = speed.value;
        servo.speed_source = speed.source;
    }
    for (const char* keyword : {"NumBStC", "NumNStC", "NumTStC", "NumSStC"})
        file.left_out_unless(keyword, 0, "dampers and masses of structural control are not part of the model");
    for (const char* keyword : {"CompNTMD", "CompTTMD"})
        if (file.flag_or(keyword, false)) file.left_out(keyword, "tuned mass dampers are not part of the model");
    servo.controller = controller_of(file, needed);
    if (controller) {
        servo.controller.gains = gains_of(*controller);
        servo.controller.gains.source = servo.operation.source;
    }
    servo.notes = file.notes({{{"*"}, "control, brakes and electrical drive: not part of the description"}});
    servo.source = text("# ", path.string(), "\n", file.text());
    return servo;
}

}  // namespace cardan::turbines
