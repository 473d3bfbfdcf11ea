#include "solvers/algebra/coupled_groups.hpp"

#include "mbs/base/disjoint_sets.hpp"
#include "mbs/base/entry.hpp"

namespace cardan::solvers {

std::vector<std::vector<Eigen::Index>> coupled_groups(const Matrix& A, Eigen::Index first) {
    const Eigen::Index count = A.rows() - first;
    DisjointSets sets(count);
    for (Eigen::Index j = 0; j < count; ++j)
        for (Eigen::Index i = 0; i < count; ++i)
            if (A(first + i, first + j) != 0) sets.join(i, j);
    std::vector<std::vector<Eigen::Index>> groups;
    std::vector<Eigen::Index> place(static_cast<std::size_t>(count), -1);
    for (Eigen::Index i = 0; i < count; ++i) {
        Eigen::Index& own = entry(place, sets.leader(i));
        if (own < 0) {
            own = std::ssize(groups);
            groups.emplace_back();
        }
        entry(groups, own).push_back(first + i);
    }
    return groups;
}

}  // namespace cardan::solvers
