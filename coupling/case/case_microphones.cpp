#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

/// The kinds of [[microphone]]: two hear the acoustic solvers, two a surface of the flow.
enum class Kind { mesh, far_field, curle, ffowcs_williams_hawkings };

std::vector<acoustic::MirrorPlane> read_mirrors(base::Table& table) {
  std::vector<acoustic::MirrorPlane> mirrors;
  if (!table.has("mirror")) return mirrors;
  const std::vector<std::string> axes = table.texts("mirror");
  const std::vector<double> positions = table.numbers("mirror_at", axes.size(), axes.size(), "m");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::size_t axis = std::string("xyz").find(axes[i]);
    if (axes[i].size() != 1 || axis == std::string::npos) {
      throw UserError(table.place("mirror") + " holds axes", "\"" + axes[i] + "\"", "write x, y or z");
    }
    mirrors.push_back({static_cast<int>(axis), positions[i]});
  }
  reject_duplicates(table, "mirror", axes);
  return mirrors;
}

SurfaceMicrophoneSettings read_surface_microphone(base::Table& table, const std::string& name, Kind kind,
                                                  Case& config) {
  SurfaceMicrophoneSettings microphone;
  microphone.name = name;
  microphone.position = read_vector(table, "position", "m", config);
  if (!config.has_flow()) {
    throw UserError(table.place("kind") + " of a microphone that hears a surface of the flow needs a flow", "no [flow]",
                    "write kind = \"mesh\" or \"far_field\"");
  }
  if (kind == Kind::ffowcs_williams_hawkings) microphone.method = SurfaceMethod::ffowcs_williams_hawkings;
  microphone.groups = read_groups(table, config);
  microphone.compact = table.boolean_or("compact", microphone.compact);
  microphone.viscous_stress = table.boolean_or("viscous_stress", microphone.viscous_stress);
  if (!config.acoustics.empty()) microphone.speed_of_sound = config.acoustics.front().speed_of_sound;
  microphone.speed_of_sound = table.number_or("speed_of_sound", microphone.speed_of_sound, base::positive, "m/s");
  microphone.mirrors = read_mirrors(table);
  return microphone;
}

acoustic::MicrophoneSettings read_microphone(base::Table& table, const std::string& name, Kind kind, Case& config) {
  acoustic::MicrophoneSettings microphone;
  microphone.name = name;
  microphone.position = read_vector(table, "position", "m", config);
  if (kind == Kind::mesh) return microphone;
  microphone.kind = acoustic::MicrophoneKind::far_field;
  microphone.surface = read_group(table, config, "surface");
  config.references.back().kind = MeshReference::Kind::group_of_sound;
  microphone.mirrors = read_mirrors(table);
  return microphone;
}

}  // namespace

void read_microphones(base::Table& root, Case& config) {
  std::vector<std::string> names;
  for (base::Table& table : root.tables("microphone")) {
    const std::string name = read_plain_name(table, "name");
    const Kind kind = table.choice_or<Kind>("kind", Kind::mesh,
                                            {{"mesh", Kind::mesh},
                                             {"far_field", Kind::far_field},
                                             {"curle", Kind::curle},
                                             {"fwh", Kind::ffowcs_williams_hawkings}});
    names.push_back(name);
    if (kind == Kind::mesh || kind == Kind::far_field) {
      config.microphones.push_back(read_microphone(table, name, kind, config));
    } else {
      config.surface_microphones.push_back(read_surface_microphone(table, name, kind, config));
    }
  }
  reject_duplicates(root, "[[microphone]]", names);
}

}  // namespace vocalis::coupling
