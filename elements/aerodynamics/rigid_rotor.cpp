#include "elements/aerodynamics/rigid_rotor.hpp"

#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

namespace {

// Where a blade is and what it feels.
struct PlacedBlade {
    Mat3 axes;  // ground, of the coned blade
    std::vector<SectionAir> sections;
    std::vector<Annulus> annuli;
};

class Evaluation {
public:
    Evaluation(const AeroBlade& blade, const RotorPose& pose, const SteadyWind& wind, double speed, double azimuth,
               double pitch, const RotorAirOptions& options)
        : blade_(blade),
          pose_(pose),
          wind_(wind),
          options_(options),
          speed_(speed),
          shaft_(rot_z(pose.yaw) * rot_y(pose.tilt)) {
        for (int k = 0; k < pose.blades; ++k) place(azimuth + 2 * pi * k / pose.blades, speed, pitch);
    }

    RotorAir result() {
        RotorAir out;
        const Vec3 wind = mean_wind_ / static_cast<double>(blades_.size() * blade_.sections());
        const double normal = wind.dot(shaft_.col(0)), radius = blades_.front().annuli.back().radius;
        const Vec3 side = wind - normal * shaft_.col(0);
        out.skew = skew_angle(normal, side.norm());
        out.induction = options_.induction ? induction_share(speed_ * radius, wind.norm()).value : 0;
        for (PlacedBlade& own : blades_) {
            find_inductions(own, {.angle = out.skew, .share = out.induction}, side, radius);
            add_loads(own, out);
            out.sections.push_back(own.sections);
        }
        return out;
    }

private:
    void place(double azimuth, double speed, double pitch) {
        PlacedBlade own{shaft_ * rot_x(azimuth) * rot_y(pose_.cone), {}, {}};
        for (std::size_t i = 0; i < blade_.sections(); ++i) {
            const double z = blade_.position[i];
            const Vec3 arm = z * own.axes.col(2), air = wind_.at(pose_.hub + arm),
                       relative = air - speed * cross<double>(shaft_.col(0), arm);
            mean_wind_ += air;
            SectionAir& section = own.sections.emplace_back();
            section.V_x = relative.dot(own.axes.col(0));
            section.V_y = relative.dot(own.axes.col(1));
            Annulus& annulus = own.annuli.emplace_back(blade_.annulus(i, pose_.blades));
            annulus.radius *= std::cos(pose_.cone);
            annulus.angle += pitch;
        }
        blades_.push_back(std::move(own));
    }

    std::vector<Induction> inductions_of(const PlacedBlade& own, double share) const {
        std::vector<Induction> out(own.sections.size());
        std::vector<SectionInflow> inflows;
        inflows.reserve(out.size());
        for (std::size_t i = 0; i < out.size(); ++i) {
            inflows.push_back({&own.annuli[i], own.sections[i].V_x, own.sections[i].V_y});
            out[i].phi = std::atan2(inflows[i].V_x, inflows[i].V_y);
        }
        if (share > 0) solve_inductions(inflows, options_.momentum, out);
        return out;
    }

    // @param side    the mean wind in the plane of the rotor
    // @param radius  of the rotor
    void find_inductions(PlacedBlade& own, RotorWake wake, const Vec3& side, double radius) const {
        const Vec3 span = own.axes.col(2) - own.axes.col(2).dot(shaft_.col(0)) * shaft_.col(0);
        const double sine = side.norm() > 0 ? span.dot(side) / (span.norm() * side.norm()) : 0;
        const std::vector<Induction> balances = inductions_of(own, wake.share);
        for (std::size_t i = 0; i < own.sections.size(); ++i) {
            const Annulus& annulus = own.annuli[i];
            if (options_.skew == Skew::pitt_peters) wake.lever = annulus.radius / radius * sine * std::sin(wake.angle);
            SectionAir& section = own.sections[i];
            section = section_air(balances[i], annulus, section.V_x, section.V_y, wake, wind_.density);
        }
    }

    // Forces per length are linear between sections, and so are places: Simpson's rule is exact.
    void add_loads(const PlacedBlade& own, RotorAir& out) const {
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // about the hub's centre, axes of the blade
        const auto at = [&](std::size_t i) {
            const SectionForce& f = own.sections[i].force;
            return Vec3(f.normal, -f.driving, 0);
        };
        for (std::size_t i = 0; i + 1 < own.sections.size(); ++i) {
            const double z0 = blade_.position[i], z1 = blade_.position[i + 1], h = z1 - z0;
            const Vec3 f0 = at(i), f1 = at(i + 1), middle = (f0 + f1) / 2, up = Vec3::UnitZ();
            force += h * middle;
            moment += h / 6 * cross<double>(up, z0 * f0 + 2 * (z0 + z1) * middle + z1 * f1);
            moment.z() += h / 2 * (own.sections[i].force.moment + own.sections[i + 1].force.moment);
        }
        const Vec3 to_root = blade_.position.front() * Vec3::UnitZ();
        out.roots.push_back({force, moment - cross<double>(to_root, force)});
        const Mat3 to_shaft = shaft_.transpose() * own.axes;
        out.force += to_shaft * force;
        out.moment += to_shaft * moment;
    }

    const AeroBlade& blade_;
    const RotorPose& pose_;
    const SteadyWind& wind_;
    const RotorAirOptions& options_;
    double speed_;
    Mat3 shaft_;
    std::vector<PlacedBlade> blades_;
    Vec3 mean_wind_ = Vec3::Zero();
};

}  // namespace

Annulus AeroBlade::annulus(std::size_t section, double blades) const {
    const double root = position.front(), tip = position.back(), z = position[section];
    return {.blades = blades,
            .radius = z,
            .chord = chord[section],
            .angle = twist[section],
            .tip = blades / 2 * (tip - z) / z,
            .hub = blades / 2 * (z - root) / root,
            .polar = &polars[airfoil[section]],
            .viscosity = viscosity};
}

void AeroBlade::check() const {
    constexpr const char* here = "aerodynamic blade";
    constexpr double farthest = 1e4;  // m
    const std::size_t n = sections();
    if (n < 2) throw InputError(here, "number of sections", n, "at least 2");
    if (chord.size() != n || twist.size() != n || airfoil.size() != n)
        throw InputError(here, "lengths of the columns",
                         text(n, ", ", chord.size(), ", ", twist.size(), ", ", airfoil.size()), "equal");
    require_positive(here, "kinematic viscosity of the air [m^2/s]", viscosity);
    for (const auto* offsets : {&prebend, &sweep})
        if (!offsets->empty() && offsets->size() != n)
            throw InputError(here, "number of offsets", offsets->size(), text(n, ", one per section, or none"));
    for (std::size_t i = 0; i < n; ++i) {
        const std::string section = text(here, ", section ", i + 1);
        for (const auto* offsets : {&prebend, &sweep})
            if (!offsets->empty() && !std::isfinite((*offsets)[i]))
                throw InputError(section, "offset [m]", (*offsets)[i], "finite");
        require_positive(section, "place from the hub's centre [m]", position[i]);
        require_positive(section, "chord [m]", chord[i]);
        if (!(std::abs(twist[i]) <= 2 * pi))
            throw InputError(section, "twist [rad]", twist[i], "at most a turn either way");
        for (const double size : {position[i], chord[i]})
            if (size > farthest) throw InputError(section, "place or chord [m]", size, text("at most ", farthest));
        if (i > 0 && !(position[i] > position[i - 1]))
            throw InputError(section, "place from the hub's centre [m]", position[i],
                             text("> ", position[i - 1], ", that of the section before"));
        if (airfoil[i] >= polars.size())
            throw InputError(section, "airfoil", airfoil[i], text("0 ... ", static_cast<long>(polars.size()) - 1));
    }
}

RotorAir rigid_rotor_air(const AeroBlade& blade, const RotorPose& pose, const SteadyWind& wind, double speed,
                         double azimuth, double pitch, const RotorAirOptions& options) {
    blade.check();
    wind.check();
    if (pose.blades < 1) throw InputError("rotor", "number of blades", pose.blades, ">= 1");
    return Evaluation(blade, pose, wind, speed, azimuth, pitch, options).result();
}

RotorCoefficients rotor_coefficients(const AeroBlade& blade, int blades, double cone, double ratio, double pitch,
                                     const RotorAirOptions& options) {
    const SteadyWind wind{.speed = 8};  // coefficients depend on it by the Reynolds number alone
    const double R = blade.position.back() * std::cos(cone), speed = ratio * wind.speed / R,
                 pressure = wind.density / 2 * pi * R * R * wind.speed * wind.speed;
    const RotorAir air = rigid_rotor_air(blade, {.blades = blades, .cone = cone}, wind, speed, 0, pitch, options);
    return {air.moment.x() * speed / (pressure * wind.speed), air.force.x() / pressure};
}

}  // namespace cardan
