// A shared object with the libraries in it, as a module for another language would be.
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/turbines/reference_turbines/wt600.hpp>

#include <vector>

/// Frequency of the lowest mode of the 600 kW machine at standstill, Hz; negative: an error.
extern "C" double lowest_frequency_of_wt600() {
    try {
        const cardan::turbines::Turbine turbine = cardan::turbines::wt600({.tower_elements = 1, .blade_elements = 1});
        const cardan::solvers::Campbell diagram =
            cardan::solvers::campbell(turbine.system(), turbine.rotor(), std::vector<double>{0});
        return diagram.points[0].modes[0].mode.natural_hz();
    } catch (const cardan::Error&) {
        return -1;
    }
}
