#include "transfer/fill.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::transfer {

namespace {

// Enough to be near rest some four cells deep; always as many, so that the result does not depend on rounding.
constexpr int kSweeps = 32;

/// Gives each vertex that is not fixed the mean of its neighbours that have a value; whether any of them, on any rank,
/// had none before. Collective.
bool sweep(fem::Field& field, const std::vector<std::int32_t>& is_fixed, std::vector<std::int32_t>& has_value) {
  const mesh::Mesh& mesh = *field.space->mesh;
  const int n = field.components;
  // Sums of neighbours and their number; each edge counts once, on the rank that owns it.
  std::vector<double> sums(static_cast<std::size_t>(mesh.num_vertices()) * (n + 1), 0.0);
  for (std::int32_t edge = 0; edge < mesh.edges.num_owned; ++edge) {
    const std::int32_t* ends = mesh.edge_vertices.data() + 2 * static_cast<std::size_t>(edge);
    for (int i = 0; i < 2; ++i) {
      const std::int32_t here = ends[i], other = ends[1 - i];
      if (is_fixed[here] || !has_value[other]) continue;
      double* sum = sums.data() + static_cast<std::size_t>(here) * (n + 1);
      for (int c = 0; c < n; ++c) sum[c] += field.at(other)[c];
      sum[n] += 1;
    }
  }
  mesh.vertex_halo.add_to_owners(sums, n + 1);
  mesh.vertex_halo.copy_to_ghosts(sums, n + 1);
  std::int32_t has_grown = 0;
  for (std::int32_t i = 0; i < mesh.num_vertices(); ++i) {
    const double* sum = sums.data() + static_cast<std::size_t>(i) * (n + 1);
    if (is_fixed[i] || sum[n] == 0) continue;
    for (int c = 0; c < n; ++c) field.at(i)[c] = sum[c] / sum[n];
    if (!has_value[i]) has_grown = 1;
    has_value[i] = 1;
  }
  return base::largest(mesh.comm, has_grown) > 0;
}

}  // namespace

void fill(fem::Field& field, const std::vector<std::int32_t>& is_known) {
  for (std::int32_t i = 0; i < field.space->num_dofs(); ++i) {
    if (!is_known[i]) std::fill_n(field.at(i), field.components, 0.0);
  }
  std::vector<std::int32_t> has_value = is_known;
  if (!sweep(field, is_known, has_value)) return;
  bool has_grown = true;
  for (int sweeps = 1; has_grown || sweeps < kSweeps; ++sweeps) has_grown = sweep(field, is_known, has_value);
}

}  // namespace vocalis::transfer
