#include "transfer/point_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/mesh/cell_tree.hpp"

namespace vocalis::transfer {

namespace {

using Point = std::array<double, 3>;

double longest_edge(const mesh::Mesh& mesh, std::int32_t cell) {
  double square = 0;
  const auto vertices = mesh.vertices_of(cell);
  for (const auto& [a, b] : mesh::edges_of_cell(mesh.dimension)) {
    double edge = 0;
    for (int k = 0; k < mesh.dimension; ++k) {
      edge += std::pow(mesh.point(vertices[a])[k] - mesh.point(vertices[b])[k], 2);
    }
    square = std::max(square, edge);
  }
  return std::sqrt(square);
}

/// Collective.
double longest_edge(const mesh::Mesh& mesh, std::span<const std::int32_t> cell_counts) {
  double result = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (cell_counts.empty() || cell_counts[cell]) result = std::max(result, longest_edge(mesh, cell));
  }
  return base::largest(mesh.comm, result);
}

/// The box around the cells of each rank. Collective.
std::vector<mesh::Box> boxes_of_ranks(MPI_Comm comm, const mesh::Box& mine) {
  std::vector<double> numbers(mine.low.begin(), mine.low.end());
  numbers.insert(numbers.end(), mine.high.begin(), mine.high.end());
  const std::vector<double> all = base::concatenate_all(comm, numbers);
  std::vector<mesh::Box> boxes(all.size() / 6);
  for (std::size_t r = 0; r < boxes.size(); ++r) {
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(6 * r), 3, boxes[r].low.begin());
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(6 * r + 3), 3, boxes[r].high.begin());
  }
  return boxes;
}

/// All that ranks were asked so far, and what they found.
class Questions {
 public:
  Questions(const mesh::Mesh& mesh, std::span<const std::int32_t> cell_counts)
      : mesh_(mesh),
        tree_(mesh, cell_counts),
        boxes_(boxes_of_ranks(mesh.comm, tree_.box())),
        longest_(longest_edge(mesh, cell_counts)) {}

  double longest() const { return longest_; }

  /// Asks the ranks whose boxes are within reach of the points that have no holder yet. Places are those among all
  /// answers. Collective.
  void ask(const std::vector<Point>& points, double reach, std::vector<Holder>& holders) {
    std::vector<std::vector<std::int32_t>> asked(boxes_.size());
    std::vector<std::vector<double>> lists(boxes_.size());
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (holders[j].rank >= 0) continue;
      for (std::size_t r = 0; r < boxes_.size(); ++r) {
        // The box of a point on it may be off by rounding.
        if (boxes_[r].distance(points[j]) > reach + 1e-9 * longest_) continue;
        asked[r].push_back(static_cast<std::int32_t>(j));
        lists[r].insert(lists[r].end(), points[j].begin(), points[j].end());
      }
    }
    std::vector<std::vector<double>> answers(boxes_.size());
    const auto received = base::exchange(mesh_.comm, lists);
    for (std::size_t r = 0; r < received.size(); ++r) answers[r] = answer(received[r], reach);
    const auto replies = base::exchange(mesh_.comm, answers);
    for (std::size_t r = 0; r < replies.size(); ++r) {
      for (std::size_t i = 0; i < asked[r].size(); ++i)
        take(replies[r].data() + 3 * i, static_cast<int>(r), holders[asked[r][i]]);
    }
  }

  const HeldPoint& found(std::int64_t place) const { return found_[place]; }

 private:
  /// Distance, size of the cell and place of each point; an infinite distance where there is nothing within reach.
  std::vector<double> answer(const std::vector<double>& points, double reach) {
    std::vector<double> result;
    for (std::size_t i = 0; i < points.size(); i += 3) {
      const auto nearest = tree_.nearest({points[i], points[i + 1], points[i + 2]}, reach);
      if (nearest.cell < 0) {
        result.insert(result.end(), {std::numeric_limits<double>::infinity(), 0, -1});
        continue;
      }
      result.insert(result.end(),
                    {nearest.closest.distance, longest_edge(mesh_, nearest.cell), static_cast<double>(found_.size())});
      found_.push_back({nearest.cell, nearest.closest.barycentric});
    }
    return result;
  }

  static void take(const double* reply, int rank, Holder& holder) {
    const bool is_better = holder.rank < 0 ? std::isfinite(reply[0]) : reply[0] < holder.distance;
    if (is_better) holder = {rank, static_cast<std::int64_t>(reply[2]), reply[0], reply[1]};
  }

  const mesh::Mesh& mesh_;
  mesh::CellTree tree_;
  std::vector<mesh::Box> boxes_;
  double longest_;
  std::vector<HeldPoint> found_;
};

/// Keeps of all answers those that were taken; places become those in the list that is left. Collective.
std::vector<HeldPoint> keep_taken(MPI_Comm comm, const Questions& questions, std::vector<Holder>& holders) {
  std::vector<std::vector<std::int64_t>> taken(base::size(comm)), starts(base::size(comm));
  for (Holder& holder : holders) {
    if (holder.rank < 0) continue;
    taken[holder.rank].push_back(holder.place);
    holder.place = static_cast<std::int64_t>(taken[holder.rank].size()) - 1;
  }
  const auto received = base::exchange(comm, taken);
  std::vector<HeldPoint> held;
  for (std::size_t r = 0; r < received.size(); ++r) {
    starts[r] = {static_cast<std::int64_t>(held.size())};
    for (const std::int64_t place : received[r]) held.push_back(questions.found(place));
  }
  const auto start = base::exchange(comm, starts);
  for (Holder& holder : holders) {
    if (holder.rank >= 0) holder.place += start[holder.rank].front();
  }
  return held;
}

}  // namespace

PointSearch search_points(const mesh::Mesh& mesh, std::span<const double> points,
                          std::span<const std::int32_t> cell_counts) {
  const std::size_t d = mesh.dimension;
  std::vector<Point> mine(points.size() / d, Point{0, 0, 0});
  for (std::size_t j = 0; j < mine.size(); ++j)
    std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(j * d), d, mine[j].begin());
  PointSearch search;
  search.holders.resize(mine.size());
  Questions questions(mesh, cell_counts);
  questions.ask(mine, 0, search.holders);
  questions.ask(mine, questions.longest(), search.holders);
  search.held = keep_taken(mesh.comm, questions, search.holders);
  return search;
}

}  // namespace vocalis::transfer
