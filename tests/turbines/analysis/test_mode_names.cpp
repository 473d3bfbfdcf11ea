// Names of modes that an engineer reads: what is not marked is right, and the same in every diagram.
//
// Reference: energies and whirl of a mode taken from its shape here, by components and rows; a diagram of one speed
// beside those of several.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "turbines/analysis/campbell.hpp"
#include "turbines/machine/read_machine.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cardan::testing::names_of_modes {

namespace {

using namespace turbines;
using solvers::Branch;
using solvers::Campbell;
using solvers::CampbellMode;
using solvers::RotorPattern;

const std::string small_fst = std::string(CARDAN_SOURCE_DIR) + "/tests/data/openfast/small.fst";

const Machine& machine(const std::string& name) {
    static std::map<std::string, Machine> known;
    auto found = known.find(name);
    if (found == known.end()) found = known.emplace(name, read_machine(name)).first;
    return found->second;
}

CampbellDiagram over(const std::string& name, const std::vector<double>& rpm) {
    std::vector<double> speeds;
    for (const double one : rpm) speeds.push_back(one * units::rpm);
    return campbell(
        machine(name),
        {.rotor_speeds = speeds, .machine = {.blade_elements = 3, .tower_elements = 2}, .max_frequency_hz = 9});
}

std::vector<double> steps(double last, int count) {
    std::vector<double> list;
    for (int i = 0; i <= count; ++i) list.push_back(last * i / count);
    return list;
}

struct Named {
    std::string name;
    bool doubtful;
};

// By frequency, Hz.
std::map<double, Named> names_at(const Campbell& diagram, double rpm) {
    std::map<double, Named> names;
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        if (std::abs(diagram.points[i].rotor_speed - rpm * units::rpm) < 1e-9)
            for (const Branch& branch : diagram.branches)
                if (branch.mode[i] >= 0) names[diagram.natural_hz(branch, i)] = {branch.name, branch.doubtful[i]};
    return names;
}

const Named* near(const std::map<double, Named>& names, double hz) {
    for (const auto& [at, named] : names)
        if (std::abs(at - hz) < 1e-6 * hz) return &named;
    return nullptr;
}

}  // namespace

TEST_CASE("mode names: one that is not marked is the same whatever rotor speeds the diagram has", "[crosscheck]") {
    struct Case {
        std::string machine;
        double rpm;
    };
    for (const Case& one : {Case{"wt600", 32}, Case{small_fst, 45}}) {
        const std::vector<CampbellDiagram> diagrams{over(one.machine, steps(one.rpm, 8)), over(one.machine, {one.rpm}),
                                                    over(one.machine, {one.rpm / 2, one.rpm}),
                                                    over(one.machine, steps(one.rpm, 16))};
        for (const double rpm : {one.rpm, one.rpm / 2}) {
            int sure = 0, compared = 0;
            for (const Campbell& a : diagrams)
                for (const auto& [hz, first] : names_at(a, rpm))
                    for (const Campbell& b : diagrams) {
                        const auto others = names_at(b, rpm);
                        const Named* const second = near(others, hz);
                        if (second == nullptr) continue;
                        ++compared;
                        if (first.doubtful || second->doubtful) continue;
                        ++sure;
                        CAPTURE(one.machine, rpm, hz);
                        CHECK(first.name == second->name);
                    }
            CHECK(compared > 90);
            CHECK(sure > compared / 2);
        }
    }
}

TEST_CASE("mode names: at rest all names and marks are the same whatever rotor speeds follow", "[crosscheck]") {
    for (const std::string& name : {std::string("wt600"), small_fst}) {
        const CampbellDiagram slow = over(name, {0, 0.5});
        for (const Branch& branch : slow.branches) {
            CAPTURE(name, branch.name);
            CHECK(branch.mac[1] > 0.8);  // curves go on
        }
        const auto first = names_at(slow, 0);
        CHECK(first.size() > 10);
        for (const std::vector<double>& rpm :
             {std::vector<double>{0, 1}, {0, 5, 10}, {0, 32}, {0, 40}, {0, 8, 16, 24, 32, 40}}) {
            const auto others = names_at(over(name, rpm), 0);
            for (const auto& [hz, named] : first) {
                const Named* const other = near(others, hz);
                CAPTURE(name, rpm, hz, named.name);
                REQUIRE(other != nullptr);
                CHECK(other->name == named.name);
                CHECK(other->doubtful == named.doubtful);
            }
        }
    }
}

TEST_CASE("mode names: three quarters of the energy under one name is that name, at every speed of every diagram",
          "[property]") {
    for (const std::string& name : {std::string("wt600"), small_fst})
        for (const int count : {4, 16}) {
            const CampbellDiagram diagram = over(name, steps(44, count));
            int found = 0;
            for (std::size_t i = 1; i < diagram.points.size(); ++i)
                for (const Branch& branch : diagram.branches) {
                    const CampbellMode* const mode = diagram.mode(branch, i);
                    if (mode == nullptr) continue;
                    for (const solvers::EnergyFraction& share : mode->shares)
                        for (const RotorPattern pattern :
                             {RotorPattern::collective, RotorPattern::backward, RotorPattern::forward}) {
                            if (share.of(pattern) < 0.75) continue;
                            const solvers::Component& c = entry(diagram.components, share.component);
                            CAPTURE(name, count, i, branch.name, c.family, c.ordinal);
                            CHECK(branch.component == share.component);
                            CHECK(branch.pattern == (c.of_blades ? pattern : RotorPattern::none));
                            ++found;
                        }
                }
            CHECK(found >= 3 * count);
        }
}

TEST_CASE("mode names: less than half of the energy, or another part with four fifths of it, has a mark with a reason",
          "[property]") {
    for (const std::string& name : {std::string("wt600"), small_fst}) {
        const CampbellDiagram diagram = over(name, {0, 20, 45});
        int marked = 0, sure = 0;
        for (std::size_t i = 0; i < diagram.points.size(); ++i)
            for (const Branch& branch : diagram.branches) {
                const CampbellMode* const mode = diagram.mode(branch, i);
                if (mode == nullptr || branch.component < 0) continue;
                const double own = entry(mode->shares, branch.component).total();
                double next = 0;
                for (const solvers::EnergyFraction& share : mode->shares)
                    if (share.component != branch.component) next = std::max(next, share.total());
                CAPTURE(name, i, branch.name, own, next);
                CHECK(branch.doubtful[i] == !branch.doubt[i].empty());
                ++(branch.doubtful[i] ? marked : sure);
                if (own < 0.5 || next >= 0.8 * own) CHECK(branch.doubtful[i]);
            }
        CHECK(marked > 0);
        CHECK(sure > marked);
    }
}

TEST_CASE("mode names: what hardly whirls is not called forward or backward without a mark", "[property]") {
    const CampbellDiagram diagram = over(small_fst, {3, 20, 45});
    int standing = 0;
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        for (const Branch& branch : diagram.branches) {
            const CampbellMode* const mode = diagram.mode(branch, i);
            const bool whirls = branch.pattern == RotorPattern::backward || branch.pattern == RotorPattern::forward;
            if (mode == nullptr || !whirls) continue;
            const double whirl = entry(mode->shares, branch.component).whirl,
                         sense = branch.pattern == RotorPattern::forward ? 1 : -1;
            CAPTURE(i, branch.name, whirl);
            // The other sense has four fifths of the energy of this one.
            if (sense * whirl < 1.0 / 9) {
                CHECK(branch.doubtful[i]);
                ++standing;
            }
        }
    CHECK(standing > 0);
}

}  // namespace cardan::testing::names_of_modes
