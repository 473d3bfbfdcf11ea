/// @file
/// Names of branches taken over from the diagram of a neighbouring variant of the machine.
#pragma once

#include "solvers/campbell_data/diagram.hpp"
#include "solvers/mode_names/detail/line_likeness.hpp"

#include <functional>
#include <optional>

namespace cardan::solvers {

/// The branch of the neighbour that a branch continues. Decided once per branch, by the sum of the MAC over all rotor
/// speeds that both diagrams have, rather than at the first speed: that is usually standstill, where nothing whirls and
/// pairs lie close together; and where modes veer within the sweep the two variants may be linked crosswise from there
/// on, which only the sum detects. Where two curves exchange their characters it goes by points (HandOver). A branch is
/// doubtful at speeds where it does not fit.
class NeighbourNames {
public:
    /// @param neighbour  kept as a reference
    explicit NeighbourNames(const Campbell& neighbour) : neighbour_(neighbour) {}

    /// Modes are compared by their rows where these are the neighbour's and it has shapes in them, else by lines.
    /// @throws InputError unless method and blades are the neighbour's, and rows, if there are no motions of lines
    void set_machine(const Campbell& diagram);
    /// Adds the next point: its MAC with the neighbour's modes at the same rotor speed, if there is one.
    /// @param system  the (transformed) system of the point
    /// @param motions  gives those of the diagram's frames in all modes of the point
    void add(const SecondOrderSystem& system, const CampbellPoint& point,
             const std::function<std::vector<std::vector<FrameMotion>>()>& motions);
    /// Call after the last point: finds the partners of all branches (with `mode` set); none if the mean MAC is below
    /// 0.1.
    /// @throws InputError if the diagrams have no rotor speed in common
    void pair(const std::vector<Branch>& branches);

    /// Null without a partner.
    const Branch* partner(std::size_t branch) const;
    /// The component of a partner.
    const Component& component(const Branch& partner) const {
        return neighbour_.components.at(static_cast<std::size_t>(partner.component));
    }
    /// True if the MAC with the partner is below `min_reliable_mac`, or another mode is nearly as close to the partner,
    /// or another branch of the neighbour nearly as close to this mode (0.8 of the MAC); always true without a partner.
    bool doubtful(std::size_t branch, std::size_t point, int mode) const;
    /// The branch of the neighbour that a mode is in beyond doubt; null: none.
    const Branch* certain(std::size_t point, int mode) const;

private:
    bool fits(int branch, std::size_t point, int mode) const;
    bool has_shapes(std::size_t rows) const;

    const Campbell& neighbour_;
    std::optional<LineLikeness> lines_;  // none: by rows
    std::vector<Matrix> mac_;            // by point: a row per branch of the neighbour, a column per mode; or empty
    std::vector<int> partner_;
};

}  // namespace cardan::solvers
