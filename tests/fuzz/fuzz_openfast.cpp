// The first byte says which of the eight files of a model the rest replaces; the others are those of tests/data.
#include "tests/fuzz/fuzz.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/readers/openfast.hpp"

#include <array>

namespace {

constexpr std::array<const char*, 8> files{
    "small.fst",         "small_ElastoDyn.dat", "small_Blade.dat",         "small_Tower.dat",
    "small_BeamDyn.fst", "small_BeamDyn.dat",   "small_BeamDyn_Blade.dat", "small_ServoDyn.dat"};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const auto read = [](const std::filesystem::path&) {
        for (const char* main : {"small.fst", "small_BeamDyn.fst"})
            fuzz::try_it([&] {
                const TurbineFile machine = read_openfast(fuzz::folder() / main);
                (void)assemble(machine.description, {.tower_elements = 1, .blade_elements = 1});
                fuzz::must_succeed([&] { (void)to_yaml(machine.description); });  // finite, for one
                for (const double number : {machine.rotor_speed, machine.pitch, machine.operation.rated_power,
                                            machine.operation.min_rotor_speed, machine.gravity})
                    fuzz::require_finite(number);
            });
    };
    return fuzz::with_one_replaced(CARDAN_SOURCE_DIR "/tests/data/openfast", files, data, size, read);
}
