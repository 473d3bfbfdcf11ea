#include "elements/turbulence/box_spectra.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

namespace {

constexpr int circle_angles = 2048, most_harmonics = 120;

void require_component(int component) {
    if (component < 0 || component > 2) throw InputError("wind box", "component", component, "0 ... 2");
}

void require_index(const char* what, int index, int count) {
    if (index < 0 || index >= count) throw InputError("wind box", what, index, text("0 ... ", count - 1));
}

// At most so many of them, evenly spaced.
std::vector<int> some_rows(int rows, int most) {
    const int count = std::min(rows, most);
    std::vector<int> out;
    out.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) out.push_back(count == 1 ? rows / 2 : i * (rows - 1) / (count - 1));
    return out;
}

// c_n of a frequency: the coherence is an even function of the angle, with a kink at 0, so that Simpson's rule is taken
// from there to half way round.
double circle_harmonic(const std::function<double(double, double)>& coherence, double radius, double f, int n,
                       const std::vector<double>& cosines) {
    constexpr int half = circle_angles / 2;
    double sum = 0;
    for (int a = 0; a <= half; ++a) {
        const double gamma = coherence(f, 2 * radius * std::sin(pi * a / circle_angles));
        const int weight = a == 0 || a == half ? 1 : a % 2 == 1 ? 4 : 2;
        sum += weight * gamma * entry(cosines, n * a % circle_angles);
    }
    return sum / (3 * half);
}

}  // namespace

TimeSeries series_at(const WindBox& box, int component, int row, int column) {
    const BoxGrid& grid = box.grid();
    require_component(component);
    require_index("row", row, grid.rows);
    require_index("column", column, grid.columns);
    TimeSeries out{.values = {}, .step = grid.time_step, .periodic = box.data().periodic};
    out.values.reserve(static_cast<std::size_t>(grid.steps));
    for (int t = 0; t < grid.steps; ++t) out.values.push_back(box.at_point(t, row, column)[component]);
    return out;
}

std::vector<Coherence> coherences_across(const WindBox& box, int component, std::span<const int> columns_apart,
                                         const CoherenceOptions& options) {
    const BoxGrid& grid = box.grid();
    require_component(component);
    for (const int apart : columns_apart)
        if (apart < 1 || apart >= grid.columns)
            throw InputError("coherence", "columns apart", apart, text("1 ... ", grid.columns - 1));
    if (options.rows < 1) throw InputError("coherence", "number of rows", options.rows, ">= 1");

    const std::vector<int> rows = some_rows(grid.rows, options.rows);
    std::vector<SpectrumLines> lines;
    for (const int row : rows)
        for (int column = 0; column < grid.columns; ++column) {
            if (options.cancelled && options.cancelled()) return {};
            lines.push_back(spectrum_lines(series_at(box, component, row, column)));
        }
    std::vector<Coherence> out;
    for (const int apart : columns_apart) {
        std::vector<SeriesPair> pairs;
        for (std::size_t row = 0; row < rows.size(); ++row)
            for (int column = 0; column + apart < grid.columns; ++column) {
                const auto first = row * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
                pairs.push_back({first, first + static_cast<std::size_t>(apart)});
            }
        out.push_back(coherence(lines, pairs, options.per_decade));
    }
    return out;
}

Coherence coherence_across(const WindBox& box, int component, int columns_apart, const CoherenceOptions& options) {
    std::vector<Coherence> one = coherences_across(box, component, {&columns_apart, 1}, options);
    return one.empty() ? Coherence() : std::move(one.front());
}

Vec3 TurningPoint::place(double time) const {
    const double psi = azimuth + rotor_speed * time;
    return {0, -radius * std::sin(psi), hub_height + radius * std::cos(psi)};
}

TimeSeries series_at(const WindBox& box, int component, const TurningPoint& point, double step) {
    constexpr auto where = "turning point";
    require_component(component);
    require_not_negative(where, "radius [m]", point.radius);
    require_not_negative(where, "step [s]", step);
    for (const auto& [what, number] : {std::pair("hub height [m]", point.hub_height),
                                       {"rotor speed [rad/s]", point.rotor_speed},
                                       {"azimuth [rad]", point.azimuth}})
        if (!std::isfinite(number)) throw InputError(where, what, number, "finite");
    const BoxGrid& grid = box.grid();
    TimeSeries out{.values = {}, .step = step > 0 ? step : grid.time_step, .periodic = false};
    const WindBoxData& data = box.data();
    // Of a box that is not periodic the planes from `start` on that are whole.
    const double first = data.periodic ? 0 : -data.start / data.speed;
    const double length = (data.periodic ? grid.steps : grid.steps - 1) * grid.time_step;
    const auto count = static_cast<std::size_t>(std::floor(length / out.step * (1 + 1e-12))) + (data.periodic ? 0 : 1);
    out.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double time = static_cast<double>(i) * out.step;
        out.values.push_back(box.at(point.place(time), first + time)[component]);
    }
    return out;
}

PowerSpectrum turning_spectrum(const WindBox& box, int component, const TurningPoint& point, int azimuths) {
    if (azimuths < 1) throw InputError("turning point", "number of azimuths", azimuths, ">= 1");
    std::vector<PowerSpectrum> spectra;
    for (int i = 0; i < azimuths; ++i) {
        TurningPoint turned = point;
        turned.azimuth += 2 * pi * i / azimuths;
        spectra.push_back(power_spectrum(spectrum_lines(series_at(box, component, turned))));
    }
    return mean_spectrum(spectra);
}

double turning_spectrum(const std::function<double(double f)>& spectrum,
                        const std::function<double(double f, double distance)>& coherence, double radius,
                        double rotor_speed, double frequency, int harmonics) {
    constexpr auto where = "spectrum of a turning point";
    require_positive(where, "radius [m]", radius);
    require_positive(where, "rotor speed [rad/s]", rotor_speed);
    require_positive(where, "frequency [Hz]", frequency);
    if (harmonics < 0 || harmonics > most_harmonics)
        throw InputError(where, "harmonics", harmonics, text("0 ... ", most_harmonics));
    const double P = rotor_speed / (2 * pi);
    if (harmonics == 0) harmonics = static_cast<int>(std::min<double>(most_harmonics, std::ceil(frequency / P) + 24));
    std::vector<double> cosines;
    cosines.reserve(circle_angles);
    for (int a = 0; a < circle_angles; ++a) cosines.push_back(std::cos(2 * pi * a / circle_angles));
    double sum = 0;
    for (int n = -harmonics; n <= harmonics; ++n) {
        const double f = std::abs(frequency - n * P);
        if (f > 0) sum += spectrum(f) * circle_harmonic(coherence, radius, f, std::abs(n), cosines);
    }
    return sum;
}

}  // namespace cardan
