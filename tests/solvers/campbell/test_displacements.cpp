// Rigid motions of several free coordinates.
#include "solvers/campbell/detail/displacements.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::solvers;

namespace {

CampbellMode motion(const Vector& shape, FloquetKind kind) {
    CampbellMode out;
    FloquetMode& mode = out.floquet.emplace();
    mode.kind = kind;
    mode.period = 1;
    mode.harmonics = shape.cast<Complex>();
    mode.participation = Vector::Ones(1);
    out.mode.shape = mode.harmonics.col(0);
    out.mode.states = ComplexVector::Zero(0);
    return out;
}

}  // namespace

TEST_CASE("displacements: of mixed ones of two free coordinates each is of one coordinate, by order of the rows",
          "[analytic]") {
    Matrix M = Matrix::Identity(4, 4);
    M(1, 1) = 40;
    M(3, 3) = 0.2;
    // Coordinate 3 takes along coordinate 0, which has less energy.
    const Eigen::Vector4d yaw(0, 1, 0, 0), azimuth(0.2, 0, 0, 1);
    std::vector<CampbellMode> modes{
        motion(azimuth + 2 * yaw, FloquetKind::rigid), motion(Eigen::Vector4d(1, 2, 3, 4), FloquetKind::oscillation),
        motion(yaw - 0.3 * azimuth, FloquetKind::rigid), motion(azimuth + 2.0000001 * yaw, FloquetKind::rigid),
        motion(3 * yaw - 0.8 * azimuth, FloquetKind::rigid)};
    separate_displacements(modes, M);
    CHECK(modes[1].mode.shape == Eigen::Vector4d(1, 2, 3, 4).cast<Complex>());
    const std::vector<std::size_t> rigid{0, 2, 3, 4};
    for (std::size_t i = 0; i < rigid.size(); ++i) {
        const CampbellMode& mode = modes[rigid[i]];
        const Eigen::Vector4d own = i % 2 == 0 ? yaw : azimuth;
        CHECK(mode.row == (i % 2 == 0 ? 1 : 3));
        // Energy 1 J at unit rate.
        const Vector expected = own * std::sqrt(2 / own.dot(M * own));
        CHECK((mode.mode.shape.cwiseAbs() - expected).norm() < 1e-12 * expected.norm());
        CHECK(mode.floquet->harmonics.col(0) == mode.mode.shape);
    }
}

TEST_CASE("displacements: of one free coordinate they stay as they are", "[property]") {
    const Eigen::Vector3d yaw(0.2, 1, -0.1);
    std::vector<CampbellMode> modes{motion(yaw, FloquetKind::rigid),
                                    motion(yaw + Eigen::Vector3d(1e-8, 0, 1e-8), FloquetKind::rigid)};
    const std::vector<CampbellMode> before = modes;
    separate_displacements(modes, Matrix::Identity(3, 3));
    for (std::size_t i = 0; i < modes.size(); ++i) CHECK(modes[i].mode.shape == before[i].mode.shape);
}
