#include "elements/sections/section.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

// Forces at the reference line -> principal axes (P) -> each force at its own centre: T about the shear centre, M_y and
// M_z about the tension centre, which adds `offset` times the forces to the moments. By blocks of three, since
// assembling a machine asks for thousands of sections.
BeamSection EngineeringSection::section() const {
    const Mat3 P = rot_x(beta).transpose();
    Mat3 offset;
    offset << 0, shear_centre.z, -shear_centre.y, -tension_centre.z, 0, 0, tension_centre.y, 0, 0;
    const Vec3 by_force(1 / EA, 1 / GA_y, 1 / GA_z), by_moment(1 / GJ, 1 / EI_flap, 1 / EI_edge);
    const Mat3 turned = by_moment.asDiagonal() * P, offset_P = offset * P;
    BeamSection s;
    s.compliance.topLeftCorner<3, 3>() =
        P.transpose() * by_force.asDiagonal() * P + offset_P.transpose() * by_moment.asDiagonal() * offset_P;
    s.compliance.bottomLeftCorner<3, 3>() = turned.transpose() * offset_P;
    s.compliance.topRightCorner<3, 3>() = s.compliance.bottomLeftCorner<3, 3>().transpose();
    s.compliance.bottomRightCorner<3, 3>() = P.transpose() * turned;
    s.mass = mass;
    s.centre = P.transpose() * Vec3(0, mass_centre.y, mass_centre.z);
    s.J = P.transpose() * Vec3(j_flap + j_edge, j_flap, j_edge).asDiagonal() * P;
    s.beta = beta;
    return s;
}

void BeamSection::check(const std::string& where) const {
    require_not_negative(where, "mass per length [kg/m]", mass);
    if (!compliance.allFinite()) throw InputError(where, "compliance", text("\n", compliance, "\n"), "finite");
    // Scaled: entries of forces and moments differ by many decades.
    const Vec6 size = compliance.diagonal();
    if (!(size.minCoeff() >= 0)) throw InputError(where, "compliance", size.minCoeff(), ">= 0 on the diagonal");
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            if (std::abs(compliance(i, j) - compliance(j, i)) > 1e-9 * std::sqrt(size(i) * size(j)))
                throw InputError(where, "compliance", text("\n", compliance, "\n"), "symmetric");
    if (!centre.allFinite() || centre(0) != 0)
        throw InputError(where, "centre of mass [m]", centre.transpose(), "finite and in the section: x = 0");
    if (!J.allFinite()) throw InputError(where, "inertia per length [kg m]", text("\n", J, "\n"), "finite");
    if (!std::isfinite(beta)) throw InputError(where, "angle of the section [rad]", beta, "finite");
}

void EngineeringSection::check(const std::string& where) const {
    const auto stiff = [&](const char* quantity, double value) {
        if (!(value > 0)) throw InputError(where, quantity, value, "> 0 (infinite: rigid)");
    };
    require_not_negative(where, "mass per length [kg/m]", mass);
    require_not_negative(where, "flap inertia per length [kg m]", j_flap);
    require_not_negative(where, "edge inertia per length [kg m]", j_edge);
    stiff("EA [N]", EA);
    stiff("GJ [N m^2]", GJ);
    stiff("EI flap [N m^2]", EI_flap);
    stiff("EI edge [N m^2]", EI_edge);
    stiff("GA y [N]", GA_y);
    stiff("GA z [N]", GA_z);
    for (double value :
         {beta, mass_centre.y, mass_centre.z, shear_centre.y, shear_centre.z, tension_centre.y, tension_centre.z})
        if (!std::isfinite(value)) throw InputError(where, "twist [rad] or offset [m]", value, "finite");
    if (std::abs(beta) > pi + 1e-9) throw InputError(where, "twist [rad]", beta, "-pi ... pi (given in degrees?)");
}

}  // namespace cardan
