#include "examples/studies/beams/assumed_modes_section.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"
#include "mbs/model/spatial.hpp"

#include <algorithm>

namespace cardan {

namespace {

using Index = Eigen::Index;
using Slopes = Eigen::Matrix<double, 3, 6>;

// Derivatives of the three vectors by the unknowns, at s = 0.
std::array<Slopes, 3> first_derivatives() {
    std::array<Slopes, 3> d{Slopes::Zero(), Slopes::Zero(), Slopes::Zero()};
    d[0](0, state_u) = d[0](1, state_v) = d[0](2, state_w) = 1;
    d[1](0, state_v_slope) = -1, d[1](2, state_phi) = 1;
    d[2](0, state_w_slope) = -1, d[2](1, state_phi) = -1;
    return d;
}

// [i][c]: second derivatives of component c of vector i.
std::array<std::array<Mat6, 3>, 3> second_derivatives() {
    std::array<std::array<Mat6, 3>, 3> H;
    for (auto& vector : H) vector.fill(Mat6::Zero());
    const auto set = [&](std::size_t i, std::size_t c, Index a, Index b, double value) {
        H[i][c](a, b) = H[i][c](b, a) = value;
    };
    set(1, 0, state_phi, state_w_slope, -1);
    set(1, 1, state_phi, state_phi, -1), set(1, 1, state_v_slope, state_v_slope, -1);
    set(2, 0, state_phi, state_v_slope, 1);
    set(2, 1, state_v_slope, state_w_slope, -1);
    set(2, 2, state_phi, state_phi, -1), set(2, 2, state_w_slope, state_w_slope, -1);
    return H;
}

// Mass moments int rho (1, y, z)^T (1, y, z) dA about the axis. Beside J, int rho y^2 = J_zz, int rho y z = -J_yz.
Mat3 mass_moments(const BeamSection& s) {
    const double y = s.centre.y(), z = s.centre.z();
    Mat3 G;
    G << 1, y, z, y, y * y, y * z, z, y * z, z * z;
    G *= s.mass;
    G(1, 1) += s.J(2, 2), G(2, 2) += s.J(1, 1), G(1, 2) -= s.J(1, 2), G(2, 1) -= s.J(1, 2);
    return G;
}

}  // namespace

SectionMass::SectionMass(const BeamSection& section, double x, bool rotary_inertia) {
    static const auto all = first_derivatives();
    static const auto H = second_derivatives();
    const Mat3 moments = mass_moments(section);
    const std::array<Vec3, 3> X{Vec3(x, 0, 0), Vec3::UnitY(), Vec3::UnitZ()};
    Mat6 keep = Mat6::Identity();  // of the second moments without rotary inertia: nothing of the slopes
    if (!rotary_inertia) keep(state_v_slope, state_v_slope) = keep(state_w_slope, state_w_slope) = 0;

    G.fill(Mat6::Zero()), K_origin.fill(Mat6::Zero()), d_first.setZero();
    for (std::size_t a = 0; a < 3; ++a) K_spin[a].fill(Mat6::Zero()), d_second[a].fill(SectionRow::Zero());
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double g = moments(static_cast<Index>(i), static_cast<Index>(j));
            if (g == 0) continue;
            const Mat6 part = i > 0 && j > 0 ? keep : Mat6(Mat6::Identity());
            const Slopes di = all[i] * part, dj = all[j] * part;
            const auto curved = [&](std::size_t c) -> Mat6 { return part * H[i][c] * part; };
            M += g * di.transpose() * dj;
            second += g * X[i] * X[j].transpose();
            for (Index a = 0; a < 3; ++a) {
                const auto c = static_cast<std::size_t>(a);
                G[c] += 2 * g * di.transpose() * skew<double>(Vec3::Unit(a)) * dj;
                if (j == 0) K_origin[c] += g * curved(c);
                for (Index b = 0; b < 3; ++b) {
                    const auto d = static_cast<std::size_t>(b);
                    K_spin[c][d] += g * (di.row(a).transpose() * dj.row(b) + curved(c) * X[j](b));
                    d_second[c][d] += g * X[i](a) * dj.row(b);
                }
            }
            if (j == 0) d_first += g * di, first += g * X[i];
        }
}

void SectionMass::add_tension(const Eigen::Vector4d& axial) {
    Mat6 slopes = Mat6::Zero();
    slopes(state_v_slope, state_v_slope) = slopes(state_w_slope, state_w_slope) = 1;
    for (Index b = 0; b < 3; ++b) entry(K_spin[0], b) -= axial(b) * slopes;
    K_origin[0] -= axial(3) * slopes;
}

Eigen::Matrix4d section_stiffness(const BeamSection& section, bool torsion, bool extension, const std::string& where) {
    const Mat6& C = section.compliance;
    const auto coupled = [&](Index i, Index j) {
        return std::abs(C(i, j)) > 1e-9 * std::sqrt(C(i, i) * C(j, j)) && C(i, i) * C(j, j) > 0;
    };
    for (Index i = 0; i < 3; ++i)
        for (Index j = 3; j < 6; ++j)
            if (coupled(i, j))
                throw InputError(
                    where,
                    i == 0 ? "extension coupled with bending or torsion" : "shear coupled with bending or torsion",
                    C(i, j), "0: shear and tension centres on the axis");
    Eigen::Matrix4d S = Eigen::Matrix4d::Zero();
    if (extension) {
        if (!(C(0, 0) > 0)) throw InputError(where, "1/EA [1/N]", C(0, 0), "> 0, or no functions of extension");
        S(0, 0) = 1 / C(0, 0);
    }
    if (torsion) {
        if (!(C(3, 3) > 0)) throw InputError(where, "1/GJ [1/(N m^2)]", C(3, 3), "> 0, or no functions of torsion");
        S.bottomRightCorner<3, 3>() = Mat3(C.bottomRightCorner<3, 3>()).inverse();
    } else {
        S.bottomRightCorner<2, 2>() = Eigen::Matrix2d(C.bottomRightCorner<2, 2>()).inverse();
    }
    return S;
}

std::vector<AxialLoad::Point> AxialLoad::along(const BeamLine& line, std::span<const double> ends,
                                               TensionIntegral from) {
    const GaussRule& rule = gauss_rule();
    std::vector<Point> points;
    Eigen::Vector4d total = Eigen::Vector4d::Zero();
    for (std::size_t k = 1; k < ends.size(); ++k) {
        const double half = (ends[k] - ends[k - 1]) / 2, middle = ends[k - 1] + half;
        Eigen::Matrix<double, 4, 12> n;  // per length: of the first moments of G about the root, times the row x of W
        for (Index i = 0; i < n.cols(); ++i) {
            const double x = middle + half * entry(rule.node, i);
            const BeamSection s = line.section(x);
            n.col(i) = s.mass * Eigen::Vector4d(x, s.centre.y(), s.centre.z(), 1);
        }
        const Eigen::Matrix<double, 4, 12> inboard = half * n * running_gauss_rule().transpose();
        for (Index i = 0; i < n.cols(); ++i)
            points.push_back(
                {middle + half * entry(rule.node, i), half * entry(rule.weight, i), total + inboard.col(i)});
        total += half * n * Eigen::Map<const Eigen::Matrix<double, 12, 1>>(rule.weight.data());
    }
    if (from == TensionIntegral::from_free_tip)
        for (Point& point : points) point.load = (total - point.load).eval();
    return points;
}

std::vector<double> station_ends(const BeamLine& line) {
    std::vector<double> x{0};
    for (double station : line.breaks)
        if (station > 0 && station < line.length) x.push_back(station);
    x.push_back(line.length);
    return x;
}

BeamLine stretched(const BeamLine& line, const HubMotion& motion) {
    const Mat3 W = motion.spin_matrix();
    const double a = motion.origin_acceleration().x();
    const std::vector<double> before = station_ends(line);
    std::vector<double> after{0}, factor;
    const auto points = AxialLoad::along(line, before, TensionIntegral::from_free_tip);
    const std::size_t each = points.size() / (before.size() - 1);
    for (std::size_t i = 0; i + 1 < before.size(); ++i) {
        double longer = 0;
        for (std::size_t k = i * each; k < (i + 1) * each; ++k) {
            const double tension = -W.row(0) * points[k].load.head<3>() - a * points[k].load(3);
            longer += points[k].weight * tension * line.section(points[k].x).compliance(0, 0);
        }
        const double h = before[i + 1] - before[i];
        factor.push_back(1 + longer / h);
        after.push_back(after.back() + h + longer);
    }
    BeamLine out = line;
    out.length = after.back();
    out.breaks = after;
    out.section = [line, before, after, factor](double x) {
        const std::size_t i = place_among(after, x).left;
        BeamSection s = line.section(std::min(before[i] + (x - after[i]) / factor[i], before[i + 1]));
        s.mass /= factor[i];
        s.J /= factor[i];
        s.compliance /= factor[i];
        return s;
    };
    return out;
}

}  // namespace cardan
