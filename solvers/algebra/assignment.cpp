#include "solvers/algebra/assignment.hpp"

#include <limits>

namespace cardan::solvers {

namespace {

// rows <= columns. Potentials u (rows) and v (columns); every row is inserted along the cheapest augmenting path.
std::vector<int> assign_wide(const Matrix& cost) {
    const int rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
    const auto at = [](auto& list, int i) -> auto& {
        return list[static_cast<std::size_t>(i)];
    };
    std::vector<double> u(static_cast<std::size_t>(rows) + 1), v(static_cast<std::size_t>(columns) + 1);
    std::vector<int> row_of(v.size(), 0), previous(v.size(), 0);  // counted from 1; 0: none
    for (int row = 1; row <= rows; ++row) {
        std::vector<double> shortest(v.size(), std::numeric_limits<double>::infinity());
        std::vector<bool> reached(v.size(), false);
        int column = 0;
        row_of[0] = row;
        do {
            reached[static_cast<std::size_t>(column)] = true;
            const int from = at(row_of, column);
            double step = std::numeric_limits<double>::infinity();
            int next = 0;
            for (int j = 1; j <= columns; ++j) {
                if (reached[static_cast<std::size_t>(j)]) continue;
                const double reduced = cost(from - 1, j - 1) - at(u, from) - at(v, j);
                if (reduced < at(shortest, j)) at(shortest, j) = reduced, at(previous, j) = column;
                if (at(shortest, j) < step) step = at(shortest, j), next = j;
            }
            for (int j = 0; j <= columns; ++j) {
                if (reached[static_cast<std::size_t>(j)])
                    at(u, at(row_of, j)) += step, at(v, j) -= step;
                else
                    at(shortest, j) -= step;
            }
            column = next;
        } while (at(row_of, column) != 0);
        for (; column != 0; column = at(previous, column)) at(row_of, column) = at(row_of, at(previous, column));
    }
    std::vector<int> column_of(static_cast<std::size_t>(rows), -1);
    for (int j = 1; j <= columns; ++j)
        if (at(row_of, j) != 0) at(column_of, at(row_of, j) - 1) = j - 1;
    return column_of;
}

}  // namespace

std::vector<int> assign(const Matrix& score) {
    if (score.rows() <= score.cols()) return assign_wide(-score);
    const std::vector<int> row_of = assign_wide(-score.transpose());
    std::vector<int> column_of(static_cast<std::size_t>(score.rows()), -1);
    for (std::size_t j = 0; j < row_of.size(); ++j)
        column_of[static_cast<std::size_t>(row_of[j])] = static_cast<int>(j);
    return column_of;
}

}  // namespace cardan::solvers
