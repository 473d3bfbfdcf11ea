/// @file
/// The memory of the kernels: allocated once per model and thread.
#pragma once

#include "mbs/model/model.hpp"

#include <cstdint>
#include <memory>

namespace cardan {

template <class S>
struct KernelArraysT;
template <class S>
class KinematicsT;

/// Arrays over bodies that the kernels read and write. They overwrite each other's scratch; what the kinematics() stage
/// wrote stays valid until it is called again: KinematicsT gives poses and axes of the bodies. A copy has arrays of its
/// own.
template <class S>
class WorkspaceT {
public:
    /// @throws MemoryError
    explicit WorkspaceT(const Model& model);
    WorkspaceT(const WorkspaceT& other);
    WorkspaceT(WorkspaceT&& other) noexcept;
    WorkspaceT& operator=(const WorkspaceT& other);
    WorkspaceT& operator=(WorkspaceT&& other) noexcept;
    ~WorkspaceT();

    /// Model::serial() of the model it was made for; 0 after it was moved from.
    std::uint64_t model_serial() const { return model_serial_; }
    /// Number of times that kinematics() has written to it.
    std::uint64_t generation() const { return generation_; }

private:
    friend class KinematicsT<S>;
    template <class T>
    friend KinematicsT<T> kinematics(const Model& model, VectorInT<T> q, WorkspaceT<T>& workspace);

    std::unique_ptr<KernelArraysT<S>> arrays_;
    std::uint64_t model_serial_, generation_ = 0;
};

using Workspace = WorkspaceT<double>;

}  // namespace cardan
