// Two Campbell diagrams and two motions of one machine at once, each in a thread of its own: the same numbers as one
// after the other. Under the thread sanitizer (preset `thread`) it also shows that they share nothing that changes.
#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/time/integrate.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <exception>
#include <iostream>
#include <thread>
#include <vector>

namespace {

using namespace cardan;
using namespace cardan::solvers;

struct Result {
    std::vector<double> frequencies;
    Vector q;
    std::string failure;

    bool operator==(const Result& other) const {
        return frequencies == other.frequencies && q == other.q && failure == other.failure;
    }
};

Result work(const turbines::Turbine& turbine) {
    Result result;
    try {
        const Campbell diagram = campbell(turbine.system(), turbine.rotor(), rpm_range(0, 20, 10));
        for (const Branch& branch : diagram.branches)
            for (std::size_t i = 0; i < diagram.points.size(); ++i)
                if (branch.mode[i] >= 0) result.frequencies.push_back(diagram.natural_hz(branch, i));
        const Vector bent = Vector::Constant(turbine.system().model.size(), 1e-3), still = 0 * bent;
        Integrator motion(turbine.system(), {}, 0, bent, still);
        if (!motion.advance(0.05).reached()) result.failure = "the motion ended early";
        result.q = motion.state().q;
    } catch (const std::exception& error) {
        result.failure = error.what();
    }
    return result;
}

}  // namespace

int main() {
    const turbines::Turbine turbine = turbines::wt600({.tower_elements = 1, .blade_elements = 1});
    Result first, second;
    {
        std::thread other([&] { second = work(turbine); });
        first = work(turbine);
        other.join();
    }
    const Result alone = work(turbine);
    if (!alone.failure.empty()) std::cerr << "two_sweeps: " << alone.failure << "\n";
    const bool good = alone.failure.empty() && !alone.frequencies.empty() && first == alone && second == alone;
    std::cout << (good ? "the same" : "DIFFERENT") << " numbers in two threads and in one\n";
    return good ? 0 : 1;
}
