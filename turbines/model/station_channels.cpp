#include "turbines/model/station_channels.hpp"

#include "elements/cardan_beam/beam_station.hpp"
#include "mbs/base/error.hpp"
#include "turbines/model/detail/channel_axes.hpp"
#include "turbines/model/detail/tower_loads.hpp"

#include <Eigen/Geometry>

#include <array>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr std::size_t max_stations = 9;  // one digit in OpenFAST's names

// How the names of channels begin and end.
struct BeamNames {
    std::string beam, root_axes;         // "blade 1", "blade 1"; "tower", "tower base"
    std::string stem, suffix;            // of the alias: "Spn", "b1"; an empty stem: no alias
    std::array<const char*, 3> along{};  // what x, y, z are
};

// A station and its axes.
struct Gauge {
    BeamStation station;
    FrameId root;
    Placement undeformed;  // section in beam axes
    Mat3 root_axes;        // axes of deflections in beam axes
    Mat3 local_axes;       // axes of loads in those of the section
};

void check(const std::string& beam, double length, const std::vector<double>& places) {
    const std::string where = "stations of " + beam;
    if (places.size() > max_stations) throw InputError(where, "number", places.size(), text("at most ", max_stations));
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!(places[i] >= 0 && places[i] <= length))
            throw InputError(where, text("place of station ", i + 1, " [m]"), places[i], text("0 ... ", length));
        for (std::size_t j = 0; j < i; ++j)  // names have ten digits
            if (text(places[j]) == text(places[i]))
                throw InputError(where, text("places of stations ", j + 1, " and ", i + 1, " [m]"), places[i],
                                 "each place once");
    }
}

// Axis times angle.
Vec3 rotation_vector(const Mat3& R) {
    const Eigen::AngleAxisd turn(R);
    return turn.angle() * turn.axis();
}

void sample(const Gauge& gauge, const DynamicView& in, double* values) {
    const Kinematics& kin = in.kinematics;
    const Pose<double> here = gauge.station.pose(kin), root = pose(kin, gauge.root);
    const Mat3 to_local = (here.R * gauge.local_axes).transpose(), to_root = gauge.root_axes.transpose();
    Wrench load = gauge.station.load(kin, in.forces, in.loads());
    const Vec3 moved = root.R.transpose() * (here.p - root.p) - gauge.undeformed.p;
    const Mat3 turned = root.R.transpose() * here.R * gauge.undeformed.R.transpose();
    const Vec3 acceleration = gauge.station.acceleration(kin, in.loads());
    write(to_local * load.force, values);
    write(to_local * load.moment, values);
    write(to_root * moved, values);
    write(to_root * rotation_vector(turned), values);
    write(to_local * acceleration, values);
    write(to_local * (acceleration - in.forces.gravity()), values);
}

// Three channels.
void add(ChannelGroup& group, const BeamNames& names, const std::string& point, std::size_t number, const char* kind,
         const char* units, bool local, const char* what, const char* alias) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string letter(1, "xyz"[i]);
        group.channels.push_back(
            {.name = text(point, " ", kind, " ", letter),
             .units = units,
             .long_name = text(what, names.along.at(i), local ? " of the section" : "", ", ", point),
             .frame = local ? text(point, " section") : names.root_axes,
             .point = point,
             .alias = names.stem.empty() ? "" : text(names.stem, number, alias, letter, names.suffix)});
    }
}

ChannelGroup group_at(const BeamNames& names, std::size_t number, double place) {
    const std::string at = text(names.beam, " at ", place, " m");
    ChannelGroup group;
    add(group, names, at, number, "force", "N", true, "force ", "FL");
    add(group, names, at, number, "moment", "N m", true, "moment about the axis ", "ML");
    add(group, names, at, number, "deflection", "m", false, "displacement against the undeformed beam ", "TD");
    add(group, names, at, number, "rotation", "rad", false, "rotation against the undeformed beam about the axis ",
        "RD");
    add(group, names, at, number, "acceleration", "m s-2", true, "acceleration relative to the ground ", "AL");
    add(group, names, at, number, "accelerometer", "m s-2", true, "acceleration less gravity ", "ALg");
    return group;
}

void add_stations(std::vector<ChannelGroup>& groups, const BeamNames& names, const CardanBeam& beam,
                  const std::vector<double>& places, const std::function<Gauge(double place)>& gauge) {
    check(names.beam, beam.line.length, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        groups.push_back(group_at(names, i + 1, places[i]));
        groups.back().sample = [own = gauge(places[i])](const DynamicView& in, double* values) {
            sample(own, in, values);
        };
    }
}

void add_blade(std::vector<ChannelGroup>& groups, const MachineLayout& layout, std::size_t k,
               const std::vector<double>& places) {
    const int number = layout.blade_numbers[k];
    const CardanBeam& beam = layout.blades[k];
    const std::string blade = text("blade ", number);
    const BeamNames names{blade,
                          blade,
                          number <= 3 ? "Spn" : "",
                          text("b", number),
                          {"downwind", "toward the trailing edge", "to the tip"}};
    add_stations(groups, names, beam, places, [&](double s) {
        return Gauge{BeamStation(beam, s), layout.blade_roots[k], beam.line.pose(s), openfast_axes(Mat3::Identity()),
                     openfast_axes(rot_x(beam.line.section(s).beta))};
    });
}

void add_tower(std::vector<ChannelGroup>& groups, const MachineLayout& layout, const std::vector<double>& places) {
    const CardanBeam& beam = *layout.tower;
    const Mat3 axes = foot_axes(Mat3::Identity());
    const BeamNames names{"tower", "tower base", "TwHt", "t", {"downwind", "to the left", "upward"}};
    add_stations(groups, names, beam, places, [&](double s) {
        return Gauge{BeamStation(beam, s), layout.tower_base, beam.line.pose(s), axes, axes};
    });
}

}  // namespace

std::vector<ChannelGroup> station_channels(const Turbine& turbine, const Stations& stations) {
    const MachineLayout& layout = turbine.layout();
    if (layout.blades.empty() && !stations.blades.empty())
        throw InputError("stations of blades", "number", stations.blades.size(), "0: the machine has no blades");
    if (!layout.tower && !stations.tower.empty())
        throw InputError("stations of tower", "number", stations.tower.size(),
                         layout.tower_top == FrameId{} ? "0: the machine has no tower" : "0: the tower is rigid");
    std::vector<ChannelGroup> groups;
    if (layout.tower) add_tower(groups, layout, stations.tower);
    for (std::size_t k = 0; k < layout.blades.size(); ++k) add_blade(groups, layout, k, stations.blades);
    return groups;
}

}  // namespace cardan::turbines
