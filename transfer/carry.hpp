#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/fem/field.hpp"
#include "transfer/strip.hpp"

namespace vocalis::transfer {

/// The vertices that two meshes of one parent have in common, and how P1 fields and loads go from one to the other: by
/// a local gather where every rank finds what it needs at its own vertices, through the parent's halo elsewhere (a
/// vertex may touch only a solid cell on one rank and only an air cell on another). Which of the two was found when
/// the object was made. Refers to the parent, and is valid until one of the meshes is stripped again.
class SharedVertices {
 public:
  /// All are collective.
  static SharedVertices from_parent(const mesh::Mesh& parent, const StrippedMesh& to);
  static SharedVertices to_parent(const mesh::Mesh& parent, const StrippedMesh& from);
  static SharedVertices between(const mesh::Mesh& parent, const StrippedMesh& from, const StrippedMesh& to);

  /// Injection: values at shared vertices, exactly; `otherwise` where `from` has no such vertex on any rank.
  /// The ghosts of `from` must be current; those of `to` are. Collective.
  void carry(const fem::Field& from, fem::Field& to, double otherwise = 0) const;

  /// Transpose of the injection of fields of `to` into `from`: what each rank has summed so far is added at the same
  /// vertices of `to`, then to the owners there, so that the total is conserved if `to` has all vertices with a load.
  /// On exit `to` is whole at its owners, its ghosts are 0; its former content is lost. Collective.
  void carry(const fem::Load& from, fem::Load& to) const;

  /// (local vertices of `to`) whether `from` has the vertex, on any rank.
  const std::vector<std::int32_t>& is_shared() const { return is_shared_; }

 private:
  SharedVertices(const mesh::Mesh& parent, std::vector<std::int32_t> from_to_parent, std::int32_t from_owned,
                 std::vector<std::int32_t> to_to_parent, std::int32_t to_owned);

  const mesh::Mesh* parent_ = nullptr;
  std::vector<std::int32_t> from_to_parent_, to_to_parent_;
  std::vector<std::int32_t> to_to_from_;  ///< on this rank, or -1
  std::vector<std::int32_t> is_shared_;
  std::int32_t from_owned_ = 0, to_owned_ = 0;
  bool fields_are_local_ = false, loads_are_local_ = false;
};

}  // namespace vocalis::transfer
