#include "elements/machine/coordinate_force.hpp"

#include "mbs/base/error.hpp"

#include <utility>

namespace cardan {

UserForce coordinate_force(std::string name, BodyId coordinate,
                           std::function<CoordinateLaw(double, double, double)> law, bool elastic) {
    if (!law) throw InputError(text("force '", name, "'"), "law", "empty function", "a callable one");
    UserForce force;
    force.name = std::move(name);
    force.elastic = elastic;
    const auto at = [coordinate, law = std::move(law)](const StateView& in, int& index) {
        index = in.kinematics.model().index(coordinate);
        return law(in.time, in.q(index), in.qd(index));
    };
    force.force = [at](const StateView& in, VectorOut Q) {
        int i = 0;
        const CoordinateLaw now = at(in, i);
        Q(i) += now.force;
    };
    force.jacobian = [at](const StateView& in, MatrixOut dQ_dq, MatrixOut dQ_dqd) {
        int i = 0;
        const CoordinateLaw now = at(in, i);
        dQ_dq(i, i) += now.by_position;
        dQ_dqd(i, i) += now.by_rate;
    };
    if (elastic)
        force.energy = [at](const StateView& in) {
            int i = 0;
            return at(in, i).energy;
        };
    return force;
}

}  // namespace cardan
