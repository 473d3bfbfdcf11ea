/// @file
/// One element as a planar beam, sampled for integrals and running integrals along it, from which hinge positions and
/// inertia partitions are computed.
#pragma once

#include "elements/cardan_beam/element_line.hpp"

namespace cardan {

/// Mass, bending compliance and shear compliance of a section in one plane.
struct PlanarSection {
    double mass = 0;     ///< kg/m
    double bending = 0;  ///< 1/EI, 1/(N m^2)
    double shear = 0;    ///< 1/GA, 1/N
};

/// Mean by which the compliances of both planes are combined into one: sqrt(det) of the 2 x 2 compliance of the
/// section, which is 1/sqrt(EI_y EI_z) in whatever axes; or half the trace.
enum class PlaneMean : std::uint8_t { geometric, arithmetic };

class PlanarElement {
public:
    using Samples = Eigen::ArrayXd;

    /// @param sections  at 0 <= x <= length
    /// @param breaks    where they have kinks or jumps, ascending, m
    PlanarElement(double length, std::vector<double> breaks, std::function<PlanarSection(double x)> sections);
    /// Makes an element that bends in both planes with the same bodies: mean compliance, also in shear. Lengths are
    /// measured along the line.
    explicit PlanarElement(const ElementLine& element, PlaneMean mean = PlaneMean::geometric);

    double length() const { return length_; }
    const Samples& x() const { return x_; }
    const Samples& mass() const { return mass_; }
    const Samples& bending() const { return bending_; }
    const Samples& shear() const { return shear_; }

    /// Quadrature weights of the samples in an integral along the element, m.
    const Samples& weight() const { return weight_; }

    double integral(const Samples& f) const { return (weight_ * f).sum(); }
    /// Integrals from 0 to every sample.
    Samples running(const Samples& f) const;
    /// int mu (1, x, x^2) dx over a part of the element.
    Vec3 mass_moments(double from, double to) const;

private:
    double length_;
    std::vector<double> breaks_;
    std::function<PlanarSection(double)> sections_;
    Samples x_, weight_, mass_, bending_, shear_, half_;  // half_: of the length of every piece
};

}  // namespace cardan
