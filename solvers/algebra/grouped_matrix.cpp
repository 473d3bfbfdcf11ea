#include "solvers/algebra/grouped_matrix.hpp"

#include "mbs/base/disjoint_sets.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"
#include "solvers/algebra/dense.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

std::vector<std::vector<Index>> groups_of(DisjointSets& sets, Index count) {
    std::vector<std::vector<Index>> groups;
    std::vector<Index> place(static_cast<std::size_t>(count), -1);
    for (Index i = 0; i < count; ++i) {
        Index& own = entry(place, sets.leader(i));
        if (own < 0) {
            own = std::ssize(groups);
            groups.emplace_back();
        }
        entry(groups, own).push_back(i);
    }
    return groups;
}

std::vector<std::vector<Index>> coupled_groups(const Matrix& A) {
    DisjointSets sets(A.rows());
    for (Index j = 0; j < A.cols(); ++j)
        for (Index i = 0; i < A.rows(); ++i)
            if (A(i, j) != 0) sets.join(i, j);
    return groups_of(sets, A.rows());
}

// Calls `f` with row, column and entry of every place of a block.
template <class Group, class F>
void for_each_entry(Group& group, const F& f) {
    for (Index j = 0; j < group.block.cols(); ++j)
        for (Index i = 0; i < group.block.rows(); ++i) f(entry(group.rows, i), entry(group.rows, j), group.block(i, j));
}

}  // namespace

void GroupedMatrix::set_groups(std::vector<std::vector<Index>> groups) {
    std::size_t count = 0;
    for (const std::vector<Index>& rows : groups) count += rows.size();
    places_.resize(count);
    groups_.clear();
    groups_.reserve(groups.size());
    for (std::vector<Index>& rows : groups) {
        for (std::size_t i = 0; i < rows.size(); ++i) entry(places_, rows[i]) = {groups_.size(), static_cast<Index>(i)};
        const Index size = std::ssize(rows);
        groups_.push_back({std::move(rows), Matrix::Zero(size, size)});
    }
}

// Zero outside of the groups: as many entries that are not zero as within.
bool GroupedMatrix::covers(const Matrix& A) const {
    if (A.rows() != rows()) return false;
    Index within = 0;
    for (const Group& group : groups_)
        for_each_entry(group, [&](Index i, Index j, double) { within += A(i, j) != 0 ? 1 : 0; });
    return within == (A.array() != 0).count();
}

void GroupedMatrix::set(const Matrix& A) {
    require_size("grouped matrix", "square matrix", A, A.rows(), A.rows());
    if (!covers(A)) set_groups(coupled_groups(A));
    for (Group& group : groups_) for_each_entry(group, [&](Index i, Index j, double& own) { own = A(i, j); });
}

void GroupedMatrix::join(const std::vector<std::vector<int>>& sets) {
    const bool joined = std::ranges::all_of(sets, [&](const std::vector<int>& rows) {
        return std::ranges::all_of(rows, [&](int row) { return group_of(row) == group_of(rows[0]); });
    });
    if (joined) return;
    DisjointSets all(rows());
    for (const Group& group : groups_)
        for (const Index row : group.rows) all.join(row, group.rows[0]);
    for (const std::vector<int>& rows : sets)
        for (const int row : rows) all.join(row, rows[0]);
    const std::vector<Group> before = std::move(groups_);
    set_groups(groups_of(all, rows()));
    for (const Group& group : before) add(group, 1);
}

std::size_t GroupedMatrix::group_of(Index row) const {
    return entry(places_, row).group;
}

Index GroupedMatrix::place_in_group(Index row) const {
    return entry(places_, row).in_group;
}

Matrix GroupedMatrix::dense() const {
    Matrix all = Matrix::Zero(rows(), rows());
    for (const Group& group : groups_) all(group.rows, group.rows) = group.block;
    return all;
}

Vector GroupedMatrix::diagonal() const {
    Vector all(rows());
    for (const Group& group : groups_) all(group.rows) = group.block.diagonal();
    return all;
}

void GroupedMatrix::add(const GroupedMatrix& other, double factor) {
    require_count("grouped matrix", "rows of a sum", other.places_.size(), places_.size());
    bool same = groups_.size() == other.groups_.size();
    for (std::size_t g = 0; same && g < groups_.size(); ++g) same = groups_[g].rows == other.groups_[g].rows;
    if (same) {
        for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].block += factor * other.groups_[g].block;
        return;
    }
    std::vector<std::vector<int>> sets;
    sets.reserve(other.groups_.size());
    for (const Group& group : other.groups_) sets.emplace_back(group.rows.begin(), group.rows.end());
    join(sets);
    for (const Group& group : other.groups_) add(group, factor);
}

// A group that is within one of these.
void GroupedMatrix::add(const Group& part, double factor) {
    Matrix& block = groups_[group_of(part.rows[0])].block;
    for_each_entry(
        part, [&](Index i, Index j, double value) { block(place_in_group(i), place_in_group(j)) += factor * value; });
}

GroupedMatrix& GroupedMatrix::operator*=(double factor) {
    for (Group& group : groups_) group.block *= factor;
    return *this;
}

void GroupedMatrix::scale(const Vector& left, const Vector& right) {
    require_size("grouped matrix", "factors of the rows", left, rows());
    require_size("grouped matrix", "factors of the columns", right, rows());
    for (Group& group : groups_)
        for_each_entry(group, [&](Index i, Index j, double& own) { own *= left(i) * right(j); });
}

double GroupedMatrix::norm() const {
    double squares = 0;
    for (const Group& group : groups_) squares += group.block.squaredNorm();
    return std::sqrt(squares);
}

double GroupedMatrix::largest() const {
    double largest = 0;
    for (const Group& group : groups_) largest = std::max(largest, group.block.cwiseAbs().maxCoeff());
    return largest;
}

bool GroupedMatrix::solve(Matrix& X) const {
    require_size("grouped matrix", "rows of the right side", X, rows(), X.cols());
    for (const Group& group : groups_) {
        LuFactors factors(group.block.rows());
        factors.matrix() = group.block;
        factors.factorise();
        if (!factors.regular()) return false;
        Matrix own = X(group.rows, Eigen::all);
        factors.solve(own);
        X(group.rows, Eigen::all) = own;
    }
    return X.allFinite();
}

bool GroupedMatrix::all_finite() const {
    return std::ranges::all_of(groups_, [](const Group& group) { return group.block.allFinite(); });
}

}  // namespace cardan::solvers
