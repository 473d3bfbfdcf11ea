/// @file
/// Participation of component modes and rotor patterns in the elastic energy of a mode, and mode names derived from it.
#pragma once

#include "solvers/campbell_data/shares.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"

#include <array>
#include <span>
#include <string>

namespace cardan::solvers {

/// Decomposes modes into component modes. In joint coordinates the elastic stiffness is block diagonal by part, and the
/// component modes of a part are orthogonal in it: the shares add up to one exactly. Blades that differ have component
/// modes of their own, each with its stiffness and mass; those of one name are one component, and patterns are those of
/// their energy amplitudes.
class EnergyFractions {
public:
    /// @param lin   linearisation whose elastic stiffness and mass define the component modes (e.g. at standstill)
    /// @param rows  what the rows of the system are (ColemanTransform::rows); without kinds the blades have no
    ///              multi-blade coordinates
    /// Coordinates of a part that the map does not name make a part of their own, called after it; those without a part
    /// are one together, of the family "mode".
    EnergyFractions(const Linearisation& lin, const Model& model, const RotorMap& rotor,
                    const std::vector<int>& coordinates, const std::vector<MultiBladeRow>& rows);

    const std::vector<Component>& components() const { return components_; }
    /// @param out  overwritten: one entry per component, in the order of components(); nothing is allocated if it
    ///             already held as many from this object. Blades that differ: at azimuth 0
    void shares(const Mode& mode, std::vector<EnergyFraction>& out) const;
    std::vector<EnergyFraction> shares(const Mode& mode) const;
    /// Shares of a motion with several harmonics, each with its own shape and eigenvalue (the frequency may have either
    /// sign): their energies are added up. Blades that differ: over the revolution.
    /// @param harmonics  one after another, at eigenvalues that differ by i rotor_speed
    /// @param rotor_speed  rad/s; used where blades differ
    std::vector<EnergyFraction> shares(std::span<const Mode> harmonics, double rotor_speed = 0) const;
    /// Names are "1st tower fore-aft", "2nd blade flap (backward)"; families with one component have no ordinal.
    /// @param harmonic  for RotorPattern::single the place of the blade in RotorMap::blades, from 1
    std::string name(int component, RotorPattern pattern, int harmonic = 1) const;
    /// Largest harmonic of the azimuth: 1 for three and four blades, 2 for five and six.
    int harmonics() const { return harmonics_; }
    /// Patterns are symmetric and antisymmetric.
    bool two_blades() const { return two_blades_; }
    bool blades_differ() const { return blades_differ_; }
    /// Three or more blades that have none but the collective pattern.
    bool without_patterns() const { return plain_ && !two_blades_; }

private:
    // The rows of one part, by pattern (blades) or all together.
    struct Block {
        std::vector<int> collective, differential;
        std::vector<std::vector<int>> cosine, sine;  // by harmonic, from 1
        Matrix weights;                              // K V: energy amplitude of each component mode by column
        int first_component;
    };
    static void add_pair(int harmonic, Complex c, Complex s, EnergyFraction& share);
    static void block_shares(const Block& block, const Mode& mode, std::vector<EnergyFraction>& out);
    void add_part(const Linearisation& lin, const Model& model, const PartAxes& part, bool blades,
                  const std::vector<int>& own, Block block);

    // The rows of one part of blades that differ or have no multi-blade coordinates. Columns of the weights are
    // component modes, zero where the blade has none of that name.
    struct BladeBlock {
        std::vector<std::vector<int>> rows;  // [slot or blade][coordinate]
        std::vector<MultiBladeRow> slots;    // empty: rows are those of the blades themselves
        std::vector<Matrix> weights;         // by blade
        Matrix at_zero;                      // multi_blade_block at azimuth 0
        int first_component;
    };
    struct BladePart {
        const PartAxes& axes;
        const std::vector<int>& coordinates;
        const std::vector<MultiBladeRow>& rows;
    };
    void add_blades(const Linearisation& lin, const Model& model, const RotorMap& rotor, const BladePart& part);
    void add_modes(const BladePart& part, const Linearisation& lin, const std::vector<int>& own,
                   const std::vector<std::string>& families, BladeBlock& block);
    int component_of(const BladeBlock& block, const Component& named);
    using Patterns = std::array<Complex, ColemanTransform::max_blades>;
    static Complex blade_amplitude(const BladeBlock& block, Eigen::Index component, Eigen::Index blade, const Matrix& T,
                                   const ComplexVector& shape);
    static Patterns patterns(const BladeBlock& block, Eigen::Index component, const Matrix& T,
                             const ComplexVector& shape);
    static EnergyFraction pattern_share(const BladeBlock& block, const Patterns& amplitude,
                                        std::vector<WhirlShare> higher);
    static EnergyFraction mean_share(const BladeBlock& block, Eigen::Index component, const ComplexVector& shape);
    static EnergyFraction blade_share(const BladeBlock& block, Eigen::Index component, const Mode& mode,
                                      std::vector<WhirlShare> higher);
    static EnergyFraction blade_share(const BladeBlock& block, Eigen::Index component, std::span<const Mode> harmonics,
                                      double rotor_speed);

    static void divide_by(double total, std::vector<EnergyFraction>& shares);

    int harmonics_ = 1;
    bool two_blades_ = false, blades_differ_ = false, plain_ = false;
    std::vector<BladeBlock> blade_blocks_;
    std::vector<int> blade_numbers_;
    std::vector<Component> components_;
    std::vector<Block> blocks_;
};

}  // namespace cardan::solvers
