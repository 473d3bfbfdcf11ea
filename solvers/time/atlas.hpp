/// @file
/// Motion in time through the singularities of charts: two or more trees that carry the same bodies by other joints.
#pragma once

#include "mbs/geometry/change_of_chart.hpp"
#include "solvers/time/integrate.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Coordinates for the configuration space, with what the integrator needs in them.
struct Chart {
    const System* system = nullptr;   ///< must live as long as the atlas
    std::vector<Drive> drives = {};   ///< motions of coordinates of this chart
    IntegrationOptions options = {};  ///< events speak of coordinates of this chart
};

/// Integrates in one chart as long as that is good, and goes on in the best other one from the end of the step in which
/// its quality falls below the least. Coordinates that are called the same in all charts are taken over (see
/// change_of_chart()); the others are those by which charts differ, such as the three rotations of a floating body,
/// and all of them carry one frame. Works, energies and statistics go on; the method of integration starts anew.
/// Motions and forces that events have exchanged in one chart are not known to the others.
///
/// If no other chart is better it stays where it is. Near a singularity steps become short and rounding is amplified by
/// one over the square of the distance (rad).
class AtlasIntegrator {
public:
    /// @param charts  two or more; their models have a frame of this name, and coordinates of their own
    /// @param frame   carried by the coordinates that differ
    /// @param time, q, qd   start, in the first chart
    /// @param least_quality  see chart_quality(): 1 for perpendicular axes, 0 where they are singular
    /// @throws InputError for values out of range, and what Integrator throws
    AtlasIntegrator(std::vector<Chart> charts, std::string frame, double time, const Vector& q, const Vector& qd,
                    double least_quality = 0.3);
    ~AtlasIntegrator() = default;
    AtlasIntegrator(const AtlasIntegrator&) = delete;
    AtlasIntegrator& operator=(const AtlasIntegrator&) = delete;

    /// As Integrator::advance().
    Advance advance(double time);

    /// That of the present chart, until the next advance().
    Integrator& integrator() { return *integrator_; }
    const System& system() const { return *charts_[now_].system; }
    /// Index of the present chart.
    std::size_t chart() const { return now_; }
    /// How often the chart has changed.
    int changes() const { return changes_; }

private:
    double quality(std::size_t chart, const Vector& q) const;
    void watch(std::size_t chart);
    void change();

    std::vector<Chart> charts_;
    std::string frame_;
    double least_quality_;
    std::vector<std::vector<int>> own_;  ///< coordinates that not all charts have
    std::size_t now_ = 0;
    int changes_ = 0;
    bool poor_ = false;
    std::unique_ptr<Integrator> integrator_;
};

}  // namespace cardan::solvers
