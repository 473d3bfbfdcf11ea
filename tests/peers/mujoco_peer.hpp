/// @file
/// MuJoCo (Todorov, Erez and Tassa 2012): composite bodies, sparse factorisation of the metric, Newton-Euler recursion.
#pragma once

#include "tests/peers/peer.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace cardan::peers {

/// MuJoCo has no moving bodies without mass: the joint of a massless link becomes one more joint of the link it
/// carries.
class MujocoPeer : public Peer {
public:
    /// @throws PeerRefusal for a massless link that carries not exactly one other, and for what MuJoCo itself refuses
    /// @param pins  that have to be closed at q = 0. MuJoCo's are soft: accelerations differ by some 1e-4 from those of
    ///              pins that hold, where these are closed.
    explicit MujocoPeer(const std::vector<PeerLink>& links, std::array<double, 3> gravity = {},
                        const std::vector<PeerPin>& pins = {});
    /// From a URDF text, which MuJoCo reads by itself. Limits, damping and friction are switched off.
    /// @throws PeerRefusal for what MuJoCo refuses
    static std::unique_ptr<MujocoPeer> from_urdf(const std::string& urdf);
    ~MujocoPeer() override;
    MujocoPeer(const MujocoPeer&) = delete;
    MujocoPeer& operator=(const MujocoPeer&) = delete;

    /// Names of the joints in the order of the coordinates.
    std::vector<std::string> joints() const;
    void metric(const double* q, double* g) override;
    void inverse_dynamics(const double* q, const double* qd, const double* qdd, double* tau) override;
    void forward_dynamics(const double* q, const double* qd, const double* Q, double* qdd) override;

private:
    struct Impl;
    explicit MujocoPeer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The tree in MuJoCo's own format (MJCF); the joints are named after the links: "0", "1" ...
/// @throws PeerRefusal for a massless link that carries not exactly one other
std::string mujoco_xml(const std::vector<PeerLink>& links, std::array<double, 3> gravity,
                       const std::vector<PeerPin>& pins = {});

}  // namespace cardan::peers
