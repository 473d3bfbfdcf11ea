#include "mbs/kernels/branch_lu.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/registers/vector_loops.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

#include <cmath>

namespace cardan {

namespace {

constexpr double smallest_pivot = 1e-10;  // of the diagonal element before the elimination

struct Factors {
    int n;
    const Model::Link* links;
    const std::size_t* offset;
    Packed3<double>*rows, *columns;
};

// y -= factor x, by whole registers; what stands behind the last number is never read.
CARDAN_INLINE void subtract(std::ptrdiff_t count, double factor, const Packed3<double>* x,
                            Packed3<double>* __restrict y) {
    for (std::ptrdiff_t i = 0; i < PathTwists<double>::blocks(count); ++i) y[i] -= factor * x[i];
}

// Coordinate k leaves every two of its ancestors i, j the product A_ik A_kj / A_kk.
CARDAN_INLINE void eliminate(const Factors& f, int k, double inverse_pivot) {
    Packed3<double>*row = f.rows + f.offset[k], *column = f.columns + f.offset[k];
    for (std::ptrdiff_t i = 0; i < PathTwists<double>::blocks(f.links[k].depth - 1); ++i)
        column[i] = inverse_pivot * column[i];
    for (int a = f.links[k].parent; a >= 0; a = f.links[a].parent) {
        const int i = f.links[a].depth - 1;
        subtract(i + 1, numbers(column)[i], row, f.rows + f.offset[a]);
        subtract(i, numbers(row)[i], column, f.columns + f.offset[a]);
    }
}

CARDAN_VECTORISED bool eliminate_all(const Factors& f, const double* diagonal) {
    for (int k = f.n - 1; k >= 0; --k) {
        const int last = f.links[k].depth - 1;
        auto& pivot = f.rows[f.offset[k] + static_cast<std::size_t>(last / 4)].lanes;
        const double value = pivot[last % 4];
        if (!(std::abs(value) > smallest_pivot * diagonal[k])) return false;
        pivot[last % 4] = 1 / value;
        eliminate(f, k, 1 / value);
    }
    return true;
}

CARDAN_VECTORISED void solve_all(int n, const Model::Link* links, const std::size_t* offset,
                                 const Packed3<double>* rows, const Packed3<double>* columns, double* x) {
    for (int k = n - 1; k >= 0; --k) {
        const double* column = numbers(columns + offset[k]);
        const double factor = -x[k];
        for_ancestors(links, k, [&](int first, int position, int count) CARDAN_INLINE_LAMBDA {
            add_multiple(count, factor, column + position, x + first);
        });
    }
    for (int k = 0; k < n; ++k) {
        const double* row = numbers(rows + offset[k]);
        double value = x[k];
        for_ancestors(links, k, [&](int first, int position, int count) CARDAN_INLINE_LAMBDA {
            value -= dot(row + position, x + first, count);
        });
        x[k] = value * row[links[k].depth - 1];
    }
}

}  // namespace

BranchLu::BranchLu(const Model& model) : a_(model), diagonal_(static_cast<std::size_t>(model.size())) {}

bool BranchLu::factorise() {
    for (int k = 0; k < a_.size(); ++k) entry(diagonal_, k) = std::abs(a_.row(k).back());
    return eliminate_all({a_.size(), a_.model().links().data(), a_.offset(), vectors(a_.rows()), vectors(a_.columns())},
                         diagonal_.data());
}

void BranchLu::solve(VectorOut x) const {
    require_size("solution on branches", "x", x, a_.size());
    solve_all(a_.size(), a_.model().links().data(), a_.offset(), vectors(a_.rows()), vectors(a_.columns()), x.data());
}

}  // namespace cardan
