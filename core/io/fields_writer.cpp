#include "core/io/fields_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"
#include "core/io/hdf5_handle.hpp"
#include "core/io/rank_parts.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

[[noreturn]] void throw_not_written(const std::string& path, const std::string& reason) {
  throw UserError("the fields file " + path + " must be writable", reason,
                  "check that the folder exists, its permissions, and the free space of the disk");
}

/// The mesh as fields.h5 has it, on rank 0.
struct GatheredMesh {
  std::vector<std::int64_t> cells;   ///< (cells, dimension + 1) global vertices
  std::vector<double> coordinates;   ///< (vertices, 3) [m]
  std::vector<std::int32_t> region;  ///< (cells)
};

/// Rows of `components` numbers of all vertices in their global order on rank 0; more than one is filled up to three.
/// Collective.
std::vector<double> gather_at_vertices(const mesh::Mesh& mesh, std::span<const double> values, int components) {
  const int width = components == 1 ? 1 : 3;
  std::vector<double> mine(static_cast<std::size_t>(mesh.vertices.num_owned) * width, 0.0);
  for (std::size_t v = 0; v < static_cast<std::size_t>(mesh.vertices.num_owned); ++v) {
    std::copy_n(values.begin() + v * components, components, mine.begin() + v * width);
  }
  return gather_to_first<double>(mesh.comm, mine);
}

GatheredMesh gather_mesh(const mesh::Mesh& mesh) {
  std::vector<std::int64_t> cells;
  cells.reserve(mesh.cell_vertices.size());
  for (const std::int32_t vertex : mesh.cell_vertices) cells.push_back(mesh.vertices.to_global(vertex));
  const std::span<const std::int32_t> region(mesh.cell_region.data(), mesh.num_cells());
  return {gather_to_first<std::int64_t>(mesh.comm, cells), gather_at_vertices(mesh, mesh.coordinates, mesh.dimension),
          gather_to_first<std::int32_t>(mesh.comm, region)};
}

/// Gives a whole temporary file its name at once, so that a reader never sees half of it.
void rename_whole(const std::string& temporary, const std::string& path) {
  if (std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(temporary.c_str());
  throw_not_written(path, reason);
}

void create_fields(const std::string& path, const mesh::Mesh& parent, const GatheredMesh& mesh) {
  const std::string temporary = path + ".part";
  Hdf5Handle file = create_hdf5(temporary);
  write_dataset(file, "/mesh/cells", mesh.cells, {mesh.region.size(), static_cast<hsize_t>(parent.dimension + 1)});
  write_dataset(file, "/mesh/coordinates", mesh.coordinates, {mesh.coordinates.size() / 3, 3});
  const Hdf5Handle region = write_dataset(file, "/mesh/region", mesh.region, {mesh.region.size()});
  write_attribute(region, "region_names", fmt::format("{}", fmt::join(parent.region_names, ",")));
  file.close_file();
  rename_whole(temporary, path);
}

void check_mesh(hid_t file, const std::string& path, const GatheredMesh& mesh) {
  if (read_dataset<std::int64_t>(file, "/mesh/cells") != mesh.cells ||
      read_dataset<double>(file, "/mesh/coordinates") != mesh.coordinates ||
      read_dataset<std::int32_t>(file, "/mesh/region") != mesh.region) {
    throw UserError("the fields file " + path + " must have the mesh of the run that continues it", "another mesh",
                    "resume with the case that wrote it, or move the file away: then a new one is begun");
  }
}

/// The step that a group of fields.h5 holds, or -1.
long step_of_group(const std::string& name) {
  constexpr const char* prefix = "step_";
  return name.starts_with(prefix) ? std::strtol(name.c_str() + std::strlen(prefix), nullptr, 10) : -1;
}

std::vector<XdmfField> fields_of_group(hid_t file, const std::string& name) {
  const Hdf5Handle group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, name + " was not opened");
  std::vector<XdmfField> fields;
  for (const std::string& field : names_in(group)) {
    fields.push_back({field, num_dimensions(group, field) == 1 ? 1 : 3});
  }
  return fields;
}

/// Adds the group of a step. The group gets its name when all of it is in the file, so that a process that is killed
/// meanwhile leaves a file without this step; only the naming, a few small writes, is not safe.
void add_step(Hdf5Handle& file, const std::string& name, double time, const std::vector<XdmfField>& fields,
              const std::vector<std::vector<double>>& values) {
  const Hdf5Handle group = create_nameless_group(file);
  write_attribute(group, "time", time);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const hsize_t width = fields[i].components;
    std::vector<hsize_t> shape = {values[i].size() / width};
    if (width > 1) shape.push_back(width);
    write_dataset(group, fields[i].name, values[i], shape);
  }
  file.flush_file();
  if (has_object(file, name)) remove_object(file, name);
  name_group(group, file, name);
}

void replace_text(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".part";
  errno = 0;
  if (!(std::ofstream(temporary, std::ios::binary) << text << std::flush)) {
    const std::string reason = std::strerror(errno);
    std::remove(temporary.c_str());
    throw_not_written(path, reason);
  }
  rename_whole(temporary, path);
}

}  // namespace

FieldsWriter::FieldsWriter(Nothing, MPI_Comm comm, const std::string& folder, const mesh::Mesh& parent)
    : comm_(comm),
      folder_(folder),
      parent_(&parent),
      shape_{parent.dimension, parent.cells.num_global, parent.vertices.num_global} {}

FieldsWriter::FieldsWriter(MPI_Comm comm, const std::string& folder, const mesh::Mesh& parent)
    : FieldsWriter(Nothing{}, comm, folder, parent) {
  const GatheredMesh mesh = gather_mesh(parent);
  base::on_first_rank(comm, [&] {
    const QuietHdf5 quiet;
    std::remove(path("fields.xdmf").c_str());  // it describes the old file
    try {
      create_fields(path("fields.h5"), parent, mesh);
    } catch (const Hdf5Error& error) {
      throw_not_written(path("fields.h5"), error.what());
    }
    write_description();
  });
}

FieldsWriter FieldsWriter::resume(MPI_Comm comm, const std::string& folder, const mesh::Mesh& parent, long last_step) {
  FieldsWriter writer(Nothing{}, comm, folder, parent);
  const GatheredMesh mesh = gather_mesh(parent);
  base::on_first_rank(comm, [&] {
    const QuietHdf5 quiet;
    const std::string file = writer.path("fields.h5");
    try {
      if (!std::filesystem::exists(file)) {
        create_fields(file, parent, mesh);
      } else {
        check_mesh(open_hdf5(file, H5F_ACC_RDONLY), file, mesh);
        writer.read_steps(last_step);
      }
    } catch (const Hdf5Error& error) {
      throw UserError("the fields file " + file + " must be whole and writable to be continued", error.what(),
                      "check its permissions, or move the file away: then a new one is begun");
    }
    writer.write_description();
  });
  return writer;
}

void FieldsWriter::read_steps(long last_step) {
  Hdf5Handle file = open_hdf5(path("fields.h5"), H5F_ACC_RDWR);
  for (const std::string& name : names_in(file)) {
    const long step = step_of_group(name);
    if (step > last_step) {
      remove_object(file, name);
    } else if (step >= 0) {
      const Hdf5Handle group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, name + " was not opened");
      describe(step, read_real_attribute(group, "time"), fields_of_group(file, name));
    }
  }
  file.close_file();
}

void FieldsWriter::describe(long step, double time, const std::vector<XdmfField>& fields) {
  const auto at = std::lower_bound(steps_.begin(), steps_.end(), step,
                                   [](const Step& entry, long number) { return entry.number < number; });
  Step entry{step, xdmf_step(shape_, step, time, fields)};
  if (at != steps_.end() && at->number == step) {
    *at = std::move(entry);
  } else {
    steps_.insert(at, std::move(entry));
  }
}

void FieldsWriter::write_description() const {
  std::vector<std::string> descriptions;
  for (const Step& step : steps_) descriptions.push_back(step.description);
  replace_text(path("fields.xdmf"), xdmf_file(shape_, descriptions));
}

void FieldsWriter::write(long step, double time, const std::vector<NamedValues>& fields) {
  std::vector<XdmfField> described;
  std::vector<std::vector<double>> gathered;
  for (const NamedValues& field : fields) {
    assert(field.components == 1 || field.components == parent_->dimension);
    assert(field.values.size() == static_cast<std::size_t>(parent_->num_vertices()) * field.components);
    described.push_back({field.name, field.components == 1 ? 1 : 3});
    gathered.push_back(gather_at_vertices(*parent_, field.values, field.components));
  }
  base::on_first_rank(comm_, [&] {
    const QuietHdf5 quiet;
    try {
      Hdf5Handle file = open_hdf5(path("fields.h5"), H5F_ACC_RDWR);
      add_step(file, "/" + step_group(step), time, described, gathered);
      file.close_file();
    } catch (const Hdf5Error& error) {
      throw_not_written(path("fields.h5"), error.what());
    }
    describe(step, time, described);
    write_description();
  });
}

}  // namespace vocalis::io
