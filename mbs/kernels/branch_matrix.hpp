/// @file
/// Matrices with the pattern of the tree.
#pragma once

#include "mbs/base/aligned_numbers.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/types.hpp"

#include <span>

namespace cardan {

class Model;

/// An n x n matrix A_ab that is zero unless a and b lie on one path from the base, as the metric, its derivatives and
/// those of the recursions are. Stored by branches: for every coordinate m its row up to and including the diagonal,
/// and its column above the diagonal. Memory and the cost of filling it grow like n d, where d is the depth of the
/// tree. Functions throw InputError for indices out of range and arguments of the wrong size.
class BranchMatrix {
public:
    /// @throws MemoryError
    explicit BranchMatrix(const Model& model);
    explicit BranchMatrix(Model&&) = delete;  // the model must live longer

    int size() const { return static_cast<int>(offset_.size()); }
    const Model& model() const { return *model_; }
    /// A_ab, any indices.
    double operator()(int a, int b) const;
    /// A_ma for a on the path from the base to m, m itself last: entry depth(a) - 1.
    std::span<const double> row(int m) const;
    /// A_am for a on the path from the base to m, m itself left out.
    std::span<const double> column(int m) const;
    /// The full matrix, zeros included. @param A  out, n x n, overwritten
    void write(MatrixOut A) const;
    /// y = A x. @param y  out, size n; must not alias x. Cost O(n d), no allocation.
    void multiply(VectorIn x, VectorOut y) const;

    /// Raw storage for the kernels: rows and columns by coordinate, those of m starting with block offset()[m] of four
    /// numbers.
    double* rows() { return rows_.data(); }
    double* columns() { return columns_.data(); }
    const double* rows() const { return rows_.data(); }
    const double* columns() const { return columns_.data(); }
    const std::size_t* offset() const { return offset_.data(); }
    /// Adds to A_ab; a and b must lie on one path.
    void add(int a, int b, double value);
    /// Adds what a full matrix has on the branches.
    /// @return whether that is all of it: false if it has other entries that are not zero.  Cost O(n^2), no allocation
    bool add(MatrixIn A);
    /// a A + b B + c C, all of one model; this may be one of them.
    void set_sum(double a, const BranchMatrix& A, double b, const BranchMatrix& B, double c, const BranchMatrix& C);
    /// Row and column m of the unit matrix.
    void set_unit(int m);

private:
    double* own_row(int m) { return rows_.data() + 4 * entry(offset_, m); }
    double* own_column(int m) { return columns_.data() + 4 * entry(offset_, m); }

    const Model* model_;
    std::vector<std::size_t> offset_;
    AlignedNumbers rows_, columns_;
};

}  // namespace cardan
