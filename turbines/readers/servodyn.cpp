#include "turbines/readers/servodyn.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/controller_file.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan::turbines {

namespace {

struct Generator {
    double rated_speed = 0, min_rotor_speed = 0;  // rad/s
    double torque = 0;                            // at the rated speed, N m
    std::string source;
};

std::string in_file(const char* keywords, const std::filesystem::path& file) {
    return text(keywords, " of ", file.filename().string());
}

// None: there is no file, it cannot be read, or it is another controller's.
std::optional<ControllerFile> controller_file(OpenFastFile& file) {
    if (!file.has("DLL_InFile") || file.word("DLL_InFile").empty()) return std::nullopt;
    try {
        const std::filesystem::path path = file.path("DLL_InFile");
        ControllerFile controller(text_file(path), path.string());
        if (controller.is_rosco()) return controller;
        file.note("DLL_InFile", "not a file of ROSCO: rated speed, power and pitch are not read from it");
    } catch (const FileError& error) {
        file.left_out("DLL_InFile", text("not read (", error.what(), "); it may have the rated speed and the pitch"));
    }
    return std::nullopt;
}

// Entries that are not used often have one number that means nothing, as 9999.9.
bool is_placeholder(OpenFastFile& file, const char* keyword) {
    constexpr std::array entries{"VS_RtGnSp", "VS_RtTq",  "VS_Rgn2K", "VS_SlPc",  "SIG_SlPc", "SIG_SySp", "SIG_RtTq",
                                 "SIG_PORt",  "TEC_Freq", "TEC_SRes", "TEC_RRes", "TEC_VLL",  "TEC_SLR",  "TEC_MR"};
    const double value = file.number(keyword);
    if (value == 0) return false;  // not given
    const auto same = std::ranges::count_if(entries, [&](const char* other) { return file.is_number(other, value); });
    if (same < 3) return false;
    file.note(keyword, text("a placeholder: ", same, " entries of the generator have this number"));
    return true;
}

// Of the rated speed, N m; 0: not given.
double torque_of(OpenFastFile& file, const char* keyword) {
    return file.has(keyword) && !is_placeholder(file, keyword) ? file.number(keyword) : 0;
}

Generator of_induction_generator(OpenFastFile& file) {
    if (file.number_or("GenModel", 0) == 1 && !is_placeholder(file, "SIG_SySp")) {
        const double synchronous = file.number("SIG_SySp") * units::rpm;
        return {synchronous * (1 + file.number("SIG_SlPc") / 100), synchronous, torque_of(file, "SIG_RtTq"),
                in_file("SIG_SySp and SIG_SlPc", file.name())};
    }
    if (file.number_or("GenModel", 0) == 2 && file.number("TEC_NPol") > 0 && !is_placeholder(file, "TEC_Freq")) {
        const double synchronous = 4 * pi * file.number("TEC_Freq") / file.number("TEC_NPol");
        return {synchronous, synchronous, 0, in_file("TEC_Freq and TEC_NPol", file.name())};
    }
    return {};
}

Generator of_torque_law(OpenFastFile& file) {
    if (is_placeholder(file, "VS_RtGnSp")) return {};
    return {file.number("VS_RtGnSp") * units::rpm, 0, torque_of(file, "VS_RtTq"), in_file("VS_RtGnSp", file.name())};
}

// 3 and others are routines of the user's.
enum class Control : std::uint8_t { generator_model = 0, torque_law = 1, controller = 5 };

bool has_control(OpenFastFile& file, Control control) {
    return file.number_or("VSContrl", 0) == static_cast<double>(control);
}

// Without its numbers there is none.
TorqueLaw torque_law(OpenFastFile& file) {
    if (!has_control(file, Control::torque_law)) return {};
    for (const char* keyword : {"VS_RtGnSp", "VS_RtTq", "VS_Rgn2K", "VS_SlPc"})
        if (!file.has(keyword) || is_placeholder(file, keyword)) {
            file.left_out("VSContrl", text("no law of the torque: ", keyword, " is not given"));
            return {};
        }
    const TorqueLaw law{file.number("VS_RtGnSp") * units::rpm, file.number("VS_RtTq"),
                        file.number("VS_Rgn2K") / (units::rpm * units::rpm), file.number("VS_SlPc") / 100};
    try {
        law.check(file.name());
    } catch (const InputError& error) {
        file.left_out("VSContrl", text("no law of the torque: ", error.what()));
        return {};
    }
    return law;
}

// Near the synchronous speed, which is the least one of an induction generator: the simple one (GenModel 1), or by
// Thevenin's equivalent circuit (2). Without its numbers there is none.
SlippingGenerator slipping_generator(OpenFastFile& file, const Generator& machine) {
    const auto of = [&file](const char* keyword) { return file.number_or(keyword, 0); };
    const double synchronous = machine.min_rotor_speed, slip = machine.rated_speed - synchronous;
    if (!(synchronous > 0)) return {};
    if (slip > 0) return {synchronous, machine.torque / slip};
    const double magnetising = of("TEC_MR"), circuit = std::hypot(of("TEC_SRes"), of("TEC_SLR") + magnetising);
    if (of("GenModel") != 2 || !(of("TEC_RRes") > 0) || !(circuit > 0)) return {};
    const double voltage = of("TEC_VLL") * magnetising / circuit;  // line to line, behind the circuit
    return {synchronous, voltage * voltage / (synchronous * synchronous * of("TEC_RRes"))};
}

Generator generator(OpenFastFile& file, const std::optional<ControllerFile>& controller) {
    const int control = file.integer("VSContrl", 0, 5);
    if (control == static_cast<int>(Control::generator_model)) return of_induction_generator(file);
    if (control == static_cast<int>(Control::torque_law)) return of_torque_law(file);
    if (control != static_cast<int>(Control::controller) || !controller) return {};
    return {controller->number("PC_RefSpd").value_or(0), 0, 0, in_file("PC_RefSpd", file.path("DLL_InFile"))};
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
ModelController controller_of(OpenFastFile& file, const Generator& machine, bool acts) {
    ModelController controller;
    const double efficiency = file.number_or("GenEff", 0) / 100;
    if (efficiency > 0 && efficiency <= 1) controller.generator_efficiency = efficiency;
    controller.individual_pitch = file.has("Ptch_Cntrl") && file.integer("Ptch_Cntrl", 0, 1) == 1;
    controller.generator = slipping_generator(file, machine);
    controller.torque_law = torque_law(file);
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

JointSupport yaw_drive(OpenFastFile& file) {
    const JointSupport drive{file.not_negative("YawSpr"), file.not_negative("YawDamp")};
    file.left_out_unless("YawNeut", 0, "the nacelle points into the wind here");
    return drive.stiffness == 0 ? JointSupport{0, drive.damping, JointSupport::Kind::free} : drive;
}

}  // namespace

ServoDyn read_servodyn(const std::filesystem::path& path) {
    OpenFastFile file = OpenFastFile::read(path);
    ServoDyn servo;
    servo.yaw = yaw_drive(file);
    const bool needed =
        has_control(file, Control::controller) || file.number_or("PCMode", 0) == static_cast<int>(Control::controller);
    const std::optional<ControllerFile> controller = needed ? controller_file(file) : std::nullopt;
    const Generator machine = generator(file, controller);
    read_pitch(file, controller, servo);
    if (controller) {
        servo.operation = operation_of(*controller);
        servo.operation.source = file.path("DLL_InFile").filename().string();
    }
    if (servo.operation.rated_power == 0 && machine.rated_speed > 0 && machine.torque > 0) {
        servo.operation.rated_power = machine.torque * machine.rated_speed;
        if (!controller) servo.operation.source = path.filename().string();
    }
    if (machine.rated_speed > 0) {
        servo.rated_generator_speed = machine.rated_speed;
        servo.min_generator_speed = machine.min_rotor_speed;
        servo.speed_source = machine.source;
    }
    for (const char* keyword : {"NumBStC", "NumNStC", "NumTStC", "NumSStC"})
        file.left_out_unless(keyword, 0, "dampers and masses of structural control are not part of the model");
    for (const char* keyword : {"CompNTMD", "CompTTMD"})
        if (file.flag_or(keyword, false)) file.left_out(keyword, "tuned mass dampers are not part of the model");
    servo.controller = controller_of(file, machine, needed);
    if (controller) {
        servo.controller.gains = gains_of(*controller);
        servo.controller.gains.source = servo.operation.source;
    }
    servo.notes = file.notes({{{"*"}, "control, brakes and electrical drive: not part of the description"}});
    servo.source = text("# ", path.string(), "\n", file.text());
    return servo;
}

}  // namespace cardan::turbines
