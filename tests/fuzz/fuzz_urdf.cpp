#include "mbs/urdf/urdf.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    return fuzz::try_it([&] {
        const UrdfModel robot = parse_urdf(fuzz::text_of(data, size));
        for (const Tree::Piece& piece : robot.tree.pieces()) {
            fuzz::require_finite(piece.inertia.mass);
            for (const double number : piece.inertia.com) fuzz::require_finite(number);
            for (const double number : piece.inertia.J.reshaped()) fuzz::require_finite(number);
        }
        for (const UrdfJoint& joint : robot.joints) {
            fuzz::require_finite(joint.damping);
            fuzz::require_finite(joint.friction);
        }
        (void)parse_urdf(to_urdf(robot.tree, {.joints = robot.joints}));  // what was read can be written and read
    });
}
