/// @file
/// The twists along a path from the base, laid out so that a loop over the path uses whole registers.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/branch_matrix.hpp"
#include "mbs/kernels/registers/kernel_arrays.hpp"

namespace cardan {

/// Structure of arrays along one path: three rows per vector, one column per body, by depth. Coordinate j moves the
/// point C of a body distal to it with angular velocity w_j and velocity u_j + w_j x (C - o_j): a prismatic joint has
/// its axis in u and w = 0, a revolute one its axis in w and u = 0, so that no loop has to branch on the joint type.
///
/// Bodies are visited in the order of the model, depth first: when body m writes column depth(m) - 1, the columns
/// before it still hold its ancestors.
template <class S>
class PathTwists {
public:
    /// Rows of w, o and u relative to the extra rows, and the total number of rows.
    static constexpr int w_rows = -9, o_rows = -6, u_rows = -3, rows = 32;
    using Columns = Packed3<S>;  ///< four columns of a row

    CARDAN_INLINE PathTwists(Columns* data, std::ptrdiff_t stride) : data_(data), stride_(stride) {}

    CARDAN_INLINE Columns* w(int i) const { return row(w_rows + i); }
    CARDAN_INLINE Columns* o(int i) const { return row(o_rows + i); }
    CARDAN_INLINE Columns* u(int i) const { return row(u_rows + i); }
    /// Extra rows for the kernels, counted from 0.
    CARDAN_INLINE Columns* row(int i) const { return data_ + (i - w_rows) * stride_; }
    /// The three rows of a vector.
    CARDAN_INLINE void set(int first_row, std::ptrdiff_t column, const Packed3<S>& v) const {
        for (int i = 0; i < 3; ++i) row(first_row + i)[column / 4].lanes[column % 4] = v(i);
    }
    CARDAN_INLINE Packed3<S> get(int first_row, std::ptrdiff_t column) const {
        const auto at = [&](int i) CARDAN_INLINE_LAMBDA { return row(first_row + i)[column / 4].lanes[column % 4]; };
        return Packed3<S>::of(at(0), at(1), at(2));
    }
    CARDAN_INLINE void set(const Model::Link& link, const typename KernelArraysT<S>::Frame& frame) const {
        const Packed3<S> none = Packed3<S>::zero();
        set(w_rows, link.depth - 1, link.revolute ? frame.E[2] : none);
        set(o_rows, link.depth - 1, frame.o);
        set(u_rows, link.depth - 1, link.revolute ? none : frame.E[2]);
    }
    /// Number of Columns for `depth` columns.
    CARDAN_INLINE static std::ptrdiff_t blocks(std::ptrdiff_t depth) { return (depth + 3) / 4; }

private:
    Columns* data_;
    std::ptrdiff_t stride_;
};

/// twist_at() for loops over the model's own indices, without checks.
template <class S>
CARDAN_INLINE PointTwist<S> own_twist_at(const KinematicsT<S>& kin, int a, const Vec3T<S>& C) {
    const typename KernelArraysT<S>::Frame& frame = entry(kin.arrays().frame, a);
    const Vec3T<S> e = frame.E[2].vector();
    if (entry(kin.model().links(), a).revolute) return {e, cross<S>(e, C - frame.o.vector())};
    return {Vec3T<S>::Zero(), e};
}
/// Model::body(a).parent, likewise without checks.
inline int own_parent(const Model& model, int a) {
    return entry(model.links(), a).parent;
}

/// Columns of all bodies of the run that starts with body `first`; returns one past its last body. The columns of a
/// whole run are set before the first is used, so that a register is loaded long after its four numbers were stored (no
/// store-forwarding stall).
template <class S>
CARDAN_INLINE int set_run(const PathTwists<S>& path, const Model::Link* links,
                          const typename KernelArraysT<S>::Frame* frame, int first, int n) {
    int end = first;
    for (; end < n && links[end].run == first; ++end) path.set(links[end], frame[end]);
    return end;
}

/// Calls visit(first, position, count) for the runs of consecutive indices that the ancestors of body m are, from its
/// parent to the base: first, first + 1, ... stand at `position`, `position` + 1, ... of its row.
template <class Visit>
CARDAN_INLINE void for_ancestors(const Model::Link* links, int m, Visit&& visit) {
    for (int last = links[m].parent; last >= 0;) {
        const int first = links[last].run;
        visit(first, links[first].depth - 1, last - first + 1);
        last = links[first].parent;
    }
}

/// Writes what belongs to body m into an n x n matrix (column-major): row m left of the diagonal and column m above it,
/// given by depth; the diagonal from `row`. Zero where m and the other body are not on one path from the base.
template <class S>
CARDAN_INLINE void write_branch(const Model::Link* links, int n, int m, const S* row, const S* column, S* matrix,
                                std::ptrdiff_t stride) {
    S* const own_column = matrix + m * stride;
    S* const own_row = matrix + m;
    for (int last = m; last >= 0;) {
        const int first = links[last].run, next = links[first].parent;
        const S* const from_row = row + (links[first].depth - 1);
        const S* const from_column = column + (links[first].depth - 1);
        for (int i = 0; i <= last - first; ++i) own_column[first + i] = from_column[i];
        CARDAN_UNROLL
        for (int i = 0; i <= last - first; ++i) own_row[(first + i) * stride] = from_row[i];
        for (int a = next + 1; a < first; ++a) own_column[a] = S(0);
        last = next;
    }
    for (int a = links[m].subtree_end; a < n; ++a) own_column[a] = S(0);
}

/// Copies rows and columns, given by depth, into an n x n matrix.
template <class S>
struct DenseSink {
    const Model::Link* links;
    int n;
    S* matrix;
    std::ptrdiff_t stride;
    Packed3<S>*row, *column;  ///< scratch

    CARDAN_INLINE Packed3<S>* row_of(int) const { return row; }
    CARDAN_INLINE Packed3<S>* column_of(int) const { return column; }
    CARDAN_INLINE void written(int m) const {
        write_branch(links, n, m, numbers(row), numbers(column), matrix, stride);
    }
};

/// Copies them into the memory of a BranchMatrix.
struct BranchSink {
    explicit BranchSink(BranchMatrix& to)
        : rows(vectors(to.rows())), columns(vectors(to.columns())), offset(to.offset()) {}

    Packed3<double>*rows, *columns;
    const std::size_t* offset;

    CARDAN_INLINE Packed3<double>* row_of(int m) const { return rows + offset[m]; }
    CARDAN_INLINE Packed3<double>* column_of(int m) const { return columns + offset[m]; }
    CARDAN_INLINE void written(int) const {}
};

}  // namespace cardan
