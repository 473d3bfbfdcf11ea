#include "mbs/kernels/christoffel.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/composites.hpp"
#include "mbs/kernels/detail/added_mass.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

#include <algorithm>

namespace cardan {

Christoffel::Christoffel(const Model& model) : model_(&model) {
    std::size_t values = 0, on_paths = 0;
    for (int m = 0; m < model.size(); ++m) {
        const std::size_t d = static_cast<std::size_t>(model.body(m).depth);
        value_offset_.push_back(values);
        path_offset_.push_back(on_paths);
        values += d * stride(m) / 4;
        on_paths += d;
        stored_ += d * d;
    }
    const auto what = [&] { return text("the Christoffel symbols of ", model.size(), " bodies (", stored_, ")"); };
    with_memory(what, [&] {
        values_ = AlignedNumbers(values);
        paths_.resize(on_paths);
    });
    for (int m = 0; m < model.size(); ++m) {
        auto at = paths_.begin() + static_cast<std::ptrdiff_t>(entry(path_offset_, m));
        at += model.body(m).depth;
        for (int a = m; a >= 0; a = model.body(a).parent) *--at = a;
    }
}

std::span<const double> Christoffel::table(int m) const {
    const std::size_t d = static_cast<std::size_t>(model_->body(m).depth);
    return {values_.data() + 4 * entry(value_offset_, m), d * stride(m)};
}

std::size_t Christoffel::stride(int m) const {
    return 4 * static_cast<std::size_t>(PathTwists<double>::blocks(model_->body(m).depth));
}

std::span<const int> Christoffel::path(int m) const {
    const auto depth = static_cast<std::size_t>(model_->body(m).depth);
    return {paths_.data() + entry(path_offset_, m), depth};
}

double Christoffel::operator()(int a, int b, int c) const {
    if (b > c) std::swap(b, c);
    for (const int index : {a, b, c}) require_index("Christoffel symbols", "index", index, model_->size());
    const int m = std::max(a, c);
    if (!model_->precedes(a, m) || !model_->precedes(b, m) || !model_->precedes(c, m)) return 0;
    const auto place = [&](int index) { return static_cast<std::size_t>(model_->body(index).depth - 1); };
    const auto at = [&](int row, int column) { return table(m)[place(row) * stride(m) + place(column)]; };
    return m == c ? at(a, b) : -at(c, b);
}

namespace {

// Rows of the branch: three each, then one for what nobody reads.
struct TableRows {
    enum Row { w = -9, v = 0, f = 3, t = 6, spare = 9 };
};

// K(a, b) = v_a . f_b + w_a . t_b with v the velocities at the centre C of the subtree of the last column m,
// f = M w x v_m and t = P w x w_m. A prismatic b has w = 0, which makes its column vanish: the factor (1 - s_b).
CARDAN_INLINE void branch_columns(const PathTwists<double>& path, std::ptrdiff_t depth,
                                  const KernelArrays::Inertia& body) {
    using enum TableRows::Row;
    using Columns = Packed3<double>;
    const Columns cx = broadcast<0>(body.C), cy = broadcast<1>(body.C), cz = broadcast<2>(body.C);
    for (std::ptrdiff_t j = 0; j < PathTwists<double>::blocks(depth); ++j) {
        const Columns wx = path.w(0)[j], wy = path.w(1)[j], wz = path.w(2)[j];
        const Columns x = cx - path.o(0)[j], y = cy - path.o(1)[j], z = cz - path.o(2)[j];
        path.row(v)[j] = path.u(0)[j] + times(wy, z) - times(wz, y);
        path.row(v + 1)[j] = path.u(1)[j] + times(wz, x) - times(wx, z);
        path.row(v + 2)[j] = path.u(2)[j] + times(wx, y) - times(wy, x);
    }
    const Packed3<double> p = body.M * path.get(v, depth - 1), s = path.get(w, depth - 1);
    const Columns px = broadcast<0>(p), py = broadcast<1>(p), pz = broadcast<2>(p);
    const Columns sx = broadcast<0>(s), sy = broadcast<1>(s), sz = broadcast<2>(s);
    const Packed33<double>& P = body.P;
    for (std::ptrdiff_t j = 0; j < PathTwists<double>::blocks(depth); ++j) {
        const Columns wx = path.w(0)[j], wy = path.w(1)[j], wz = path.w(2)[j];
        path.row(f)[j] = times(wy, pz) - times(wz, py);
        path.row(f + 1)[j] = times(wz, px) - times(wx, pz);
        path.row(f + 2)[j] = times(wx, py) - times(wy, px);
        const Columns hx = P[0](0) * wx + P[1](0) * wy + P[2](0) * wz, hy = P[0](1) * wx + P[1](1) * wy + P[2](1) * wz,
                      hz = P[0](2) * wx + P[1](2) * wy + P[2](2) * wz;
        path.row(t)[j] = times(hy, sz) - times(hz, sy);
        path.row(t + 1)[j] = times(hz, sx) - times(hx, sz);
        path.row(t + 2)[j] = times(hx, sy) - times(hy, sx);
    }
}

CARDAN_INLINE Packed3<double> all(const Packed3<double>* row, std::ptrdiff_t column) {
    return Packed3<double>::all(numbers(row)[column]);
}

// Two rows at a time, for every number of f and t loaded to serve twice; the row after the last is a spare one.
CARDAN_INLINE void fill_table(const PathTwists<double>& path, std::ptrdiff_t depth, Packed3<double>* K) {
    using enum TableRows::Row;
    using Columns = Packed3<double>;
    const std::ptrdiff_t blocks = PathTwists<double>::blocks(depth);
    const Columns *fx = path.row(f), *fy = path.row(f + 1), *fz = path.row(f + 2), *tx = path.row(t),
                  *ty = path.row(t + 1), *tz = path.row(t + 2);
    for (std::ptrdiff_t a = 0; a < depth; a += 2, K += 2 * blocks) {
        Columns* const second = a + 1 < depth ? K + blocks : path.row(spare);
        const Columns vx = all(path.row(v), a), vy = all(path.row(v + 1), a), vz = all(path.row(v + 2), a),
                      wx = all(path.w(0), a), wy = all(path.w(1), a), wz = all(path.w(2), a);
        const Columns Vx = all(path.row(v), a + 1), Vy = all(path.row(v + 1), a + 1), Vz = all(path.row(v + 2), a + 1),
                      Wx = all(path.w(0), a + 1), Wy = all(path.w(1), a + 1), Wz = all(path.w(2), a + 1);
        for (std::ptrdiff_t b = 0; b < blocks; ++b) {
            K[b] = times(vx, fx[b]) + times(vy, fy[b]) + times(vz, fz[b]) +
                   (times(wx, tx[b]) + times(wy, ty[b]) + times(wz, tz[b]));
            second[b] = times(Vx, fx[b]) + times(Vy, fy[b]) + times(Vz, fz[b]) +
                        (times(Wx, tx[b]) + times(Wy, ty[b]) + times(Wz, tz[b]));
        }
    }
}

CARDAN_VECTORISED void fill(int n, const Model::Link* links, const KernelArrays::Frame* frame,
                            const KernelArrays::Inertia* composite, const PathTwists<double>& path,
                            Packed3<double>* values, const std::size_t* offset) {
    for (int first = 0; first < n;) {
        const int end = set_run(path, links, frame, first, n);
        for (int m = first; m < end; ++m) {
            branch_columns(path, links[m].depth, composite[m]);
            fill_table(path, links[m].depth, values + offset[m]);
        }
        first = end;
    }
}

// K(a, b) = S_a . B S_b, where B belongs to the subtree of m and to the twist of m.
void add_added_mass_symbols(const Kinematics& kin, const Christoffel& gamma, double* values,
                            const std::size_t* offset) {
    const KernelArrays& ws = kin.arrays();
    for (const KernelArrays::Entraining& at : ws.entraining) {
        const int m = at.body;
        const Vec3 o = entry(ws.frame, m).o.vector();
        const Mat6 B = coriolis_inertia<double>(at.I, twist_column(kin, m, o));
        const std::span<const int> path = gamma.path(m);
        double* const K = values + 4 * offset[m];
        for (std::size_t b = 0; b < path.size(); ++b) {
            const Vec6 force = B * twist_column(kin, path[b], o);
            for (std::size_t a = 0; a + 1 < path.size(); ++a)  // zero for a = m
                K[a * gamma.stride(m) + b] += work<double>(twist_column(kin, path[a], o), force);
        }
    }
}

}  // namespace

void christoffel_first_kind(const Kinematics& kin, Christoffel& gamma) {
    require_model("Christoffel symbols", "table", gamma.model().serial(), kin.model().serial());
    composites(kin);
    KernelArrays& ws = kin.arrays();
    const Model& model = kin.model();
    fill(model.size(), model.links().data(), ws.frame.data(), ws.composite.data(),
         PathTwists<double>(ws.branch.data(), ws.stride), vectors(gamma.values_.data()), gamma.value_offset_.data());
    add_added_mass_symbols(kin, gamma, gamma.values_.data(), gamma.value_offset_.data());
}

}  // namespace cardan
