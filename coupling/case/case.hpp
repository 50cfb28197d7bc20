#pragma once

#include <mpi.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/settings.hpp"
#include "contact/contact_search.hpp"
#include "core/io/geo_parameters.hpp"
#include "coupling/far_field/surface_microphone_settings.hpp"
#include "coupling/flow/given_flow_settings.hpp"
#include "coupling/monitors/monitor_settings.hpp"
#include "coupling/statistics.hpp"
#include "fsi_solver/settings.hpp"

namespace vocalis::coupling {

enum class RegionKind { fluid, solid, air };

/// Cells of one named group of the mesh.
struct Region {
  std::string name;
  RegionKind kind = RegionKind::fluid;
};

/// Of the flow, solved or not: for what listens to its surfaces.
struct Fluid {
  double density = 0;    ///< ρ [kg/m^3]
  double viscosity = 0;  ///< µ [Pa s]
};

struct MeshSettings {
  std::string file;          ///< absolute path of a Gmsh geometry or mesh file
  bool is_geometry = false;  ///< Gmsh shall mesh it
  io::GeoValues parameters;  ///< DefineConstant values of the geometry
};

/// The mesh of an [[acoustic]] that does not sound on the case's own mesh.
struct AcousticMesh {
  std::string table;  ///< name of the [[acoustic]] table, which may be several voices
  MeshSettings mesh;
  std::vector<std::string> flow_ends;  ///< groups of the case's mesh where the flow ends inside of this air
  bool follows_flow = false;           ///< its vertices within the flow move as the flow's mesh does
};

/// A prescribed glottal signal, the normal velocity of a boundary into the air [m/s]: acoustics alone, without a flow.
struct SourceSettings {
  std::string group;  ///< where it enters; the acoustic solvers get a boundary of kind `flux` there
  acoustic::PulseSettings pulse;
};

struct OutputSettings {
  std::string directory;            ///< the run folder
  double fields_interval = 0;       ///< [s] of simulated time; 0: no fields
  double kymogram_interval = 1e-4;  ///< [s] of simulated time, for monitors of kind glottis; 0: none
  int checkpoint_steps = 0;         ///< steps between checkpoints; 0: none
};

enum class Precision { double_, single };

/// The flow is written into flow_record.h5 after every accepted step, for `replay`.
struct RecordSettings {
  Precision precision = Precision::double_;
};

/// What a published or measured source says that a result should be.
struct ExpectedResult {
  double value = 0;      ///< in the unit that the result's name carries
  double tolerance = 0;  ///< absolute, in the same unit
  std::string source;
  double spread = 0;  ///< the source's own uncertainty, in the same unit; 0: it tells none
};

/// A name or point of the case that only the mesh can confirm, with its place in the file.
struct MeshReference {
  enum class Kind { region, group, group_of_sound, vector };  ///< group_of_sound: of every mesh that sounds
  Kind kind = Kind::region;
  std::string place;
  std::string name;
  std::vector<double> components;  ///< of a vector as written: 2 or 3
  std::string acoustic = {};       ///< the [[acoustic]] table whose own mesh is meant; empty: the case's
};

/// A case file, resolved: all values, defaults included. Physics that the file does not name is absent. [SI units]
struct Case {
  std::string file;  ///< as given by the user
  std::string name;
  std::string description;
  MeshSettings mesh;
  std::vector<Region> regions;
  std::optional<fsi::FlowSettings> flow;        ///< one that is solved
  std::optional<GivenFlowSettings> given_flow;  ///< one that is not; no more than one of both is there
  Fluid fluid;
  std::optional<contact::ContactSettings> contact;  ///< none: walls cannot touch
  fsi::TimeSettings time;                           ///< without a flow only `end` and `step` have a meaning
  std::vector<acoustic::AcousticSettings> acoustics;
  std::map<std::string, AcousticMesh> acoustic_meshes;  ///< by [[acoustic]]; of the others it is the case's, stripped
  std::optional<SourceSettings> source;
  std::vector<acoustic::MicrophoneSettings> microphones;       ///< that hear the acoustic solvers
  std::vector<SurfaceMicrophoneSettings> surface_microphones;  ///< that hear surfaces of the flow
  std::vector<MonitorSettings> monitors;
  std::optional<StatisticsSettings> statistics;  ///< of the monitors' columns; none: those of a voice
  OutputSettings output;
  std::optional<RecordSettings> record;
  std::map<std::string, ExpectedResult> expected;

  /// Whether a flow makes the sound, solved or not.
  bool has_flow() const { return flow || given_flow; }
  /// Whether there are solids that may move: a formula moves none.
  bool may_move() const;

  std::vector<MeshReference> references;
  std::string resolved;  ///< the text of resolved.toml
};

/// Reads a case file and changes it by the user's "key=value" overrides (base::apply_override).
/// Collective; every rank gets the same case. Throws UserError on every rank for whatever can be known without the
/// mesh.
Case read_case(MPI_Comm comm, const std::string& file, const std::vector<std::string>& overrides);

/// The case that replays the flow of a run folder: its resolved.toml with [flow] as a record of it, in a folder of its
/// own, without what belongs to a flow that is solved. `overrides` may change the sound only. Collective; every rank
/// gets the same case. Throws UserError on every rank, too, if the run has no flow, or did not record it.
Case read_replay(MPI_Comm comm, const std::string& run, const std::vector<std::string>& overrides);

/// The [[acoustic]] table whose own mesh a voice sounds on; empty: on the case's.
std::string own_mesh_table(const Case& config, const std::string& voice);

/// Whether an [[acoustic]] sounds on the case's own mesh.
bool sounds_on_the_case_mesh(const Case& config);

/// What only the mesh can tell: that it has the regions and groups that the case names, that the case names all of its
/// regions, and that points have as many coordinates as the mesh. Throws UserError. Every rank must pass the same
/// names.
void check_case_against_mesh_names(const Case& config, int dimension, const std::vector<std::string>& region_names,
                                   const std::vector<std::string>& group_names);

/// The same for the groups of the own mesh of an [[acoustic]], given by its name.
void check_acoustic_against_mesh_names(const Case& config, const std::string& acoustic,
                                       const std::vector<std::string>& group_names);

/// Writes resolved.toml: a case file of its own that repeats the run. Rank 0 writes. Collective; throws UserError if it
/// cannot be written.
void write_resolved(MPI_Comm comm, const Case& config, const std::string& path);

}  // namespace vocalis::coupling
