#include "mbs/batch/batch.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/dynamics.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>

namespace cardan {

namespace {

constexpr int max_threads = 1024;  // every one has a workspace

// The exception of the lowest index so far.
class Failure {
public:
    bool before(int index) const { return index_.load(std::memory_order_relaxed) < index; }
    void keep(int index, std::exception_ptr exception) {
        const std::lock_guard lock(mutex_);
        if (index > index_) return;
        index_ = index;
        exception_ = std::move(exception);
    }
    int index() const { return exception_ ? index_.load() : -1; }
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

private:
    std::atomic<int> index_ = std::numeric_limits<int>::max();
    std::mutex mutex_;
    std::exception_ptr exception_;
};

// One call at a time: the workspaces of a thread that waits inside a call are in use.
class InUse {
public:
    explicit InUse(std::atomic<bool>& flag) : flag_(flag) {
        if (flag_.exchange(true)) throw InputError("batch: for_each called while another call of it is running");
    }
    ~InUse() { flag_ = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

private:
    std::atomic<bool>& flag_;
};

}  // namespace

struct Batch::Impl {
    Impl(const Model& of, int threads) : model(&of), arena(threads == 0 ? tbb::task_arena::automatic : threads) {
        arena.initialize();
        workspaces.assign(static_cast<std::size_t>(arena.max_concurrency()), Workspace(of));
    }

    const Model* model;
    tbb::task_arena arena;
    std::vector<Workspace> workspaces;
    std::atomic<bool> in_use = false;
    int failed = -1;
};

Batch::Batch(const Model& model, int threads) {
    if (threads < 0 || threads > max_threads)
        throw InputError("batch", "number of threads", threads, text("0 (all processors) to ", max_threads));
    impl_ = std::make_unique<Impl>(model, threads);
}

Batch::~Batch() = default;

const Model& Batch::model() const {
    return *impl_->model;
}

int Batch::threads() const {
    return static_cast<int>(impl_->workspaces.size());
}

int Batch::slot(const Workspace& workspace) const {
    for (std::size_t i = 0; i < impl_->workspaces.size(); ++i)
        if (&impl_->workspaces[i] == &workspace) return static_cast<int>(i);
    throw InputError("batch: the workspace is none of this batch's own");
}

int Batch::failed() const {
    return impl_->failed;
}

void Batch::for_each(int count, const Call& call) {
    static_cast<void>(for_each(count, call, std::stop_token()));
}

bool Batch::for_each(int count, const Call& call, const std::stop_token& stop) {
    if (count < 0) throw InputError("batch", "number of states", count, ">= 0");
    if (!call) throw InputError("batch: the function to be called for every state is empty");
    Impl& impl = *impl_;
    const InUse in_use(impl.in_use);
    Failure failure;
    std::atomic<bool> interrupted = false;
    const auto states = [&](const tbb::blocked_range<int>& range) {
        Workspace& workspace = entry(impl.workspaces, tbb::this_task_arena::current_thread_index());
        for (int index = range.begin(); index != range.end() && !failure.before(index); ++index) {
            if (stop.stop_requested()) {
                interrupted = true;
                return;
            }
            try {
                call(index, workspace);
            } catch (...) {
                failure.keep(index, std::current_exception());
            }
        }
    };
    // Isolated: a call that waits for parallel work of its own must not be given another state meanwhile, whose
    // workspace would be the same.
    impl.arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<int>(0, count), [&](const tbb::blocked_range<int>& range) {
            tbb::this_task_arena::isolate([&] { states(range); });
        });
    });
    impl.failed = failure.index();
    failure.rethrow();
    return !interrupted;
}

void inverse_dynamics_batch(Batch& batch, MatrixIn q, MatrixIn qd, MatrixIn qdd, MatrixOut tau) {
    const Model& model = batch.model();
    const Eigen::Index n = model.size(), count = q.cols();
    require_size("inverse dynamics of a batch", "q", q, n, count);
    require_size("inverse dynamics of a batch", "qd", qd, n, count);
    require_size("inverse dynamics of a batch", "qdd", qdd, n, count);
    require_size("inverse dynamics of a batch", "tau", tau, n, count);
    batch.for_each(static_cast<int>(count), [&](int index, Workspace& workspace) {
        const Kinematics kin = kinematics(model, q.col(index), workspace);
        inverse_dynamics<double>(kin, qd.col(index), qdd.col(index), tau.col(index));
    });
}

void metric_batch(Batch& batch, MatrixIn q, MatrixOut g) {
    const Model& model = batch.model();
    const Eigen::Index n = model.size(), count = q.cols();
    require_size("metrics of a batch", "q", q, n, count);
    require_size("metrics of a batch", "g", g, n, n * count);
    batch.for_each(static_cast<int>(count), [&](int index, Workspace& workspace) {
        metric<double>(kinematics(model, q.col(index), workspace), g.middleCols(index * n, n));
    });
}

}  // namespace cardan
