// Names of modes from one variant of a machine to the next: a name that goes to another mode is marked.
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "turbines/machines/wt600.hpp"

#include <complex>
#include <vector>

using namespace cardan;
using namespace cardan::solvers;

namespace {

Campbell with_yaw_stiffness(double factor, std::span<const double> speeds, const Campbell* neighbour) {
    turbines::TurbineDescription description = turbines::wt600_description();
    description.yaw.rotation.stiffness *= factor;
    const turbines::Turbine turbine = turbines::assemble(description, turbines::wt600_paper_assembly());
    CampbellOptions options;
    options.keep_shapes = false;
    options.neighbour = neighbour;
    return campbell(turbine.system(), turbine.rotor(), speeds, options);
}

// MAC of a mode in two variants by its shape alone, unweighted: not the one that names are continued by.
double shape_correlation(const CampbellMode& a, const CampbellMode& b) {
    const ComplexVector &x = a.mode.shape, &y = b.mode.shape;
    return std::norm(x.dot(y)) / (x.squaredNorm() * y.squaredNorm());
}

struct NameJumps {
    int unmarked = 0, marked = 0;
};

// Modes that are surely the same in two variants but have another name in the second.
NameJumps jumps(const Campbell& before, const Campbell& now) {
    NameJumps count;
    for (std::size_t i = 0; i < now.points.size(); ++i)
        for (const Branch& a : before.branches)
            for (const Branch& b : now.branches) {
                const CampbellMode *m = before.mode(a, i), *n = now.mode(b, i);
                if (a.name == b.name || !m || !n || shape_correlation(*m, *n) < 0.9) continue;
                ++(b.doubtful[i] ? count.marked : count.unmarked);
            }
    return count;
}

// Yaw stiffness times 2.4, 2.41, 2.42 ...
NameJumps jumps_over_yaw_stiffness(std::span<const double> speeds, int steps, bool continued) {
    NameJumps all;
    Campbell before = with_yaw_stiffness(2.4, speeds, nullptr);
    for (int i = 1; i <= steps; ++i) {
        Campbell now = with_yaw_stiffness(2.4 + 0.01 * i, speeds, continued ? &before : nullptr);
        const NameJumps step = jumps(before, now);
        all.unmarked += step.unmarked;
        all.marked += step.marked;
        before = std::move(now);
    }
    return all;
}

}  // namespace

TEST_CASE("campbell variants: names do not jump from one yaw stiffness to the next if they are continued",
          "[property]") {
    const std::vector<double> speeds = rpm_range(0, 30, 3);
    // By energy alone rotor tilt and first flap backward change places between 2.42 and 2.43, mostly without a mark.
    CHECK(jumps_over_yaw_stiffness(speeds, 4, false).unmarked > 0);
    const NameJumps continued = jumps_over_yaw_stiffness(speeds, 4, true);
    CHECK(continued.unmarked == 0);
    CHECK(continued.marked == 0);
}

TEST_CASE("campbell variants: yaw stiffness times 2.4 to 2.6 in small steps, names do not jump", "[property][slow]") {
    for (const double last_rpm : {20.0, 30.0, 40.0}) {
        const NameJumps continued = jumps_over_yaw_stiffness(rpm_range(0, last_rpm, 2), 20, true);
        CHECK(continued.unmarked == 0);
        CHECK(continued.marked == 0);
    }
}

TEST_CASE("campbell variants: where speeds are too few to follow modes a continued name may jump, with a mark",
          "[property]") {
    // 20 rpm apart, branches of one variant are linked crosswise to those of the next.
    const std::vector<double> speeds = rpm_range(0, 40, 20);
    CHECK(jumps_over_yaw_stiffness(speeds, 5, false).unmarked > 0);
    const NameJumps continued = jumps_over_yaw_stiffness(speeds, 5, true);
    CHECK(continued.unmarked == 0);
    CHECK(continued.marked > 0);
}
