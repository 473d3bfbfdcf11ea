#include "solvers/time/stick_slip.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

// What a force may be over the limit by rounding.
constexpr double rounding = 1e-9;
// An acceleration, over that which the friction alone could cause, that is none.
constexpr double no_acceleration = 1e-6;

struct Contact {
    DryFriction own;
    int coordinate, equation;  // of its lock

    double sliding(const Vector& qd) const { return qd(coordinate) - own.surface_speed; }
    bool sticks() const { return own.state->engaged; }
    // How much more the friction could hold.
    double reserve(const Vector& lambda) const { return own.static_force - std::abs(lambda(equation)); }
    void stick(double time, const Vector& q) const { *own.state = {{true, q(coordinate), own.surface_speed, time}, 0}; }
    void slide(int direction) const {
        own.state->engaged = false;
        own.state->direction = direction;
    }
    // To the side that the force does not hold.
    void break_loose(const Vector& lambda) const { slide(lambda(equation) > 0 ? -1 : 1); }
};

// Where contacts settle: before a run or in an action of one.
class Scene {
public:
    virtual ~Scene() = default;
    /// The state with contacts as they are now.
    virtual const DynamicState& evaluate() = 0;
    virtual LockHold hold(int equation) = 0;
};

class Contacts {
public:
    Contacts(const System& system, std::vector<DryFriction> frictions) {
        for (DryFriction& friction : frictions) {
            require_positive(text("friction '", friction.name, "'"), "speed that is standstill [m/s, rad/s]",
                             friction.standstill);
            const int coordinate = system.model.index(friction.coordinate);
            int loop = 0;
            while (loop < system.loops.loops() && system.loops.name(loop) != friction.name) ++loop;
            if (loop == system.loops.loops())
                throw InputError("stick-slip", text("lock of the friction '", friction.name, "'"), "none",
                                 "that of add_dry_friction() among the loops of the system");
            all_.push_back({std::move(friction), coordinate, system.loops.first_of(loop)});
        }
    }
    const std::vector<Contact>& all() const { return all_; }

    // What stands still sticks if it can, and goes on sliding if it cannot. Of what sticks, that which would have to
    // hold more than it can breaks loose, the worst first, for then the others hold less or more.
    // @param stopped, loose  has just come to a standstill, has just broken loose and does not stick again; nullptr:
    // none
    void settle(Scene& scene, const Contact* stopped, const Contact* loose) const {
        for (const Contact& contact : all_) {
            if (contact.sticks() || &contact == loose) continue;
            if (&contact == stopped || std::abs(contact.sliding(scene.evaluate().qd)) <= contact.own.standstill)
                stick_if_it_can(contact, scene);
        }
        for (std::size_t i = 0; i <= all_.size(); ++i) {
            const Vector& lambda = scene.evaluate().lambda;
            const Contact* worst = nullptr;
            double max = rounding;
            for (const Contact& contact : all_)
                if (const double over = -contact.reserve(lambda) / contact.own.static_force;
                    contact.sticks() && over > max) {
                    max = over;
                    worst = &contact;
                }
            if (!worst) return;
            worst->break_loose(lambda);
        }
    }

private:
    // Where the loops alone determine the coordinate, as they do at a dead point or where a drive moves them, friction
    // cannot hold it: its speed is zero for a moment, and only its direction changes. Where other locks determine it
    // already, it takes a share of the load, provided that it rests and is not just passing through zero.
    static void stick_if_it_can(const Contact& contact, Scene& scene) {
        const int direction = contact.own.state->direction;
        const DynamicState& before = scene.evaluate();
        const double speed = contact.sliding(before.qd);
        contact.stick(before.time, before.q);
        const DynamicState& stuck = scene.evaluate();
        const double forced = stuck.qdd(contact.coordinate);
        const LockHold hold = scene.hold(contact.equation);
        const bool rests = std::abs(forced) <= no_acceleration * contact.own.static_force * hold.mobility;
        if (hold.beside_all || (hold.beside_loops && rests)) return;
        // On the side that it moves to: of itself, by what moves it, or as before.
        const double side = std::abs(speed) > contact.own.standstill / 2 ? speed : rests ? direction : forced;
        contact.slide(side < 0 ? -1 : 1);
    }

    std::vector<Contact> all_;
};

class RunningScene : public Scene {
public:
    explicit RunningScene(Integrator& run) : run_(run) {}
    const DynamicState& evaluate() override {
        run_.update();
        return run_.state();
    }
    LockHold hold(int equation) override { return run_.hold(equation); }

private:
    Integrator& run_;
};

class FirstScene : public Scene {
public:
    FirstScene(const System& system, const std::vector<Drive>& drives, double time, const Vector& q, const Vector& qd)
        : time_(time), equations_(system, drives, time, q, qd), x_(equations_.length()) {
        x_ << q(equations_.unknowns()), qd(equations_.unknowns()), equations_.state_table().initial();
    }
    const DynamicState& evaluate() override {
        if (!equations_.complete(time_, x_.data(), state_))
            throw NumericalError(text("stick-slip: no start: ", equations_.problem()));
        return state_;
    }
    LockHold hold(int equation) override { return equations_.hold(equation); }

private:
    double time_;
    EquationsOfMotion equations_;
    Vector x_;
    DynamicState state_;
};

}  // namespace

std::vector<Event> stick_slip(const System& system, std::vector<DryFriction> frictions,
                              const std::vector<Drive>& drives, double time, const Vector& q, const Vector& qd) {
    const auto contacts = std::make_shared<const Contacts>(system, std::move(frictions));
    for (const Contact& contact : contacts->all()) contact.slide(contact.sliding(qd) < 0 ? -1 : 1);
    FirstScene start(system, drives, time, q, qd);
    contacts->settle(start, nullptr, nullptr);
    std::vector<Event> events;
    for (const Contact& contact : contacts->all()) {
        // A value of 1: nothing to watch for.
        events.push_back({.name = text(contact.own.name, " stands still"),
                          .function =
                              [contacts, &contact](const StateView& at) {
                                  const int direction = contact.own.state->direction;
                                  const double standstill = contact.own.standstill;
                                  return direction == 0 ? 1 : (direction * contact.sliding(at.qd) + standstill);
                              },
                          .direction = -1,
                          .action =
                              [contacts, &contact](Integrator& run) {
                                  RunningScene scene(run);
                                  contacts->settle(scene, &contact, nullptr);
                                  return AfterEvent::restart;
                              }});
        events.push_back(
            {.name = text(contact.own.name, " breaks loose"),
             .direction = -1,
             .action =
                 [contacts, &contact](Integrator& run) {
                     contact.break_loose(run.state().lambda);
                     RunningScene scene(run);
                     contacts->settle(scene, nullptr, &contact);
                     return AfterEvent::restart;
                 },
             .of_state = [contacts, &contact](
                             const DynamicState& at) { return contact.sticks() ? contact.reserve(at.lambda) : 1; }});
    }
    return events;
}

}  // namespace cardan::solvers
