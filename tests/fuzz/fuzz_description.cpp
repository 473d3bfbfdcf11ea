#include "tests/fuzz/fuzz.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/yaml/description.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const std::string text(fuzz::text_of(data, size));
    return fuzz::try_it([&] {
        (void)is_description(text);
        const Machine machine = parse_machine(text, "a.yaml");
        if (!machine.description.missing.empty()) return;
        std::string written;
        fuzz::must_succeed([&] { written = to_yaml(machine); });  // finite, for one
        if (to_yaml(parse_machine(written, "b.yaml")) != written) std::abort();
        if (to_yaml(parse_description(written, "b.yaml")) != to_yaml(machine.description)) std::abort();
        (void)assemble(machine.description, {.tower_elements = 1, .blade_elements = 1});
    });
}
