#include "mbs/model/rotor_map.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

namespace {

void require_coordinate(const RotorMap& rotor, const char* what, int index, int count) {
    if (index < 0 || index >= count)
        throw InputError(text("rotor map of '", rotor.machine, "'"), what, index,
                         text("0 ... ", count - 1, ", a coordinate of the model"));
}

}  // namespace

void check(const RotorMap& rotor, const Model& model) {
    const int n = model.size();
    if (rotor.spin != -1) require_coordinate(rotor, "spin coordinate", rotor.spin, n);
    for (const std::vector<int>& blade : rotor.blades)
        for (const int coordinate : blade) require_coordinate(rotor, "coordinate of a blade", coordinate, n);
    for (const int coordinate : rotor.odd_coordinates) require_coordinate(rotor, "odd coordinate", coordinate, n);
    for (const RotatingPair& pair : rotor.rotating_pairs)
        for (const int coordinate : {pair.y, pair.z})
            require_coordinate(rotor, "coordinate of a rotating pair", coordinate, n);
    model.frame(rotor.hub);
    for (const PartAxes& part : rotor.parts) model.frame(part.axes);
    for (const Polyline& line : rotor.lines)
        for (const FrameId point : line.points) model.frame(point);
}

}  // namespace cardan
