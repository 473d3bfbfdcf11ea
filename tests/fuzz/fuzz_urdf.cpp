#include "mbs/urdf/urdf.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    return fuzz::try_it([&] {
        const UrdfModel robot = parse_urdf(fuzz::text_of(data, size));
        (void)parse_urdf(to_urdf(robot.tree, {.joints = robot.joints}));  // what was read can be written and read
    });
}
