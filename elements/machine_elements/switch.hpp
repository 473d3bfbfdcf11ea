/// @file
/// Something that is switched while a machine runs: the grid breaker of a generator, the valve of a brake.
#pragma once

#include <limits>
#include <memory>

namespace cardan {

/// Forces keep a shared pointer to it; copies of a force share the same switch. It is switched between two steps, in
/// the action of an event, which must then restart the integration because the forces jump. A switch belongs to one
/// simulation at a time, and to one thread; reset it before the next run.
class Switch {
public:
    explicit Switch(bool on) : on_(on) {}

    bool is_on() const { return on_; }
    /// Time of the last change, s; minus infinity before the first one.
    double since() const { return since_; }
    /// Turns the switch, without effect if it already is in this position.
    void turn(bool on, double time) {
        if (on == on_) return;
        on_ = on;
        since_ = time;
    }
    /// Back to the state after construction.
    void reset(bool on) { *this = Switch(on); }

private:
    bool on_;
    double since_ = -std::numeric_limits<double>::infinity();
};

}  // namespace cardan
