#include "turbines/readers/servodyn.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <sstream>

namespace cardan::turbines {

namespace {

struct GeneratorSpeed {
    double value = 0;  // rad/s
    std::string source;
};

// The number before "! keyword" in a file of a ROSCO controller; none: another controller's file, which may be
// anything.
std::optional<double> controller_number(const std::string& text, std::string_view keyword) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t mark = line.find('!');
        if (mark == std::string::npos) continue;
        std::string word;
        double value = 0;
        if ((std::istringstream(line.substr(mark + 1)) >> word) && word == keyword &&
            (std::istringstream(line.substr(0, mark)) >> value) && std::isfinite(value))
            return value;
    }
    return std::nullopt;
}

std::string in_file(const char* keywords, const std::filesystem::path& file) {
    return text(keywords, " of ", file.filename().string());
}

GeneratorSpeed of_controller(OpenFastFile& file) {
    if (!file.has("DLL_InFile") || file.word("DLL_InFile").empty()) return {};
    const std::filesystem::path path = file.path("DLL_InFile");
    try {
        if (const auto speed = controller_number(text_file(path), "PC_RefSpd"))
            return {*speed, in_file("PC_RefSpd", path)};
    } catch (const FileError& error) {
        file.note("DLL_InFile", text("not read (", error.what(), "); it may have the rated speed"));
    }
    return {};
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

GeneratorSpeed generator_speed(OpenFastFile& file) {
    const int control = file.integer("VSContrl", 0, 5);
    if (control == 0) return of_induction_generator(file);
    if (control == 1) return {file.number("VS_RtGnSp") * units::rpm, in_file("VS_RtGnSp", file.name())};
    return control == 3 ? GeneratorSpeed{} : of_controller(file);  // 3: a routine of the user's
}

Bearing yaw_drive(OpenFastFile& file) {
    const Bearing drive{file.number("YawSpr"), file.number("YawDamp")};
    if (drive.damping < 0) file.fail("YawDamp", text("YawDamp = ", drive.damping, "; allowed: >= 0"));
    if (drive.stiffness < 0) file.fail("YawSpr", text("YawSpr = ", drive.stiffness, "; allowed: >= 0"));
    file.note_unless("YawNeut", 0, "the nacelle points into the wind here");
    return drive.stiffness == 0 ? Bearing{0, drive.damping, Bearing::Hold::free} : drive;
}

}  // namespace

ServoDyn read_servodyn(const std::filesystem::path& path) {
    OpenFastFile file = OpenFastFile::read(path);
    ServoDyn servo;
    servo.yaw = yaw_drive(file);
    const GeneratorSpeed speed = generator_speed(file);
    if (speed.value > 0) {
        servo.rated_generator_speed = speed.value;
        servo.speed_source = speed.source;
    }
    for (const char* keyword : {"NumBStC", "NumNStC", "NumTStC", "NumSStC"})
        file.note_unless(keyword, 0, "dampers and masses of structural control are not part of the model");
    for (const char* keyword : {"CompNTMD", "CompTTMD"})
        if (file.flag_or(keyword, false)) file.note(keyword, "tuned mass dampers are not part of the model");
    servo.notes = file.notes({{{"*"}, "control, brakes and electrical drive: not part of the description"}});
    servo.source = text("# ", path.string(), "\n", file.text());
    return servo;
}

}  // namespace cardan::turbines
