#include "turbines/readers/openfast.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/beamdyn.hpp"
#include "turbines/readers/elastodyn.hpp"
#include "turbines/readers/servodyn.hpp"

#include <cmath>

namespace cardan::turbines {

namespace {

void append(std::vector<FileNote>& notes, std::vector<FileNote> more) {
    for (FileNote& note : more) notes.push_back(std::move(note));
}

// The controller file may be missing: that is no reason not to read the structure.
ServoDyn servo_of(OpenFastFile& main) {
    ServoDyn servo;
    if (main.number("CompServo") == 0) return servo;
    try {
        return read_servodyn(main.path("ServoFile"));
    } catch (const FileError& error) {
        main.left_out("ServoFile", text("not read (", error.what(), "); the yaw joint is rigid"));
    }
    return servo;
}

// The blade of the first file, and those that have files of their own.
void read_blades(OpenFastFile& main, const std::filesystem::path& elastodyn, ElastoDynContext& context) {
    const auto keyword = [](int k) { return text("BDBldFile(", k, ")"); };
    const auto read = [&](int k) {
        return main.follow(keyword(k), [&] { return read_beamdyn(main.path(keyword(k))); });
    };
    BeamDynBlade first = read(1);
    context.blade = std::move(first.beam);
    context.pitch = first.pitch;
    context.pitch_inertia = first.pitch_inertia;
    const int blades = main.follow("EDFile", [&] { return OpenFastFile::read(elastodyn).integer("NumBl", 1, 3); });
    for (int k = 2; k <= 3; ++k) {
        if (!main.has(keyword(k)) || main.word(keyword(k)) == main.word(keyword(1))) continue;
        if (k > blades) {
            main.note(keyword(k), "of a blade that the machine does not have");
            continue;
        }
        BeamDynBlade own = read(k);
        context.individual_blades[k] = {std::move(own.beam), own.pitch, own.pitch_inertia,
                                        main.path(keyword(k)).string()};
    }
}

// SubDyn's structure has ElastoDyn's degrees of freedom of a platform as well.
std::string missing_foundation(OpenFastFile& main, const std::string& of_elastodyn) {
    if (main.number_or("CompSub", 0) != 0) return "substructure";
    if (main.number_or("CompMooring", 0) != 0) return "floating platform";
    if (!of_elastodyn.empty()) return of_elastodyn;
    return main.number_or("CompHydro", 0) != 0 ? "part under water" : "";
}

// What the main file runs; how it starts is ElastoDyn's to say.
void set_run(OpenFastFile& main, ModelRun& run, std::vector<FileNote>& notes) {
    const auto absolute = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path).lexically_normal().string();
    };
    run.file = absolute(main.name());
    try {
        if (main.has("TMax")) run.duration = main.number("TMax");
    } catch (const ParseError&) {
        main.note("TMax", "not one number: without it a run lasts as long as it is told");
    }
    run.air = main.number_or("CompAero", 0) != 0;
    if (!main.has("CompAero") && main.has("AeroFile"))
        notes.push_back(
            {main.name(), 0, "CompAero", "", "not in the file: a run has no air", FileNote::Kind::left_out});
    if (run.air && main.number_or("CompInflow", 0) != 0) run.wind = absolute(main.path("InflowFile"));
    run.controlled = main.number("CompServo") != 0;
}

// No rotor turns faster than sound; numbers beyond stand in files where they are not used.
bool is_possible(const TurbineFile& out, double rotor_speed) {
    constexpr double sound = 340;  // m/s
    const TurbineDescription& d = out.description;
    return rotor_speed * (d.hub.radius + d.blade.line.length) < sound;
}

// Two files have the gear ratio: the controller reckons with its own, the machine turns with the other.
void note_gears(TurbineFile& out) {
    constexpr double rounding = 0.01;
    const double gears = out.description.drive_train.gear_ratio, other = out.operation.gear_ratio;
    if (other == 0 || std::abs(other - gears) <= rounding * gears) return;
    out.notes.push_back({out.operation.source, 0, "WE_GearboxRatio", text(other),
                         text("GBRatio of the machine is ", gears, ": speeds of the rotor follow from that one"),
                         FileNote::Kind::left_out});
}

// The controller knows how the blades stand in operation; ElastoDyn, how they start.
void set_operation(TurbineFile& out, const ServoDyn& servo) {
    const double gears = out.description.drive_train.gear_ratio, speed = servo.rated_generator_speed / gears;
    out.operation = servo.operation;
    note_gears(out);
    if (speed > 0 && is_possible(out, speed)) {
        out.rotor_speed = out.description.rotor_speed = speed;
        out.rotor_speed_source = servo.speed_source;
        if (out.operation.min_rotor_speed == 0) out.operation.min_rotor_speed = servo.min_generator_speed / gears;
    } else if (speed > 0) {
        out.notes.push_back({servo.speed_source, 0, "rated speed", text(speed * units::to_rpm, " rpm of the rotor"),
                             "without meaning: the tips of the blades would be faster than sound"});
        out.operation.rated_power = 0;
    }
    if (servo.fine_pitch) {
        out.pitch = *servo.fine_pitch;
        out.pitch_source = servo.pitch_source;
    }
    out.pitch_schedule = servo.pitch_schedule;
    out.controller = servo.controller;
}

// Of control and brakes there is a note already: what concerns the structure is added.
TurbineFile read_fast7(const std::filesystem::path& path) {
    const ServoDyn servo = read_servodyn(path);
    ElastoDynContext context;
    context.yaw = servo.yaw;
    TurbineFile out = read_elastodyn(path, context);
    out.notes.insert(out.notes.begin(),
                     {path.string(), 0, "main file", "FAST 7", "it has the entries of ElastoDyn and ServoDyn"});
    for (const FileNote& note : servo.notes)
        if (note.line > 0) out.notes.push_back(note);
    set_operation(out, servo);
    return out;
}

}  // namespace

TurbineFile read_openfast(const std::filesystem::path& path) {
    OpenFastFile main = OpenFastFile::read(path);
    if (!main.has("EDFile") && main.has("NumBl")) {
        TurbineFile alone = is_fast7(main) ? read_fast7(path) : read_elastodyn(path);
        alone.run.reset();
        return alone;
    }
    if (!main.has("EDFile"))
        throw ParseError(path.string(), 1, 0,
                         "neither a main file of OpenFAST (no line with the keyword EDFile) nor one of ElastoDyn (none "
                         "with NumBl)");
    const std::filesystem::path elastodyn = main.path("EDFile");
    if (main.number_or("NRotors", 1) != 1)
        main.fail("NRotors", text("NRotors = ", main.number("NRotors"), "; allowed: 1"));
    if (main.has("MirrorRotor") && main.flag("MirrorRotor"))
        main.left_out("MirrorRotor", "the rotor turns clockwise seen from upwind here");
    const int kind = main.integer("CompElast", 1, 2);
    ServoDyn servo = servo_of(main);
    ElastoDynContext context;
    context.yaw = servo.yaw;
    if (kind == 2) read_blades(main, elastodyn, context);
    TurbineFile out = main.follow("EDFile", [&] { return read_elastodyn(elastodyn, context); });
    out.description.name = main.machine_name();
    set_run(main, *out.run, out.notes);
    std::string& foundation = out.description.missing_foundation.name;
    foundation = missing_foundation(main, foundation);
    for (const char* keyword : {"CompHydro", "CompSub", "CompMooring", "CompIce"})
        main.left_out_unless(keyword, 0,
                             "what the tower stands on is not part of the description; it is clamped at its foot");
    main.left_out_unless("MHK", 0, "a machine under water: neither buoyancy nor added mass are part of the model");
    if (main.has("Gravity")) {
        out.gravity = main.not_negative("Gravity");
        if (out.gravity == 0) main.note("Gravity", "nothing has weight in this model");
    }
    append(out.notes, main.notes({{{"*"}, "simulation, aerodynamics and output: without meaning for the machine"}}));
    append(out.notes, std::move(servo.notes));
    set_operation(out, servo);
    out.description.source = text("# ", path.string(), "\n", main.text(), out.description.source, servo.source);
    return out;
}

}  // namespace cardan::turbines
