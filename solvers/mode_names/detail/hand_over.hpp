/// @file
/// Modes go from one branch to another where branches exchange their characters. Internal: not for users of the
/// library.
#pragma once

#include "solvers/mode_names/detail/mode_labels.hpp"

#include <functional>
#include <vector>

namespace cardan::solvers {

/// The label that a branch is named after.
struct Naming {
    Label label;
    bool another = false;  ///< a branch that it fits better has that name
};

/// A branch is followed along its curve. In a sharp veering two curves exchange their characters within less than a
/// step or over several, and which branch goes on as what would depend on the steps. So a mode whose name is beyond
/// doubt where it is, or which stands still, goes to the branch of this name; what stood there takes its place. Other
/// modes stay on their curve.
class HandOver {
public:
    /// The label that a mode has, as far as this point goes.
    struct Name {
        const Label* label = nullptr;  ///< null: none
        bool or_pair = false;  ///< or the other of its pair, at the same frequency: nothing whirls at standstill
        bool certain = true;   ///< beyond doubt: there must be a branch of this name
    };
    using NameOf = std::function<Name(std::size_t point, int mode)>;
    /// MAC of a mode with that of an earlier point.
    using Mac = std::function<double(std::size_t before, int mode_before, std::size_t point, int mode)>;

    /// @param points  kept as a reference
    HandOver(const std::vector<CampbellPoint>& points, NameOf name_of, Mac mac)
        : points_(points), name_of_(std::move(name_of)), mac_(std::move(mac)) {}

    /// @param branches  with `mode` and `mac` set; those of motions without elastic energy stay as they are
    /// @param namings   of the branches
    /// @param more      names that no branch has get one
    void run(std::vector<Branch>& branches, std::vector<Naming>& namings, bool more) const;

private:
    struct Wanted {
        std::size_t branch;  ///< where the mode is
        int mode;
        Name name;
        bool fits(const Naming& naming) const;
    };
    std::vector<Wanted> wanted(const std::vector<Branch>& branches, std::size_t point) const;
    void add_missing(std::vector<Branch>& branches, std::vector<Naming>& namings) const;
    bool exchange(std::vector<Branch>& branches, const std::vector<Naming>& namings, std::size_t point) const;
    void set_mac(Branch& branch) const;

    const std::vector<CampbellPoint>& points_;
    NameOf name_of_;
    Mac mac_;
};

}  // namespace cardan::solvers
