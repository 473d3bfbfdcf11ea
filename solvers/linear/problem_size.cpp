#include "solvers/linear/problem_size.hpp"

#include "mbs/base/error.hpp"

namespace cardan::solvers {

void check_number_of_unknowns(const std::string& machine, std::size_t unknowns) {
    if (unknowns == 0)
        throw InputError(machine, "coordinates that can move", 0,
                         "1 and more: all its parts are rigid, locked or driven");
    if (unknowns <= max_unknowns) return;
    throw InputError(
        machine, "number of unknowns", unknowns,
        text("<= ", max_unknowns,
             " (all eigenvalues of a full matrix of twice the size are computed at every point: time grows "
             "with the cube); take fewer elements per part, their error is small long before"));
}

}  // namespace cardan::solvers
