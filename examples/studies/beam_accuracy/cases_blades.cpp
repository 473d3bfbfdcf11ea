// Two blades in bending: both planes, coupled by the twist.
#include "examples/studies/beam_accuracy/cases.hpp"
#include "examples/studies/beam_accuracy/chain.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

using enum Check::Kind;

// What all methods can do alike: mass on the line, no sectional inertia, no torsion, no extension.
BeamLine bending_only(const BeamLine& line) {
    BeamLine plain = line;
    plain.section = [line](double x) {
        BeamSection section = line.section(x);
        const Eigen::Matrix2d bending = section.compliance.block<2, 2>(4, 4);
        section.compliance.setZero();
        section.compliance.block<2, 2>(4, 4) = bending;
        section.centre.setZero(), section.J.setZero();
        return section;
    };
    return plain;
}

Beam wt600_blade(double speed) {
    return {bending_only(turbines::wt600_description().blade.line), Plane::both, speed, 1.5};
}
Beam nrel_blade(double speed) {
    const turbines::Nrel5mwBlade blade = turbines::nrel5mw_blade();
    return {bending_only(blade.line), Plane::both, speed, blade.root_radius};
}

using Ends = std::function<std::vector<double>(const Method&, const BeamLine&, int)>;

std::vector<double> equal(const Method&, const BeamLine& line, int n) {
    return equal_ends(line.length, n);
}
std::vector<double> phase(const Method&, const BeamLine& line, int n) {
    return equal_phase_ends(line, n);
}
// Static moments need the last metre apart: the stiffness falls by 27 there.
std::vector<double> nrel_equal(const Method& method, const BeamLine& line, int n) {
    if (method.scheme == Scheme::chain && method.chain.partition == Partition::static_moment)
        return turbines::nrel5mw_blade_elements(n, Partition::static_moment).boundaries;
    return equal_ends(line.length, n);
}

Study blade(const std::string& name, const std::string& title, const Beam& beam, const Ends& ends) {
    Study s{name, title};
    const BendingModes limit = hermite_limit(beam);
    constexpr auto source = "Hz; Hermite, all stations nodes, extrapolated";
    s.quantities = {{"flap 1", limit.flap.at(0) / (2 * pi), source},
                    {"edge 1", limit.edge.at(0) / (2 * pi), source},
                    {"flap 2", limit.flap.at(1) / (2 * pi), source}};
    s.methods = {"G", "S", "K", "Gauss + N", "Hermite", "static"};
    s.elements = {2, 3, 4, 6, 8, 12, 16, 32};
    s.compute = [beam, ends](const Method& method, int n) -> std::vector<double> {
        BendingModes modes = bending_modes(method, beam, ends(method, beam.line, n));
        modes.flap.resize(2, std::nan(""));
        return {modes.flap[0] / (2 * pi), modes.edge.at(0) / (2 * pi), modes.flap[1] / (2 * pi)};
    };
    return s;
}

Study placed(const std::string& name, const std::string& title, const Beam& beam, std::vector<Check> checks) {
    Study s = blade(name, title, beam, phase);
    s.checks = std::move(checks);
    s.note = "ends of 8 elements, m from the root:";
    for (double x : equal_phase_ends(beam.line, 8)) s.note += text(" ", std::round(100 * x) / 100);
    return s;
}

Study with(Study s, std::vector<Check> checks) {
    s.methods.emplace_back("mixed");  // equal elements only
    s.checks = std::move(checks);
    return s;
}

}  // namespace

Study wt600_at_rest() {
    return with(blade("wt600_rest", "600 kW blade, bending only, 0 rpm", wt600_blade(0), equal),
                {{order, "G", 0, 32, 4, 0.2},
                 {order, "S", 0, 32, 4, 0.1},
                 {order, "static", 0, 32, 4, 0.1},
                 {error, "G", 0, 4, -0.318, 0.01},
                 {order, "K", 0, 32, 4, 0.1},
                 {order, "Gauss + N", 0, 32, 4, 0.1},
                 {error, "K", 0, 4, 0.0506, 0.01},
                 {error, "Gauss + N", 0, 4, 0.0772, 0.01}});
}

Study wt600_rotating() {
    return with(blade("wt600_27", "600 kW blade, bending only, 27 rpm", wt600_blade(27 * units::rpm), equal),
                {{order, "S", 0, 32, 4, 0.1},
                 {order, "static", 0, 32, 4, 0.1},
                 {error, "G", 0, 4, -0.193, 0.01},
                 {order, "K", 0, 32, 4, 0.1},
                 {order, "Gauss + N", 0, 32, 2, 0.15},
                 {error, "K", 0, 4, 0.0623, 0.01},
                 {error, "Gauss + N", 0, 4, 0.136, 0.01}});
}

Study wt600_placed() {
    return placed("wt600_placed", "600 kW blade, bending only, 0 rpm, elements of equal phase", wt600_blade(0),
                  {{order, "static", 0, 32, 4, 0.1},
                   {error, "G", 0, 4, -0.0517, 0.01},
                   {error, "K", 0, 3, -0.00689, 0.01},
                   {error, "Gauss + N", 0, 4, -0.0063, 0.01}});
}

Study nrel_at_rest() {
    return with(blade("nrel_rest", "NREL 5 MW blade, bending only, 0 rpm", nrel_blade(0), nrel_equal),
                {{order, "S", 0, 32, 4, 0.2},
                 {order, "static", 0, 32, 4, 0.1},
                 {error, "G", 0, 8, -0.0971, 0.01},
                 {error, "Hermite", 0, 8, 0.167, 0.01},
                 {error, "K", 0, 4, 0.13, 0.01},
                 {error, "Gauss + N", 0, 4, 0.168, 0.01}});
}

Study nrel_rotating() {
    return with(blade("nrel_12", "NREL 5 MW blade, bending only, 12.1 rpm", nrel_blade(12.1 * units::rpm), nrel_equal),
                {{order, "S", 0, 32, 4, 0.2},
                 {order, "static", 0, 32, 4, 0.1},
                 {error, "G", 0, 8, -0.0449, 0.01},
                 {error, "K", 0, 2, 1.64, 0.01},
                 {error, "K", 0, 4, 0.128, 0.01},
                 {error, "Gauss + N", 0, 4, 0.233, 0.01}});
}

Study nrel_placed() {
    return placed("nrel_placed", "NREL 5 MW blade, bending only, 0 rpm, elements of equal phase", nrel_blade(0),
                  {{order, "static", 0, 32, 4, 0.1},
                   {error, "G", 0, 8, -0.00874, 0.01},
                   {error, "K", 0, 3, 0.0196, 0.01},
                   {error, "Gauss + N", 0, 4, -0.00893, 0.01}});
}

}  // namespace cardan::accuracy
