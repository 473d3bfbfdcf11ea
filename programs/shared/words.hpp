/// @file
/// Words of options: numbers, lists with separators.
#pragma once

#include "mbs/base/error.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace cardan::program {

/// A finite number, all of the text.
inline double number(const char* option, const std::string& given, const std::string& word, const char* allowed) {
    const ReadNumber read = read_number(word);
    if (!read.good()) throw InputError(option, "value", given, allowed);
    return read.value;
}

/// Words between separators, empty words included; at least one.
inline std::vector<std::string> split(const std::string& joined, char separator) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= joined.size();) {
        const std::size_t end = std::min(joined.find(separator, at), joined.size());
        words.push_back(joined.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

/// Finite numbers separated by commas, at least one.  @throws InputError naming the option
inline std::vector<double> numbers(const char* option, const std::string& given, const char* allowed) {
    std::vector<double> all;
    for (const std::string& word : split(given, ',')) all.push_back(number(option, given, word, allowed));
    return all;
}

struct NumberRange {
    double first, last, step;
};
/// Numbers (first and last, step 1), and FIRST:LAST:STEP, separated by commas: "3:10:1,11.4".
/// @throws InputError naming the option
inline std::vector<NumberRange> ranges(const char* option, const std::string& given, const char* allowed) {
    std::vector<NumberRange> all;
    for (const std::string& word : split(given, ',')) {
        std::vector<double> parts;
        for (const std::string& part : split(word, ':')) parts.push_back(number(option, given, part, allowed));
        if (parts.size() == 1) parts = {parts[0], parts[0], 1};
        if (parts.size() != 3) throw InputError(option, "value", given, allowed);
        all.push_back({parts[0], parts[1], parts[2]});
    }
    return all;
}

/// The numbers of such ranges.  @throws InputError also for a range that falls, or of more than 1e5 numbers
inline std::vector<double> numbers_in_ranges(const char* option, const std::string& given, const char* allowed) {
    std::vector<double> all;
    for (const NumberRange& range : ranges(option, given, allowed)) {
        const double steps = (range.last - range.first) / range.step;
        if (!(steps >= 0 && steps <= 1e5)) throw InputError(option, "value", given, allowed);
        for (int i = 0; i <= static_cast<int>(steps + 1e-9); ++i) all.push_back(range.first + i * range.step);
    }
    return all;
}

}  // namespace cardan::program
