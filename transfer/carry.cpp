#include "transfer/carry.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/base/mpi.hpp"

namespace vocalis::transfer {

namespace {

std::vector<std::int32_t> identity(std::int32_t count) {
  std::vector<std::int32_t> result(count);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

/// The parent's local vertices that a mesh has, on any rank. Collective.
std::vector<std::int32_t> mark_anywhere(const mesh::Mesh& parent, const std::vector<std::int32_t>& to_parent) {
  std::vector<std::int32_t> marks(parent.num_vertices(), 0);
  for (const std::int32_t vertex : to_parent) marks[vertex] = 1;
  parent.vertex_halo.max_to_owners(marks);
  parent.vertex_halo.copy_to_ghosts(marks);
  return marks;
}

bool on_all_ranks(MPI_Comm comm, bool condition) {
  return base::smallest(comm, static_cast<std::int32_t>(condition)) == 1;
}

bool is_one_per_vertex(const fem::Space& space, std::size_t num_vertices) {
  return space.degree == 1 && static_cast<std::size_t>(space.num_dofs()) == num_vertices;
}

}  // namespace

SharedVertices SharedVertices::from_parent(const mesh::Mesh& parent, const StrippedMesh& to) {
  return {parent, identity(parent.num_vertices()), parent.vertices.num_owned, to.vertex_to_parent,
          to.mesh.vertices.num_owned};
}

SharedVertices SharedVertices::to_parent(const mesh::Mesh& parent, const StrippedMesh& from) {
  return {parent, from.vertex_to_parent, from.mesh.vertices.num_owned, identity(parent.num_vertices()),
          parent.vertices.num_owned};
}

SharedVertices SharedVertices::between(const mesh::Mesh& parent, const StrippedMesh& from, const StrippedMesh& to) {
  return {parent, from.vertex_to_parent, from.mesh.vertices.num_owned, to.vertex_to_parent, to.mesh.vertices.num_owned};
}

SharedVertices::SharedVertices(const mesh::Mesh& parent, std::vector<std::int32_t> from_to_parent,
                               std::int32_t from_owned, std::vector<std::int32_t> to_to_parent, std::int32_t to_owned)
    : parent_(&parent),
      from_to_parent_(std::move(from_to_parent)),
      to_to_parent_(std::move(to_to_parent)),
      from_owned_(from_owned),
      to_owned_(to_owned) {
  std::vector<std::int32_t> parent_to_from(parent.num_vertices(), -1), parent_is_to_here(parent.num_vertices(), 0);
  for (std::size_t i = 0; i < from_to_parent_.size(); ++i) {
    parent_to_from[from_to_parent_[i]] = static_cast<std::int32_t>(i);
  }
  for (const std::int32_t vertex : to_to_parent_) parent_is_to_here[vertex] = 1;
  const std::vector<std::int32_t> is_from = mark_anywhere(parent, from_to_parent_);
  const std::vector<std::int32_t> is_to = mark_anywhere(parent, to_to_parent_);
  bool fields_are_local = true;
  for (const std::int32_t vertex : to_to_parent_) {
    to_to_from_.push_back(parent_to_from[vertex]);
    is_shared_.push_back(is_from[vertex]);
    if (is_from[vertex] && parent_to_from[vertex] < 0) fields_are_local = false;
  }
  fields_are_local_ = on_all_ranks(parent.comm, fields_are_local);
  loads_are_local_ =
      on_all_ranks(parent.comm, std::all_of(from_to_parent_.begin(), from_to_parent_.end(),
                                            [&](auto vertex) { return !is_to[vertex] || parent_is_to_here[vertex]; }));
}

void SharedVertices::carry(const fem::Field& from, fem::Field& to, double otherwise) const {
  assert(is_one_per_vertex(*from.space, from_to_parent_.size()) && is_one_per_vertex(*to.space, to_to_parent_.size()));
  assert(from.components == to.components);
  const int n = from.components;
  std::vector<double> meeting;
  if (!fields_are_local_) {
    // One rank alone, the owner in `from`, gives the value: the sum has one term and is exact.
    meeting.assign(static_cast<std::size_t>(parent_->num_vertices()) * n, 0.0);
    for (std::int32_t i = 0; i < from_owned_; ++i) std::copy_n(from.at(i), n, meeting.begin() + from_to_parent_[i] * n);
    parent_->vertex_halo.add_to_owners(meeting, n);
    parent_->vertex_halo.copy_to_ghosts(meeting, n);
  }
  for (std::int32_t i = 0; i < to.space->num_dofs(); ++i) {
    if (!is_shared_[i]) {
      std::fill_n(to.at(i), n, otherwise);
    } else {
      std::copy_n(fields_are_local_ ? from.at(to_to_from_[i]) : meeting.data() + to_to_parent_[i] * n, n, to.at(i));
    }
  }
}

void SharedVertices::carry(const fem::Load& from, fem::Load& to) const {
  assert(is_one_per_vertex(*from.space, from_to_parent_.size()) && is_one_per_vertex(*to.space, to_to_parent_.size()));
  assert(from.components == to.components);
  const int n = from.components;
  std::fill(to.values.begin(), to.values.end(), 0.0);
  if (loads_are_local_) {
    for (std::int32_t i = 0; i < to.space->num_dofs(); ++i) {
      if (to_to_from_[i] >= 0) std::copy_n(from.at(to_to_from_[i]), n, to.at(i));
    }
    to.add_to_owners();
    return;
  }
  std::vector<double> meeting(static_cast<std::size_t>(parent_->num_vertices()) * n, 0.0);
  for (std::int32_t i = 0; i < from.space->num_dofs(); ++i) {
    std::copy_n(from.at(i), n, meeting.begin() + from_to_parent_[i] * n);
  }
  parent_->vertex_halo.add_to_owners(meeting, n);
  parent_->vertex_halo.copy_to_ghosts(meeting, n);
  for (std::int32_t i = 0; i < to_owned_; ++i) std::copy_n(meeting.begin() + to_to_parent_[i] * n, n, to.at(i));
}

}  // namespace vocalis::transfer
