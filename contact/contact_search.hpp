#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/axis_gap.hpp"
#include "contact/eikonal.hpp"

namespace vocalis::contact {

enum class DistanceMethod { direct, eikonal };

/// When walls count as touching. h is a cell's length in the mesh at rest, (d! measure)^(1/d).
struct ContactSettings {
  double alpha = 0.25;       ///< cells of the axis close where half the gap is below α h
  double beta = 1;           ///< with all cells of the fluid whose middle is within β h of theirs
  double gamma = 0.5;        ///< |∇D| on the medial axis, see `axis_gap`
  double release_gap = 0.2;  ///< cells open where the gap is wider by this share than it was at closing
  DistanceMethod distance = DistanceMethod::direct;
};

/// Which cells are in contact, and what is remembered of them. All of owned cells.
struct ContactState {
  std::vector<char> in_contact;
  std::vector<double> closing_gap;  ///< [m] the gap at which a cell of the axis closed; 0: it is not closed
  std::vector<double> opening_gap;  ///< [m] the gap at which it opened, until its walls are apart; 0 then
  std::vector<double> normal;       ///< (cells, dimension) across the gap at closing, of cells in contact
};

/// How contact cells were loaded in a step; of owned cells.
struct ContactLoad {
  std::vector<double> normal_stress;   ///< [Pa] n·σ·n, negative under pressure
  std::vector<double> fluid_pressure;  ///< [Pa] of the fluid that a cell touches, NaN if it touches none
  double lowest_fluid_pressure = 0;    ///< [Pa] around all contact cells
};

/// What contact is to be, and what that changes; counts are over all ranks.
struct ContactProposal {
  ContactState state;
  std::int64_t closing = 0, opening = 0;  ///< cells of the axis
  std::int64_t closed = 0;                ///< cells of the axis, then
  double depth = 1;    ///< smallest gap of a cell that closes over the gap at which it was to close; 1 if none does
  std::string reason;  ///< why there is none; empty otherwise
};

/// Finds where walls touch: the distance D of the fluid's points from its walls, the medial axis, and on it the gap
/// between the walls. A cell of the axis closes where its gap falls below the smaller of 2 α h and half of the gap at
/// rest (so that corners and narrow channels between rigid walls never close). It opens, with the contact cells that
/// are nearest to it, where they press less than the fluid would that they touch (inside of a contact: than the lowest
/// pressure around), or where the gap has become wider than at closing by `release_gap`. One that has just opened
/// closes again only when it is a tenth narrower than then, or has been apart. All cells near closed ones are in
/// contact, and so are pockets that they cut off. Source: Degirmenci 2018, Algorithm 2, with the gap in place of D, and
/// conditions to open, which it lacks.
class ContactSearch {
 public:
  /// mesh           at rest; must outlive the search
  /// cell_is_fluid  (local cells, ghosts current)
  /// walls          facets of fluid cells that are walls
  /// Collective.
  ContactSearch(const mesh::Mesh& mesh, std::span<const char> cell_is_fluid, std::vector<mesh::NamedFacet> walls,
                std::vector<SymmetryPlane> planes, const ContactSettings& settings);

  /// No contact.
  ContactState open_state() const;

  /// Whether walls may be near enough to touch: they may have come nearer than when the gap was last measured by twice
  /// the way of their points since. Cheap. Collective.
  bool is_due(std::span<const double> coordinates) const;

  /// What was measured last, and where an iterative distance begins.
  void forget();

  /// coordinates  (vertices, dimension) [m], ghosts current
  /// Collective.
  ContactProposal propose(std::span<const double> coordinates, const ContactState& state, const ContactLoad& load);

 private:
  std::optional<WallDistance> measure(std::span<const double> coordinates, std::string& reason);
  std::vector<char> find_pulled(std::span<const double> coordinates, const ContactState& state,
                                const ContactLoad& load) const;
  void open_and_close(const AxisGap& gaps, std::span<const char> is_pulled, ContactProposal& proposal) const;
  void spread(const WallDistance& walls, std::span<const double> coordinates, const ContactState& before,
              ContactProposal& proposal) const;

  const mesh::Mesh* mesh_;
  ContactSettings settings_;
  std::vector<mesh::NamedFacet> walls_;
  std::vector<SymmetryPlane> planes_;
  fem::Space space_;                       ///< P1 on the fluid's cells
  std::vector<double> length_;             ///< (owned cells) h [m]; 0 outside of the fluid
  std::vector<double> closes_below_;       ///< (owned cells) [m]
  std::string failed_at_rest_;             ///< why gaps at rest are not known: then nothing can be proposed
  double bound_ = 0;                       ///< [m] beyond which distances are not needed
  std::vector<std::int32_t> wall_points_;  ///< vertices
  std::optional<Eikonal> eikonal_;
  std::vector<double> guess_;     ///< distance of the last solve
  std::vector<double> measured_;  ///< coordinates at the last measurement
  double clearance_ = 0;          ///< [m] of the narrowest gap then from closing
};

}  // namespace vocalis::contact
