#include "acoustic_solver/pockets.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/base/mpi.hpp"
#include "transfer/fill.hpp"

namespace vocalis::acoustic {

namespace {

// Of the constants of more than two pockets that meet at once, towards their joint minimum.
constexpr int kRounds = 30;

/// What of a pocket of the mesh before lies in one pocket now, as all ranks know it.
struct Part {
  double now = 0, before = 0;  ///< names of the pockets
  double size = 0;             ///< vertices, over all ranks
  double is_bound = 0;         ///< not 0: ψ itself acts in it
};

/// How the constant of a pocket acts on ψ of the mesh now, and on K ψ.
struct Shift {
  std::vector<double> shape;      ///< (vertices) 1 in the pocket, carried on into the opened air; ghosts current
  std::vector<double> stiffness;  ///< (vertices) K shape, at the owners
  double self = 0;                ///< shape · K shape
};

double dot(const fem::Space& space, const std::vector<double>& a, const std::vector<double>& b) {
  return base::sum(space.mesh->comm, std::inner_product(a.begin(), a.begin() + space.dofs.num_owned, b.begin(), 0.0));
}

std::vector<double> stiffness_times(const WaveOperator& wave, const fem::Space& space, const std::vector<double>& x) {
  std::vector<double> sums(x.size(), 0.0);
  wave.add_stiffness(1, x, sums);
  space.halo.add_to_owners(sums);
  return sums;
}

/// All parts, in the same order on every rank. Collective.
std::vector<Part> list_parts(const PocketsBefore& before, const std::vector<std::int32_t>& now,
                             const fem::Space& space) {
  using Names = std::pair<std::int32_t, std::int32_t>;
  std::map<Names, Part> mine, all;
  const auto add = [](std::map<Names, Part>& parts, const Part& part) {
    Part& sum = parts[{static_cast<std::int32_t>(part.now), static_cast<std::int32_t>(part.before)}];
    sum = {part.now, part.before, sum.size + part.size, sum.is_bound + part.is_bound};
  };
  for (std::int32_t v = 0; v < space.dofs.num_owned; ++v) {
    if (before.name[v] < 0) continue;
    add(mine,
        {static_cast<double>(now[v]), static_cast<double>(before.name[v]), 1, static_cast<double>(before.is_bound[v])});
  }
  std::vector<double> rows;
  for (const auto& [names, part] : mine) rows.insert(rows.end(), {part.now, part.before, part.size, part.is_bound});
  rows = base::concatenate_all(space.mesh->comm, rows);
  for (std::size_t i = 0; i < rows.size(); i += 4) add(all, {rows[i], rows[i + 1], rows[i + 2], rows[i + 3]});
  std::vector<Part> result;
  for (const auto& [names, part] : all) result.push_back(part);
  return result;
}

/// The parts whose potential moves.
std::vector<Part> parts_to_move(const std::vector<Part>& parts) {
  std::vector<Part> result;
  for (const Part& part : parts) {
    const auto rules = [&part](const Part& other) {
      if (other.now != part.now || other.before == part.before) return false;
      if (other.is_bound != 0) return true;
      return other.size > part.size || (other.size == part.size && other.before < part.before);
    };
    if (part.is_bound == 0 && std::any_of(parts.begin(), parts.end(), rules)) result.push_back(part);
  }
  return result;
}

}  // namespace

std::vector<std::int32_t> find_pockets(const mesh::Mesh& mesh) {
  // Parts of this rank by union of the vertices of each cell; then their smallest numbers travel from rank to rank.
  std::vector<std::int32_t> parent(mesh.num_vertices());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&parent](std::int32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    for (const std::int32_t v : vertices) parent[root_of(v)] = root_of(vertices[0]);
  }
  std::vector<std::int32_t> names(mesh.vertex_input.begin(), mesh.vertex_input.end()), before;
  std::int32_t changed = 1;
  while (base::largest(mesh.comm, changed) > 0) {
    before = names;
    std::vector<std::int32_t> smallest = names;
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      std::int32_t& name = smallest[root_of(v)];
      name = std::min(name, names[v]);
    }
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) names[v] = smallest[root_of(v)];
    mesh.vertex_halo.min_to_owners(names);
    mesh.vertex_halo.copy_to_ghosts(names);
    changed = names != before;
  }
  return names;
}

void join_pockets(const PocketsBefore& before, const WaveOperator& wave, const fem::Space& space,
                  std::vector<double>& psi) {
  const std::vector<std::int32_t> now = find_pockets(*space.mesh);
  std::vector<std::int32_t> is_known;
  for (const std::int32_t name : before.name) is_known.push_back(name >= 0);
  std::vector<Shift> shifts;
  for (const Part& part : parts_to_move(list_parts(before, now, space))) {
    fem::Field shape(space, 1);
    for (std::size_t v = 0; v < psi.size(); ++v) {
      shape.values[v] = now[v] == part.now && before.name[v] == part.before;
    }
    transfer::fill(shape, is_known);
    Shift shift{shape.values, stiffness_times(wave, space, shape.values), 0};
    shift.self = dot(space, shift.shape, shift.stiffness);
    shifts.push_back(std::move(shift));
  }
  for (int round = 0; round < (shifts.size() > 1 ? kRounds : 1); ++round) {
    for (const Shift& shift : shifts) {
      const double constant = -dot(space, psi, shift.stiffness) / shift.self;
      for (std::size_t v = 0; v < psi.size(); ++v) psi[v] += constant * shift.shape[v];
    }
  }
}

}  // namespace vocalis::acoustic
