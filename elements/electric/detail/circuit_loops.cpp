#include "elements/electric/detail/circuit_loops.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>
#include <numeric>

namespace cardan::detail {

namespace {

// Edges of the tree that grows; the path between two nodes of it.
class Forest {
public:
    Forest(const std::vector<CircuitEdge>& edges, int nodes) : edges_(&edges), at_(static_cast<std::size_t>(nodes)) {}

    void add(std::size_t edge) {
        entry(at_, (*edges_)[edge].from).push_back(edge);
        entry(at_, (*edges_)[edge].to).push_back(edge);
    }
    /// Adds +1 or -1 for each edge on the way from a to b to a column.  @return false: there is no way
    template <class Column>
    bool walk(int a, int b, int behind, Column&& column) const {
        if (a == b) return true;
        for (const std::size_t edge : entry(at_, a)) {
            const CircuitEdge& own = (*edges_)[edge];
            const int next = own.from == a ? own.to : own.from;
            if (next == behind || !walk(next, b, a, column)) continue;
            column(static_cast<Eigen::Index>(edge)) += own.from == a ? 1 : -1;
            return true;
        }
        return false;
    }

private:
    const std::vector<CircuitEdge>* edges_;
    std::vector<std::vector<std::size_t>> at_;  // of each node
};

}  // namespace

CircuitLoops circuit_loops(const std::vector<CircuitEdge>& edges, int nodes) {
    std::vector<std::size_t> order(edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t edge) { return edges[edge].rank; });
    Forest tree(edges, nodes);
    CircuitLoops loops;
    const auto rows = static_cast<Eigen::Index>(edges.size());
    std::vector<Vector> columns;
    for (const std::size_t edge : order) {
        Vector column = Vector::Zero(rows);
        // From its end back to its beginning: the current of a link goes round.
        if (!tree.walk(edges[edge].to, edges[edge].from, -1, column)) {
            tree.add(edge);
            continue;
        }
        column(static_cast<Eigen::Index>(edge)) = 1;
        columns.push_back(std::move(column));
        loops.links.push_back(edge);
    }
    loops.B.resize(rows, std::ssize(columns));
    for (Eigen::Index k = 0; k < loops.B.cols(); ++k) loops.B.col(k) = entry(columns, k);
    return loops;
}

std::string CircuitLoops::path(std::size_t loop, const std::vector<CircuitEdge>& edges) const {
    std::string names;
    for (Eigen::Index row = 0; row < B.rows(); ++row) {
        if (B(row, static_cast<Eigen::Index>(loop)) == 0) continue;
        names += names.empty() ? "'" : ", '";
        names += entry(edges, row).name + "'";
    }
    return names;
}

}  // namespace cardan::detail
