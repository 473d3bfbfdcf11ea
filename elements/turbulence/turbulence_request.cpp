#include "elements/turbulence/turbulence_request.hpp"

#include "elements/turbulence/detail/fourier.hpp"
#include "elements/turbulence/mann_spectra.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

namespace cardan {

namespace {

// All 64 bits, which a double does not hold.
std::optional<std::uint64_t> whole_number(std::string_view digits) {
    constexpr std::uint64_t max = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t value = 0;
    for (const char c : digits) {
        if (!is_digit(c)) return std::nullopt;
        const auto digit = static_cast<std::uint64_t>(c - '0');
        if (value > (max - digit) / 10) return std::nullopt;
        value = 10 * value + digit;
    }
    return digits.empty() ? std::nullopt : std::optional(value);
}

constexpr auto request_place = "turbulence";
constexpr std::string_view note_begin = "Cardan: ";

// Even, without large prime factors: fast to transform.
int steps_of(double duration, double time_step) {
    constexpr int largest = 1 << 26;
    require_positive(request_place, "duration [s]", duration);
    require_positive(request_place, "time step [s]", time_step);
    const double least = std::ceil(duration / time_step * (1 - 1e-12));
    if (!(least <= largest))
        throw InputError(request_place, "duration over time step", least, text("at most ", largest));
    int steps = std::max(8, static_cast<int>(least));
    steps += steps % 2;
    while (detail::largest_factor(steps) > detail::max_factor) steps += 2;
    return steps;
}

MannParameters mann_of(const TurbulenceRequest& request) {
    MannParameters out = iec_mann(request.hub_height, request.deviation);
    out.dissipation *= request.deviation * request.deviation / mann_covariance(out)(0, 0);
    return out;
}

Kaimal kaimal_of(const TurbulenceRequest& request) {
    Kaimal out = kaimal_turbulence(request.speed, request.deviation, request.hub_height);
    out.transverse = request.transverse;
    return out;
}

MadeTurbulence kaimal_made(const TurbulenceRequest& request) {
    const Kaimal model = kaimal_of(request);
    MadeTurbulence out;
    out.box = kaimal_box(model, request.grid,
                         {.seed = request.seed,
                          .scaling = request.scaled ? DeviationScaling::centre : DeviationScaling::none,
                          .threads = request.threads,
                          .cancelled = request.cancelled,
                          .progress = request.progress});
    for (int c = 0; c < 3; ++c)
        out.expected[c] = std::sqrt(model.variance_of_lines(c, request.grid.steps, request.grid.time_step));
    return out;
}

MadeTurbulence mann_made(const TurbulenceRequest& request) {
    MannBox box = mann_box({.grid = request.grid,
                            .speed = request.speed,
                            .parameters = mann_of(request),
                            .seed = request.seed,
                            .scaling = request.scaled ? MannScaling::centre : MannScaling::expected,
                            .sigma = request.deviation,
                            .order = request.order,
                            .threads = request.threads,
                            .cancelled = request.cancelled,
                            .progress = request.progress});
    MadeTurbulence out;
    out.expected = box.expected.diagonal().cwiseMax(0).cwiseSqrt();
    out.box = std::move(static_cast<TurbulenceBox&>(box));
    return out;
}

// Words of a note, and what the request says by them.
constexpr std::string_view incoherent_words = "v w incoherent", mirrored_words = "first plane first",
                           scaled_words = "scaled";

std::string note_of(const TurbulenceRequest& request) {
    std::string out = text(note_begin, name_of(request.model), ", V ", digits(request.speed), " m/s, hub ",
                           digits(request.hub_height), " m, sigma_1 ", digits(request.deviation), " m/s, exponent ",
                           digits(request.exponent), ", seed ", request.seed);
    if (request.model == TurbulenceModel::kaimal && request.transverse == TransverseCoherence::none)
        out += text(", ", incoherent_words);
    if (request.model == TurbulenceModel::mann && request.order == PlaneOrder::first_first)
        out += text(", ", mirrored_words);
    if (request.scaled) out += text(", ", scaled_words);
    return out;
}

// "sigma_1 2 m/s" is the number of the field "sigma_1".
bool take_field(std::string_view words, TurbulenceRequest& request) {
    if (words == incoherent_words) return request.transverse = TransverseCoherence::none, true;
    if (words == mirrored_words) return request.order = PlaneOrder::first_first, true;
    if (words == scaled_words) return request.scaled = true;
    const std::size_t blank = std::min(words.find(' '), words.size());
    const std::string_view name = words.substr(0, blank), rest = words.substr(std::min(blank + 1, words.size()));
    const std::string_view number = rest.substr(0, rest.find(' '));
    if (name == "seed") {
        const std::optional<std::uint64_t> seed = whole_number(number);
        request.seed = seed.value_or(0);
        return seed.has_value();
    }
    for (const auto& [field, value] : {std::pair("V", &request.speed),
                                       {"hub", &request.hub_height},
                                       {"sigma_1", &request.deviation},
                                       {"exponent", &request.exponent}})
        if (name == field) {
            const ReadNumber read = read_number(number);
            *value = read.value;
            return read.good();
        }
    return false;
}

// The numbers of a box in memory, and what keeps them.
WindBoxData data_of(const std::shared_ptr<const TurbulenceBox>& box) {
    WindBoxData out{.grid = box->grid, .components = {}, .speed = box->speed, .periodic = true, .memory = box};
    for (int c = 0; c < 3; ++c)
        entry(out.components, c) = {.data = entry(box->velocity, c).data(),
                                    .type = BoxNumbers::Type::float32,
                                    .step = std::ptrdiff_t{box->grid.rows} * box->grid.columns,
                                    .row = box->grid.columns,
                                    .column = 1};
    return out;
}

}  // namespace

const char* name_of(TurbulenceModel model) {
    return model == TurbulenceModel::kaimal ? "kaimal" : "mann";
}

BoxGrid rotor_grid(double hub_height, double rotor_diameter, const RotorGridOptions& options) {
    constexpr auto where = "grid around a rotor";
    require_positive(where, "hub height [m]", hub_height);
    require_positive(where, "rotor diameter [m]", rotor_diameter);
    const double radius = rotor_diameter / 2;
    if (radius >= hub_height)
        throw InputError(where, "rotor diameter [m]", rotor_diameter,
                         text("below ", 2 * hub_height, ", twice the hub height"));
    for (const auto& [what, count] : {std::pair("rows", options.rows), {"columns", options.columns}})
        if (count < 2) throw InputError(where, what, count, "at least 2");
    const double width = options.width.value_or(1.2 * rotor_diameter);
    const double height =
        options.height.value_or(std::min(1.2 * rotor_diameter, 2 * (radius + 0.75 * (hub_height - radius))));
    require_positive(where, "width [m]", width);
    require_positive(where, "height [m]", height);
    constexpr double rounding = 1 - 1e-9;
    if (width < rotor_diameter * rounding)
        throw InputError(where, "width [m]", width, text("at least ", rotor_diameter, ", the rotor's diameter"));
    if (height < rotor_diameter * rounding || height >= 2 * hub_height)
        throw InputError(where, "height [m]", height,
                         text("at least ", rotor_diameter, ", the rotor's diameter, and below ", 2 * hub_height,
                              ", at which the lowest points would be on the ground"));
    constexpr double finest = 0.01;  // m, far below the diameter of any eddy that a rotor feels
    if (height / (options.rows - 1) < finest || width / (options.columns - 1) < finest)
        throw InputError(where, "spacing of the points [m]",
                         std::min(height / (options.rows - 1), width / (options.columns - 1)),
                         text("at least ", finest));
    const int steps = steps_of(options.duration, options.time_step);
    if (options.time_step > options.duration / 2)
        throw InputError(where, "time between planes [s]", options.time_step,
                         text("at most half of the duration, ", options.duration / 2));
    return {.steps = steps,
            .rows = options.rows,
            .columns = options.columns,
            .time_step = options.time_step,
            .row_spacing = height / (options.rows - 1),
            .column_spacing = width / (options.columns - 1),
            .lowest = hub_height - height / 2};
}

void TurbulenceRequest::check() const {
    require_positive(request_place, "mean wind speed [m/s]", speed);
    require_positive(request_place, "standard deviation [m/s]", deviation);
    for (const auto& [what, value, max] :
         {std::tuple("mean wind speed [m/s]", speed, 200.0), {"standard deviation [m/s]", deviation, 100.0}})
        if (value > max) throw InputError(request_place, what, value, text("up to ", max));
    require_positive(request_place, "hub height [m]", hub_height);
    if (!(std::abs(exponent) <= 1)) throw InputError(request_place, "exponent of the shear", exponent, "-1 ... 1");
}

const char* name_of(IecTurbulence kind) {
    constexpr std::array names{"ntm", "etm", "ewm1", "ewm50"};
    return entry(names, kind);
}

TurbulenceRequest iec_turbulence(IecTurbulence kind, const IecClass& wind_class, double hub_height, double speed) {
    TurbulenceRequest out{.speed = speed, .hub_height = hub_height};
    if (kind == IecTurbulence::ewm1 || kind == IecTurbulence::ewm50) {
        if (speed != 0)
            throw InputError(request_place, text("mean wind speed of ", name_of(kind), " [m/s]"), speed,
                             "none, as the class has it");
        out.speed = iec_turbulent_extreme_speed(
            wind_class, kind == IecTurbulence::ewm1 ? IecRecurrence::one_year : IecRecurrence::fifty_years);
        out.deviation = iec_turbulent_extreme_intensity * out.speed;
        out.exponent = iec_extreme_exponent;
    } else {
        require_positive(request_place, "mean wind speed [m/s]", speed);
        out.deviation = kind == IecTurbulence::ntm ? iec_normal_turbulence(wind_class, speed)
                                                   : iec_extreme_turbulence(wind_class, speed);
    }
    out.check();
    return out;
}

Vec3 TurbulenceTarget::spectra(double frequency) const {
    if (const auto* const kaimal = std::get_if<Kaimal>(&model))
        return {kaimal->spectrum(0, frequency), kaimal->spectrum(1, frequency), kaimal->spectrum(2, frequency)};
    return mann_spectrum_over_time(std::get<MannParameters>(model), frequency, speed).diagonal();
}

double TurbulenceTarget::coherence(int component, double frequency, double distance) const {
    if (const auto* const kaimal = std::get_if<Kaimal>(&model)) {
        if (component > 0 && kaimal->transverse == TransverseCoherence::none) return 0;
        return kaimal->coherence(frequency, distance);
    }
    const auto& mann = std::get<MannParameters>(model);
    const double k1 = 2 * pi * frequency / speed;
    return mann_cross_spectrum(mann, k1, distance, 0)(component, component).real() /
           mann_spectrum(mann, k1)(component, component);
}

Vec3 TurbulenceTarget::deviations() const {
    if (const auto* const kaimal = std::get_if<Kaimal>(&model)) return kaimal->deviation;
    return mann_covariance(std::get<MannParameters>(model)).diagonal().cwiseSqrt();
}

TurbulenceTarget target_of(const TurbulenceRequest& request) {
    request.check();
    if (request.model == TurbulenceModel::kaimal) return {kaimal_of(request), request.speed};
    return {mann_of(request), request.speed};
}

MadeTurbulence make_turbulence(const TurbulenceRequest& request) {
    request.check();
    MadeTurbulence out = request.model == TurbulenceModel::kaimal ? kaimal_made(request) : mann_made(request);
    out.mean.speed = request.speed;
    out.mean.reference_height = request.hub_height;
    out.mean.shear = request.exponent == 0 ? Shear::none : Shear::power;
    out.mean.exponent = request.exponent;
    out.note = note_of(request);
    if (out.box.grid.steps > 0) out.realised = realised(out.box);
    return out;
}

std::shared_ptr<const WindBox> wind_box_of(MadeTurbulence made) {
    WindBoxData data = data_of(std::make_shared<const TurbulenceBox>(std::move(made.box)));
    data.outside = OutsideBox::hold;
    data.origin.format = "made in memory";
    data.origin.note = std::move(made.note);
    return std::make_shared<const WindBox>(std::move(data));
}

std::optional<TurbulenceRequest> request_of_note(std::string_view note) {
    if (!note.starts_with(note_begin)) return std::nullopt;
    note.remove_prefix(note_begin.size());
    TurbulenceRequest out;
    const std::size_t comma = std::min(note.find(','), note.size());
    if (note.substr(0, comma) == name_of(TurbulenceModel::mann))
        out.model = TurbulenceModel::mann;
    else if (note.substr(0, comma) != name_of(TurbulenceModel::kaimal))
        return std::nullopt;
    for (std::size_t at = comma; at < note.size();) {
        const std::size_t begin = std::min(note.find_first_not_of(' ', at + 1), note.size());
        const std::size_t end = std::min(note.find(',', begin), note.size());
        if (!take_field(note.substr(begin, end - begin), out)) return std::nullopt;
        at = end;
    }
    if (!(out.speed > 0 && out.deviation > 0 && out.hub_height > 0)) return std::nullopt;
    return out;
}

}  // namespace cardan
