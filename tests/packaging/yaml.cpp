// Models of machines as YAML, from the installed package.
#include "mbs/base/error.hpp"
#include "turbines/yaml/description.hpp"
#include "turbines/yaml/windio.hpp"

#include <iostream>

int main() {
    try {
        static_cast<void>(cardan::turbines::parse_description("cardan_turbine: 1\n", "text"));
    } catch (const cardan::ParseError& error) {
        std::cout << error.what() << "\n";
    }
    return cardan::turbines::is_description("cardan_turbine: 1\n") ? 0 : 1;
}
