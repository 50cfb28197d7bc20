#include "core/io/input_order.hpp"

#include <algorithm>
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

InputOrder::InputOrder(const mesh::Mesh& mesh) : mesh_(mesh) {
  const auto inputs =
      gather_to_first<std::int64_t>(mesh.comm, std::span(mesh.vertex_input).first(mesh.vertices.num_owned));
  vertices_.counts = base::gather_all(mesh.comm, static_cast<std::int64_t>(mesh.vertices.num_owned));
  vertices_.place = places(inputs.size(), [&](std::int64_t a, std::int64_t b) { return inputs[a] < inputs[b]; });
  edges_ = sorted(mesh.edges, mesh.edge_vertices, 2);
  cells_ = sorted(mesh.cells, mesh.cell_vertices, mesh.dimension + 1);
}

InputOrder::Entities InputOrder::sorted(const base::IndexMap& map, std::span<const std::int32_t> vertices,
                                        int corners) const {
  std::vector<std::int64_t> mine;
  for (const std::int32_t vertex : vertices.first(static_cast<std::size_t>(map.num_owned) * corners)) {
    mine.push_back(mesh_.vertices.to_global(vertex));
  }
  std::vector<std::int64_t> all = gather_to_first<std::int64_t>(mesh_.comm, mine);
  // A vertex' global number is its place in the order of ranks.
  for (std::int64_t& vertex : all) vertex = vertices_.place[vertex];
  const auto row = [&](std::int64_t item) { return all.begin() + item * corners; };
  const auto count = static_cast<std::int64_t>(all.size()) / corners;
  for (std::int64_t item = 0; item < count; ++item) std::sort(row(item), row(item + 1));
  Entities result;
  result.counts = base::gather_all(mesh_.comm, static_cast<std::int64_t>(map.num_owned));
  result.place = places(count, [&](std::int64_t a, std::int64_t b) {
    return std::lexicographical_compare(row(a), row(a + 1), row(b), row(b + 1));
  });
  result.vertices = to_places(result.place, all, corners);
  return result;
}

std::vector<double> InputOrder::gather(std::span<const double> values, int components, Place where) const {
  const std::int32_t owned = where == Place::edges ? mesh_.edges.num_owned : mesh_.vertices.num_owned;
  const auto mine = values.first(static_cast<std::size_t>(owned) * components);
  return to_places(at(where).place, gather_to_first(mesh_.comm, mine), components);
}

std::vector<double> InputOrder::scatter(const std::vector<double>& all, int components, Place where) const {
  const bool on_edges = where == Place::edges;
  std::vector<double> values = scatter_from_first(mesh_.comm, times(at(where).counts, components),
                                                  from_places(at(where).place, all, components));
  const std::int32_t local = on_edges ? mesh_.edges.num_local() : mesh_.num_vertices();
  values.resize(static_cast<std::size_t>(local) * components);
  (on_edges ? mesh_.edge_halo : mesh_.vertex_halo).copy_to_ghosts(values, components);
  return values;
}

std::vector<char> InputOrder::gather_marks(std::span<const char> marks) const {
  return to_places(cells_.place, gather_to_first(mesh_.comm, marks), 1);
}

std::vector<char> InputOrder::scatter_marks(const std::vector<char>& all) const {
  return scatter_from_first(mesh_.comm, cells_.counts, from_places(cells_.place, all, 1));
}

}  // namespace vocalis::io
