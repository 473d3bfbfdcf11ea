#include "tests/fuzz/fuzz.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/yaml/windio.hpp"
#include "turbines/yaml/windio_air.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const std::string text(fuzz::text_of(data, size));
    fuzz::try_it([&] {
        const TurbineFile machine = parse_windio(text, "a.yaml");
        (void)assemble(machine.description, {.tower_elements = 1, .blade_elements = 1});
        fuzz::must_succeed([&] { (void)to_yaml(machine.description); });  // finite, for one
    });
    return fuzz::try_it([&] {
        const WindioAir air = parse_windio_air(text, "a.yaml", 1);
        fuzz::require_finite(rotor_coefficients(air.blade, 3, -0.05, 7, 0.02, air.options).power);
    });
}
