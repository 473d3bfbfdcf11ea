// Turbulent wind: made for a machine, or looked at.
//
// Problem: a box of turbulence with the spectra and the coherence of IEC 61400-1 around a rotor, by Kaimal's spectra or
// Mann's tensor, that `cardan simulate` and OpenFAST read. Reference: the target spectra and the coherence are drawn
// over those of the box, also of one that another program made.
#include "elements/turbulence/box_spectra.hpp"
#include "elements/turbulence/turbsim_writer.hpp"
#include "elements/turbulence/turbulence_request.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/cardan/turbulence_pictures.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include "turbines/analysis/rotor_size.hpp"
#include "turbines/machine/built_in.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"
#include "turbines/readers/inflow_wind.hpp"
#include "turbines/readers/wind_box_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cardan::program {

namespace {

struct WindCommandArguments {
    std::string what, out, spectrum = "kaimal", wind_class, turbulence = "ntm", points = "31x31", transverse = "as-u",
                           plane_order = "last-first";
    std::optional<double> speed, deviation, hub_height, diameter, rpm, width, height, shear;
    double duration = RotorGridOptions().duration, step = RotorGridOptions().time_step;
    int seed = 1, threads = 0;
    bool scaled = false, no_picture = false;
    std::vector<Option> of_making = {};  // mean nothing for a wind that there is

    bool extreme() const { return turbulence == "ewm1" || turbulence == "ewm50"; }
};

void declare(CommandLine& app, WindCommandArguments& a) {
    app.add_option("what", a.what,
                   "with --speed or --turbulence ewm1, ewm50: a machine, for which turbulence is made (none: "
                   "--hub-height and --diameter say what for); else a turbulent wind: .bts, .wnd, InflowWind's main "
                   "file, or a result (.h5) in one");
    app.add_option("--hub-height", a.hub_height, "m (default: the machine's, or the file's)").positive();
    app.add_option("--diameter", a.diameter, "of the rotor, m (default: the machine's)").positive();
    app.add_option("--rpm", a.rpm, "rotor speed, for what a turning blade sees, rev/min (default: the machine's)")
        .positive();
    app.add_option("--out", a.out, "prefix of the files (default: name of the machine or the file, and _wind)");
    app.add_flag("--no-picture", a.no_picture, "draw nothing");
    const auto making = [&a](const Option& option) {
        a.of_making.push_back(option);
        return option;
    };
    making(app.add_option("--speed", a.speed, "mean wind speed at the hub, m/s")).positive();
    Option turbulence = making(
        app.add_option("--turbulence", a.turbulence,
                       "of IEC 61400-1: normal (ntm), extreme (etm), extreme wind of 1 or 50 years (ewm1, ewm50: "
                       "without --speed)"));
    turbulence.one_of({"ntm", "etm", "ewm1", "ewm50"});
    making(app.add_option("--wind-class", a.wind_class, wind_class_format)).one_word();
    making(app.add_option("--deviation", a.deviation,
                          "standard deviation of the downwind component at the hub instead, m/s"))
        .positive()
        .excludes(turbulence);
    making(app.add_option("--spectrum", a.spectrum, "Kaimal's spectra with exponential coherence, or Mann's tensor"))
        .one_of({"kaimal", "mann"});
    making(app.add_option("--seed", a.seed, "of the random numbers: the same seed makes the same file"))
        .range(0, 2147483647);
    making(app.add_flag("--scaled", a.scaled,
                        "scale to the standard deviation exactly, at the hub; else it is as the seed has it"));
    making(app.add_option("--points", a.points, "of the grid, across x upward")).type_name("NxN");
    making(app.add_option("--width", a.width, "of the grid, m (default: 1.2 diameters)")).positive();
    making(
        app.add_option("--height", a.height,
                       "of the grid, m (default: as the width, less where the ground is near); its middle is the hub"))
        .positive();
    making(app.add_option("--duration", a.duration, "length of the box, s; after that it begins again")).positive();
    making(app.add_option("--step", a.step, "time between planes, s")).positive();
    making(app.add_option("--shear", a.shear,
                          "exponent of the mean wind's power law (default: 0.2; of ewm1 and ewm50 0.11)"))
        .finite();
    making(app.add_option("--transverse-coherence", a.transverse,
                          "of v and w of Kaimal's spectra between points: as-u, that of u, or none, as TurbSim has it"))
        .one_of({"as-u", "none"});
    making(app.add_option("--plane-order", a.plane_order,
                          "of Mann's planes, counted downwind: last-first, the last one meets the machine first, as in "
                          "frozen turbulence; first-first, as OpenFAST reads HAWC2's boxes"))
        .one_of({"last-first", "first-first"});
    making(app.add_option("--threads", a.threads, "number of threads (0: one per processor); the file is the same"))
        .range(0, 1024);
    app.footer(text("\n", machine_help()));
}

bool is_made(const WindCommandArguments& a) {
    return a.speed || a.extreme();
}

// 31x31: across x upward.
std::pair<int, int> points_of(const std::string& given) {
    constexpr auto allowed = "NUMBERxNUMBER, 2x2 to 1024x1024, as 31x31: across x upward";
    const std::vector<std::string> words = split(lower_case(given), 'x');
    if (words.size() != 2) throw InputError("--points", "value", given, allowed);
    const auto count = [&](const std::string& word) {
        const double value = number("--points", given, word, allowed);
        if (!(value >= 2 && value <= 1024) || value != std::floor(value))
            throw InputError("--points", "value", given, allowed);
        return static_cast<int>(value);
    };
    return {count(words[0]), count(words[1])};
}

// Where the wind blows, and how fast the rotor turns there.
struct Site {
    double hub_height = 0, diameter = 0;
    std::optional<double> rotor_speed;
};

Site site_of(const WindCommandArguments& a) {
    // A rotor's centre is where its parts add up to, not more exact than a millimetre.
    const auto to_millimetre = [](double length) { return std::round(length * 1e3) / 1e3; };
    Site site{.hub_height = a.hub_height.value_or(0), .diameter = a.diameter.value_or(0), .rotor_speed = {}};
    if (a.rpm) site.rotor_speed = *a.rpm * units::rpm;
    if (a.what.empty()) {
        if (!a.hub_height || !a.diameter)
            throw InputError("a machine, or --hub-height and --diameter, to make turbulence for");
        return site;
    }
    const turbines::Machine machine = turbines::read_machine(a.what);
    const turbines::RotorSize rotor = turbines::rotor_size(machine);
    if (!a.hub_height) site.hub_height = to_millimetre(rotor.hub_height);
    if (!a.diameter) site.diameter = to_millimetre(rotor.diameter);
    if (!a.rpm && machine.operation.rotor_speed > 0) site.rotor_speed = machine.operation.rotor_speed;
    return site;
}

IecTurbulence turbulence_kind(const std::string& word) {
    for (const IecTurbulence kind : {IecTurbulence::etm, IecTurbulence::ewm1, IecTurbulence::ewm50})
        if (word == name_of(kind)) return kind;
    return IecTurbulence::ntm;
}

TurbulenceRequest request_of(const WindCommandArguments& a, const Site& site) {
    if (a.extreme() && a.speed)
        throw InputError("--speed", "value [m/s]", *a.speed,
                         text("none beside --turbulence ", a.turbulence, ", whose speed is that of the class"));
    TurbulenceRequest request = iec_turbulence(turbulence_kind(a.turbulence), wind_class_of(a.wind_class),
                                               site.hub_height, a.speed.value_or(0));
    if (a.deviation) request.deviation = *a.deviation;
    if (a.shear) request.exponent = *a.shear;
    request.model = a.spectrum == "mann" ? TurbulenceModel::mann : TurbulenceModel::kaimal;
    const auto [columns, rows] = points_of(a.points);
    request.grid = rotor_grid(site.hub_height, site.diameter,
                              {.rows = rows,
                               .columns = columns,
                               .width = a.width,
                               .height = a.height,
                               .duration = a.duration,
                               .time_step = a.step});
    request.seed = static_cast<std::uint64_t>(a.seed);
    request.scaled = a.scaled;
    request.transverse = a.transverse == "none" ? TransverseCoherence::none : TransverseCoherence::as_u;
    request.order = a.plane_order == "first-first" ? PlaneOrder::first_first : PlaneOrder::last_first;
    request.threads = a.threads;
    request.cancelled = interrupted;
    request.progress = [](int done, int total) {
        progress(text("turbulence: ", 100LL * done / std::max(1, total), " %"));
    };
    return request;
}

std::string turbulence_in_words(const WindCommandArguments& a, const TurbulenceRequest& request) {
    const std::string sigma =
        text("standard deviation of u ", std::round(request.deviation * 1e4) / 1e4, " m/s, ",
             std::round(request.deviation / request.speed * 1e4) / 100, " % of ", request.speed, " m/s");
    const std::string model = request.model == TurbulenceModel::mann ? "Mann's tensor" : "Kaimal's spectra";
    if (a.deviation) return text(model, ", ", sigma);
    return text(model, ", ", a.turbulence, " of class ", name_of(wind_class_of(a.wind_class)), ": ", sigma);
}

BoxView view_of(const WindCommandArguments& a, const turbines::WindBoxFile& file) {
    BoxView view;
    view.box = file.box.get();
    view.mean = file.mean;
    const WindBoxData& data = file.box->data();
    const std::string name = std::filesystem::path(data.origin.files.front()).filename().string();
    view.title = data.origin.note.empty() ? name : text(name, ": ", data.origin.note.substr(0, 90));
    view.hub_height = a.hub_height.value_or(file.mean.reference_height);
    view.diameter = a.diameter;
    if (a.rpm) view.rotor_speed = *a.rpm * units::rpm;
    view.cancelled = interrupted;
    return view;
}

// Of what the file says of itself, else Kaimal's with what the box has.
void set_target(BoxView& view) {
    if (const auto request = request_of_note(view.box->data().origin.note)) {
        view.target = target_of(*request);
        view.target_name = request->model == TurbulenceModel::mann ? "Mann's tensor" : "Kaimal's spectrum";
        return;
    }
    const BoxGrid& grid = view.box->grid();
    const Vec3 deviation =
        view.box->statistics(grid.row_near(view.hub_height), grid.column_near(0)).deviation.cwiseMax(1e-6);
    Kaimal model = kaimal_turbulence(view.box->data().speed, deviation[0], view.hub_height);
    model.deviation = deviation;
    view.target = {model, view.box->data().speed};
    view.target_name = "Kaimal's with its deviations";
}

bool draw(const BoxView& view, const std::string& path) {
    progress("picture");
    const bool drawn = draw_box(view, path);
    end_progress();
    return drawn;
}

// A box of Mann's tensor is scaled as a whole by what it lacks of u, whose eddies are the longest.
void warn_of_short_box(const TurbulenceRequest& request, const Vec3& expected) {
    constexpr double bearable = 1.2;
    if (request.model != TurbulenceModel::mann) return;
    const Vec3 target = target_of(request).deviations();
    const double excess = std::max(expected.y() / target.y(), expected.z() / target.z());
    if (excess > bearable)
        std::printf(
            "warning: the box is short for the long eddies of u; scaled to u, v and w are up to %.1f times as "
            "large as asked for: make it longer\n",
            excess);
}

int make(const WindCommandArguments& a, const std::string& out) {
    const Site site = site_of(a);
    const TurbulenceRequest request = request_of(a, site);
    std::printf("%s\n", text(a.what.empty() ? "" : a.what + ": ", "hub at ", site.hub_height, " m, rotor of ",
                             site.diameter, " m")
                            .c_str());
    std::printf("turbulence    %s\n", turbulence_in_words(a, request).c_str());
    MadeTurbulence made = make_turbulence(request);
    if (made.box.grid.steps == 0) return 130;
    progress("file");
    write_turbsim(out + ".bts", made.box, {.mean = made.mean, .text = made.note, .tower = true});
    made.box = {};  // what is looked at is what the file holds
    end_progress();

    const turbines::WindBoxFile file = turbines::read_wind_box(out + ".bts");
    BoxView view = view_of(a, file);
    view.hub_height = site.hub_height;
    view.diameter = site.diameter;
    view.rotor_speed = site.rotor_speed;
    print_box(view);
    print_velocities("  asked for, of infinite time", target_of(request).deviations());
    if (!request.scaled) print_velocities("  expected of all seeds in this box", made.expected);
    warn_of_short_box(request, made.expected);
    set_target(view);
    std::string files = out + ".bts";
    if (!a.no_picture) {
        if (!draw(view, out + ".svg")) return 130;
        files += ", .svg";
    }
    std::printf("\nfiles: %s\n", files.c_str());
    return 0;
}

turbines::WindBoxFile turbulence_of(const Wind& wind, const std::string& path) {
    if (wind.box() == nullptr) throw InputError(path, "wind", "without turbulence", "a turbulent wind");
    return {.box = std::make_shared<const WindBox>(*wind.box()), .mean = wind.rows().front()};
}

turbines::WindBoxFile wind_to_look_at(const std::string& path) {
    if (turbines::is_result(path)) {
        const std::optional<Wind> wind = turbines::wind_of(turbines::input_description(path), path);
        return turbulence_of(wind.value_or(SteadyWind{}), path);
    }
    if (turbines::is_wind_box(path)) {
        turbines::WindBoxFile file = turbines::read_wind_box(path);
        print_notes(file.notes, false);
        return file;
    }
    if (lower_case(std::filesystem::path(path).extension().string()) == ".csv")
        throw InputError(path, "wind", "a table, without turbulence", "a turbulent wind");
    turbines::InflowWindFile file = turbines::read_inflow_wind(path);
    print_notes(file.notes, false);
    return turbulence_of(file.wind, path);
}

// A machine without a speed is a slip of its own.
void require_wind_file(const std::string& what) {
    const auto machines = turbines::built_in_machines();
    const std::string ending = lower_case(std::filesystem::path(what).extension().string());
    if (what.empty() || std::ranges::find(machines, what, &turbines::BuiltInMachine::name) != machines.end() ||
        ending == ".fst" || ending == ".yaml" || ending == ".yml")
        throw InputError(text(what.empty() ? "" : what + ": ",
                              "--speed is needed to make turbulence for a machine; a file with a wind is looked at "
                              "without"));
}

int look(const WindCommandArguments& a, const std::string& out) {
    require_wind_file(a.what);
    for (const Option& option : a.of_making)
        if (option.given())
            throw InputError(option.name(), "use", a.what,
                             "only with --speed or --turbulence ewm1, ewm50, to make a wind");
    const turbines::WindBoxFile file = wind_to_look_at(a.what);
    BoxView view = view_of(a, file);
    std::printf("%s: %s\n", a.what.c_str(), file.box->data().origin.format.c_str());
    print_box(view);
    set_target(view);
    if (a.no_picture) return 0;
    if (!draw(view, out + ".svg")) return 130;
    std::printf("\nfiles: %s.svg, beside %s\n", out.c_str(), view.target_name.c_str());
    return 0;
}

int run(WindCommandArguments& a, const CommandLine& /*command*/) {
    if (a.out.empty()) a.out = default_prefix(a.what.empty() ? "turbulent" : a.what, "wind");
    if (is_made(a))
        check_outputs(a.out, {".bts", ".svg"}, {a.what});
    else if (!a.no_picture)
        check_outputs(a.out, {".svg"}, {a.what});
    return is_made(a) ? make(a, a.out) : look(a, a.out);
}

}  // namespace

int wind_command(int argc, char** argv) {
    return run_command<WindCommandArguments>(
        "cardan wind",
        "Turbulent wind: made for a machine (with --speed, or --turbulence ewm1, ewm50), or looked at.\n"
        "Makes PREFIX.bts, which cardan simulate --wind and OpenFAST read, prints what a wind holds, and draws "
        "PREFIX.svg: spectra, coherence, a plane, and what a turning blade sees.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
