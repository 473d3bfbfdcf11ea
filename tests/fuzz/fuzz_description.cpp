#include "tests/fuzz/fuzz.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/yaml/description.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const std::string text(fuzz::text_of(data, size));
    return fuzz::try_it([&] {
        (void)is_description(text);
        const TurbineDescription machine = parse_description(text, "a.yaml");
        const std::string written = to_yaml(machine);
        if (to_yaml(parse_description(written, "b.yaml")) != written) std::abort();
        (void)assemble(machine, {.tower_elements = 1, .blade_elements = 1});
    });
}
