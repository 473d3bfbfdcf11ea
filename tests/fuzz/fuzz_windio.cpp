#include "tests/fuzz/fuzz.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/yaml/windio.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    return fuzz::try_it([&] {
        const TurbineFile machine = parse_windio(std::string(fuzz::text_of(data, size)), "a.yaml");
        (void)assemble(machine.description, {.tower_elements = 1, .blade_elements = 1});
    });
}
