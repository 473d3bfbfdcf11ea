// Derivatives of the generalised forces of the air. With S_b the twist of coordinate b about the base's origin and W_b
// the wrench about it on all that b moves,
//
//     Q_b = S_b . W_b,    dQ_b/dq_a = S_b . dW_b/dq_a + (S_a x S_b) . W_b,  the last term for a before b,
//
// so that wrenches and their derivatives are summed from the tips down, once, and every coordinate takes its row.
//
// Of a section at P, moved by coordinate a with w and v = v_a(P), angular velocity omega_a of the body behind a:
//
//     dV_P/dq_a = omega_a x v + w x (V_P - V_P of a point fixed to that body),    dV_P/dqd_a = v.
//
// The wind that a tower changes depends on both motions, too: air_tower.cpp.
//
// Its axes x, y, z turn with w if the hub does too; else z turns with w and y stays in the plane of the rotor, so they
// turn with w + (kappa - w.z) z, kappa = (w.x) (s.z) / (s.x), s the shaft, and the angle of the chord against them
// changes by kappa - w.z. The section's rate about its span, omega . z, changes by z . (omega_a x w), and by w . z.
#include "mbs/base/entry.hpp"
#include "mbs/kernels/registers/path_twists.hpp"
#include "turbines/aerodynamics/detail/air_evaluation.hpp"

namespace cardan::turbines {

namespace {

using Slopes = LaggingSlopes;
using Loads = Eigen::Matrix<double, 3, Slopes::first_state>;         // normal, driving, moment by the motion
using MotionChange = Eigen::Matrix<double, Slopes::first_state, 1>;  // of what a section sees

// A coordinate as it moves a section: how the axes turn, the chord against them, the distance from the shaft.
struct SectionTurn {
    Vec3 axes;
    double angle, radius;
};

}  // namespace

class AirDerivatives {
public:
    AirDerivatives(const AirEvaluation& air, ElementJacobian& out)
        : air_(air),
          parts_(air.parts_),
          by_q_(out.Q_q),
          by_qd_(out.Q_qd),
          states_(parts_.lags ? &out : nullptr),
          memory_(air.scratch_.derivatives) {
        const Eigen::Index n = out.Q_q.rows();
        for (Columns6* sum : {&memory_.blade_q, &memory_.blade_qd, &memory_.trunk_q, &memory_.trunk_qd})
            sum->setZero(6, n);
        memory_.by_q.resize(parts_.airfoil->sections());
        memory_.by_qd.resize(parts_.airfoil->sections());
        memory_.by_wake.resize(air.scratch_.sections.size());
        memory_.movers.resize(static_cast<std::size_t>(n));
        if (parts_.lags) memory_.lagging.resize(air.scratch_.sections.size());
        for (const int a : parts_.bodies) entry(memory_.movers, a) = air.motion_.mover(a);
        for (SectionState& s : air.scratch_.sections) s.wind_gradient = air.wind_.gradient_at(s.place);
        if (parts_.influence) find_influence();
    }

    void add() {
        Vec6 trunk = Vec6::Zero();
        for (std::size_t k = 0; k < parts_.blades.size(); ++k) {
            const AirBlade& blade = parts_.blades[k];
            for (std::size_t i = 0; i < blade.sections.size(); ++i) find_columns(k, i);
            add_blade(k, trunk);
            if (states_ != nullptr)
                for (std::size_t i = 0; i < blade.sections.size(); ++i) add_by_states(k, i);
        }
        for (std::size_t j = parts_.trunk.size(); j-- > 0;)
            add_row(parts_.trunk[j], parts_.bodies, memory_.trunk_q, memory_.trunk_qd, trunk);
        const InductionShare& share = air_.mean_.share;
        if ((parts_.options.skew != Skew::none && air_.mean_.speed > 0) || share.by_tip_speed != 0) add_wake();
    }

private:
    const Mover& mover(int a) const { return entry(memory_.movers, a); }
    int depth(int body) const { return air_.motion_.depth(body); }
    bool moves(int a, int body) const { return body >= 0 && air_.kin_.model().precedes(a, body); }
    bool moves_hub(int a) const { return moves(a, parts_.hub_body); }

    SectionTurn turn(const SectionState& s, const Mover& by, bool with_hub) const {
        if (with_hub) return {by.w, 0, 0};
        const double across = by.w.dot(s.x) * air_.shaft_.dot(s.span) / air_.shaft_.dot(s.x),
                     angle = across - by.w.dot(s.span);
        return {by.w + angle * s.span, angle, s.radial.dot(by.at(s.place))};
    }

    void find_influence() {
        memory_.influence.resize(air_.scratch_.influence.size());
        for (std::size_t i = 0; i < memory_.influence.size(); ++i)
            memory_.influence[i] =
                InfluenceSlopes(*parts_.influence, air_.motion_, air_.wind_, air_.scratch_.influence[i]);
    }
    // Changes of the wind at a section by a coordinate: its place moves by v.
    Vec3 wind_by_q(std::size_t section, int a, const Vec3& v) const {
        Vec3 open = air_.scratch_.sections[section].wind_gradient * v;
        if (!parts_.influence) return open;
        const InfluenceState& tower = air_.scratch_.influence[section];
        return open + memory_.influence[section].by_q(tower, mover(a), v, moves(a, tower.body));
    }
    Vec3 wind_by_qd(std::size_t section, int a) const {
        if (!parts_.influence) return Vec3::Zero();
        const InfluenceState& tower = air_.scratch_.influence[section];
        return memory_.influence[section].by_qd(tower, mover(a), moves(a, tower.body));
    }

    std::size_t index(std::size_t k, std::size_t i) const { return k * parts_.airfoil->sections() + i; }

    Loads slopes_of(std::size_t all) {
        const SectionState& s = air_.scratch_.sections[all];
        if (parts_.lags) {
            LaggingSlopes& own = memory_.lagging[all];
            own = lagging_slopes(s.annulus, air_.scratch_.lagging[all], air_.motion_of(all), air_.states_of(all),
                                 parts_.options, air_.density(), parts_.lags->sections[all]);
            return own.by.topLeftCorner<3, Slopes::first_state>();
        }
        Loads out = Loads::Zero();
        out.leftCols<SectionSlopes::columns>() =
            section_slopes(s.annulus, s.air, s.wake, parts_.options, air_.density()).by;
        return out;
    }
    // Of changes of normal, driving and moment: force and moment per length, base axes.
    static Vec6 load(const SectionState& s, const Vec3& change) {
        Vec6 out;
        out << change(0) * s.x - change(1) * s.y, change(2) * s.span;
        return out;
    }
    void add_rates(std::size_t all, int a, const MotionChange& by_q, const MotionChange& by_qd) {
        const int m = parts_.lags->sections[all].states(), first = parts_.lags->first[all];
        const auto slopes = memory_.lagging[all].by.block(3, 0, m, Slopes::first_state);
        states_->f_q.col(a).segment(first, m).noalias() += slopes.lazyProduct(by_q);
        states_->f_qd.col(a).segment(first, m).noalias() += slopes.lazyProduct(by_qd);
    }

    // Force and moment per length of a section, base axes, by the coordinates before it.
    void find_columns(std::size_t k, std::size_t i) {
        const SectionState& s = air_.sections(k)[i];
        const AirBlade& blade = parts_.blades[k];
        const std::size_t all = index(k, i);
        const Loads by = slopes_of(all);
        memory_.by_wake[all] << load(s, by.col(Slopes::wake_angle)),
            load(s, by.col(Slopes::wake_lever) * s.annulus.radius / parts_.radius), load(s, by.col(Slopes::wake_share));
        Columns6 &to_q = memory_.by_q[i], &to_qd = memory_.by_qd[i];
        const int count = depth(blade.sections[i].body);
        to_q.resize(6, static_cast<Eigen::Index>(blade.path.size()));
        to_qd.resize(6, static_cast<Eigen::Index>(blade.path.size()));
        for (int j = 0; j < count; ++j) {
            const int a = entry(blade.path, j);
            const Mover& own = mover(a);
            const SectionTurn turned = turn(s, own, moves_hub(a));
            const Vec3 v = own.at(s.place), air = wind_by_q(all, a, v) - own.change_of_velocity(s.place, s.velocity),
                       air_qd = wind_by_qd(all, a) - v;
            const auto change_along = [&](const Vec3& axis) {
                return air.dot(axis) + s.relative.dot(cross<double>(turned.axes, axis));
            };
            MotionChange change, change_qd = MotionChange::Zero();
            change << change_along(s.x), change_along(s.y), turned.angle, turned.radius, 0,
                s.wake.lever / s.annulus.radius * turned.radius, 0, s.span.dot(cross<double>(own.angular, own.w));
            change_qd(Slopes::V_x) = air_qd.dot(s.x);
            change_qd(Slopes::V_y) = air_qd.dot(s.y);
            change_qd(Slopes::rate) = own.w.dot(s.span);
            Vec6 carried;
            carried << cross<double>(turned.axes, s.force), cross<double>(own.w, s.moment);
            to_q.col(j) = load(s, by * change) + carried;
            to_qd.col(j) = load(s, by * change_qd);
            if (states_ != nullptr) add_rates(all, a, change, change_qd);
        }
    }

    // dQ/ds and df/ds of a section. The points that it loads make up L = sum length and X = sum length x beyond every
    // body: a force f and a moment m per length act on it as L f and L m + X x f about the base's origin.
    void add_by_states(std::size_t k, std::size_t i) {
        const std::size_t all = index(k, i);
        const int m = parts_.lags->sections[all].states(), first = parts_.lags->first[all];
        if (m == 0) return;
        const LaggingSlopes& slopes = memory_.lagging[all];
        states_->f_s.block(first, first, m, m) += slopes.by.block(3, Slopes::first_state, m, m);
        const AirBlade& blade = parts_.blades[k];
        const SectionState& s = air_.sections(k)[i];
        Eigen::Matrix<double, 6, UnsteadySection::max_states> loads;
        for (int c = 0; c < m; ++c) loads.col(c) = load(s, slopes.by.block<3, 1>(0, Slopes::first_state + c));
        double L = 0;
        Vec3 X = Vec3::Zero();
        auto next = blade.points.begin();
        for (std::size_t j = blade.path.size(); j-- > 0;) {
            const int b = blade.path[j];
            for (; next != blade.points.end() && next->body >= b; ++next)
                if (next->section == i) {
                    L += next->length;
                    X += next->length * air_.motion_.place(next->body, next->place);
                }
            if (L == 0) continue;
            const Mover& own = mover(b);
            for (int c = 0; c < m; ++c) {
                const Vec3 force = loads.col(c).head<3>(), moment = loads.col(c).tail<3>();
                states_->Q_s(b, first + c) +=
                    own.w.dot(Vec3(L * moment + cross<double>(X, force))) + L * own.v.dot(force);
            }
        }
    }

    // What a point adds to a wrench about the base's origin and its derivatives.
    void add_point(std::size_t k, const AirPoint& point, Vec6& wrench, Columns6& sum_q, Columns6& sum_qd) const {
        const AirBlade& blade = parts_.blades[k];
        const auto& frame = entry(air_.kin_.arrays().frame, point.body);
        const Vec3 x = frame.o.vector() + frame.E.matrix() * point.place;
        const auto at_origin = [&](const Vec3& force, const Vec3& moment) {
            Vec6 out;
            out << moment + cross<double>(x, force), force;
            return Vec6(point.length * out);
        };
        const SectionState& s = air_.sections(k)[point.section];
        wrench += at_origin(s.force, s.moment);
        const int count = depth(entry(blade.sections, point.section).body);
        for (int j = 0; j < count; ++j) {
            const int a = entry(blade.path, j);
            const auto by_q = memory_.by_q[point.section].col(j), by_qd = memory_.by_qd[point.section].col(j);
            sum_q.col(a) += at_origin(by_q.head<3>(), by_q.tail<3>());
            sum_qd.col(a) += at_origin(by_qd.head<3>(), by_qd.tail<3>());
        }
        const Vec3 force = point.length * s.force;
        for (int j = 0; j < depth(point.body); ++j) {
            const int a = entry(blade.path, j);
            sum_q.col(a).head<3>() += cross<double>(mover(a).at(x), force);
        }
    }

    void add_blade(std::size_t k, Vec6& trunk) {
        const AirBlade& blade = parts_.blades[k];
        for (const int a : blade.path) {
            memory_.blade_q.col(a).setZero();
            memory_.blade_qd.col(a).setZero();
        }
        Vec6 wrench = Vec6::Zero();
        auto next = blade.points.begin();
        for (std::size_t j = blade.path.size(); j-- > parts_.trunk.size();) {
            const int b = blade.path[j];
            for (; next != blade.points.end() && next->body == b; ++next)
                add_point(k, *next, wrench, memory_.blade_q, memory_.blade_qd);
            add_row(b, blade.path, memory_.blade_q, memory_.blade_qd, wrench);
        }
        // Segments that the hub carries.
        for (; next != blade.points.end(); ++next) add_point(k, *next, wrench, memory_.blade_q, memory_.blade_qd);
        trunk += wrench;
        for (const int a : blade.path) {
            memory_.trunk_q.col(a) += memory_.blade_q.col(a);
            memory_.trunk_qd.col(a) += memory_.blade_qd.col(a);
        }
    }

    void add_row(int b, const std::vector<int>& columns, const Columns6& sum_q, const Columns6& sum_qd,
                 const Vec6& wrench) {
        turbines::add_row(air_.kin_.model(), memory_.movers, b, columns, sum_q, sum_qd, wrench, by_q_, by_qd_);
    }

    // All sections feel the mean wind, which all of them make up, and the rotor's speed. Columns: the wake's angle, the
    // blades' sines, the share of the induction.
    Eigen::Index sine_column(std::size_t k) const { return static_cast<Eigen::Index>(k) + 1; }
    Eigen::Index share_column() const { return std::ssize(parts_.blades) + 1; }

    void add_wake() {
        find_mean_wind();
        find_wake();
        find_forces_of_wake();
        // Few coordinates change the wake: without a wind that differs from place to place, those of tower and nacelle.
        for (const int a : parts_.bodies)
            for (const auto& [wake, force] : {std::pair(&memory_.wake_q, &by_q_), {&memory_.wake_qd, &by_qd_}}) {
                if (wake->row(a).isZero(0)) continue;
                force->col(a).noalias() += memory_.of_wake.lazyProduct(wake->row(a).transpose());
            }
        if (states_ == nullptr) return;
        for (const int a : parts_.bodies) {
            if (!memory_.wake_q.row(a).isZero(0)) add_wake_to_rates(memory_.wake_q, a, states_->f_q);
            if (!memory_.wake_qd.row(a).isZero(0)) add_wake_to_rates(memory_.wake_qd, a, states_->f_qd);
        }
    }

    void add_wake_to_rates(const Matrix& wake, int a, MatrixOut& rates) const {
        for (std::size_t k = 0; k < parts_.blades.size(); ++k)
            for (std::size_t i = 0; i < parts_.airfoil->sections(); ++i) {
                const std::size_t all = index(k, i);
                const int m = parts_.lags->sections[all].states(), first = parts_.lags->first[all];
                const double lever = air_.sections(k)[i].annulus.radius / parts_.radius;
                const auto by = memory_.lagging[all].by.block(3, 0, m, Slopes::first_state);
                rates.col(a).segment(first, m) += wake(a, 0) * by.col(Slopes::wake_angle) +
                                                  lever * wake(a, sine_column(k)) * by.col(Slopes::wake_lever) +
                                                  wake(a, share_column()) * by.col(Slopes::wake_share);
            }
    }

    void find_mean_wind() {
        memory_.mean_q.setZero(3, by_q_.rows());
        memory_.mean_qd.setZero(3, by_q_.rows());
        const double share = 1 / static_cast<double>(air_.scratch_.sections.size());
        for (std::size_t k = 0; k < parts_.blades.size(); ++k)
            for (std::size_t i = 0; i < parts_.airfoil->sections(); ++i) {
                const SectionState& s = air_.sections(k)[i];
                if (!parts_.influence && s.wind_gradient.isZero(0)) continue;
                const AirBlade& blade = parts_.blades[k];
                for (int j = 0; j < depth(blade.sections[i].body); ++j) {
                    const int a = entry(blade.path, j);
                    const std::size_t all = index(k, i);
                    memory_.mean_q.col(a) += share * wind_by_q(all, a, mover(a).at(s.place));
                    memory_.mean_qd.col(a) += share * wind_by_qd(all, a);
                }
            }
        const Vec3 &hub = air_.hub_, velocity = air_.motion_.velocity(parts_.hub_body, hub);
        for (const int a : parts_.trunk) {
            const Mover& own = mover(a);
            memory_.mean_q.col(a) -= own.change_of_velocity(hub, velocity);
            memory_.mean_qd.col(a) -= own.at(hub);
        }
    }

    void find_wake() {
        const Eigen::Index n = by_q_.rows(), columns = share_column() + 1;
        memory_.wake_q.setZero(n, columns);
        memory_.wake_qd.setZero(n, columns);
        const Vec3 none = Vec3::Zero();
        for (const int a : parts_.bodies) {
            find_wake_by(memory_.mean_q.col(a), moves_hub(a) ? mover(a).w : none, spin_by_q(a), memory_.wake_q, a);
            find_wake_by(memory_.mean_qd.col(a), none, spin_by_qd(a), memory_.wake_qd, a);
        }
    }
    // Changes of the rotor's speed about the shaft: by what turns the hub against the body that carries it.
    bool spins(int a) const { return moves_hub(a) && !moves(a, parts_.shaft_body); }
    double spin_by_q(int a) const {
        if (!spins(a)) return 0;
        const Vec3 hub = air_.motion_.angular(parts_.hub_body), carrier = air_.motion_.angular(parts_.shaft_body);
        const Mover& own = mover(a);
        return cross<double>(own.w, Vec3(hub - own.angular)).dot(air_.shaft_) +
               (hub - carrier).dot(cross<double>(own.w, air_.shaft_));
    }
    double spin_by_qd(int a) const { return spins(a) ? mover(a).w.dot(air_.shaft_) : 0; }
    // @param change, turn, spin  of the mean wind, of the hub, and of the rotor's speed
    void find_wake_by(const Vec3& change, const Vec3& turn, double spin, Matrix& out, int a) const {
        const InductionShare& share = air_.mean_.share;
        out(a, share_column()) = share.by_tip_speed * parts_.radius * spin;
        if (air_.mean_.speed == 0) return;
        const Vec3 &V = air_.mean_.velocity, &shaft = air_.shaft_, turned = cross<double>(turn, shaft);
        const double n = air_.mean_.normal, size = air_.mean_.speed, side = (V - n * shaft).norm(),
                     dn = change.dot(shaft) + V.dot(turned), dsize = V.dot(change) / size;
        const Vec3 along = side > 0 ? Vec3((V - n * shaft) / side) : Vec3(Vec3::Zero());
        out(a, 0) = std::copysign(1.0, n) * (n * along.dot(change - n * turned) - side * dn) / (size * size);
        out(a, share_column()) += share.by_wind * dsize;
        for (std::size_t k = 0; k < parts_.blades.size(); ++k) {
            const Vec3 axis = air_.blade_direction(k);
            out(a, sine_column(k)) =
                (cross<double>(turn, axis).dot(V) + axis.dot(change) - axis.dot(V) * dsize / size) / size;
        }
    }

    void find_forces_of_wake() {
        using ByWake = Eigen::Matrix<double, 6, 3>;
        const std::size_t sections = parts_.airfoil->sections();
        memory_.of_wake.setZero(by_q_.rows(), share_column() + 1);
        ByWake trunk = ByWake::Zero();
        const auto add = [&](int b, const auto& wrench, Eigen::Index column) {
            const Mover& own = mover(b);
            memory_.of_wake(b, column) += own.w.dot(wrench.template head<3>()) + own.v.dot(wrench.template tail<3>());
        };
        for (std::size_t k = 0; k < parts_.blades.size(); ++k) {
            const AirBlade& blade = parts_.blades[k];
            ByWake sum = ByWake::Zero();
            auto next = blade.points.begin();
            const auto gather = [&] {
                const auto& frame = entry(air_.kin_.arrays().frame, next->body);
                const Vec3 x = frame.o.vector() + frame.E.matrix() * next->place;
                const ByWake& by = memory_.by_wake[k * sections + next->section];
                for (Eigen::Index c = 0; c < by.cols(); ++c) {
                    const Vec3 force = next->length * by.col(c).head<3>();
                    sum.col(c).head<3>() += next->length * by.col(c).tail<3>() + cross<double>(x, force);
                    sum.col(c).tail<3>() += force;
                }
            };
            for (std::size_t j = blade.path.size(); j-- > parts_.trunk.size();) {
                for (; next != blade.points.end() && next->body == blade.path[j]; ++next) gather();
                add(blade.path[j], sum.col(0), 0);
                add(blade.path[j], sum.col(1), sine_column(k));
                add(blade.path[j], sum.col(2), share_column());
            }
            for (; next != blade.points.end(); ++next) gather();
            trunk += sum;
            for (const int b : parts_.trunk) add(b, sum.col(1), sine_column(k));
        }
        for (const int b : parts_.trunk) {
            add(b, trunk.col(0), 0);
            add(b, trunk.col(2), share_column());
        }
    }

    const AirEvaluation& air_;
    const AirParts& parts_;
    MatrixOut by_q_, by_qd_;
    ElementJacobian* states_;
    AirDerivativeScratch& memory_;
};

void AirEvaluation::add_derivatives(ElementJacobian& out) {
    AirDerivatives(*this, out).add();
}

}  // namespace cardan::turbines
