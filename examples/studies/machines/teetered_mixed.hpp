/// @file
/// The two-bladed teetered machine with mixed beam elements (examples/studies/beams/mixed_beam.hpp), as in the paper of
/// Lee, Hodges and Patil (2002): the same description with a different model, without a tree or joint chain.
#pragma once

#include "examples/studies/beams/mixed_beam.hpp"
#include "turbines/reference_turbines/teetered.hpp"

#include <cstdint>
#include <optional>

namespace cardan::turbines {

/// Exact equations of the machine in steady rotation, r(x, x', azimuth) = 0, and their linearisation about the steady
/// state. Gravity is left out: the steady state is constant in rotating axes.
///
/// Unknowns x: those of the tower (none if it is rigid), of blade 1 and of blade 2, see MixedBeam; velocity of the
/// origin and angular velocity of nacelle (origin: tower top), shaft (where it meets the tower axis) and hub (teeter
/// axis), each in body axes (see TurbineDescription); yaw and teeter angle.
class TeeteredMixed {
public:
    /// @throws InputError for bad data, parts that this model lacks or fewer than one element; NumericalError if the
    /// blade has no steady state
    TeeteredMixed(const TurbineDescription& description, int tower_elements, int blade_elements);

    const std::optional<MixedBeam>& tower() const { return tower_; }
    const MixedBeam& blade() const { return blade_; }
    Eigen::Index unknowns() const { return teeter() + 1; }
    enum Body : std::uint8_t { nacelle, shaft, hub };
    /// First unknown of the tower; of blade 1 or 2; of a Body.
    Eigen::Index blade_unknowns(int number) const { return tower_size_ + (number - 1) * blade_.unknowns(); }
    Eigen::Index body_unknowns(int body) const { return tower_size_ + 2 * blade_.unknowns() + 6 * Eigen::Index{body}; }
    Eigen::Index yaw() const { return body_unknowns(3); }
    Eigen::Index teeter() const { return yaw() + 1; }

    /// Steady state: straight tower, spinning blades (bent if they are coned).
    const Vector& steady_state() const { return steady_; }
    /// S is double or std::complex<double>.
    template <class S>
    VectorT<S> residual(const VectorT<S>& x, const VectorT<S>& xdot, double azimuth) const;
    /// E(azimuth) dx/dt + A(azimuth) x = 0 about the steady state, by complex steps: exact. Trigonometric polynomials
    /// of the azimuth, of second degree. Unknowns and equations are scaled to order one: the true unknowns are
    /// unknown_scales() times x.
    DescriptorPencil pencil(double azimuth) const;
    Vector unknown_scales() const;

private:
    template <class S>
    struct Rotor;
    Vector equation_scales() const;
    Placement blade_root(int number) const;  // in hub axes

    TurbineDescription d_;
    std::optional<MixedBeam> tower_;
    MixedBeam blade_;
    Eigen::Index tower_size_;
    Vector steady_;
};

}  // namespace cardan::turbines
