// Inductions of many sections at once: the arithmetic of eight of them fills the registers of the processor.
#include "elements/aerodynamics/detail/balance.hpp"
#include "elements/aerodynamics/momentum.hpp"
#include "mbs/base/registers/vector_math.hpp"
#include "mbs/base/registers/vectorised.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cardan {

namespace {

constexpr int at_once = 8;
constexpr double min_angle = 1e-6;                           // rad, from where sine or cosine vanish
constexpr double no_loss = 40;                               // over sin(phi): from there on Prandtl's factor is 1
constexpr double min_factor = 1e-4, glauert_from = 2.0 / 3;  // as in Balance
constexpr double min_share = 0.1;                            // of the wind that is left, to begin with
constexpr int max_steps = 16;
constexpr double last_step = 1e-8, last_but_one = 3e-6;  // of phi; the error of Newton's method is squared by a step

using Lanes = double[at_once];

// Sections side by side: what is given, and what an evaluation at the angles phi finds.
struct alignas(64) Group {
    Lanes V_x, V_y, angle, tip, hub, chords, radius;
    Lanes solidity;
    Lanes phi;
    Lanes s, c, attack, decay;
    Lanes lift, drag, lift_slope, drag_slope, room;
    Lanes F, F_slope;
    Lanes k, k_slope, turn, turn_slope, along, along_slope;  // along: 1 / (1 - a)
    Lanes step;
};

// Which terms count, as factors.
struct Terms {
    double axial_drag, tangential_drag, rotation;
};

// The inflow that lift along its line and momentum agree on, for small angles without losses, drag and rotation:
//
//     phi (x - phi) = sigma (slope (phi - angle) + offset) / 4,    x = V_x / V_y.
CARDAN_VECTORISED void guess_angles(Group* __restrict g) {
    for (int i = 0; i < at_once; ++i) {
        g->solidity[i] = g->chords[i] / (2 * pi * g->radius[i]);
        const double x = g->V_x[i] / g->V_y[i], part = g->solidity[i] / 4, p = (x - part * g->lift_slope[i]) / 2,
                     source = part * (g->lift_slope[i] * g->angle[i] - g->lift[i]),
                     t = std::max(p + std::sqrt(std::max(p * p + source, 0.0)), min_share * x), by_t = 1 / t;
        // An angle near atan(t).
        g->phi[i] = t < 1 ? t / (1 + 0.28 * t * t) : pi / 2 - by_t / (1 + 0.28 * by_t * by_t);
    }
}

CARDAN_VECTORISED void find_angles(Group* __restrict g) {
    for (int i = 0; i < at_once; ++i) g->s[i] = ::sin(g->phi[i]);
    for (int i = 0; i < at_once; ++i) g->c[i] = ::cos(g->phi[i]);
    for (int i = 0; i < at_once; ++i) {
        g->attack[i] = g->phi[i] - g->angle[i];
        g->F[i] = 1;
        g->F_slope[i] = 0;
    }
}

// A factor of Prandtl's, (2 / pi) acos exp(-x / s), with its slope by phi; where it is 1 nothing is left of the
// exponential.
CARDAN_VECTORISED void add_loss(Group* __restrict g, const double* __restrict exponent) {
    for (int i = 0; i < at_once; ++i) g->decay[i] = ::exp(-exponent[i] / g->s[i]);
    for (int i = 0; i < at_once; ++i) {
        constexpr double unit = 2 / pi;
        const bool counts = exponent[i] < no_loss * g->s[i];
        const double e = g->decay[i], of_e = unit * ::acos(e), loss = counts ? of_e : 1.0,
                     slope = -unit * e * exponent[i] * g->c[i] / (g->s[i] * g->s[i] * std::sqrt((1 - e) * (1 + e)));
        g->F_slope[i] = g->F_slope[i] * loss + g->F[i] * slope;
        g->F[i] *= loss;
    }
}

// k, k' and 1 / (1 - a) by momentum with their slopes by phi, term by term as Balance, for air from the front.
CARDAN_VECTORISED void find_balance(Group* __restrict g, const Terms* __restrict terms) {
    for (int i = 0; i < at_once; ++i) {
        const double s = g->s[i], c = g->c[i], solidity = g->solidity[i] / 4;
        const double lift = g->lift[i], lift_slope = g->lift_slope[i];
        const double axial_drag = terms->axial_drag * g->drag[i], axial_slope = terms->axial_drag * g->drag_slope[i],
                     side_drag = terms->tangential_drag * g->drag[i],
                     side_slope = terms->tangential_drag * g->drag_slope[i];
        const double normal = lift * c + axial_drag * s,
                     normal_slope = lift_slope * c - lift * s + axial_slope * s + axial_drag * c,
                     driving = lift * s - side_drag * c,
                     driving_slope = lift_slope * s + lift * c - side_slope * c + side_drag * s;
        const bool counts = g->F[i] >= min_factor;
        const double F = counts ? g->F[i] : min_factor, F_slope = counts ? g->F_slope[i] : 0.0;
        const double by_all = 1 / (F * s * c), by_F = s * c * by_all, by_s = F * c * by_all, by_c = F * s * by_all;
        const double part = solidity * by_F * by_s * by_s, k = part * normal,
                     k_slope = part * normal_slope - k * (F_slope * by_F + 2 * c * by_s),
                     factor = terms->rotation * solidity * by_all, turn = factor * driving,
                     turn_slope = factor * driving_slope - turn * (F_slope * by_F + c * by_s - s * by_c);
        g->F[i] = F;
        g->F_slope[i] = F_slope;
        g->k[i] = k;
        g->k_slope[i] = k_slope;
        g->turn[i] = turn;
        g->turn_slope[i] = turn_slope;
        g->along[i] = 1 + k;
        g->along_slope[i] = k_slope;
    }
}

// Where the thrust is high Buhl's relation takes the place of momentum.
CARDAN_VECTORISED void follow_buhl(Group* __restrict g) {
    for (int i = 0; i < at_once; ++i) {
        const double F = g->F[i], F_slope = g->F_slope[i], k = g->k[i], x = 2 * F * k,
                     x_slope = 2 * (F_slope * k + F * g->k_slope[i]), root = std::sqrt(x - F * (4.0 / 3 - F)),
                     root_slope = (x_slope - (4.0 / 3 - 2 * F) * F_slope) / (2 * root), below = x - (25.0 / 9 - 2 * F),
                     below_slope = x_slope + 2 * F_slope, above = root + F - 5.0 / 3,
                     above_slope = root_slope + F_slope;
        const bool singular = std::abs(below) < 1e-6, low = k <= glauert_from;
        const double along = singular ? 2 * root : below / above,
                     along_slope = singular ? 2 * root_slope : (below_slope - along * above_slope) / above;
        g->along[i] = low ? g->along[i] : along;
        g->along_slope[i] = low ? g->along_slope[i] : along_slope;
    }
}

CARDAN_VECTORISED void find_steps(Group* __restrict g) {
    for (int i = 0; i < at_once; ++i) {
        const double s = g->s[i], c = g->c[i], V_x = g->V_x[i], V_y = g->V_y[i], rest = 1 - g->turn[i],
                     residual = s * g->along[i] * V_y - V_x * c * rest,
                     slope = (c * g->along[i] + s * g->along_slope[i]) * V_y + V_x * (s * rest + c * g->turn_slope[i]);
        g->step[i] = residual / slope;
    }
}

class GroupSolver {
public:
    explicit GroupSolver(const MomentumOptions& options)
        : options_(options),
          terms_{options.axial_drag ? 1.0 : 0.0, options.tangential_drag ? 1.0 : 0.0, options.rotation ? 1.0 : 0.0} {}

    // Lanes that are left over repeat the last one.
    void solve(std::span<const SectionInflow> sections, std::span<Induction> out) {
        count_ = static_cast<int>(sections.size());
        for (int i = 0; i < at_once; ++i) load(i, sections[static_cast<std::size_t>(std::min(i, count_ - 1))]);
        guess_angles(&g_);
        for (int step = 0; step < max_steps; ++step) {
            evaluate();
            if (move()) break;
        }
        for (int i = 0; i < count_; ++i) {
            const SectionInflow& own = sections[static_cast<std::size_t>(i)];
            out[static_cast<std::size_t>(i)] = state_[i] == State::at_rest && is_min(i, own)
                                                   ? found_[i]
                                                   : solve_induction(*own.annulus, own.V_x, own.V_y, options_);
        }
    }

private:
    enum class State : std::uint8_t { moving, at_rest, lost };

    void load(int i, const SectionInflow& own) {
        const Annulus& a = *own.annulus;
        annulus_[i] = &a;
        reynolds_[i] = reynolds_of<double>(a, own.V_x, own.V_y);
        const double tip = options_.tip_loss ? std::min(a.tip, no_loss) : no_loss,
                     hub = options_.hub_loss ? std::min(a.hub, no_loss) : no_loss;
        // Where a and a' are as the balance has them.
        const bool usual = own.V_y > 0 && own.V_x * Balance<double>::no_swirl > 2 * own.V_y && tip > 0 && hub > 0;
        state_[i] = usual ? State::moving : State::lost;
        g_.V_x[i] = usual ? own.V_x : 1;
        g_.V_y[i] = usual ? own.V_y : 1;
        g_.tip[i] = usual ? tip : no_loss;
        g_.hub[i] = usual ? hub : no_loss;
        g_.angle[i] = a.angle;
        moved_[i] = g_.room[i] = 0;
        g_.lift_slope[i] = a.polar->lift_line().slope;
        g_.lift[i] = a.polar->lift_line().offset;
        g_.chords[i] = a.blades * a.chord;
        g_.radius[i] = a.radius;
    }

    bool is_min(int i, const SectionInflow& own) const {
        const double attack = std::remainder(found_[i].root - own.annulus->angle, 2 * pi);
        return (g_.F[i] > large_loss && own.annulus->polar->is_attached(attack)) ||
               is_min_attack(own, options_, found_[i].root);
    }

    void evaluate() {
        find_angles(&g_);
        if (is_lost(g_.tip)) add_loss(&g_, g_.tip);
        if (is_lost(g_.hub)) add_loss(&g_, g_.hub);
        for (int i = 0; i < count_; ++i) find_coefficients(i);
        for (Lanes* lanes : {&g_.lift, &g_.drag, &g_.lift_slope, &g_.drag_slope, &g_.room})
            std::fill(*lanes + count_, *lanes + at_once, (*lanes)[count_ - 1]);
        find_balance(&g_, &terms_);
        if (std::ranges::any_of(g_.k, [](double k) { return k > glauert_from; })) follow_buhl(&g_);
        find_steps(&g_);
    }

    // At most steps they are linear from where they were.
    void find_coefficients(int i) {
        if (std::abs(moved_[i]) < g_.room[i]) {
            g_.lift[i] += moved_[i] * g_.lift_slope[i];
            g_.drag[i] += moved_[i] * g_.drag_slope[i];
            g_.room[i] -= std::abs(moved_[i]);
            return;
        }
        const Polar::Point p = point_of(*annulus_[i]->polar, g_.attack[i], reynolds_[i]);
        g_.lift[i] = p.lift;
        g_.drag[i] = p.drag;
        g_.lift_slope[i] = p.lift_slope;
        g_.drag_slope[i] = p.drag_slope;
        g_.room[i] = p.room;
    }

    // Is Prandtl's factor of these exponents anywhere below 1?
    bool is_lost(const Lanes& exponent) const {
        bool any = false;
        for (int i = 0; i < at_once; ++i) any |= exponent[i] < no_loss * g_.s[i];
        return any;
    }

    // As newton_root(). True: none is on its way any more.
    bool move() {
        bool done = true;
        for (int i = 0; i < at_once; ++i) {
            moved_[i] = 0;
            if (state_[i] != State::moving) continue;
            double& phi = g_.phi[i];
            const double next = phi - g_.step[i];
            if (!std::isfinite(next)) {
                state_[i] = State::lost;
            } else if (next > min_angle && next < pi / 2 - min_angle) {
                moved_[i] = next - phi;
                phi = next;
                if (is_last(i)) settle(i);
            } else {
                phi = (phi + (next <= min_angle ? min_angle : pi / 2 - min_angle)) / 2;
                g_.room[i] = 0;
            }
            done = done && state_[i] != State::moving;
        }
        return done;
    }

    // Has the step come to the solution? Where nothing bends on its way the next one would be as the square of this
    // one.
    bool is_last(int i) const {
        const double step = std::abs(g_.step[i]), phi = g_.phi[i], k = g_.k[i];
        if (step < last_step * phi) return true;
        const bool same_relation = (k > glauert_from) == (k + moved_[i] * g_.k_slope[i] > glauert_from);
        return step < last_but_one * phi && step < g_.room[i] && same_relation;
    }

    // What is found does not depend on how long the others of the group take.
    void settle(int i) {
        state_[i] = g_.k[i] >= -1 ? State::at_rest : State::lost;
        found_[i] = induction(i);
    }

    // The last step is so small that slopes take k' and 1 / (1 - a) with it.
    Induction induction(int i) const {
        const double turn = g_.turn[i] + moved_[i] * g_.turn_slope[i],
                     along = g_.along[i] + moved_[i] * g_.along_slope[i], axial = 1 - 1 / along,
                     tangential = turn / (1 - turn);
        Induction out{.axial = std::clamp(axial, -1.0, 1.5),
                      .tangential = std::clamp(tangential, -1.0, 1.0),
                      .phi = g_.phi[i],
                      .root = g_.phi[i],
                      .solved = true};
        if (out.axial != axial || out.tangential != tangential)
            out.phi = std::atan2(g_.V_x[i] * (1 - out.axial), g_.V_y[i] * (1 + out.tangential));
        return out;
    }

    Group g_{};  // first: the others fill what its alignment leaves
    const MomentumOptions& options_;
    Terms terms_;
    const Annulus* annulus_[at_once]{};
    double reynolds_[at_once]{}, moved_[at_once]{};
    int count_ = 0;
    State state_[at_once]{};
    Induction found_[at_once]{};
};

}  // namespace

void solve_inductions(std::span<const SectionInflow> sections, const MomentumOptions& options,
                      std::span<Induction> out) {
    GroupSolver solver(options);
    for (std::size_t first = 0; first < sections.size(); first += at_once) {
        const std::size_t count = std::min<std::size_t>(at_once, sections.size() - first);
        solver.solve(sections.subspan(first, count), out.subspan(first, count));
    }
}

}  // namespace cardan
