#include "mbs/kernels/metric_factor.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/registers/vectorised.hpp"

#include <algorithm>
#include <limits>

namespace cardan {

namespace {

constexpr int tile_width = 16;

// Rows of the ancestors less the outer product of the scaled row of length d; that of ancestor i has i + 1 entries.
CARDAN_VECTORISED void eliminate_row(std::size_t d, const double* __restrict row, const int* __restrict path,
                                     const std::size_t* __restrict offset, double* __restrict values) {
    for (std::size_t i = 0; i + 1 < d; ++i) {
        double* __restrict ancestor = values + offset[path[i]];
        const double factor = row[i];
        for (std::size_t j = 0; j <= i; ++j) ancestor[j] -= factor * row[j];
    }
}

// The packed rows as plain arrays: what the loops over right-hand sides see.
struct Rows {
    int n;
    const std::size_t* offset;
    const int* path;
    const double* values;
    const double* inverse_pivot;
};

// One row without its pivot.
struct Row {
    const double* values;
    const int* at;
    std::size_t size;
};

// own <- factor own, for W right-hand sides side by side
template <int W>
CARDAN_INLINE void scale(double* own, double factor) {
    for (int c = 0; c < W; ++c) own[c] *= factor;
}

// own <- own + sign sum_b L_ab x_b
template <int W>
CARDAN_INLINE void gather(const Row& L, double sign, const double* x, double* __restrict own) {
    for (std::size_t j = 0; j < L.size; ++j) {
        const double* __restrict from = x + static_cast<std::ptrdiff_t>(L.at[j]) * W;
        const double factor = sign * L.values[j];
        for (int c = 0; c < W; ++c) own[c] += factor * from[c];
    }
}

// x_b <- x_b + sign L_ab own
template <int W>
CARDAN_INLINE void scatter(const Row& L, double sign, const double* __restrict own, double* x) {
    for (std::size_t j = 0; j < L.size; ++j) {
        double* __restrict to = x + static_cast<std::ptrdiff_t>(L.at[j]) * W;
        const double factor = sign * L.values[j];
        for (int c = 0; c < W; ++c) to[c] += factor * own[c];
    }
}

// The four sweeps over the rows; the order of the rows keeps what is still needed.
struct TimesL {
    static constexpr bool from_base = false;
    template <int W>
    CARDAN_INLINE static void row(const Row& L, double pivot, double, double* x, double* own) {
        scale<W>(own, pivot);
        gather<W>(L, 1, x, own);
    }
};
struct TimesLT {
    static constexpr bool from_base = true;
    template <int W>
    CARDAN_INLINE static void row(const Row& L, double pivot, double, double* x, double* own) {
        scatter<W>(L, 1, own, x);
        scale<W>(own, pivot);
    }
};
struct InverseL {
    static constexpr bool from_base = true;
    template <int W>
    CARDAN_INLINE static void row(const Row& L, double, double inverse, double* x, double* own) {
        gather<W>(L, -1, x, own);
        scale<W>(own, inverse);
    }
};
struct InverseLT {
    static constexpr bool from_base = false;
    template <int W>
    CARDAN_INLINE static void row(const Row& L, double, double inverse, double* x, double* own) {
        scale<W>(own, inverse);
        scatter<W>(L, -1, own, x);
    }
};

template <class Sweep, int W>
CARDAN_INLINE void sweep(const Rows& rows, double* x) {
    for (int step = 0; step < rows.n; ++step) {
        const int a = Sweep::from_base ? step : rows.n - 1 - step;
        const std::size_t begin = rows.offset[a], size = rows.offset[a + 1] - begin;
        if (size == 0) continue;
        const Row L{rows.values + begin, rows.path + begin, size - 1};
        Sweep::template row<W>(L, L.values[size - 1], rows.inverse_pivot[a], x, x + static_cast<std::ptrdiff_t>(a) * W);
    }
}

CARDAN_VECTORISED void sweep_tile(TimesL, const Rows& rows, double* x) {
    sweep<TimesL, tile_width>(rows, x);
}
CARDAN_VECTORISED void sweep_tile(TimesLT, const Rows& rows, double* x) {
    sweep<TimesLT, tile_width>(rows, x);
}
CARDAN_VECTORISED void sweep_tile(InverseL, const Rows& rows, double* x) {
    sweep<InverseL, tile_width>(rows, x);
}
CARDAN_VECTORISED void sweep_tile(InverseLT, const Rows& rows, double* x) {
    sweep<InverseLT, tile_width>(rows, x);
}

}  // namespace

std::string PivotStatus::message() const {
    if (ok()) return {};
    return text("the metric is not positive definite: coordinate '", coordinate, "' (index ", index, ") has the pivot ",
                pivot, ", its diagonal element being ", diagonal,
                "; give the bodies that it carries inertia about or along its axis, add an armature, or drive it");
}

MetricFactor::MetricFactor(const Model& model) : MetricFactor(model, model.coordinates().driven()) {}

MetricFactor::MetricFactor(const Model& model, std::vector<bool> driven)
    : model_(&model), driven_(std::move(driven)), g_(model) {
    const int n = model.size();
    if (driven_.size() != static_cast<std::size_t>(n))
        throw InputError("metric factor", "number of driven flags", driven_.size(), text(n, ", one per coordinate"));
    offset_.push_back(0);
    for (int a = 0; a < n; ++a) {
        const auto begin = std::ssize(paths_);
        if (!is_driven(a))
            for (int b = a; b >= 0; b = model.body(b).parent)
                if (!is_driven(b)) paths_.push_back(b);
        std::reverse(paths_.begin() + begin, paths_.end());
        offset_.push_back(paths_.size());
    }
    with_memory("the factor of a metric", [&] { values_.assign(paths_.size(), 0.0); });
    inverse_pivot_.assign(static_cast<std::size_t>(n), 0.0);
    tile_.assign(static_cast<std::size_t>(n) * tile_width, 0.0);
}

std::span<const int> MetricFactor::path(int a) const {
    require_index("metric factor", "coordinate", a, model_->size());
    const std::size_t first = entry(offset_, a);
    return {paths_.data() + first, entry(offset_, a + 1) - first};
}

std::span<const double> MetricFactor::row(int a) const {
    require_index("metric factor", "coordinate", a, model_->size());
    const std::size_t first = entry(offset_, a);
    return {values_.data() + first, entry(offset_, a + 1) - first};
}

double MetricFactor::operator()(int a, int b) const {
    require_index("metric factor", "coordinate", b, model_->size());
    const std::span<const int> on_path = path(a);
    const auto at = std::lower_bound(on_path.begin(), on_path.end(), b);
    return at != on_path.end() && *at == b ? entry(row(a), at - on_path.begin()) : 0.0;
}

PivotStatus MetricFactor::factorise(const Kinematics& kin) {
    require_model("metric factor", "kinematics", kin.model().serial(), model_->serial());
    metric(kin, g_);
    return factorise(g_);
}

PivotStatus MetricFactor::factorise(const BranchMatrix& g) {
    require_model("metric factor", "matrix g", g.model().serial(), model_->serial());
    for (int a = 0; a < model_->size(); ++a) {
        double* own = values_.data() + entry(offset_, a);
        const std::span<const double> row = g.row(a);
        for (const int b : path(a)) *own++ = entry(row, model_->body(b).depth - 1);
    }
    return eliminate();
}

PivotStatus MetricFactor::factorise(MatrixIn g) {
    require_size("metric factor", "g", g, model_->size(), model_->size());
    for (int a = 0; a < model_->size(); ++a) {
        double* own = values_.data() + entry(offset_, a);
        for (const int b : path(a)) *own++ = g(b, a);
    }
    return eliminate();
}

PivotStatus MetricFactor::eliminate() {
    const int n = model_->size();
    // The diagonal is kept where the inverse pivots are about to stand.
    for (int a = 0; a < n; ++a)
        if (const std::span<const double> own = row(a); !own.empty()) entry(inverse_pivot_, a) = own.back();
    const double rounding = n * std::numeric_limits<double>::epsilon();
    for (int a = n - 1; a >= 0; --a) {
        const std::size_t i = static_cast<std::size_t>(a), d = path(a).size();
        if (d == 0) continue;
        double* entries = values_.data() + offset_[i];
        const double pivot = entries[d - 1], diagonal = inverse_pivot_[i];
        if (!(pivot > rounding * std::abs(diagonal))) return {a, model_->coordinates()[a].name, pivot, diagonal};
        entries[d - 1] = std::sqrt(pivot);
        inverse_pivot_[i] = 1 / entries[d - 1];
        for (std::size_t j = 0; j + 1 < d; ++j) entries[j] *= inverse_pivot_[i];
        eliminate_row(d, entries, paths_.data() + offset_[i], offset_.data(), values_.data());
    }
    return {};
}

// Several right-hand sides are laid side by side, so that every entry of L is used for all of them at once; a few
// single ones are not worth a tile.
template <class... Sweeps>
void MetricFactor::apply(MatrixOut& x) {
    const Eigen::Index n = model_->size();
    require_size("metric factor", "x", x, n, x.cols());
    const Rows rows{model_->size(), offset_.data(), paths_.data(), values_.data(), inverse_pivot_.data()};
    Eigen::Index column = 0;
    while (x.cols() - column >= tile_width / 4) {
        const Eigen::Index width = std::min<Eigen::Index>(tile_width, x.cols() - column);
        double* tile = tile_.data();
        if (width < tile_width) std::fill(tile_.begin(), tile_.end(), 0.0);
        for (Eigen::Index c = 0; c < width; ++c)
            for (Eigen::Index k = 0; k < n; ++k) tile[k * tile_width + c] = x(k, column + c);
        (sweep_tile(Sweeps{}, rows, tile), ...);
        for (Eigen::Index c = 0; c < width; ++c)
            for (Eigen::Index k = 0; k < n; ++k) x(k, column + c) = tile[k * tile_width + c];
        column += width;
    }
    for (; column < x.cols(); ++column) (sweep<Sweeps, 1>(rows, x.col(column).data()), ...);
}

void MetricFactor::solve(MatrixOut x) {
    apply<InverseLT, InverseL>(x);
}

void MetricFactor::multiply_L(MatrixOut x) {
    apply<TimesL>(x);
}

void MetricFactor::multiply_LT(MatrixOut x) {
    apply<TimesLT>(x);
}

void MetricFactor::solve_L(MatrixOut x) {
    apply<InverseL>(x);
}

void MetricFactor::solve_LT(MatrixOut x) {
    apply<InverseLT>(x);
}

double MetricFactor::log_determinant() const {
    double sum = 0;
    for (int a = 0; a < model_->size(); ++a)
        if (!is_driven(a)) sum += std::log(row(a).back());
    return 2 * sum;
}

}  // namespace cardan
