#include "solvers/algebra/assignment.hpp"

#include "mbs/base/entry.hpp"

#include <limits>

namespace cardan::solvers {

namespace {

// rows <= columns. Potentials u (rows) and v (columns); every row is inserted along the cheapest augmenting path.
std::vector<int> assign_wide(const Matrix& cost) {
    const int rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
    std::vector<double> u(static_cast<std::size_t>(rows) + 1), v(static_cast<std::size_t>(columns) + 1);
    std::vector<int> row_of(v.size(), 0), previous(v.size(), 0);  // counted from 1; 0: none
    for (int row = 1; row <= rows; ++row) {
        std::vector<double> shortest(v.size(), std::numeric_limits<double>::infinity());
        std::vector<bool> reached(v.size(), false);
        int column = 0;
        row_of[0] = row;
        do {
            entry(reached, column) = true;
            const int from = entry(row_of, column);
            double step = std::numeric_limits<double>::infinity();
            int next = 0;
            for (int j = 1; j <= columns; ++j) {
                if (entry(reached, j)) continue;
                const double reduced = cost(from - 1, j - 1) - entry(u, from) - entry(v, j);
                if (reduced < entry(shortest, j)) entry(shortest, j) = reduced, entry(previous, j) = column;
                if (entry(shortest, j) < step) step = entry(shortest, j), next = j;
            }
            for (int j = 0; j <= columns; ++j) {
                if (entry(reached, j))
                    entry(u, entry(row_of, j)) += step, entry(v, j) -= step;
                else
                    entry(shortest, j) -= step;
            }
            column = next;
        } while (entry(row_of, column) != 0);
        for (; column != 0; column = entry(previous, column))
            entry(row_of, column) = entry(row_of, entry(previous, column));
    }
    std::vector<int> column_of(static_cast<std::size_t>(rows), -1);
    for (int j = 1; j <= columns; ++j)
        if (entry(row_of, j) != 0) entry(column_of, entry(row_of, j) - 1) = j - 1;
    return column_of;
}

}  // namespace

std::vector<int> assign(const Matrix& score) {
    if (score.rows() <= score.cols()) return assign_wide(-score);
    const std::vector<int> row_of = assign_wide(-score.transpose());
    std::vector<int> column_of(static_cast<std::size_t>(score.rows()), -1);
    for (std::size_t j = 0; j < row_of.size(); ++j) entry(column_of, row_of[j]) = static_cast<int>(j);
    return column_of;
}

}  // namespace cardan::solvers
