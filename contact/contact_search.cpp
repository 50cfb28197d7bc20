#include "contact/contact_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/closed_cells.hpp"
#include "contact/crushed.hpp"
#include "contact/pockets.hpp"
#include "contact/slivers.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::contact {

namespace {

constexpr double closes_again = 0.9;    ///< of the gap at which a cell opened
constexpr double share_of_rest = 0.5;   ///< no cell closes that is wider than this share of its gap at rest
constexpr double pocket_width = 2;      ///< half the gap of a pocket over that of a cell that closes, at most
constexpr double thin = 0.06;           ///< of cells beside contact that are about to be crushed, see `find_crushed`
constexpr double nearly_flat = 0.03;    ///< of cells behind those
constexpr double safe_clearance = 0.5;  ///< share of the clearance that walls may have used up unmeasured

/// Returns how many are new.
std::int64_t add_to(std::vector<char>& in_contact, const std::vector<char>& more) {
  std::int64_t added = 0;
  for (std::size_t cell = 0; cell < more.size(); ++cell) {
    added += more[cell] && !in_contact[cell];
    in_contact[cell] |= more[cell];
  }
  return added;
}

fem::Space space_on_fluid(const mesh::Mesh& mesh, std::span<const char> cell_is_fluid) {
  std::vector<std::int32_t> label(mesh.num_cells());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) label[cell] = cell_is_fluid[cell] ? 0 : -1;
  return fem::lagrange(mesh, 1, label);
}

std::vector<double> lengths(const mesh::Mesh& mesh, std::span<const char> cell_is_fluid) {
  std::vector<double> result(mesh.num_cells(), 0.0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!cell_is_fluid[cell]) continue;
    const double measure = mesh::signed_volume(mesh, mesh.vertices_of(cell));
    result[cell] = mesh.dimension == 2 ? std::sqrt(2 * measure) : std::cbrt(6 * measure);
  }
  return result;
}

std::vector<std::int32_t> points_of(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets) {
  std::vector<std::int32_t> points;
  for (const mesh::NamedFacet& facet : facets) {
    const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
    points.insert(points.end(), corners.begin(), corners.begin() + mesh.dimension);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Sums over contact cells: their number and normal stress; the number of those at the fluid, and its pressure there.
using GroupLoad = std::array<double, 4>;

}  // namespace

ContactSearch::ContactSearch(const mesh::Mesh& mesh, std::span<const char> cell_is_fluid,
                             std::vector<mesh::NamedFacet> walls, std::vector<SymmetryPlane> planes,
                             const ContactSettings& settings)
    : mesh_(&mesh),
      settings_(settings),
      walls_(std::move(walls)),
      planes_(std::move(planes)),
      space_(space_on_fluid(mesh, cell_is_fluid)),
      length_(lengths(mesh, cell_is_fluid)),
      wall_points_(points_of(mesh, walls_)) {
  if (settings.distance == DistanceMethod::eikonal) eikonal_.emplace(space_);
  double longest = 0;
  for (const double length : length_) longest = std::max(longest, length);
  const double widest = 2 * settings.alpha * base::largest(mesh.comm, longest);
  bound_ = widest / share_of_rest;
  closes_below_.assign(length_.size(), 0.0);
  const auto walls_at_rest = measure(mesh.coordinates, failed_at_rest_);
  if (!walls_at_rest) return;
  const AxisGap rest = axis_gap(*walls_at_rest, mesh.coordinates, settings.gamma);
  for (std::size_t cell = 0; cell < length_.size(); ++cell) {
    closes_below_[cell] = std::min(2 * settings.alpha * length_[cell], share_of_rest * rest.gap[cell]);
  }
}

ContactState ContactSearch::open_state() const {
  ContactState state;
  state.in_contact.assign(length_.size(), 0);
  state.closing_gap.assign(length_.size(), 0.0);
  state.opening_gap.assign(length_.size(), 0.0);
  state.normal.assign(length_.size() * mesh_->dimension, 0.0);
  return state;
}

bool ContactSearch::is_due(std::span<const double> coordinates) const {
  if (measured_.empty()) return true;
  const int d = mesh_->dimension;
  double farthest = 0;  // squared
  for (const std::int32_t v : wall_points_) {
    double square = 0;
    for (std::size_t i = static_cast<std::size_t>(v) * d; i < static_cast<std::size_t>(v + 1) * d; ++i) {
      square += (coordinates[i] - measured_[i]) * (coordinates[i] - measured_[i]);
    }
    farthest = std::max(farthest, square);
  }
  return 2 * std::sqrt(base::largest(mesh_->comm, farthest)) >= safe_clearance * clearance_;
}

void ContactSearch::forget() {
  guess_.clear();
  measured_.clear();
}

std::optional<WallDistance> ContactSearch::measure(std::span<const double> coordinates, std::string& reason) {
  if (!eikonal_) {
    return direct_distance(space_, walls_, coordinates, planes_, bound_);
  }
  EikonalReport report;
  WallDistance walls =
      eikonal_distance(*eikonal_, space_, walls_, coordinates, planes_, EikonalSettings{}, guess_, report);
  if (!report.converged) {
    reason = "the distance from walls: " + report.reason;
    return std::nullopt;
  }
  guess_ = walls.distance.values;
  return walls;
}

ContactProposal ContactSearch::propose(std::span<const double> coordinates, const ContactState& state,
                                       const ContactLoad& load) {
  ContactProposal proposal;
  proposal.state = state;
  if (!failed_at_rest_.empty()) {
    proposal.reason = failed_at_rest_ + ", at rest";
    return proposal;
  }
  const auto walls = measure(coordinates, proposal.reason);
  if (!walls) return proposal;
  const AxisGap gaps = axis_gap(*walls, coordinates, settings_.gamma);
  open_and_close(gaps, find_pulled(coordinates, state, load), proposal);
  double clearance = bound_;
  for (std::size_t cell = 0; cell < gaps.gap.size(); ++cell) {
    clearance = std::min(clearance, gaps.gap[cell] - closes_below_[cell]);
    if (state.closing_gap[cell] > 0 || state.opening_gap[cell] > 0) clearance = 0;
  }
  const MPI_Comm comm = mesh_->comm;
  clearance_ = std::max(0.0, base::smallest(comm, clearance));
  measured_.assign(coordinates.begin(), coordinates.end());
  proposal.closing = base::sum(comm, proposal.closing);
  proposal.opening = base::sum(comm, proposal.opening);
  proposal.closed = base::sum(comm, proposal.closed);
  proposal.depth = base::smallest(comm, proposal.depth);
  if (proposal.closed > 0) {
    spread(*walls, coordinates, state, proposal);
  } else {
    std::fill(proposal.state.in_contact.begin(), proposal.state.in_contact.end(), 0);
  }
  return proposal;
}

/// Whether each contact cell is of a group that shall open: all that are nearest to one closed cell of the axis.
std::vector<char> ContactSearch::find_pulled(std::span<const double> coordinates, const ContactState& state,
                                             const ContactLoad& load) const {
  const ClosedCells closed = gather_closed(*mesh_, coordinates, state.closing_gap, state.normal);
  std::vector<GroupLoad> groups(closed.count());
  std::vector<std::size_t> cell_to_group(length_.size(), 0);
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    if (!state.in_contact[cell] || groups.empty()) continue;
    cell_to_group[cell] = closed.nearest(middle(*mesh_, cell, coordinates)).index;
    GroupLoad& group = groups[cell_to_group[cell]];
    group[0] += 1;
    group[1] += load.normal_stress[cell];
    if (std::isnan(load.fluid_pressure[cell])) continue;
    group[2] += 1;
    group[3] += load.fluid_pressure[cell];
  }
  if (!groups.empty()) {
    MPI_Allreduce(MPI_IN_PLACE, groups.data(), static_cast<int>(4 * groups.size()), MPI_DOUBLE, MPI_SUM, mesh_->comm);
  }
  std::vector<char> is_pulled(length_.size(), 0);
  for (std::size_t cell = 0; cell < length_.size(); ++cell) {
    if (!state.in_contact[cell] || groups.empty()) continue;
    const auto& [cells, stress, at_fluid, pressures] = groups[cell_to_group[cell]];
    const double pressure = at_fluid > 0 ? pressures / at_fluid : load.lowest_fluid_pressure;
    is_pulled[cell] = stress / cells > -pressure;
  }
  return is_pulled;
}

/// The cells of the axis, on this rank.
void ContactSearch::open_and_close(const AxisGap& gaps, std::span<const char> is_pulled,
                                   ContactProposal& proposal) const {
  const int d = mesh_->dimension;
  ContactState& state = proposal.state;
  const double apart = 1 + settings_.release_gap;
  for (std::size_t cell = 0; cell < gaps.gap.size(); ++cell) {
    const double gap = gaps.gap[cell];
    if (state.closing_gap[cell] > 0) {
      const bool is_wide = std::isfinite(gap) && gap > apart * state.closing_gap[cell];
      if (is_wide || is_pulled[cell]) {
        state.opening_gap[cell] = std::isfinite(gap) ? gap : state.closing_gap[cell];
        state.closing_gap[cell] = 0;
        ++proposal.opening;
      }
    } else {
      double below = closes_below_[cell];
      // Cells of the axis that were in contact beside one that opens must not close in its place.
      if (is_pulled[cell] && std::isfinite(gap)) state.opening_gap[cell] = gap;
      if (gap > apart * below) state.opening_gap[cell] = 0;
      if (state.opening_gap[cell] > 0) below = std::min(below, closes_again * state.opening_gap[cell]);
      if (gap < below) {
        state.closing_gap[cell] = gap;
        state.opening_gap[cell] = 0;
        std::copy_n(gaps.normal.begin() + static_cast<std::ptrdiff_t>(cell) * d, d,
                    state.normal.begin() + static_cast<std::ptrdiff_t>(cell) * d);
        proposal.depth = std::min(proposal.depth, gap / below);
        ++proposal.closing;
      }
    }
    proposal.closed += state.closing_gap[cell] > 0;
  }
}

/// All cells near closed ones, of which those that are in contact already stay a little longer, pockets,
/// slivers and what is about to be crushed.
void ContactSearch::spread(const WallDistance& walls, std::span<const double> coordinates, const ContactState& before,
                           ContactProposal& proposal) const {
  const std::ptrdiff_t d = mesh_->dimension;
  ContactState& state = proposal.state;
  const ClosedCells closed = gather_closed(*mesh_, coordinates, state.closing_gap, state.normal);
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    if (length_[cell] == 0) continue;
    const auto [nearest, square] = closed.nearest(middle(*mesh_, cell, coordinates));
    const double reach = settings_.beta * length_[cell] * (before.in_contact[cell] ? 1 + settings_.release_gap : 1);
    state.in_contact[cell] = square <= reach * reach;
    if (before.in_contact[cell]) continue;
    std::copy_n(closed.normals.begin() + static_cast<std::ptrdiff_t>(nearest) * d, d, state.normal.begin() + cell * d);
  }
  std::vector<double> width(length_.size());
  for (std::size_t cell = 0; cell < width.size(); ++cell) width[cell] = pocket_width * settings_.alpha * length_[cell];
  add_to(state.in_contact, find_pockets(walls, width, state.in_contact));
  add_to(state.in_contact, find_crushed(walls, width, coordinates, state.in_contact, thin));
  // In the notch between such cells and a wall that comes down on them. Thin ones would lead along all of a channel.
  for (std::int64_t added = 1; added > 0;) {
    added = add_to(state.in_contact, find_crushed(walls, width, coordinates, state.in_contact, nearly_flat));
    added = base::sum(mesh_->comm, added);
  }
  add_to(state.in_contact, find_slivers(walls, state.in_contact));
}

}  // namespace vocalis::contact
