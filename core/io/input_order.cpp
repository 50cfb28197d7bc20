#include "core/io/input_order.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/io/rank_parts.hpp"

namespace vocalis::io {

namespace {

/// Where each item comes to stand when they are sorted.
template <class Less>
std::vector<std::int64_t> places(std::size_t count, const Less& less) {
  std::vector<std::int64_t> order(count), place(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), less);
  for (std::size_t i = 0; i < count; ++i) place[order[i]] = static_cast<std::int64_t>(i);
  return place;
}

/// Rows that stand in the order of ranks, at their places; and back.
template <class T>
std::vector<T> to_places(const std::vector<std::int64_t>& place, const std::vector<T>& rows, int width) {
  std::vector<T> result(rows.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    std::copy_n(rows.begin() + i * width, width, result.begin() + place[i] * width);
  }
  return result;
}

template <class T>
std::vector<T> from_places(const std::vector<std::int64_t>& place, const std::vector<T>& rows, int width) {
  std::vector<T> result(rows.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    std::copy_n(rows.begin() + place[i] * width, width, result.begin() + i * width);
  }
  return result;
}

std::vector<std::int64_t> times(std::vector<std::int64_t> counts, int width) {
  for (std::int64_t& count : counts) count *= width;
  return counts;
}

}  // namespace

InputOrder::InputOrder(const mesh::Mesh& mesh)
    : mesh_(mesh),
      vertex_counts_(base::gather_all(mesh.comm, static_cast<std::int64_t>(mesh.vertices.num_owned))),
      cell_counts_(base::gather_all(mesh.comm, static_cast<std::int64_t>(mesh.num_cells()))) {
  const std::size_t corners = mesh.dimension + 1;
  const auto inputs =
      gather_to_first<std::int64_t>(mesh.comm, std::span(mesh.vertex_input).first(mesh.vertices.num_owned));
  std::vector<std::int64_t> mine;
  for (const std::int32_t vertex : mesh.cell_vertices) mine.push_back(mesh.vertices.to_global(vertex));
  std::vector<std::int64_t> cells = gather_to_first<std::int64_t>(mesh.comm, mine);
  vertex_place_ = places(inputs.size(), [&](std::int64_t a, std::int64_t b) { return inputs[a] < inputs[b]; });
  // A vertex' global number is its place in the order of ranks.
  for (std::int64_t& vertex : cells) vertex = vertex_place_[vertex];
  const auto row = [&](std::int64_t cell) { return cells.begin() + cell * static_cast<std::int64_t>(corners); };
  const auto num_cells = static_cast<std::int64_t>(cells.size() / corners);
  for (std::int64_t cell = 0; cell < num_cells; ++cell) std::sort(row(cell), row(cell + 1));
  cell_place_ = places(num_cells, [&](std::int64_t a, std::int64_t b) {
    return std::lexicographical_compare(row(a), row(a + 1), row(b), row(b + 1));
  });
  cells_ = to_places(cell_place_, cells, static_cast<int>(corners));
}

std::vector<double> InputOrder::gather(std::span<const double> values, int components) const {
  assert(values.size() == static_cast<std::size_t>(mesh_.num_vertices()) * components);
  const auto owned = values.first(static_cast<std::size_t>(mesh_.vertices.num_owned) * components);
  return to_places(vertex_place_, gather_to_first(mesh_.comm, owned), components);
}

std::vector<double> InputOrder::scatter(const std::vector<double>& all, int components) const {
  std::vector<double> values =
      scatter_from_first(mesh_.comm, times(vertex_counts_, components), from_places(vertex_place_, all, components));
  values.resize(static_cast<std::size_t>(mesh_.num_vertices()) * components);
  mesh_.vertex_halo.copy_to_ghosts(values, components);
  return values;
}

std::vector<char> InputOrder::gather_marks(std::span<const char> marks) const {
  return to_places(cell_place_, gather_to_first(mesh_.comm, marks), 1);
}

std::vector<char> InputOrder::scatter_marks(const std::vector<char>& all) const {
  return scatter_from_first(mesh_.comm, cell_counts_, from_places(cell_place_, all, 1));
}

}  // namespace vocalis::io
