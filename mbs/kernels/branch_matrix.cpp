#include "mbs/kernels/branch_matrix.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/path_twists.hpp"

namespace cardan {

template <class S>
BranchMatrixT<S>::BranchMatrixT(const Model& model) : model_(&model) {
    std::size_t blocks = 0;
    for (const Model::Link& link : model.links()) {
        offset_.push_back(blocks);
        blocks += static_cast<std::size_t>(PathTwists<S>::blocks(link.depth));
    }
    with_memory(
        [&] {
            return text("a matrix on the branches of ", model.size(), " bodies (",
                        2e-9 * static_cast<double>(blocks * sizeof(Packed3<S>)), " GB)");
        },
        [&] {
            rows_.assign(blocks, Packed3<S>::zero());
            columns_.assign(blocks, Packed3<S>::zero());
        });
}

template <class S>
std::span<const S> BranchMatrixT<S>::row(int m) const {
    const auto depth = static_cast<std::size_t>(model_->body(m).depth);
    return {numbers(rows_.data() + entry(offset_, m)), depth};
}

template <class S>
std::span<const S> BranchMatrixT<S>::column(int m) const {
    const auto depth = static_cast<std::size_t>(model_->body(m).depth);
    return {numbers(columns_.data() + entry(offset_, m)), depth - 1};
}

template <class S>
S BranchMatrixT<S>::operator()(int a, int b) const {
    require_index("branch matrix", "row", a, size());
    require_index("branch matrix", "column", b, size());
    if (model_->precedes(b, a)) return entry(row(a), model_->body(b).depth - 1);
    if (model_->precedes(a, b)) return entry(column(b), model_->body(a).depth - 1);
    return S(0);
}

template <class S>
void BranchMatrixT<S>::add(int a, int b, const S& value) {
    require_index("branch matrix", "row", a, size());
    const bool left = model_->precedes(b, a);
    if (!left && !model_->precedes(a, b))
        throw InputError("branch matrix", "entry", text("(", a, ", ", b, ")"), "both indices on one path");
    const int position = model_->body(left ? b : a).depth - 1;
    const std::size_t first = entry(offset_, left ? a : b);
    (left ? rows_ : columns_)[first + static_cast<std::size_t>(position / 4)].lanes[position % 4] += value;
}

template <class S>
void BranchMatrixT<S>::write(Eigen::Ref<MatrixT<S>> A) const {
    const int n = size();
    require_size("branch matrix", "A", A, n, n);
    for (int m = 0; m < n; ++m)
        write_branch(model_->links().data(), n, m, row(m).data(), column(m).data(), A.data(), A.outerStride());
}

template <class S>
void BranchMatrixT<S>::multiply(const Eigen::Ref<const VectorT<S>>& x, Eigen::Ref<VectorT<S>> y) const {
    require_size("branch matrix", "x", x, size());
    require_size("branch matrix", "y", y, size());
    y.setZero();
    for (int m = 0; m < size(); ++m) {
        const std::span<const S> left = row(m), above = column(m);
        std::size_t i = left.size() - 1;
        S sum = left[i] * x(m);
        for (int a = model_->body(m).parent; a >= 0; a = model_->body(a).parent) {
            --i;
            sum += left[i] * x(a);
            y(a) += above[i] * x(m);
        }
        y(m) += sum;
    }
}

template class BranchMatrixT<double>;
template class BranchMatrixT<Complex>;

}  // namespace cardan
