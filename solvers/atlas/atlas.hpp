/// @file
/// Time integration through chart singularities, with two or more trees that carry the same bodies on different joints.
#pragma once

#include "mbs/geometry/change_of_chart.hpp"
#include "solvers/time/integrate.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cardan::solvers {

/// One set of coordinates for the configuration space, with what the integrator needs to use it.
struct Chart {
    const System* system = nullptr;   ///< must live as long as the atlas
    std::vector<Drive> drives = {};   ///< motions of coordinates of this chart
    IntegrationOptions options = {};  ///< events refer to coordinates of this chart
};

/// Integrates in one chart while its quality is sufficient, and continues in the best other one from the end of the
/// step in which the quality falls below the minimum. Coordinates with the same name in all charts are copied (see
/// change_of_chart()); the others, in which the charts differ, such as the three rotations of a floating body, must all
/// carry one frame. Work, energies and statistics are continued; the integration method restarts. Motions and forces
/// that events have replaced in one chart are not replaced in the others.
///
/// If no other chart is better it stays in the present one. Near a singularity steps become short and rounding errors
/// are amplified by the inverse square of the distance (rad).
class AtlasIntegrator {
public:
    /// @param charts  two or more; each model has a frame of this name, and coordinates the others lack
    /// @param frame   carried by the coordinates that differ
    /// @param time, q, qd   start, in the first chart
    /// @param min_quality  see chart_quality(): 1 for perpendicular axes, 0 for a singularity
    /// @throws InputError for values out of range, and what Integrator throws
    AtlasIntegrator(std::vector<Chart> charts, std::string frame, double time, const Vector& q, const Vector& qd,
                    double min_quality = 0.3);
    ~AtlasIntegrator() = default;
    AtlasIntegrator(const AtlasIntegrator&) = delete;
    AtlasIntegrator& operator=(const AtlasIntegrator&) = delete;

    /// See Integrator::advance().
    Advance advance(double time);

    /// Integrator of the present chart, valid until the next advance().
    Integrator& integrator() { return *integrator_; }
    const System& system() const { return *charts_[now_].system; }
    /// Index of the present chart.
    std::size_t chart() const { return now_; }
    /// Number of chart changes so far.
    int changes() const { return changes_; }

private:
    double quality(std::size_t chart, const Vector& q) const;
    void watch(std::size_t chart);
    void change();

    std::vector<Chart> charts_;
    std::string frame_;
    double min_quality_;
    std::vector<std::vector<int>> own_;  ///< coordinates that not all charts have
    std::size_t now_ = 0;
    int changes_ = 0;
    bool poor_ = false;
    std::unique_ptr<Integrator> integrator_;
};

}  // namespace cardan::solvers
