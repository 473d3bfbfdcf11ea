// Models of machines as YAML, from the installed package.
#include <cardan/mbs/base/error.hpp>
#include <cardan/turbines/yaml/description.hpp>
#include <cardan/turbines/yaml/windio.hpp>

#include <iostream>

int main() {
    try {
        static_cast<void>(cardan::turbines::parse_description("cardan_turbine: 1\n", "text"));
    } catch (const cardan::ParseError& error) {
        std::cout << error.what() << "\n";
    }
    return cardan::turbines::is_description("cardan_turbine: 1\n") ? 0 : 1;
}
