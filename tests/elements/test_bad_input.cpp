// Beams that must be refused: what, where, the value, what is allowed.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/sections/tube.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::bad_input {

namespace {

template <class Change>
void check_beam_refused(Change change, std::initializer_list<std::string> parts) {
    BeamLine line = uniform_beam(10, slender(2, 3), "spar");
    CardanBeamOptions options = bending_only(2);
    change(line, options);
    Tree tree;
    ForceSet forces;
    check_refused([&] { add_cardan_beam(tree, forces, Tree::base(), line, "spar", {"wing"}, options); }, parts);
}
using L = BeamLine;
using O = CardanBeamOptions;

template <class Change>
void check_section_refused(Change change, std::initializer_list<std::string> parts) {
    EngineeringSection s = slender(2, 3);
    change(s);
    check_refused([&] { (void)uniform_beam(10, s, "spar"); }, parts);
}
using S = EngineeringSection;

template <class Change>
void check_tube_refused(Change change, std::initializer_list<std::string> parts) {
    TubeSpec spec;
    spec.length = 50, spec.diameter_base = 3, spec.diameter_top = 2, spec.wall_thickness = {0.02, 0.01};
    spec.E = 2.1e11, spec.G = 8e10, spec.density = 7850;
    CHECK_NOTHROW(tube(spec, "tower"));
    change(spec);
    check_refused([&] { (void)tube(spec, "tower"); }, parts);
}
using T = TubeSpec;

}  // namespace

TEST_CASE("beam: delta must lie inside (0, 0.5)", "[property]") {
    for (const auto& [value, shown] :
         {std::pair{0.0, "= 0;"}, {0.5, "= 0.5;"}, {-0.1, "= -0.1;"}, {0.7, "= 0.7;"}, {not_a_number, "= nan;"}})
        check_beam_refused([delta = value](L&, O& o) { o.delta = delta; }, {"spar: delta", shown, "0 < delta < 0.5"});
}

TEST_CASE("beam: at least one element; boundaries increase from 0 to the length", "[property]") {
    check_beam_refused([](L&, O& o) { o.elements = 0; }, {"spar: number of elements = 0; allowed: >= 1"});
    check_beam_refused([](L&, O& o) { o.elements = -2; }, {"spar: number of elements = -2"});
    check_beam_refused([](L&, O& o) { o.boundaries = {0}; }, {"spar: element boundaries [m] = 0 ... 0", "length 10"});
    check_beam_refused([](L&, O& o) { o.boundaries = {0, 9}; }, {"spar: element boundaries [m] = 0 ... 9"});
    check_beam_refused([](L&, O& o) { o.boundaries = {1, 10}; }, {"spar: element boundaries [m] = 1 ... 10"});
    check_beam_refused(
        [](L&, O& o) {
            o.boundaries = {0, 6, 4, 10};
        },
        {"spar: element boundary 3 [m] = 4; allowed: increasing"});
    check_beam_refused(
        [](L&, O& o) {
            o.boundaries = {0, not_a_number, 10};
        },
        {"spar: element boundary 2 [m] = nan; allowed: finite"});
}

TEST_CASE("beam: an element shorter than rounding allows, a boundary that is not a number", "[property]") {
    check_beam_refused(
        [](L&, O& o) {
            o.boundaries = {0, 5, 5.00001, 10};
        },
        {"spar: length of element 2 [m] = 1e-05", "of the length of the beam"});
    check_beam_refused([](L&, O& o) { o.boundaries = {not_a_number, 5, 10}; }, {"element boundary 1 [m] = nan"});
}

TEST_CASE("beam: its length must be finite and positive, its breaks increase, its section exist", "[property]") {
    check_beam_refused([](L& l, O&) { l.length = 0; }, {"spar: length [m] = 0; allowed: finite and > 0"});
    check_beam_refused([](L& l, O&) { l.length = -3; }, {"spar: length [m] = -3"});
    check_beam_refused([](L& l, O&) { l.length = not_a_number; }, {"spar: length [m] = nan"});
    check_beam_refused([](L& l, O&) { l.length = infinite; }, {"spar: length [m] = inf"});
    check_beam_refused([](L& l, O&) { l.section = {}; }, {"spar: the section function is missing"});
    check_beam_refused([](L& l, O&) { l.breaks = {0, 5, 5, 10}; }, {"spar: station 3 [m] = 5", "increasing"});
    check_refused([] { (void)uniform_beam(-1, slender(2, 3), "spar"); }, {"spar: length [m] = -1"});
}

TEST_CASE("beam: a negative damping ratio, or one at no frequency, is refused", "[property]") {
    const auto refused = [](double ratio, double frequency, std::initializer_list<std::string> said) {
        check_refused([&] { (void)BeamDamping::ratio_at(ratio, frequency); }, said);
    };
    refused(-0.01, 2, {"ratio at frequency [Hz]", "-0.01 at 2", "ratio >= 0"});
    refused(0.01, 0, {"0.01 at 0", "frequency > 0"});
    refused(not_a_number, 1, {"nan at 1"});
    check_beam_refused([](L&, O& o) { o.damping.time_constants[4] = -1e-3; },
                       {"spar: damping time constant [s] = -0.001; allowed: finite and >= 0"});
    check_beam_refused([](L&, O& o) { o.damping.mass_proportional = not_a_number; },
                       {"spar: mass-proportional damping [1/s] = nan"});
    check_beam_refused([](L&, O& o) { o.damping.modal.torsion = {0.01, -2}; }, {"spar: modal damping ratio = -2"});
    check_beam_refused([](L&, O& o) { o.damping.modal = {.all = {0.01}, .torsion = {0.01}}; },
                       {"spar: modal damping", "one of them"});
}

TEST_CASE("beam: a free direction of a rigid section is refused with the element named", "[property]") {
    check_beam_refused([](L&, O& o) { o.torsion = true; }, {"spar element 1: flexibility of torsion (phi) = 0",
                                                            "a rigid direction must be locked", "`torsion = false`"});
    check_beam_refused([](L&, O& o) { o.extension = true; },
                       {"spar element 1: flexibility of extension (u) = 0", "a rigid direction must be locked",
                        "`extension = false`"});
}

TEST_CASE("beam: a negative armature that leaves a coordinate no inertia is refused by the model, which names it",
          "[property]") {
    const auto made = [](double bending, double torsion) {
        Tree tree;
        ForceSet forces;
        CardanBeamOptions options = all_free(3);
        options.bending_armature = bending;
        options.torsion_armature = torsion;
        EngineeringSection section = slender(2, 3);
        section.j_flap = section.j_edge = 0.01, section.GJ = 1, section.EA = 100;
        add_cardan_beam(tree, forces, Tree::base(), uniform_beam(10, section, "spar"), "spar", {"wing"}, options);
        return Model(tree);
    };
    CHECK_NOTHROW(made(-2.9e-4, -1. / 12));
    check_refused([&] { (void)made(-0.1, 0); }, {"indefinite metric", "bending", "negative armature"});
    check_refused([&] { (void)made(0, -0.6); }, {"indefinite metric", "torsion'", "negative armature"});
}

TEST_CASE("beam: a second one of the same name is refused", "[property]") {
    Tree tree;
    ForceSet forces;
    const auto add = [&] {
        add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "spar", {"wing"}, bending_only(1));
    };
    CHECK_NOTHROW(add());
    check_refused(add, {"'spar start'", "a name not used before"});
}

TEST_CASE("section: bad constants are refused with the quantity and its unit", "[property]") {
    check_section_refused([](S& s) { s.mass = -1; }, {"spar: mass per length [kg/m] = -1; allowed: finite and >= 0"});
    check_section_refused([](S& s) { s.mass = not_a_number; }, {"spar: mass per length [kg/m] = nan"});
    check_section_refused([](S& s) { s.mass = infinite; }, {"spar: mass per length [kg/m] = inf"});
    check_section_refused([](S& s) { s.EI_flap = 0; }, {"spar: EI flap [N m^2] = 0; allowed: > 0"});
    check_section_refused([](S& s) { s.EI_edge = -5; }, {"spar: EI edge [N m^2] = -5"});
    check_section_refused([](S& s) { s.EA = 0; }, {"spar: EA [N] = 0"});
    check_section_refused([](S& s) { s.GJ = not_a_number; }, {"spar: GJ [N m^2] = nan"});
    check_section_refused([](S& s) { s.GA_y = -1; }, {"spar: GA y [N] = -1"});
    check_section_refused([](S& s) { s.GA_z = 0; }, {"spar: GA z [N] = 0"});
    check_section_refused([](S& s) { s.j_flap = -1; }, {"spar: flap inertia per length [kg m] = -1"});
    check_section_refused([](S& s) { s.j_edge = not_a_number; }, {"spar: edge inertia per length [kg m] = nan"});
    check_section_refused([](S& s) { s.beta = infinite; }, {"spar: twist [rad] or offset [m] = inf"});
    check_section_refused([](S& s) { s.mass_centre.y = not_a_number; }, {"spar: twist [rad] or offset [m] = nan"});
}

TEST_CASE("section table: a stiffness that is infinite at some stations only is refused with the station",
          "[property]") {
    EngineeringSection soft = slender(2, 3), rigid = soft;
    soft.GA_y = 1e6;
    check_refused(
        [&] {
            (void)beam_line({"spar", {0, 1, 2}, {soft, soft, rigid}});
        },
        {"spar, station 3 (x = 2 m): GA y [N] = inf", "infinite at all stations or at none"});
    rigid = soft;
    rigid.EI_flap = infinite;
    check_refused(
        [&] {
            (void)beam_line({"spar", {0, 1}, {rigid, soft}});
        },
        {"station 2", "EI flap [N m^2] = 2", "infinite at all"});
}

TEST_CASE("beam: a section function that gives no section is refused with the place", "[property]") {
    const auto with = [](auto change) {
        return [change](L& line, O&) {
            line.section = [change, good = line.section](double x) {
                BeamSection section = good(x);
                if (x > 4) change(section);
                return section;
            };
        };
    };
    check_beam_refused(with([](BeamSection& s) { s.centre.x() = 0.5; }),
                       {"spar, section at 4.99", "in the section: x = 0"});
    check_beam_refused(with([](BeamSection& s) { s.compliance(4, 5) = 1; }), {"spar, section at", "symmetric"});
    check_beam_refused(with([](BeamSection& s) { s.mass = -1; }), {"mass per length [kg/m] = -1"});
    check_beam_refused(with([](BeamSection& s) { s.J(0, 0) = not_a_number; }), {"inertia per length", "finite"});
    check_beam_refused(with([](BeamSection& s) { s.compliance(4, 4) = not_a_number; }), {"compliance", "finite"});
}

TEST_CASE("section table: too few stations, stations that do not increase, a bad one among them", "[property]") {
    const S s = slender(2, 3);
    const auto make = [](std::vector<double> x, std::vector<S> sections) {
        return [=] { (void)beam_line({"blade", x, sections}); };
    };
    check_refused(make({0}, {s}), {"blade: number of stations = 1; allowed: at least 2"});
    check_refused(make({0, 1, 2}, {s, s}), {"blade: number of sections = 2; allowed: 3, one per station"});
    check_refused(make({0, 2, 2}, {s, s, s}), {"blade: station 3 [m] = 2; allowed: finite and increasing"});
    check_refused(make({0, 2, 1}, {s, s, s}), {"blade: station 3 [m] = 1"});
    check_refused(make({0, not_a_number}, {s, s}), {"blade: station 2 [m] = nan"});
    S bad = s;
    bad.EI_edge = -2;
    check_refused(make({0, 1.5, 4}, {s, bad, s}), {"blade, station 2 (x = 1.5 m): EI edge [N m^2] = -2"});
}

TEST_CASE("tube: walls thicker than the radius, missing walls, dimensions that are not positive", "[property]") {
    check_tube_refused(
        [](T& t) {
            t.wall_thickness = {0.02, 1.2};
        },
        {"tower: wall thickness [m] = 1.2; allowed: 0 ... 1"});
    check_tube_refused([](T& t) { t.wall_thickness = {0}; }, {"tower: wall thickness [m] = 0"});
    check_tube_refused([](T& t) { t.wall_thickness = {}; }, {"tower: number of wall thicknesses = 0"});
    check_tube_refused([](T& t) { t.length = -50; }, {"tower: length [m] = -50; allowed: finite and > 0"});
    check_tube_refused([](T& t) { t.diameter_base = 0; }, {"tower: diameter at the base [m] = 0"});
    check_tube_refused([](T& t) { t.diameter_top = not_a_number; }, {"tower: diameter at the top [m] = nan"});
    check_tube_refused([](T& t) { t.E = 0; }, {"tower: E [Pa] = 0"});
    check_tube_refused([](T& t) { t.G = -1; }, {"tower: G [Pa] = -1"});
    check_tube_refused([](T& t) { t.density = infinite; }, {"tower: density [kg/m^3] = inf"});
    check_tube_refused([](T& t) { t.shear_factor = 0; }, {"tower: shear factor = 0"});
}

}  // namespace cardan::testing::bad_input
