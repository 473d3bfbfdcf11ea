// A good Campbell diagram with changes at arbitrary places.
#include "solvers/campbell/diagram.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "tests/fuzz/fuzz_hdf5.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/reference_turbines/wt600.hpp"

namespace {

using namespace cardan;
using namespace cardan::solvers;

std::string good_diagram() {
    const auto path = fuzz::folder() / "good.h5";
    const turbines::Turbine turbine = turbines::wt600({.tower_elements = 1, .blade_elements = 1});
    write_hdf5(campbell(turbine.system(), turbine.rotor(), {0.0, 1.0}), path);
    return fuzz::bytes_of(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string good = good_diagram();
    const auto path = fuzz::with_changes(good, data, size);
    fuzz::try_it([&] { (void)table(read_campbell(path)); });
    fuzz::try_it([&] { (void)read_campbell(path, CampbellShapes::read); });
    return fuzz::try_it([&] { (void)turbines::input_description(path); });
}
