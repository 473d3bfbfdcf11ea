/// @file
/// One computation for many states (azimuths, rotor speeds, samples of parameters) on several threads.
#pragma once

#include "mbs/kernels/workspace.hpp"

#include <functional>
#include <memory>
#include <stop_token>

namespace cardan {

/// Threads with one workspace each. The result for a state depends on nothing but that state, so on one machine results
/// are bitwise identical whatever the number of threads and the order in which they take the states.
class Batch {
public:
    /// Work for the state `index`. It runs on any thread and may write only what belongs to its index.
    using Call = std::function<void(int index, Workspace& workspace)>;

    /// @param model    kept by reference
    /// @param threads  upper limit, the calling thread included; 0: as many as there are processors. Threads beyond the
    ///                 program's overall limit for tasks (oneTBB: the number of processors) stay idle.
    /// @throws InputError unless 0 <= threads <= 1024
    explicit Batch(const Model& model, int threads = 0);
    ~Batch();
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    const Model& model() const;
    /// Number of workspaces.
    int threads() const;
    /// Index of this workspace, 0 <= slot < threads(), for callers that keep memory of their own per thread.
    int slot(const Workspace& workspace) const;

    /// Calls for the indices 0 to count - 1, in any order. If calls throw, those with lower indices are still made, and
    /// the exception of the lowest index is rethrown. Nothing is allocated per state.
    /// @throws InputError if count is negative, or if a call of this Batch is still running
    void for_each(int count, const Call& call);
    /// Calls `call` for every state until a stop is requested, which is checked before each.
    /// @return true if all calls were made
    [[nodiscard]] bool for_each(int count, const Call& call, const std::stop_token& stop);

    /// Index of the state whose exception the last for_each() rethrew; -1: none.
    int failed() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Inverse dynamics of many states, one per column.
/// @param q, qd, qdd  n x count
/// @param tau         out, n x count, N m or N; overwritten; must not alias the inputs
/// @throws InputError if the sizes do not fit
void inverse_dynamics_batch(Batch& batch, MatrixIn q, MatrixIn qd, MatrixIn qdd, MatrixOut tau);

/// Metrics of many states side by side: g has the columns [i n, (i + 1) n) from column i of q.
/// @param q  n x count
/// @param g  out, n x (n count), overwritten
/// @throws InputError if the sizes do not fit
void metric_batch(Batch& batch, MatrixIn q, MatrixOut g);

}  // namespace cardan
