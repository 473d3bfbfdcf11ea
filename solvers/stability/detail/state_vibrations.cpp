#include "solvers/stability/detail/state_vibrations.hpp"

#include "solvers/campbell/detail/floquet_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cardan::solvers {

void take_vibrations_of_states(const PointSolver& solver, CampbellPoint& point) {
    const SecondOrderSystem& system = solver.system();
    std::vector<StateMotion> others;
    for (StateMotion& motion : point.state_motions) {
        Mode& mode = motion.mode;
        const double energy = energy_product(system, mode, mode).real();
        if (!mode.oscillates() || !(energy > 0)) {
            others.push_back(std::move(motion));
            continue;
        }
        mode.shape *= std::sqrt(2 / energy);
        mode.states *= std::sqrt(2 / energy);
        CampbellMode& added = point.modes.emplace_back();
        added.shares = solver.energy_shares()->shares(mode);
        added.row_shares = energy_by_row(system, mode);
        added.row = naming_row(system, mode);
        added.mode = std::move(mode);
    }
    point.state_motions = std::move(others);
    std::ranges::stable_sort(point.modes, {}, [](const CampbellMode& one) {
        return std::pair(!one.mode.oscillates(), one.mode.natural_hz());
    });
}

}  // namespace cardan::solvers
