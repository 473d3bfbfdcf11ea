// What Lee, Hodges and Patil (2002) say in words about the modes of their two-bladed machine (their section "Results"),
// on the modes that Cardan finds for the data of their Table I: three elements per part, tower of a hundred times the
// blades' rigidity, 6.02 rad/s, Floquet's theory over half a revolution.
#include "mbs/base/entry.hpp"
#include "solvers/periodic/floquet.hpp"
#include "solvers/periodic/periodic_system.hpp"
#include "tests/oracles/teetered_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_floquet.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"

#include <map>

using namespace cardan;
using namespace cardan::testing;

namespace {

// For one mode: the largest row of every family (sums and differences of the blades, tower, yaw, teeter) in every
// harmonic, over the largest of all rows in all harmonics. Angles and lengths have the same weight.
class Rows {
public:
    Rows(const solvers::FloquetMode& mode, const HalfTurnCoordinates& z) {
        const ComplexMatrix rows = z.T * mode.harmonics;
        const double largest = rows.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            for (Eigen::Index j = 0; j < rows.cols(); ++j) {
                double& here = part_[{entry(z.family, i), static_cast<int>(j) + mode.first_harmonic}];
                here = std::max(here, std::abs(rows(i, j)) / largest);
            }
    }
    // At the frequency of the mode plus j per revolution.
    double of(const std::string& family, int j) const {
        const auto found = part_.find({family, j});
        return found == part_.end() ? 0 : found->second;
    }
    double of(const std::string& family) const {
        double most = 0;
        for (const auto& [key, value] : part_)
            if (key.first == family) most = std::max(most, value);
        return most;
    }
    // The harmonic in which a family moves most.
    int harmonic(const std::string& family) const {
        int best = 0;
        double most = -1;
        for (const auto& [key, value] : part_)
            if (key.first == family && value > most) most = value, best = key.second;
        return best;
    }
    double largest_besides(const std::string& family) const {
        double most = 0;
        for (const auto& [key, value] : part_)
            if (key.first != family) most = std::max(most, value);
        return most;
    }

private:
    std::map<std::pair<std::string, int>, double> part_;
};

struct Modes {
    explicit Modes(bool rigid_tower = false, double per_period = 46) {
        turbines::AssemblyOptions options = turbines::teetered_paper_assembly(3);
        options.tower_beam->torsion_armature = options.blade_beam->torsion_armature = -1. / 12;
        auto description = turbines::with_tower_rigidity(turbines::teetered_description(), 100);
        description.tower.rigid = rigid_tower;
        const auto machine = turbines::assemble(description, options);
        for (int i = 0; i < machine.system().model.size(); ++i)
            if (i != machine.rotor().spin) unknowns.push_back(i);
        solvers::PeriodicOptions periodic;
        periodic.rotor_speed = teetered_speed;
        const auto state = solvers::harmonic_balance(machine.system(), machine.rotor().spin, periodic);
        solvers::FloquetOptions wanted;
        wanted.per_period = per_period;
        wanted.tolerance = 1e-7;
        wanted.symmetry =
            solvers::blade_symmetry(machine.rotor(), unknowns, teetered_speed, machine.rotor().odd_coordinates);
        result = solvers::floquet(solvers::linearised(machine.system(), state), wanted);
        z = half_turn_coordinates(machine, unknowns);
    }
    // The mode whose frequency is nearest.
    Rows at(double per_rev) const {
        const solvers::FloquetMode* best = &result.modes.front();
        for (const solvers::FloquetMode& mode : result.modes)
            if (std::abs(mode.exponent.imag() / teetered_speed - per_rev) <
                std::abs(best->exponent.imag() / teetered_speed - per_rev))
                best = &mode;
        return Rows(*best, z);
    }
    std::vector<int> unknowns;
    solvers::Floquet result;
    HalfTurnCoordinates z;
};
const Modes& modes() {
    static const Modes computed;
    return computed;
}

}  // namespace

TEST_CASE("teetered machine, statements: symmetric flap couples with the fore-aft bending of the tower",
          "[published]") {
    for (double f : {3.56, 20.33}) {
        const Rows rows = modes().at(f);
        CHECK(rows.of("symmetric flap", 0) == 1);
        CHECK(rows.of("tower fore-aft", 0) > 3e-3);
        // "very small contributions from tower lateral bending and torsion and from yaw"
        for (const char* family : {"tower lateral", "tower torsion", "yaw"}) CHECK(rows.of(family) < 6e-3);
    }
}

TEST_CASE("teetered machine, statements: antisymmetric flap couples strongly with teeter", "[published]") {
    const Rows first = modes().at(10.18), second = modes().at(34.04);
    CHECK(first.of("antisymmetric flap", 0) == 1);
    CHECK(first.of("teeter", 0) == Approx(0.96).margin(0.01));
    CHECK(second.of("antisymmetric flap", 0) == 1);
    CHECK(second.of("teeter", 0) > 0.35);
    for (const char* family : {"tower lateral", "tower fore-aft", "tower torsion", "yaw"}) {
        CHECK(first.of(family) < 1e-3);
        CHECK(second.of(family) < 2e-3);
    }
}

TEST_CASE("teetered machine, statements: symmetric torsion is pure, antisymmetric torsion has a weak yaw",
          "[published]") {
    const Rows symmetric = modes().at(43.83), antisymmetric = modes().at(44.12);
    CHECK(symmetric.of("symmetric torsion", 0) == 1);
    CHECK(symmetric.largest_besides("symmetric torsion") < 1e-6);
    CHECK(antisymmetric.of("antisymmetric torsion", 0) == 1);
    CHECK(antisymmetric.of("yaw") == Approx(2.5e-3).margin(2e-4));
}

TEST_CASE("teetered machine, statements: antisymmetric lag has yaw most at one per revolution more", "[published]") {
    const Rows first = modes().at(3.45), second = modes().at(20.10);
    for (const Rows& rows : {first, second}) {
        CHECK(rows.of("antisymmetric lag", 0) == 1);
        CHECK(rows.harmonic("yaw") == 1);
        CHECK(rows.of("yaw", 0) < 1e-9);  // not at its own frequency: half a turn changes the sign of one of them
        CHECK(rows.of("yaw", -1) > 0.8 * rows.of("yaw", 1));  // nearly as much at one less
        CHECK(rows.of("tower lateral") > 5e-3);
    }
    CHECK(first.of("yaw", 1) == Approx(0.25).margin(0.01));
}

TEST_CASE("teetered machine, statements: symmetric lag is not a mode of the blades alone, contrary to the paper",
          "[property]") {
    // The torques about the shaft add up, and with the rotor speed prescribed they bend the elastic tower sideways.
    const Rows rows = modes().at(3.09);
    CHECK(rows.of("symmetric lag", 0) == 1);
    CHECK(rows.of("tower lateral", 0) == Approx(0.061).margin(2e-3));
    CHECK(rows.of("yaw") > 0.03);
}

TEST_CASE("teetered machine: yaw and teeter grow by 0.04525 per revolution, whether blades and tower are rigid or not",
          "[analytic][discrete]") {
    const double slender = 2 * 67.5772 * (std::pow(10.22, 3) - std::pow(1.8, 3)) / 3, both = 2 * 8.42;
    const oracles::RigidTeeteredRotor rigid{.spanwise = 50 + both * 5,
                                            .teeter = 50 + slender + both * 1e-4,
                                            .shaft = 5 + slender + both * 4.9999,
                                            .yaw = 16599 + both * 67.5772 * 2.388 * 2.388,
                                            .rotor_speed = teetered_speed};
    double largest = 0;
    for (const Complex& mu : rigid.half_turn_multipliers()) largest = std::max(largest, mu.real());
    CHECK(std::log(largest) / pi == Approx(0.04525).epsilon(0).margin(1e-5));
    // Numbers of another implementation: on the rigid tower, on the elastic one.
    CHECK(Modes(true, 4).result.growth() / teetered_speed == Approx(0.045247).epsilon(0).margin(1e-6));
    CHECK(modes().result.growth() / teetered_speed == Approx(0.045250).epsilon(0).margin(1e-6));
}
