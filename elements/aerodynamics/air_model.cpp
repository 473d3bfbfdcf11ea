#include "elements/aerodynamics/air_model.hpp"

#include "mbs/base/error.hpp"

#include <array>
#include <string>
#include <utility>

namespace cardan {

namespace {

constexpr std::array wakes{std::pair{Wake::none, "none"}, std::pair{Wake::frozen, "frozen"},
                           std::pair{Wake::equilibrium, "equilibrium"}, std::pair{Wake::oye, "oye"}};
constexpr std::array airfoil_models{std::pair{Airfoils::steady, "steady"}, std::pair{Airfoils::unsteady, "unsteady"}};
// Names of earlier versions, and what is called so now.
constexpr std::array earlier{std::pair{"quasi-steady", "equilibrium"}, std::pair{"dynamic", "oye"}};

template <class Names, class Value>
std::string_view name_in(const Names& names, Value value) {
    for (const auto& [one, name] : names)
        if (one == value) return name;
    return {};
}

}  // namespace

std::string_view name_of(Wake wake) {
    return name_in(wakes, wake);
}

Wake wake_named(std::string_view name, const char* option) {
    for (const auto& [wake, known] : wakes)
        if (name == known) return wake;
    for (const auto& [before, now] : earlier)
        if (name == before) throw InputError(option, "value", std::string(name), text(now, ", as it is called now"));
    throw InputError(option, "value", std::string(name), "none, frozen, equilibrium or oye");
}

std::string_view name_of(Airfoils airfoils) {
    return name_in(airfoil_models, airfoils);
}

Airfoils airfoils_named(std::string_view name, const char* option) {
    for (const auto& [airfoils, known] : airfoil_models)
        if (name == known) return airfoils;
    throw InputError(option, "value", std::string(name), "steady or unsteady");
}

}  // namespace cardan
