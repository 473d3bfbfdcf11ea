// Slow motions as a system of their own, beside the integration of all.
#include "solvers/periodic/detail/slow_motions.hpp"
#include "solvers/periodic/floquet.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

// Slow and fast oscillators that inertia, gyroscopic and circulatory terms and dampers couple, all of which change with
// time. Half a period later the odd rows have changed their sign.
class Coupled {
public:
    explicit Coupled(const Vector& omega, double coupling = 0.2) : omega_(omega), n_(omega.size()) {
        const auto coefficients = [&](double size) {
            Matrix A(n_, n_);
            for (Index j = 0; j < n_; ++j)
                for (Index i = 0; i < n_; ++i) A(i, j) = size * std::sin(1.0 + 3.1 * static_cast<double>(i * n_ + j));
            return A;
        };
        inertia_ = coefficients(coupling);
        inertia_ = (inertia_ + inertia_.transpose()).eval() / 2;
        rates_ = coefficients(coupling);
        springs_ = coefficients(0.5 * coupling);
    }

    void operator()(double t, SecondOrderSystem& out) const {
        out.M = Matrix::Identity(n_, n_);
        out.C = 0.02 * omega_.asDiagonal();
        out.K = out.K_elastic = omega_.cwiseAbs2().asDiagonal();
        for (Index j = 0; j < n_; ++j)
            for (Index i = 0; i < n_; ++i) {
                const double harmonic = (i + j) % 2 == 0 ? 2 : 1, c = std::cos(harmonic * t),
                             s = std::sin(harmonic * t);
                out.M(i, j) += c * inertia_(i, j);
                out.C(i, j) += s * rates_(i, j);
                out.K(i, j) += (c + 0.3 * s) * springs_(i, j) * std::min(omega_(i), omega_(j));
            }
    }
    PeriodicSystem system() const { return PeriodicSystem::second_order(2 * pi, n_, *this); }
    BladeSymmetry symmetry() const {
        Vector signs(n_);
        for (Index i = 0; i < n_; ++i) signs(i) = i % 2 == 0 ? 1 : -1;
        return {2, signs.asDiagonal()};
    }

private:
    Vector omega_;
    Index n_;
    Matrix inertia_, rates_, springs_;
};

Vector with_gap() {
    return (Vector(9) << 0.37, 0.9, 2.2, 3.1, 150, 210, 340, 900, 2000).finished();
}

// Largest difference of the exponents of `some` from the nearest of `all`, and of their energies by harmonics.
double difference(const Floquet& some, const Floquet& all) {
    double largest = 0;
    for (const FloquetMode& mode : some.modes) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const FloquetMode& other : all.modes) {
            double one = std::abs(mode.exponent - other.exponent);
            for (int j = -3; j <= 3; ++j) one = std::max(one, std::abs(mode.share(j) - other.share(j)));
            nearest = std::min(nearest, one);
        }
        largest = std::max(largest, nearest);
    }
    return largest;
}

}  // namespace

TEST_CASE("slow motions: what they are after a period is the same in the small system and in the whole",
          "[crosscheck]") {
    const Coupled coupled(with_gap());
    const PeriodicSystem system = coupled.system();
    const std::optional<SlowMotions> slow = SlowMotions::find(system, {}, 4, 1e-9);
    REQUIRE(slow);
    REQUIRE(slow->system().rows() == 4);
    CHECK(slow->error() < 1e-9);
    for (const double t : {0.6, 2 * pi}) {
        const Matrix whole = transitions(system, 0, t, 1, 256, {.stages = 7}).front() * slow->expansion(0),
                     small = slow->expansion(t) * transitions(slow->system(), 0, t, 1, 64, {.stages = 7}).front();
        CHECK((whole - small).cwiseAbs().maxCoeff() < 1e-8 * whole.cwiseAbs().maxCoeff());
    }
    const Matrix own = slow->expansion(0);
    // Fast rows take part by far more than the comparison would let pass.
    CHECK(own.topLeftCorner(9, 4).bottomRows(5).cwiseAbs().maxCoeff() > 1e-6);
}

TEST_CASE("slow motions: exponents and harmonics by Floquet's theory are those of the whole", "[crosscheck]") {
    const Coupled coupled(with_gap());
    const PeriodicSystem system = coupled.system();
    FloquetOptions options{.per_period = 4};
    const Floquet all = floquet(system, options);
    options.only_slow = true;
    const Floquet whole = floquet(system, options);
    options.symmetry = coupled.symmetry();
    const Floquet half = floquet(system, options);
    for (const Floquet* some : {&whole, &half}) {
        CHECK(some->modes.size() == 4);
        CHECK(some->unresolved.empty());
        CHECK(some->note.empty());
        CHECK(difference(*some, all) < 2e-9);
        for (const FloquetMode& mode : some->modes) CHECK(mode.error < 1e-8);
    }
}

// The correction knows no damping, and harmonics near the width of the gap fall little by one correction.
TEST_CASE("slow motions: a strong damper between slow and fast rows, and a narrow gap", "[crosscheck]") {
    const Vector omega = (Vector(9) << 0.37, 0.9, 2.2, 3.1, 30, 42, 68, 180, 400).finished();
    const Coupled coupled(omega);
    const PeriodicSystem system = PeriodicSystem::second_order(2 * pi, 9, [coupled](double t, SecondOrderSystem& out) {
        coupled(t, out);
        const Vector damper = (Vector(9) << 0, 1, 0, -0.4, 1.5, 0, 0.8, 0, 1.2).finished();
        out.C += 6 * damper * damper.transpose();
    });
    const std::optional<SlowMotions> slow = SlowMotions::find(system, {}, 6, 1e-9);
    REQUIRE(slow);
    REQUIRE(slow->system().rows() == 4);
    FloquetOptions options{.per_period = 4};
    const Floquet all = floquet(system, options);
    options.only_slow = true;
    const Floquet some = floquet(system, options);
    CHECK(some.modes.size() >= 4);
    CHECK(difference(some, all) < 1e-8);
}

TEST_CASE("slow motions: without a gap all are integrated", "[crosscheck]") {
    const Vector omega = (Vector(6) << 0.37, 1.9, 5.2, 9.1, 13.3, 18.2).finished();
    const Coupled coupled(omega);
    const PeriodicSystem system = coupled.system();
    CHECK_FALSE(SlowMotions::find(system, {}, 4, 1e-9));
    FloquetOptions options{.per_period = 4};
    const Floquet all = floquet(system, options);
    options.only_slow = true;
    const Floquet same = floquet(system, options);
    CHECK(same.modes.size() == all.modes.size());
    CHECK(difference(same, all) < 1e-9);
}

TEST_CASE("slow motions: none where the harmonics of their shapes do not die out", "[crosscheck]") {
    // Inertia that nearly vanishes twice per period: a series of very many harmonics.
    const PeriodicSystem system = PeriodicSystem::second_order(2 * pi, 3, [](double t, SecondOrderSystem& out) {
        out.M = Matrix::Identity(3, 3);
        out.M(0, 0) = out.M(1, 1) = 1 + 0.999 * std::cos(2 * t);
        out.M(0, 1) = out.M(1, 0) = 0.0005;
        out.C = Matrix::Zero(3, 3);
        out.K = out.K_elastic = Vector(Eigen::Vector3d(1, 4e4, 9e4)).asDiagonal();
        out.K(0, 1) = out.K(1, 0) = 30 * std::cos(t);
    });
    CHECK_FALSE(SlowMotions::find(system, {}, 4, 1e-12));
}
