// A checkpoint of any numbers: a motion goes on from it, ends with a reason, or is refused.
#include "mbs/model/tree.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <cstring>

namespace {

using namespace cardan;
using namespace cardan::solvers;

const System& pendulum() {
    static const System system = [] {
        Tree tree;
        BodySpec body;
        body.name = "angle";
        body.inertia = RigidInertia{2, {1, 0, 0}, Mat3::Identity() * 0.1};
        const BodyId id = tree.add_body(body);
        ForceSet forces;
        forces.add_spring("spring", id, 50, 0.5);
        return System(tree, forces);
    }();
    return system;
}

class Numbers {
public:
    Numbers(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
    double next() {
        double value = 0;
        const std::size_t count = std::min(left_, sizeof value);
        if (count > 0) std::memcpy(&value, data_, count);
        data_ += count;
        left_ -= count;
        return value;
    }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    Numbers numbers(data + 2, size - 2);
    Checkpoint from;
    from.q = Vector::Zero(data[0] % 3);
    from.qd = Vector::Zero(data[1] % 3);
    from.time = numbers.next();
    for (double& x : from.q) x = numbers.next();
    for (double& x : from.qd) x = numbers.next();
    from.work = {numbers.next(), numbers.next(), numbers.next()};
    from.kinetic_at_start = numbers.next();
    from.potential_at_start = numbers.next();
    from.statistics.last_step = numbers.next();
    return fuzz::try_it([&] {
        int steps = 0;
        Integrator integrator(pendulum(), {}, from, {.cancelled = [&steps] { return ++steps > 200; }});
        const bool reached = integrator.advance(from.time + 0.1).reached();
        if (reached)
            for (const double number : integrator.state().q) fuzz::require_finite(number);
        (void)integrator.energy();
    });
}
