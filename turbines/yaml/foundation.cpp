#include "turbines/yaml/foundation.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/yaml/detail/node.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

Mat6 matrix(const YamlNode& node, bool or_infinite) {
    const std::vector<YamlNode> rows = node.items();
    if (rows.size() != 6) node.fail(text(rows.size(), " rows; allowed: 6"));
    Mat6 M;
    for (Eigen::Index i = 0; i < 6; ++i) {
        const std::vector<double> row = entry(rows, i).numbers(or_infinite);
        if (row.size() != 6) entry(rows, i).fail(text(row.size(), " numbers; allowed: 6"));
        for (Eigen::Index j = 0; j < 6; ++j) M(i, j) = entry(row, j);
    }
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            if (!(std::abs(M(i, j) - M(j, i)) <= 1e-6 * std::sqrt(std::abs(M(i, i) * M(j, j)))))
                node.fail(text("entries ", i + 1, ", ", j + 1, " and ", j + 1, ", ", i + 1, " = ", M(i, j), " and ",
                               M(j, i), "; allowed: a symmetric matrix"));
    return (M + M.transpose()) / 2;
}

void hold(PlatformDescription& foundation, Eigen::Index i) {
    for (Mat6* M : {&foundation.hydrostatic_stiffness, &foundation.added_mass, &foundation.damping}) {
        M->row(i).setZero();
        M->col(i).setZero();
    }
    entry(foundation.coordinates.roles, i) = CoordinateRole::prescribed;
}

// Every direction that is not held has a spring, and the springs hold the tower up.
void check_stiffness(const YamlNode& node, const PlatformDescription& foundation) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (entry(foundation.coordinates.roles, i)) continue;
        free.push_back(i);
        if (const double k = foundation.hydrostatic_stiffness(i, i); !(k > 0))
            node.fail(text("entry ", i + 1, ", ", i + 1, " = ", k, "; allowed: > 0, or .inf: held"));
    }
    if (free.empty()) return;
    const Matrix K = foundation.hydrostatic_stiffness(free, free);
    const Vector scale = K.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix unit = scale.asDiagonal() * K * scale.asDiagonal();
    if (const double lowest = Eigen::SelfAdjointEigenSolver<Matrix>(unit, Eigen::EigenvaluesOnly).eigenvalues()(0);
        !(lowest > 0))
        node.fail(text("lowest eigenvalue (unit diagonal) = ", lowest, "; allowed: > 0"));
}

}  // namespace

PlatformDescription parse_foundation(const std::string& text, const std::string& file) {
    const YamlNode root = YamlNode::parse(text, file);
    for (const YamlNode& one : root.entries())
        if (one.path() != "stiffness" && one.path() != "mass" && one.path() != "damping")
            one.fail(cardan::text("unknown key; allowed: stiffness, mass and damping"));
    PlatformDescription foundation;
    foundation.name = "foundation";
    foundation.source = text;
    foundation.coordinates.role = CoordinateRole::free;
    foundation.hydrostatic_stiffness = matrix(root["stiffness"], true);
    if (const auto mass = root.find("mass")) foundation.added_mass = matrix(*mass, false);
    if (const auto damping = root.find("damping")) foundation.damping = matrix(*damping, false);
    for (Eigen::Index i = 0; i < 6; ++i)
        if (std::isinf(foundation.hydrostatic_stiffness(i, i))) hold(foundation, i);
    check_stiffness(root["stiffness"], foundation);
    foundation.check(file);
    return foundation;
}

PlatformDescription read_foundation(const std::filesystem::path& path) {
    return parse_foundation(text_file(path), path.string());
}

}  // namespace cardan::turbines
