// A long run must not take more memory the longer it gets.
#include "mbs/base/error.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <fstream>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Memory of this process at present, kB.
long resident_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == "VmRSS:") {
            status >> word;
            return std::stol(word);
        }
    return -1;
}

}  // namespace

TEST_CASE("long runs: the second to the tenth hundred thousand of recorded steps take no more memory than the first",
          "[property][slow]") {
    if (resident_memory() < 0) return;  // no Linux
    const System system = chain(0.3, CoordinateRole::prescribed);
    const test::Folder folder;
    for (const Method method : {Method::dirk, Method::generalised_alpha}) {
        IntegrationOptions options = with(method, 1e-3, 1e-3);
        if (method == Method::generalised_alpha)
            options.fixed_step = 1e-3;
        else
            options.max_step = 1e-3;
        Integrator integrator(system, {{0, Motion::harmonic(0, 0.3, 1.5)}}, 0, vector({0, 0.5, -0.4}),
                              vector({0, 0, 0}), options);
        Recorder recorder(integrator);
        HistoryWriter writer = HistoryWriter::create(folder / "run.h5", recorder.channels(), {}, {.replace = true});
        long first = 0;
        for (int part = 0; part < 10; ++part) {
            const double from = 100.0 * part;
            REQUIRE(record(integrator, recorder, sample_times(from, from + 100, 0.01), writer).reached());
            if (part == 0) first = resident_memory();
        }
        CAPTURE(static_cast<int>(method), first);
        CHECK(integrator.statistics().steps >= 1000000);
        CHECK(writer.rows() == 100001);
        CHECK(resident_memory() < first + 1024);
    }
}
