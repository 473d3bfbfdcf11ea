#include "turbines/analysis/rising.hpp"

#include "mbs/base/error.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/analysis/in_unit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cardan::turbines {

namespace {

// "8, 10, 12 m/s"; of many the first and the last.
std::string in_words(const std::vector<double>& values, double unit, const std::string& unit_name) {
    constexpr std::size_t many = 6;
    const auto one = [&](double value) { return rounded(in_unit(value, unit)); };
    if (values.size() > many)
        return text(values.size(), " from ", one(values.front()), " to ", one(values.back()), " ", unit_name);
    std::string words;
    for (const double value : values) words += text(words.empty() ? "" : ", ", one(value));
    return text(words, " ", unit_name);
}

}  // namespace

std::vector<double> rising(std::vector<double> values, const char* field, const char* what, double unit,
                           const std::string& unit_name, const Report& report) {
    for (const double value : values)
        if (!(std::isfinite(value) && value >= 0))
            throw InputError(field, text("value [", unit_name, "]"), in_unit(value, unit), "finite and >= 0");
    // Steps of a range may be another number by rounding than the one that is given beside it.
    const auto same = [](double a, double b) { return std::abs(b - a) <= 1e-9 * std::max(a, b); };
    const auto rises = [&](double a, double b) { return a < b && !same(a, b); };
    if (std::ranges::adjacent_find(values, std::not_fn(rises)) == values.end()) return values;
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
    report_remark(
        report, {Remark::Kind::taken, text(what, ": in rising order, each once: ", in_words(values, unit, unit_name))});
    return values;
}

}  // namespace cardan::turbines
