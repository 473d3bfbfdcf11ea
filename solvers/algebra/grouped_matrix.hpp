/// @file
/// Square matrices whose rows couple within groups only, as those of local states do.
#pragma once

#include "mbs/base/types.hpp"

#include <vector>

namespace cardan::solvers {

/// A square matrix kept as one dense block for every group of rows that couple with one another, directly or through
/// others; it is zero elsewhere. Local states, such as those of the air on a section, make many small groups.
class GroupedMatrix {
public:
    struct Group {
        std::vector<Eigen::Index> rows;
        Matrix block;
    };

    GroupedMatrix() = default;
    /// Takes the groups of A. Implicit: a dense matrix is one of these.
    GroupedMatrix(const Matrix& A) { set(A); }  // NOLINT(google-explicit-constructor)

    Eigen::Index rows() const { return static_cast<Eigen::Index>(places_.size()); }
    const std::vector<Group>& groups() const { return groups_; }
    /// Takes the entries of a square matrix. The groups stay, and nothing is allocated, if it has the same size and is
    /// zero outside of them; otherwise they become its own.
    void set(const Matrix& A);
    /// Makes the groups so large that every one of these sets of rows is within one. Allocates nothing if they are.
    void join(const std::vector<std::vector<int>>& sets);
    /// The block of a group, to be changed.
    Matrix& block(std::size_t group) { return groups_[group].block; }
    /// Place of a row.
    std::size_t group_of(Eigen::Index row) const;
    Eigen::Index place_in_group(Eigen::Index row) const;

    Matrix dense() const;
    Vector diagonal() const;
    /// Adds factor times another matrix, whose groups are joined to these.
    void add(const GroupedMatrix& other, double factor = 1);
    GroupedMatrix& operator*=(double factor);
    GroupedMatrix& operator/=(double divisor) { return *this *= 1 / divisor; }
    /// Multiplies row i by left(i) and column j by right(j).
    void scale(const Vector& left, const Vector& right);
    double norm() const;     ///< Frobenius
    double largest() const;  ///< of the magnitudes; 0 if it is empty
    bool all_finite() const;

    /// X := A^-1 X, group by group. @returns false if the matrix is singular, or the result not finite
    bool solve(Matrix& X) const;

private:
    struct Place {
        std::size_t group;
        Eigen::Index in_group;
    };
    void set_groups(std::vector<std::vector<Eigen::Index>> groups);
    bool covers(const Matrix& A) const;
    void add(const Group& part, double factor);

    std::vector<Group> groups_;
    std::vector<Place> places_;  // by row
};

}  // namespace cardan::solvers
