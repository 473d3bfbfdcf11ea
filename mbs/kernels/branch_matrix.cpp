#include "mbs/kernels/branch_matrix.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/registers/vector_loops.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

#include <algorithm>

namespace cardan {

namespace {

CARDAN_VECTORISED void multiply_branches(int n, const Model::Link* links, const std::size_t* offset,
                                         const Packed3<double>* rows, const Packed3<double>* columns, const double* x,
                                         double* y) {
    for (int m = 0; m < n; ++m) {
        const double *const row = numbers(rows + offset[m]), *const column = numbers(columns + offset[m]);
        double sum = row[links[m].depth - 1] * x[m];
        for_ancestors(links, m, [&](int first, int position, int count) CARDAN_INLINE_LAMBDA {
            sum += dot(row + position, x + first, count);
            add_multiple(count, x[m], column + position, y + first);
        });
        y[m] = sum;  // what lies behind m has yet to come
    }
}

}  // namespace

BranchMatrix::BranchMatrix(const Model& model) : model_(&model) {
    std::size_t blocks = 0;
    for (const Model::Link& link : model.links()) {
        offset_.push_back(blocks);
        blocks += static_cast<std::size_t>(PathTwists<double>::blocks(link.depth));
    }
    with_memory(
        [&] {
            return text("a matrix on the branches of ", model.size(), " bodies (",
                        2e-9 * static_cast<double>(blocks * sizeof(Packed3<double>)), " GB)");
        },
        [&] {
            rows_ = AlignedNumbers(blocks);
            columns_ = AlignedNumbers(blocks);
        });
}

std::span<const double> BranchMatrix::row(int m) const {
    const auto depth = static_cast<std::size_t>(model_->body(m).depth);
    return {rows_.data() + 4 * entry(offset_, m), depth};
}

std::span<const double> BranchMatrix::column(int m) const {
    const auto depth = static_cast<std::size_t>(model_->body(m).depth);
    return {columns_.data() + 4 * entry(offset_, m), depth - 1};
}

double BranchMatrix::operator()(int a, int b) const {
    require_index("branch matrix", "row", a, size());
    require_index("branch matrix", "column", b, size());
    if (model_->precedes(b, a)) return entry(row(a), model_->body(b).depth - 1);
    if (model_->precedes(a, b)) return entry(column(b), model_->body(a).depth - 1);
    return 0;
}

void BranchMatrix::add(int a, int b, double value) {
    require_index("branch matrix", "row", a, size());
    const bool left = model_->precedes(b, a);
    if (!left && !model_->precedes(a, b))
        throw InputError("branch matrix", "entry", text("(", a, ", ", b, ")"), "both indices on one path");
    const int position = model_->body(left ? b : a).depth - 1;
    (left ? own_row(a) : own_column(b))[position] += value;
}

void BranchMatrix::write(MatrixOut A) const {
    const int n = size();
    require_size("branch matrix", "A", A, n, n);
    for (int m = 0; m < n; ++m)
        write_branch(model_->links().data(), n, m, row(m).data(), column(m).data(), A.data(), A.outerStride());
}

void BranchMatrix::multiply(VectorIn x, VectorOut y) const {
    require_size("branch matrix", "x", x, size());
    require_size("branch matrix", "y", y, size());
    multiply_branches(size(), model_->links().data(), offset_.data(), vectors(rows()), vectors(columns()), x.data(),
                      y.data());
}

bool BranchMatrix::add(MatrixIn A) {
    require_size("branch matrix", "A", A, size(), size());
    Eigen::Index on_branches = 0;
    for (int m = 0; m < size(); ++m) {
        double *const row = own_row(m), *const column = own_column(m);
        for (int a = m; a >= 0; a = own_parent(*model_, a)) {
            const int position = entry(model_->links(), a).depth - 1;
            row[position] += A(m, a);
            on_branches += A(m, a) != 0;
            if (a == m) continue;
            column[position] += A(a, m);
            on_branches += A(a, m) != 0;
        }
    }
    return on_branches == (A.array() != 0).count();
}

void BranchMatrix::set_sum(double a, const BranchMatrix& A, double b, const BranchMatrix& B, double c,
                           const BranchMatrix& C) {
    for (const BranchMatrix* m : {&A, &B, &C})
        require_model("sum of branch matrices", "matrix", m->model_->serial(), model_->serial());
    const auto set = [&](double* z, const double* x, const double* y, const double* w) {
        for (std::size_t i = 0; i < rows_.blocks(); ++i)
            vectors(z)[i] = a * vectors(x)[i] + b * vectors(y)[i] + c * vectors(w)[i];
    };
    set(rows(), A.rows(), B.rows(), C.rows());
    set(columns(), A.columns(), B.columns(), C.columns());
}

void BranchMatrix::set_unit(int m) {
    require_index("branch matrix", "row", m, size());
    const auto clear = [](double* first, int count) { std::fill(first, first + count, 0.0); };
    const int position = model_->body(m).depth - 1;
    clear(own_row(m), position);
    clear(own_column(m), position);
    own_row(m)[position] = 1;
    for (int k = m + 1; k < entry(model_->links(), m).subtree_end; ++k)
        own_row(k)[position] = own_column(k)[position] = 0;
}

}  // namespace cardan
