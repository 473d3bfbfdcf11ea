// An input of quadruples (place of three bytes, byte) changes a good Campbell diagram at these places; one that begins
// as an HDF5 file does is taken as it is.
#include "solvers/hdf5/campbell.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machines/wt600.hpp"

#include <iterator>

namespace {

using namespace cardan;
using namespace cardan::solvers;

std::string good_diagram() {
    const auto path = fuzz::folder() / "good.h5";
    const turbines::Turbine turbine = turbines::wt600({.tower_elements = 1, .blade_elements = 1});
    write_hdf5(campbell(turbine.system(), turbine.rotor(), {0.0, 1.0}), path);
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

// HDF5 1.10 itself loses some bytes when a header that it reads is damaged.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): the sanitizer's name
    return "detect_leaks=0";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string good = good_diagram();
    std::string bytes = good;
    if (fuzz::text_of(data, size).starts_with("\x89HDF"))
        bytes = fuzz::text_of(data, size);
    else
        for (std::size_t i = 0; i + 3 < size; i += 4)
            bytes[((data[i] * 256U + data[i + 1]) * 256U + data[i + 2]) % bytes.size()] =
                static_cast<char>(data[i + 3]);
    const auto path = fuzz::folder() / "a.h5";
    fuzz::write(path, bytes);
    fuzz::try_it([&] { (void)table(read_campbell(path)); });
    fuzz::try_it([&] { (void)read_campbell(path, CampbellShapes::read); });
    return fuzz::try_it([&] { (void)turbines::input_description(path); });
}
