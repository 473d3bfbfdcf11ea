#include "elements/cardan_beam/partition.hpp"

#include "elements/cardan_beam/detail/mean_difference.hpp"
#include "elements/cardan_beam/detail/static_moment.hpp"
#include "elements/cardan_beam/detail/tilted_masses.hpp"

namespace cardan {

namespace {

// Mass, first moment and second moments (Binet tensor about the origin of the element) of a line of point masses.
using Moments = Eigen::Matrix<double, 4, 4>;  // int mu (1, r)(1, r)^T dx

RigidInertia line_mass(const ElementLine& element, double from, double to) {
    const Moments m = element.integral(from, to, Moments(Moments::Zero()), [&](double x) {
        const BeamSection s = element.line().section(x);
        Eigen::Vector4d r;
        r << 1.0, element.pose(x) * s.centre;
        return Moments(s.mass * r * r.transpose());
    });
    RigidInertia body;
    body.mass = m(0, 0);
    if (!(body.mass > 0)) return body;
    body.com = m.block<3, 1>(1, 0) / body.mass;
    const Mat3 P = m.bottomRightCorner<3, 3>() - body.mass * body.com * body.com.transpose();
    body.J = ordinary_tensor<double>((P + P.transpose()) / 2);
    return body;
}

Mat3 rotary_inertia(const ElementLine& element, double from, double to) {
    return element.integral(from, to, Mat3(Mat3::Zero()), [&](double x) {
        const Mat3 R = element.pose(x).R;
        return Mat3(R * element.line().section(x).J * R.transpose());
    });
}

// Centroid of the torsion compliance, as a fraction of the arc. A uniform line of polar inertia that is cut there has
// the momentum of the static twist.
double torsion_centre(const ElementLine& on) {
    const double arc = on.end() - on.start();
    const Eigen::Vector2d c = on.integral(0, 1, Eigen::Vector2d(Eigen::Vector2d::Zero()), [&](double s) {
        return Eigen::Vector2d(on.line().section(s).compliance(3, 3) * Eigen::Vector2d(1, (s - on.start()) / arc));
    });
    return c(0) > 0 ? std::clamp(c(1) / c(0), 0.0, 1.0) : 0.5;
}

// True segments between the hinges of the element.
void cut_at_hinges(const ElementLine& on, ElementInertia& element) {
    const std::array<double, 5> ends = element.hinges.ends();
    for (std::size_t k = 0; k < 4; ++k) {
        element.body[k] = line_mass(on, ends[k], ends[k + 1]);
        element.mass += element.body[k].mass;
        element.polar_inertia +=
            element.body[k].J(0, 0) + element.body[k].mass * element.body[k].com.tail<2>().squaredNorm();
    }
}

Vec3 first_moment(const std::array<RigidInertia, 4>& bodies) {
    Vec3 sum = Vec3::Zero();
    for (const RigidInertia& body : bodies) sum += body.mass * body.com;
    return sum;
}

// The material of a segment with another mass and moment of inertia along the axis.
RigidInertia reshaped(const RigidInertia& segment, const PlanarBody& planar, const Vec3& centre_without_mass) {
    RigidInertia body;
    body.mass = planar.mass;
    body.com = segment.mass > 0 ? segment.com : centre_without_mass;
    body.com(0) = planar.x;
    Mat3 P = Mat3::Zero();
    const Mat3 material = binet_tensor<double>(segment.J);
    if (segment.mass > 0 && material(0, 0) > 0) {
        const double scale = planar.mass / segment.mass;
        P = scale * material;
        const double stretch = scale > 0 ? std::sqrt(planar.J / P(0, 0)) : 0;
        P.row(0) *= stretch;
        P.col(0) *= stretch;
    }
    P(0, 0) = planar.J;
    body.J = ordinary_tensor<double>(P);
    return body;
}

// Lengths of the planar partition are those along the line; `straight` is chord over arc.
void move_to_mean_difference(const ElementLine& on, const MeanDifference& planar, ElementInertia& element) {
    const double arc = on.end() - on.start(), straight = on.chord() / arc;
    const Vec3 S = first_moment(element.body), centre = S / element.mass;
    // B2 and B3 turn as one in bending; their masses are divided at the torsion joint, which preserves the mass that
    // extension moves.
    const double inboard = line_mass(on, 0, element.rotary_split).mass;
    const PlanarBody& middle = planar.body[1];
    const double r = std::clamp((inboard - planar.body[0].mass) / middle.mass, 0.0, 1.0);
    const std::array<PlanarBody, 4> split{planar.body[0], PlanarBody{r * middle.mass, middle.x, r * middle.J},
                                          PlanarBody{(1 - r) * middle.mass, middle.x, (1 - r) * middle.J},
                                          planar.body[2]};
    for (std::size_t k = 0; k < 4; ++k) {
        const PlanarBody on_chord{split[k].mass, split[k].x * straight, split[k].J * straight * straight};
        element.body[k] = reshaped(element.body[k], on_chord, centre);
    }
    const Vec3 shift = (S - first_moment(element.body)) / middle.mass;
    element.body[1].com += shift;
    element.body[2].com += shift;
}

void place_at_compliance(const ElementLine& on, Partition partition, ElementInertia& element) {
    const PlanarElement plane(on);
    const auto set = [&](const HingePlaces& h) {
        const double first = h.first / plane.length(), second = h.second / plane.length();
        element.hinges = {first, second, (first + second) / 2};
    };
    element.rotary_split = torsion_centre(on);
    const bool massless = !(plane.integral(plane.mass()) > 0);
    if (partition == Partition::compliance_gauss || massless) {
        set(partition == Partition::compliance_gauss ? compliance_gauss_points(plane) : mean_difference_points(plane));
        element.shape_share = partition == Partition::mean_difference && plane.bending().maxCoeff() > 0 ? 1 : 0;
        return cut_at_hinges(on, element);
    }
    const MeanDifference planar = mean_difference(plane);
    set(planar.hinges);
    cut_at_hinges(on, element);
    element.shape_share = planar.limiter;
    if (planar.limiter > 0) move_to_mean_difference(on, planar, element);
}

}  // namespace

std::string_view partition_name(Partition partition) {
    switch (partition) {
        case Partition::segment_masses:
            return "segment masses";
        case Partition::static_moment:
            return "static moments";
        case Partition::compliance_gauss:
            return "compliance Gauss points";
        case Partition::mean_difference:
            break;
    }
    return "mean differences";
}

ElementInertia partition_element(const BeamLine& line, double x0, double L, double delta, Partition partition) {
    return partition_element(ElementLine(line, x0, x0 + L), delta, partition);
}

ElementInertia partition_element(const ElementLine& on, double delta, Partition partition) {
    ElementInertia element;
    if (places_hinges(partition)) {
        place_at_compliance(on, partition, element);
    } else {
        element.hinges = Hinges::symmetric(delta);
        cut_at_hinges(on, element);
    }
    if (partition == Partition::static_moment) element.shape_share = 1;
    if (partition == Partition::static_moment && element.mass > 0) move_to_static_moment(on, delta, element);
    const Mat3 left = rotary_inertia(on, 0, element.rotary_split), right = rotary_inertia(on, element.rotary_split, 1);
    element.body[0].J += left;
    element.body[3].J += right;
    element.polar_inertia += left(0, 0) + right(0, 0);
    element.tilted_moment = shift_tilted_masses(on, element);
    return element;
}

}  // namespace cardan
