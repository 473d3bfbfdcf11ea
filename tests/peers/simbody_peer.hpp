/// @file
/// Simbody (Sherman, Seth and Delp 2011): O(n) recursions in the spatial operator algebra.
#pragma once

#include "tests/peers/peer.hpp"

#include <array>
#include <memory>

namespace cardan::peers {

class SimbodyPeer : public Peer {
public:
    /// @throws PeerRefusal for a link that has moments of inertia but no mass
    explicit SimbodyPeer(const std::vector<PeerLink>& links, std::array<double, 3> gravity = {},
                         const std::vector<PeerPin>& pins = {});
    ~SimbodyPeer() override;
    SimbodyPeer(const SimbodyPeer&) = delete;
    SimbodyPeer& operator=(const SimbodyPeer&) = delete;

    void metric(const double* q, double* g) override;
    void inverse_dynamics(const double* q, const double* qd, const double* qdd, double* tau) override;
    void forward_dynamics(const double* q, const double* qd, const double* Q, double* qdd) override;
    /// Likewise with the pins.
    void closed_dynamics(const double* q, const double* qd, const double* Q, double* qdd);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Motions of links with pins under gravity by Simbody's own integration: Runge, Kutta and Merson's method with
/// projection.
class SimbodyMotion {
public:
    SimbodyMotion(const std::vector<PeerLink>& links, std::array<double, 3> gravity, const std::vector<PeerPin>& pins);
    ~SimbodyMotion();
    SimbodyMotion(const SimbodyMotion&) = delete;
    SimbodyMotion& operator=(const SimbodyMotion&) = delete;

    /// @param q, qd     in and out
    /// @param accuracy  Simbody's: relative error of a step
    /// @return steps taken; -1: it failed
    int advance(double* q, double* qd, double duration, double accuracy);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardan::peers
