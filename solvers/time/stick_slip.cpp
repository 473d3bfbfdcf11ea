#include "solvers/time/stick_slip.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <functional>
#include <utility>

namespace cardan::solvers {

namespace {

// Sliding at less than this is standing still, beside the speed of the surface and 1 m/s or rad/s. What has just broken
// loose starts from zero, with a force that is hardly less than what held it.
constexpr double standing = 1e-10;
// What a force may be over the limit by rounding.
constexpr double rounding = 1e-9;

struct Contact {
    DryFriction own;
    int coordinate, equation;  // of its lock

    double sliding(const Vector& qd) const { return qd(coordinate) - own.surface_speed; }
    double slowest() const { return standing * (1 + std::abs(own.surface_speed)); }
    bool sticks() const { return own.state->engaged; }
    // How much more the friction could hold.
    double reserve(const Vector& lambda) const { return own.static_force - std::abs(lambda(equation)); }
    void stick(double time, const Vector& q) const { *own.state = {{true, q(coordinate), own.surface_speed, time}, 0}; }
    // To the side that the force does not hold.
    void break_loose(const Vector& lambda) const { slide(lambda(equation) > 0 ? -1 : 1); }
    void slide(int direction) const {
        own.state->engaged = false;
        own.state->direction = direction;
    }
};

class Contacts {
public:
    Contacts(const System& system, std::vector<DryFriction> frictions) {
        for (DryFriction& friction : frictions) {
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
    // Where one has begun to stick or to slide, others may break loose.
    // @param multipliers  of the present states
    void settle(const std::function<Vector()>& multipliers) const {
        for (std::size_t i = 0; i <= all_.size(); ++i) {
            const Vector lambda = multipliers();
            bool changed = false;
            for (const Contact& contact : all_)
                if (contact.sticks() && contact.reserve(lambda) < -rounding * contact.own.static_force) {
                    contact.break_loose(lambda);
                    changed = true;
                }
            if (!changed) return;
        }
    }
    void settle(Integrator& run) const {
        settle([&] {
            run.update();
            return run.state().lambda;
        });
    }

private:
    std::vector<Contact> all_;
};

void begin(const Contacts& contacts, const System& system, const std::vector<Drive>& drives, double time,
           const Vector& q, const Vector& qd) {
    for (const Contact& contact : contacts.all()) {
        const double speed = contact.sliding(qd);
        if (std::abs(speed) <= contact.slowest())
            contact.stick(time, q);
        else
            contact.slide(speed > 0 ? 1 : -1);
    }
    EquationsOfMotion equations(system, drives, time, q, qd);
    Vector x(equations.length());
    x << q(equations.unknowns()), qd(equations.unknowns()), equations.state_table().initial();
    contacts.settle([&] {
        DynamicState state;
        if (!equations.complete(time, x.data(), state))
            throw NumericalError(text("stick-slip: no start: ", equations.problem()));
        return state.lambda;
    });
}

}  // namespace

std::vector<Event> stick_slip(const System& system, std::vector<DryFriction> frictions,
                              const std::vector<Drive>& drives, double time, const Vector& q, const Vector& qd) {
    const auto contacts = std::make_shared<const Contacts>(system, std::move(frictions));
    begin(*contacts, system, drives, time, q, qd);
    std::vector<Event> events;
    for (const Contact& contact : contacts->all()) {
        // A value of 1: nothing to watch for.
        events.push_back({.name = text(contact.own.name, " stands still"),
                          .function =
                              [contacts, &contact](const ForceInput& at) {
                                  const int direction = contact.own.state->direction;
                                  return direction == 0 ? 1 : direction * contact.sliding(at.qd) + contact.slowest();
                              },
                          .direction = -1,
                          .action =
                              [contacts, &contact](Integrator& run) {
                                  contact.stick(run.time(), run.state().q);
                                  contacts->settle(run);
                                  return AfterEvent::restart;
                              }});
        events.push_back(
            {.name = text(contact.own.name, " breaks loose"),
             .direction = -1,
             .action =
                 [contacts, &contact](Integrator& run) {
                     contact.break_loose(run.state().lambda);
                     contacts->settle(run);
                     return AfterEvent::restart;
                 },
             .of_state = [contacts, &contact](
                             const DynamicState& at) { return contact.sticks() ? contact.reserve(at.lambda) : 1; }});
    }
    return events;
}

}  // namespace cardan::solvers
