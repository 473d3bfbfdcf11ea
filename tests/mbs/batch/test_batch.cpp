// Many states on several threads: the same numbers to the last bit, whatever the threads do.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/batch/batch.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>

using namespace cardan;
using namespace cardan::testing;

namespace {

// As many threads as the tests ask for, also on a machine with fewer processors.
struct ManyThreads {
    tbb::global_control control{tbb::global_control::max_allowed_parallelism, 8};
};

struct States {
    explicit States(int of, unsigned seed = 1)
        : random(seed),
          model(random_tree(random, {.bodies = 20})),
          n(model.size()),
          count(of),
          q(columns()),
          qd(columns()),
          qdd(columns()) {}
    Matrix columns() {
        return Matrix::NullaryExpr(n, count, [&] { return uniform(random, -1, 1); });
    }

    Random random;
    Model model;
    int n, count;
    Matrix q, qd, qdd;
};

}  // namespace

TEST_CASE("batch: inverse dynamics and metrics equal the serial ones to the last bit with any number of threads",
          "[property]") {
    const ManyThreads many;
    States s(300);
    Matrix tau(s.n, s.count), g(s.n, s.n * s.count);
    Workspace workspace(s.model);
    for (int i = 0; i < s.count; ++i) {
        const Kinematics kin = kinematics(s.model, s.q.col(i), workspace);
        inverse_dynamics<double>(kin, s.qd.col(i), s.qdd.col(i), tau.col(i));
        metric<double>(kin, g.middleCols(i * s.n, s.n));
    }
    for (const int threads : {0, 1, 2, 3, 8}) {
        Batch batch(s.model, threads);
        for (int round = 0; round < 5; ++round) {
            Matrix batch_tau = Matrix::Constant(s.n, s.count, 99), batch_g = Matrix::Constant(s.n, s.n * s.count, 99);
            inverse_dynamics_batch(batch, s.q, s.qd, s.qdd, batch_tau);
            metric_batch(batch, s.q, batch_g);
            CAPTURE(threads, round);
            REQUIRE((batch_tau.array() == tau.array()).all());
            REQUIRE((batch_g.array() == g.array()).all());
        }
    }
}

TEST_CASE("batch: every index is called once; a workspace serves one thread at a time and has a place of its own",
          "[property]") {
    const ManyThreads many;
    States s(1);
    Batch batch(s.model, 4);
    REQUIRE(batch.threads() == 4);
    std::vector<std::atomic<int>> calls(1000), in_use(4);
    std::atomic<bool> shared = false;
    batch.for_each(1000, [&](int index, Workspace& workspace) {
        std::atomic<int>& place = entry(in_use, batch.slot(workspace));
        if (place.fetch_add(1) != 0) shared = true;
        ++entry(calls, index);
        // Parallel work inside a call: the thread may wait, but gets no other state meanwhile.
        tbb::parallel_for(0, 8, [](int) { std::this_thread::yield(); });
        place.fetch_sub(1);
    });
    REQUIRE(!shared);
    for (const auto& count : calls) REQUIRE(count == 1);
    const Workspace foreign(s.model);
    REQUIRE_THROWS_AS(batch.slot(foreign), InputError);
}

TEST_CASE("batch: more than one thread takes part", "[property]") {
    const ManyThreads many;
    States s(1);
    Batch batch(s.model, 3);
    std::mutex mutex;
    std::set<std::thread::id> threads;
    std::atomic<int> waiting = 0;
    batch.for_each(3, [&](int, Workspace&) {
        {
            const std::lock_guard lock(mutex);
            threads.insert(std::this_thread::get_id());
        }
        // The first call waits for a second one, at most some seconds.
        ++waiting;
        for (int i = 0; i < 5000 && waiting < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    REQUIRE(threads.size() >= 2);
}

TEST_CASE("batch: the exception of the lowest index is thrown, whichever comes first; the batch can be used again",
          "[property]") {
    const ManyThreads many;
    States s(1);
    for (const int threads : {1, 2, 5}) {
        Batch batch(s.model, threads);
        REQUIRE(batch.failed() == -1);
        for (int round = 0; round < 50; ++round) {
            std::vector<std::atomic<int>> calls(400);
            const int lowest = 7 * round % 400;
            const auto call = [&](int index, Workspace&) {
                ++entry(calls, index);
                if (index < lowest || (index - lowest) % 11 != 0) return;
                if (index == lowest) std::this_thread::sleep_for(std::chrono::microseconds(200));
                throw NumericalError(text("state ", index));
            };
            CAPTURE(threads, round);
            try {
                batch.for_each(400, call);
                FAIL("nothing was thrown");
            } catch (const NumericalError& error) {
                REQUIRE(error.what() == text("state ", lowest));
            }
            REQUIRE(batch.failed() == lowest);
            for (int i = 0; i < 400; ++i) {
                const int made = entry(calls, i);
                if (i <= lowest) REQUIRE(made == 1);
                REQUIRE(made <= 1);
            }
        }
        batch.for_each(3, [](int, Workspace&) {});
        REQUIRE(batch.failed() == -1);
    }
}

TEST_CASE("batch: exceptions that are not Cardan's pass as they are", "[property]") {
    States s(1);
    Batch batch(s.model, 2);
    const auto throw_number = [](int index, Workspace&) {
        if (index == 5) throw index;
    };
    REQUIRE_THROWS_AS(batch.for_each(20, throw_number), int);
}

TEST_CASE("batch: a stop is seen between states; without one all are done", "[property]") {
    const ManyThreads many;
    States s(1);
    for (const int threads : {1, 4}) {
        Batch batch(s.model, threads);
        std::stop_source source;
        std::atomic<int> made = 0;
        REQUIRE(batch.for_each(
            100, [&](int, Workspace&) { ++made; }, source.get_token()));
        REQUIRE(made == 100);
        made = 0;
        const bool finished = batch.for_each(
            100000,
            [&](int, Workspace&) {
                if (++made == 10) source.request_stop();
            },
            source.get_token());
        REQUIRE(!finished);
        REQUIRE(made >= 10);
        REQUIRE(made < 10 + threads);  // each thread finishes the state that it is at
        REQUIRE(!batch.for_each(
            1, [&](int, Workspace&) { FAIL("stopped before"); }, source.get_token()));
    }
}

TEST_CASE("batch: no states, bad numbers, wrong sizes, a call inside a call", "[property]") {
    States s(4);
    Batch batch(s.model, 2);
    batch.for_each(0, [](int, Workspace&) { FAIL("there is no state"); });
    Matrix none(s.n, 0), no_metric(s.n, 0);
    inverse_dynamics_batch(batch, none, none, none, none);
    metric_batch(batch, none, no_metric);

    check_refused([&] { batch.for_each(-1, [](int, Workspace&) {}); }, {"batch", "number of states = -1"});
    check_refused([&] { Batch(s.model, -1); }, {"batch", "number of threads = -1", "0 (all processors) to"});
    check_refused([&] { Batch(s.model, 1000000); }, {"number of threads = 1000000"});
    REQUIRE_THROWS_AS(batch.for_each(1, [&](int, Workspace&) { batch.for_each(1, [](int, Workspace&) {}); }),
                      InputError);

    Matrix tau(s.n, s.count), short_tau(s.n, s.count - 1), g(s.n, s.n);
    check_refused([&] { inverse_dynamics_batch(batch, s.q, s.qd, s.qdd, short_tau); },
                  {"inverse dynamics of a batch", "size of tau = 20 x 3", "20 x 4"});
    check_refused([&] { inverse_dynamics_batch(batch, s.q.topRows(3), s.qd, s.qdd, tau); }, {"size of q = 3 x 4"});
    check_refused([&] { metric_batch(batch, s.q, g); }, {"size of g = 20 x 20", "20 x 80"});
}

TEST_CASE("batch: a batch within a call of another", "[property]") {
    const ManyThreads many;
    States s(50);
    Matrix expected(s.n, s.count), tau(s.n, s.count);
    Batch outer(s.model, 3), serial(s.model, 1);
    inverse_dynamics_batch(serial, s.q, s.qd, s.qdd, expected);
    std::atomic<int> different = 0;
    outer.for_each(12, [&](int, Workspace&) {
        Batch inner(s.model, 2);
        Matrix own(s.n, s.count);
        inverse_dynamics_batch(inner, s.q, s.qd, s.qdd, own);
        if (own != expected) ++different;
    });
    REQUIRE(different == 0);
}

TEST_CASE("batch: the computation of a state allocates nothing", "[property]") {
    if (!AllocationGuard::works()) return;
    const ManyThreads many;
    States s(200);
    Matrix tau(s.n, s.count);
    Batch batch(s.model, 3);
    std::atomic<std::size_t> allocations = 0;
    batch.for_each(s.count, [&](int index, Workspace& workspace) {
        const AllocationGuard guard;
        const Kinematics kin = kinematics(s.model, s.q.col(index), workspace);
        inverse_dynamics<double>(kin, s.qd.col(index), s.qdd.col(index), tau.col(index));
        allocations += guard.count();
    });
    REQUIRE(allocations == 0);

    // One thread: what for_each itself allocates does not grow with the number of states.
    Batch alone(s.model, 1);
    const auto of = [&](int count) {
        const Batch::Call nothing = [](int, Workspace&) {};
        alone.for_each(count, nothing);
        const AllocationGuard guard;
        alone.for_each(count, nothing);
        return guard.count();
    };
    REQUIRE(of(100000) <= of(100) + 8);
}
