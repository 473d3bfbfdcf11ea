// The input file of a ROSCO controller, DISCON.IN.
#include "tests/fuzz/fuzz.hpp"
#include "turbines/readers/detail/controller_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const std::string_view text = fuzz::text_of(data, size);
    fuzz::try_it([&] {
        const FileOperation operation = operation_of(ControllerFile(text, "DISCON.IN"));
        for (const double number : {operation.rated_power, operation.min_rotor_speed, operation.tip_speed_ratio})
            fuzz::require_finite(number);
        for (const PitchAtWind& one : operation.min_pitch) fuzz::require_finite(one.wind + one.pitch);
    });
    fuzz::try_it([&] {
        for (const PitchAt& one : minimum_pitch(ControllerFile(text, "DISCON.IN")))
            fuzz::require_finite(one.rotor_speed + one.pitch);
    });
    return fuzz::try_it([&] { (void)gains_of(ControllerFile(text, "DISCON.IN")); });
}
