#include "acoustic_solver/yielding_walls.hpp"

#include <algorithm>
#include <set>

#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

YieldingWalls::YieldingWalls(const mesh::Mesh& mesh, const WaveOperator& wave) : mesh_(&mesh), wave_(&wave) {
  std::vector<std::set<std::int32_t>> vertices(wave.wall_branches().size());
  for_each_facet([&](const BoundaryFacet& facet, const std::int32_t* corners, int count) {
    vertices[facet.wall].insert(corners, corners + count);
  });
  for (std::size_t b = 0; b < vertices.size(); ++b) {
    if (wave.wall_branches()[b].empty()) continue;
    Wall wall{b, num_numbers_, {vertices[b].begin(), vertices[b].end()}, wave.wall_branches()[b]};
    num_numbers_ += 2 * wall.vertices.size() * wall.branches.size();
    walls_.push_back(std::move(wall));
  }
}

template <class Function>
void YieldingWalls::for_each_facet(const Function& function) const {
  for (const BoundaryFacet& facet : wave_->facets()) {
    if (facet.wall < 0) continue;
    const auto vertices = mesh_->vertices_of(facet.cell);
    std::int32_t corners[3];
    int count = 0;
    for (int i = 0; i <= mesh_->dimension; ++i) {
      if (i != facet.index) corners[count++] = vertices[i];
    }
    function(facet, corners, count);
  }
}

void YieldingWalls::prepare(Unknowns& unknowns) const {
  if (unknowns.wall_motion.size() != num_numbers_) unknowns.wall_motion.assign(num_numbers_, 0.0);
}

int YieldingWalls::numbers_a_vertex() const {
  std::size_t count = 0;
  for (const Wall& wall : walls_) count += 2 * wall.branches.size();
  return static_cast<int>(count);
}

std::vector<double> YieldingWalls::motion_of_vertices(const Unknowns& unknowns) const {
  const int n = numbers_a_vertex(), here = base::rank(mesh_->comm);
  std::vector<double> of_vertices(static_cast<std::size_t>(mesh_->num_vertices()) * n, 0.0);
  int column = 0;
  for (const Wall& wall : walls_) {
    // One rank gives the motion at a vertex, the lowest with a facet there: the sum has one term and is exact.
    std::vector<std::int32_t> giver(mesh_->num_vertices(), base::size(mesh_->comm));
    for (const std::int32_t v : wall.vertices) giver[v] = here;
    mesh_->vertex_halo.min_to_owners(giver);
    mesh_->vertex_halo.copy_to_ghosts(giver);
    const double* motion = unknowns.wall_motion.data() + wall.first;
    for (std::size_t b = 0; b < wall.branches.size(); ++b, column += 2) {
      for (const std::int32_t v : wall.vertices) {
        if (giver[v] == here) std::copy_n(motion, 2, of_vertices.begin() + static_cast<std::ptrdiff_t>(v) * n + column);
        motion += 2;
      }
    }
  }
  mesh_->vertex_halo.add_to_owners(of_vertices, n);
  mesh_->vertex_halo.copy_to_ghosts(of_vertices, n);
  return of_vertices;
}

void YieldingWalls::take_motion(std::span<const double> of_vertices, Unknowns& unknowns) const {
  const int n = numbers_a_vertex();
  prepare(unknowns);
  int column = 0;
  for (const Wall& wall : walls_) {
    double* motion = unknowns.wall_motion.data() + wall.first;
    for (std::size_t b = 0; b < wall.branches.size(); ++b, column += 2) {
      for (const std::int32_t v : wall.vertices) {
        std::copy_n(of_vertices.begin() + static_cast<std::ptrdiff_t>(v) * n + column, 2, motion);
        motion += 2;
      }
    }
  }
}

double YieldingWalls::branch_velocity(const WallBranch& branch, double beta, double pressure, const double* motion) {
  const double force = pressure + branch.mass / beta * motion[0] - branch.stiffness * motion[1];
  return branch.step_admittance(beta) * force;
}

std::vector<std::vector<double>> YieldingWalls::velocities(double beta, std::span<const double> pressure,
                                                           const Unknowns& beginning) const {
  std::vector<std::vector<double>> result(wave_->wall_branches().size());
  for (const Wall& wall : walls_) {
    std::vector<double>& velocity = result[wall.boundary];
    velocity.assign(mesh_->num_vertices(), 0.0);
    const double* motion = beginning.wall_motion.data() + wall.first;
    for (const WallBranch& branch : wall.branches) {
      for (const std::int32_t v : wall.vertices) {
        velocity[v] += branch_velocity(branch, beta, pressure[v], motion);
        motion += 2;
      }
    }
  }
  return result;
}

void YieldingWalls::add_forces(double beta, std::span<const double> pressure, const Unknowns& beginning,
                               std::span<double> sums) const {
  if (walls_.empty()) return;
  const auto velocity = velocities(beta, pressure, beginning);
  for_each_facet([&](const BoundaryFacet& facet, const std::int32_t* corners, int count) {
    const double weight = wave_->facet_weight(facet);
    const std::vector<double>& here = velocity[facet.wall];
    double total = 0;
    for (int i = 0; i < count; ++i) total += here[corners[i]];
    for (int i = 0; i < count; ++i) sums[corners[i]] -= weight * (total + here[corners[i]]);
  });
}

void YieldingWalls::advance(double beta, std::span<const double> pressure, Unknowns& unknowns) const {
  for (const Wall& wall : walls_) {
    double* motion = unknowns.wall_motion.data() + wall.first;
    for (const WallBranch& branch : wall.branches) {
      for (const std::int32_t v : wall.vertices) {
        motion[0] = branch_velocity(branch, beta, pressure[v], motion);
        motion[1] += beta * motion[0];
        motion += 2;
      }
    }
  }
}

double YieldingWalls::energy(const Unknowns& unknowns) const {
  double result = 0;
  for (const Wall& wall : walls_) {
    const double* motion = unknowns.wall_motion.data() + wall.first;
    for (const WallBranch& branch : wall.branches) {
      std::vector<double> velocity(mesh_->num_vertices(), 0.0), displacement(mesh_->num_vertices(), 0.0);
      for (const std::int32_t v : wall.vertices) {
        velocity[v] = motion[0];
        displacement[v] = motion[1];
        motion += 2;
      }
      for_each_facet([&](const BoundaryFacet& facet, const std::int32_t* corners, int count) {
        if (static_cast<std::size_t>(facet.wall) != wall.boundary) return;
        const double weight = 0.5 * wave_->facet_weight(facet);
        for (int i = 0; i < count; ++i) {
          for (int j = 0; j < count; ++j) {
            result += (i == j ? 2 : 1) * weight *
                      (branch.mass * velocity[corners[i]] * velocity[corners[j]] +
                       branch.stiffness * displacement[corners[i]] * displacement[corners[j]]);
          }
        }
      });
    }
  }
  return base::sum(mesh_->comm, result);
}

}  // namespace vocalis::acoustic
