#include "examples/studies/beams/assumed_modes_blade.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

namespace {

using Index = Eigen::Index;
using Kind = ShapeFunctions::Kind;

void check_count(const std::string& name, const char* of, int count, int min, int max) {
    if (count < min || count > max)
        throw InputError(name, text("assumed functions of ", of), count, text(min, " ... ", max));
}

std::vector<double> pieces(const BeamLine& line, const AssumedModesBasis& basis) {
    line.check();
    if (!line.is_straight()) throw InputError(text(line.name, ": assumed modes need a straight line"));
    check_count(line.name, "bending", basis.bending, 2, 9);
    check_count(line.name, "torsion", basis.torsion, 0, basis.sines ? 40 : 9);
    check_count(line.name, "extension", basis.extension, 0, 9);
    if (basis.breaks.empty()) return station_ends(line);
    const std::vector<double>& ends = basis.breaks;
    const std::string allowed = text("ascending from 0 to the length, ", line.length);
    if (ends.size() < 2) throw InputError(line.name, "number of ends of the pieces", ends.size(), ">= 2, " + allowed);
    for (std::size_t i = 0; i < ends.size(); ++i)
        if ((i == 0 && ends[i] != 0) || (i > 0 && !(ends[i] > ends[i - 1])) ||
            (i + 1 == ends.size() && ends[i] != line.length))
            throw InputError(line.name, text("end ", i + 1, " of the pieces [m]"), ends[i], allowed);
    return ends;
}

// The integrands have kinks at stations and ends of pieces; and no interval is longer than a sine bears.
std::vector<double> intervals(const BeamLine& line, const AssumedModesBasis& basis) {
    std::vector<double> kinks = station_ends(line), ends{0};
    kinks.insert(kinks.end(), basis.breaks.begin(), basis.breaks.end());
    std::sort(kinks.begin(), kinks.end());
    kinks.erase(std::unique(kinks.begin(), kinks.end()), kinks.end());
    for (std::size_t i = 1; i < kinks.size(); ++i) {
        const double h = kinks[i] - kinks[i - 1];
        const int parts = 1 + (basis.sines ? static_cast<int>(h * basis.torsion / line.length) : 0);
        for (int k = 1; k < parts; ++k) ends.push_back(kinks[i - 1] + h * k / parts);
        ends.push_back(kinks[i]);
    }
    return ends;
}

// Unknowns and strains at a place by those coordinates that move it.
struct Local {
    std::vector<Index> row;
    Eigen::Matrix<double, 6, Eigen::Dynamic> state;   // SectionState
    Eigen::Matrix<double, 4, Eigen::Dynamic> strain;  // u', phi', -w'', v''

    explicit Local(std::size_t max)
        : state(decltype(state)::Zero(6, static_cast<Index>(max))),
          strain(decltype(strain)::Zero(4, static_cast<Index>(max))) {}
    // Calls set(column, k) for function k of the values.
    template <class Set>
    void add(const ShapeValues& values, Index first, const Set& set) {
        for (std::size_t k = 0; k < values.column.size(); ++k) {
            set(std::ssize(row), k);
            row.push_back(first + values.column[k]);
        }
    }
    void scatter(const Matrix& local, Matrix& sum) const {
        for (Index j = 0; j < std::ssize(row); ++j)
            for (Index i = 0; i < std::ssize(row); ++i) sum(entry(row, i), entry(row, j)) += local(i, j);
    }
    void add_form(const Mat6& form, Matrix& sum) const {
        if (!form.isZero(0)) scatter(state.transpose() * form * state, sum);
    }
    template <class Sum>
    void add_row(const SectionRow& form, Sum&& sum) const {
        for (Index i = 0; i < std::ssize(row); ++i) sum(entry(row, i)) += (form * state.col(i)).value();
    }
};

// Coordinates in the order v, w, torsion, extension.
Local local_shapes(const ShapeFunctions& bending, const ShapeFunctions& torsion, const ShapeFunctions& extension,
                   double x) {
    const ShapeValues b = bending.at(x), t = torsion.at(x), e = extension.at(x);
    Local local(2 * b.column.size() + t.column.size() + e.column.size());
    local.add(b, 0, [&](Index i, std::size_t k) {
        local.state(state_v, i) = b.value[k], local.state(state_v_slope, i) = b.slope[k];
        local.strain(3, i) = b.curvature[k];
    });
    local.add(b, bending.size(), [&](Index i, std::size_t k) {
        local.state(state_w, i) = b.value[k], local.state(state_w_slope, i) = b.slope[k];
        local.strain(2, i) = -b.curvature[k];
    });
    local.add(t, 2 * bending.size(),
              [&](Index i, std::size_t k) { local.state(state_phi, i) = t.value[k], local.strain(1, i) = t.slope[k]; });
    local.add(e, 2 * bending.size() + torsion.size(),
              [&](Index i, std::size_t k) { local.state(state_u, i) = e.value[k], local.strain(0, i) = e.slope[k]; });
    return local;
}

Vec3 axial_vector(const Mat3& X) {
    return {X(1, 2) - X(2, 1), X(2, 0) - X(0, 2), X(0, 1) - X(1, 0)};
}

}  // namespace

AssumedModesBlade::AssumedModesBlade(const BeamLine& line, const AssumedModesOptions& options)
    : length_(line.length),
      bending_(Kind::clamped, pieces(line, options.basis), options.basis.bending),
      torsion_(options.basis.sines ? Kind::sines : Kind::continuous, pieces(line, options.basis),
               options.basis.torsion),
      extension_(Kind::continuous, pieces(line, options.basis), options.basis.extension) {
    assemble(line, intervals(line, options.basis), options);
}

Index AssumedModesBlade::first(Deflection of) const {
    switch (of) {
        case Deflection::edge:
            return 0;
        case Deflection::flap:
            return bending_.size();
        case Deflection::torsion:
            return 2 * bending_.size();
        case Deflection::extension:
            return 2 * bending_.size() + torsion_.size();
        case Deflection::mixed:
            break;
    }
    return 2 * bending_.size() + torsion_.size() + extension_.size();
}

Deflection AssumedModesBlade::deflection(Index row) const {
    if (columns_.size() > 0) return Deflection::mixed;
    for (const Deflection of : {Deflection::extension, Deflection::torsion, Deflection::flap})
        if (row >= first(of)) return of;
    return Deflection::edge;
}

void AssumedModesBlade::assemble(const BeamLine& line, std::span<const double> ends,
                                 const AssumedModesOptions& options) {
    const Index n = first(Deflection::mixed);
    M_.setZero(n, n), K_elastic_.setZero(n, n), d_first_.setZero(3, n);
    for (std::size_t a = 0; a < 3; ++a) {
        G_[a].setZero(n, n), K_origin_[a].setZero(n, n);
        for (std::size_t b = 0; b < 3; ++b) K_spin_[a][b].setZero(n, n), d_second_[a][b].setZero(n);
    }
    for (const AxialLoad::Point& point : AxialLoad::along(line, ends, options.tension)) {
        const Local local = local_shapes(bending_, torsion_, extension_, point.x);
        const BeamSection section = line.section(point.x);
        const Eigen::Matrix4d stiffness =
            section_stiffness(section, options.basis.torsion > 0, options.basis.extension > 0,
                              text(line.name, " at x = ", point.x, " m"));
        SectionMass inertia(section, point.x, options.rotary_inertia);
        inertia.add_tension(point.load);
        const double dx = point.weight;
        local.scatter(dx * local.strain.transpose() * stiffness * local.strain, K_elastic_);
        local.add_form(dx * inertia.M, M_);
        for (std::size_t a = 0; a < 3; ++a) {
            local.add_form(dx * inertia.G[a], G_[a]);
            local.add_form(dx * inertia.K_origin[a], K_origin_[a]);
            local.add_row(dx * inertia.d_first.row(static_cast<Index>(a)), d_first_.row(static_cast<Index>(a)));
            for (std::size_t b = 0; b < 3; ++b) {
                local.add_form(dx * inertia.K_spin[a][b], K_spin_[a][b]);
                local.add_row(dx * inertia.d_second[a][b], d_second_[a][b]);
            }
        }
        mass_ += dx * section.mass;
        first_ += dx * inertia.first;
        second_ += dx * inertia.second;
    }
}

AssumedModesMatrices AssumedModesBlade::at(const HubMotion& motion) const {
    const Mat3 W = motion.spin_matrix();
    const Vec3 a = motion.origin_acceleration();
    AssumedModesMatrices out{M_, Matrix::Zero(size(), size()), K_elastic_, K_elastic_, -d_first_.transpose() * a};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto r = static_cast<Index>(i);
        out.G += motion.A(r) * G_[i];
        out.K += a(r) * K_origin_[i];
        for (std::size_t j = 0; j < 3; ++j) {
            const auto s = static_cast<Index>(j);
            out.K += W(r, s) * K_spin_[i][j];
            out.f -= W(r, s) * d_second_[j][i];
        }
    }
    return out;
}

Matrix AssumedModesBlade::shapes(double x) const {
    Matrix rows = Matrix::Zero(4, first(Deflection::mixed));
    const auto fill = [&](Index row, const ShapeFunctions& functions, Deflection of) {
        const ShapeValues values = functions.at(x);
        for (std::size_t k = 0; k < values.column.size(); ++k)
            rows(row, first(of) + values.column[k]) = values.value[k];
    };
    fill(0, extension_, Deflection::extension);
    fill(1, bending_, Deflection::edge);
    fill(2, bending_, Deflection::flap);
    fill(3, torsion_, Deflection::torsion);
    return columns_.size() > 0 ? Matrix(rows * columns_) : rows;
}

RootLoad AssumedModesBlade::root_load(const HubMotion& motion, const Vector& q, const Vector& qd,
                                      const Vector& qdd) const {
    const Mat3 W = motion.spin_matrix(), turn = skew(motion.A);
    const Vec3 a = motion.origin_acceleration();
    // int rho p_c dp_d
    const auto second = [&](const Vector& rate) {
        Mat3 Z;
        for (Index c = 0; c < 3; ++c)
            for (Index d = 0; d < 3; ++d) Z(c, d) = entry(entry(d_second_, c), d).dot(rate);
        return Z;
    };
    const Vec3 p = first_ + d_first_ * q;
    const Mat3 Z = second(q);
    RootLoad load;
    load.force = mass_ * a + W * p + 2 * turn * d_first_ * qd + d_first_ * qdd;
    load.moment = cross(p, a) + axial_vector(second(qdd) + 2 * second(qd) * turn.transpose() +
                                             (second_ + Z + Z.transpose()) * W.transpose());
    return load;
}

AssumedModesBlade AssumedModesBlade::reduced(const Matrix& columns) const {
    if (columns.rows() != size() || columns.cols() < 1 || !columns.allFinite())
        throw InputError("assumed modes, reduced", "rows, columns", text(columns.rows(), ", ", columns.cols()),
                         text(size(), ", >= 1, finite"));
    AssumedModesBlade out = *this;
    out.columns_ = columns_.size() > 0 ? Matrix(columns_ * columns) : columns;
    const auto project = [&](Matrix& matrix) { matrix = (columns.transpose() * matrix * columns).eval(); };
    project(out.M_), project(out.K_elastic_);
    out.d_first_ = d_first_ * columns;
    for (std::size_t a = 0; a < 3; ++a) {
        project(out.G_[a]), project(out.K_origin_[a]);
        for (std::size_t b = 0; b < 3; ++b) {
            project(out.K_spin_[a][b]);
            out.d_second_[a][b] = columns.transpose() * d_second_[a][b];
        }
    }
    return out;
}

std::vector<AssumedMode> natural_modes(const AssumedModesMatrices& matrices) {
    const Matrix K = (matrices.K + matrices.K.transpose()) / 2;
    if (Eigen::LLT<Matrix>(matrices.M).info() != Eigen::Success)
        throw NumericalError("assumed modes: the mass matrix is not positive definite (torsion without inertia?)");
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(K, matrices.M);
    if (solver.info() != Eigen::Success) throw NumericalError("assumed modes: the eigenvalue iteration failed");
    if (!(solver.eigenvalues()(0) > 0))
        throw NumericalError(text("assumed modes: the stiffness is not positive definite (lowest omega^2 ",
                                  solver.eigenvalues()(0), " 1/s^2): the loads buckle the blade"));
    std::vector<AssumedMode> modes;
    for (Index i = 0; i < K.rows(); ++i)
        modes.push_back({std::sqrt(solver.eigenvalues()(i)) / (2 * pi), solver.eigenvectors().col(i)});
    return modes;
}

std::array<double, 4> energy_shares(const AssumedModesBlade& blade, const AssumedModesMatrices& matrices,
                                    const Vector& shape) {
    const Vector by_row = shape.cwiseProduct(matrices.K_elastic * shape);
    std::array<double, 4> shares{};
    for (Index i = 0; i < by_row.size(); ++i) {
        const auto of = static_cast<std::size_t>(blade.deflection(i));
        if (of < shares.size()) shares[of] += by_row(i) / by_row.sum();
    }
    return shares;
}

}  // namespace cardan
