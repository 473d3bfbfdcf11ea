// The first byte says which of the four files of a blade the rest replaces; the others are those of tests/data.
#include "tests/fuzz/fuzz.hpp"
#include "turbines/readers/aerodyn.hpp"

#include <array>

namespace {

constexpr std::array<const char*, 4> files{"small_AeroDyn.dat", "small_AeroDyn_Blade.dat", "small_Polar_1.dat",
                                           "small_Polar_2.dat"};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const auto read = [](const std::filesystem::path&) {
        fuzz::try_it([] {
            const AeroDynFile air = read_aerodyn(fuzz::folder() / files[0], 1.5);
            fuzz::require_finite(rotor_coefficients(air.blade, 3, -0.05, 7, 0.02, air.options).power);
        });
    };
    return fuzz::with_one_replaced(CARDAN_SOURCE_DIR "/tests/data/aerodyn", files, data, size, read);
}
