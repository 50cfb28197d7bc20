#include "acoustic_solver/row_order.hpp"

#include <algorithm>

namespace vocalis::acoustic {

namespace {

struct Search {
  std::span<const std::int32_t> starts, columns;
  std::vector<char> reached;
  std::vector<std::int32_t> order;

  std::int32_t degree(std::int32_t node) const { return starts[node + 1] - starts[node]; }

  /// Appends the nodes that are connected to `root`, breadth first, neighbours by their degrees.
  void visit(std::int32_t root) {
    std::size_t next = order.size();
    reached[root] = 1;
    order.push_back(root);
    for (; next < order.size(); ++next) {
      const std::size_t first = order.size();
      for (std::int32_t k = starts[order[next]]; k < starts[order[next] + 1]; ++k) {
        const std::int32_t node = columns[k];
        if (node >= static_cast<std::int32_t>(reached.size()) || reached[node]) continue;
        reached[node] = 1;
        order.push_back(node);
      }
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(),
                [this](std::int32_t a, std::int32_t b) { return std::pair(degree(a), a) < std::pair(degree(b), b); });
    }
  }
};

}  // namespace

std::vector<std::int32_t> reverse_cuthill_mckee(std::span<const std::int32_t> starts,
                                                std::span<const std::int32_t> columns) {
  const auto num_nodes = static_cast<std::int32_t>(starts.size()) - 1;
  Search search = {starts, columns, std::vector<char>(num_nodes, 0), {}};
  search.order.reserve(num_nodes);
  for (std::int32_t node = 0; node < num_nodes; ++node) {
    if (search.reached[node]) continue;
    // The last node of a search lies at an end of its component: levels from there are narrow. What the first search
    // reached is searched again.
    const std::size_t before = search.order.size();
    search.visit(node);
    const std::int32_t end = search.order.back();
    for (std::size_t i = before; i < search.order.size(); ++i) search.reached[search.order[i]] = 0;
    search.order.resize(before);
    search.visit(end);
  }
  std::reverse(search.order.begin(), search.order.end());
  return search.order;
}

}  // namespace vocalis::acoustic
