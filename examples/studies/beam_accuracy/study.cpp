#include "examples/studies/beam_accuracy/study.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace cardan::accuracy {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string format(const char* pattern, double value) {
    std::array<char, 40> buffer{};
    const int n = std::snprintf(buffer.data(), buffer.size(), pattern, value);
    return {buffer.data(), static_cast<std::size_t>(n)};
}

std::string padded(const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::size_t place_of(const Study& study, int elements) {
    const auto at = std::find(study.elements.begin(), study.elements.end(), elements);
    if (at == study.elements.end()) throw InputError(study.name, "elements of a check", elements, "those of the study");
    return static_cast<std::size_t>(at - study.elements.begin());
}

// Smallest number of elements from which on the error stays below a bound.
std::string need(const Result& result, std::size_t m, std::size_t k, double bound) {
    std::string number = "-";
    for (std::size_t i = result.study.elements.size(); i-- > 0;) {
        const double error = std::abs(result.error[m][k][i]);
        if (std::isnan(error) && number == "-") continue;  // not computed
        if (!(error <= bound)) break;
        number = text(result.study.elements[i]);
    }
    return number;
}

void print_needs(const Result& result, std::ostream& out) {
    const Study& study = result.study;
    out << "\nelements for an error below 1 % | 0.1 % | 0.01 %\n";
    for (std::size_t k = 0; k < study.quantities.size(); ++k) {
        out << padded(study.quantities[k].name, 16) << ":";
        for (std::size_t m = 0; m < study.methods.size(); ++m)
            out << "  " << study.methods[m] << " " << need(result, m, k, 1e-2) << " | " << need(result, m, k, 1e-3)
                << " | " << need(result, m, k, 1e-4) << (m + 1 < study.methods.size() ? ";" : "\n");
    }
}

}  // namespace

double Result::order(std::size_t method, std::size_t quantity, std::size_t place, std::size_t before) const {
    const double coarse = std::abs(error[method][quantity][before]), fine = std::abs(error[method][quantity][place]);
    if (!(fine > floor_of_precision) || !(coarse > 0)) return none;
    return std::log(coarse / fine) / std::log(double(study.elements[place]) / study.elements[before]);
}

bool run(const Study& study, Result& result, const std::function<bool(const std::string&)>& progress) {
    result.study = study;
    const std::vector<double> empty(study.elements.size(), none);
    result.value.assign(study.methods.size(), std::vector(study.quantities.size(), empty));
    result.error = result.value;
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
        const Method& how = method(study.methods[m]);
        bool refused = false;
        for (std::size_t i = 0; i < study.elements.size(); ++i) {
            const int n = study.elements[i];
            if (how.scheme == Scheme::mixed && n > study.mixed_elements) continue;
            if (!progress(text(study.name, ", ", how.key, ", ", n, " elements"))) return false;
            try {
                const std::vector<double> values = study.compute(how, n);
                for (std::size_t k = 0; k < std::min(values.size(), study.quantities.size()); ++k) {
                    const double reference = study.quantities[k].reference;
                    result.value[m][k][i] = values[k];
                    result.error[m][k][i] = reference == 0 ? values[k] : values[k] / reference - 1;
                }
            } catch (const Error& e) {  // an answer, too
                if (!refused) result.refusals.push_back(text(how.key, ", ", n, " elements: ", e.what()));
                refused = true;
            }
        }
    }
    return true;
}

void print(const Result& result, std::ostream& out) {
    const Study& study = result.study;
    out << "\n== " << study.name << ": " << study.title << "\n";
    for (std::size_t k = 0; k < study.quantities.size(); ++k) {
        const Quantity& quantity = study.quantities[k];
        out << "\n" << quantity.name;
        if (quantity.reference != 0) out << " = " << format("%.9g", quantity.reference);
        out << " (" << quantity.source << "); error, % (order from the row above)\n" << padded("elements", 9);
        for (const std::string& key : study.methods) out << padded(key, 20);
        out << "\n";
        for (std::size_t i = 0; i < study.elements.size(); ++i) {
            out << padded(text(study.elements[i]), 9);
            for (std::size_t m = 0; m < study.methods.size(); ++m) {
                const double error = result.error[m][k][i];
                const double order = i > 0 ? result.order(m, k, i, i - 1) : none;
                std::string cell = std::isnan(error) ? "-" : format("%+.3g", 100 * error);
                cell += std::isnan(order) ? "       " : " (" + padded(format("%.1f", order), 4) + ")";
                out << padded(cell, 20);
            }
            out << "\n";
        }
    }
    print_needs(result, out);
    for (const std::string& refusal : result.refusals) out << "refused: " << refusal << "\n";
    if (!study.note.empty()) out << study.note << "\n";
}

std::string csv(const Result& result) {
    const Study& study = result.study;
    std::string lines = "case,quantity,method,elements,value,reference,relative_error\n";
    for (std::size_t m = 0; m < study.methods.size(); ++m)
        for (std::size_t k = 0; k < study.quantities.size(); ++k)
            for (std::size_t i = 0; i < study.elements.size(); ++i) {
                if (std::isnan(result.error[m][k][i])) continue;
                const Quantity& quantity = study.quantities[k];
                lines += text(study.name, ",\"", quantity.name, "\",", study.methods[m], ",", study.elements[i], ",",
                              format("%.12g", result.value[m][k][i]), ",", format("%.12g", quantity.reference), ",",
                              format("%.6g", result.error[m][k][i]), "\n");
            }
    return lines;
}

int check(const Result& result, std::ostream& out) {
    const Study& study = result.study;
    int failures = 0;
    if (!study.checks.empty()) out << "\ncheck: computed | reference | error\n";
    for (const Check& c : study.checks) {
        const auto at = std::find(study.methods.begin(), study.methods.end(), c.method);
        if (at == study.methods.end()) throw InputError(study.name, "method of a check", c.method, "one of the study");
        const auto m = static_cast<std::size_t>(at - study.methods.begin());
        const std::size_t place = place_of(study, c.elements);
        const bool order = c.kind == Check::Kind::order;
        const double computed = order ? result.order(m, c.quantity, place, place_of(study, c.elements / 2))
                                      : 100 * result.error[m][c.quantity][place];
        const double off = order ? computed - c.expected : computed / c.expected - 1;
        const bool good = std::abs(off) <= c.tolerance;
        if (!good) ++failures;
        out << (good ? "  ok   " : "  OFF  ") << study.name << ", " << study.quantities.at(c.quantity).name << ", "
            << c.method << ", " << c.elements << " elements, " << (order ? "order: " : "error in %: ")
            << format("%.4g", computed) << " | " << format("%.4g", c.expected) << " | "
            << (order ? format("%+.3f", off) : format("%+.2f", 100 * off) + " %") << "\n";
    }
    return failures;
}

}  // namespace cardan::accuracy
