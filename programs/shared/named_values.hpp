/// @file
/// Options such as --q elbow=0.5: numbers by name, or one number for all.
#pragma once

#include "mbs/model/coordinates.hpp"
#include "programs/shared/words.hpp"

#include <map>
#include <string>
#include <vector>

namespace cardan::program {

/// The values of all coordinates: `initial`, changed in turn by "name=value" or, if `for_all`, by "value" alone.
/// @throws InputError naming the option
inline Vector named_values(const char* option, const std::vector<std::string>& given, const CoordinateTable& table,
                           Vector initial, bool for_all) {
    const char* const allowed = for_all ? "NUMBER or COORDINATE=NUMBER" : "COORDINATE=NUMBER";
    for (const std::string& word : given) {
        const std::size_t equals = word.rfind('=');
        if (equals == std::string::npos) {
            if (!for_all) throw InputError(option, "value", word, allowed);
            initial.setConstant(number(option, word, word, allowed));
            continue;
        }
        const double value = number(option, word, word.substr(equals + 1), allowed);
        initial(table.index(word.substr(0, equals))) = value;
    }
    return initial;
}

/// Numbers given as NAME=VALUE by their names, the last one of each name.  @throws InputError naming the option
inline std::map<std::string, double> named_numbers(const char* option, const std::vector<std::string>& given) {
    constexpr auto allowed = "COORDINATE=NUMBER";
    std::map<std::string, double> all;
    for (const std::string& word : given) {
        const std::size_t equals = word.rfind('=');
        if (equals == std::string::npos) throw InputError(option, "value", word, allowed);
        all[word.substr(0, equals)] = number(option, word, word.substr(equals + 1), allowed);
    }
    return all;
}

}  // namespace cardan::program
