#include "core/io/record_writer.hpp"

#include <fmt/format.h>

#include <cassert>

#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

[[noreturn]] void throw_not_written(const std::string& path, const std::string& reason) {
  throw UserError("the flow record " + path + " must be writable", reason,
                  "check that the folder exists, its permissions, and the free space of the disk");
}

[[noreturn]] void throw_not_resumed(const std::string& path, const std::string& reason) {
  throw UserError("the flow record " + path + " must be that of the run that goes on", reason,
                  "run the case again from its start, or leave out [record] in the folder's resolved.toml");
}

/// What HDF5 knows of the file stays in memory until it is flushed: what is on the disk is whole meanwhile.
void keep_until_flush(hid_t file) {
  H5AC_cache_config_t config{};
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Fget_mdc_config(file, &config);
  config.evictions_enabled = 0;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  if (H5Fset_mdc_config(file, &config) < 0) throw Hdf5Error("the file's cache could not be set");
}

void replace_steps(hid_t file, std::int64_t steps) {
  if (H5Aexists(file, "steps") > 0) H5Adelete(file, "steps");
  write_attribute(file, "steps", std::vector<std::int64_t>{steps});
}

}  // namespace

RecordWriter::RecordWriter(Nothing, const std::string& path, const mesh::Mesh& mesh, RecordLayout layout)
    : path_(path), mesh_(&mesh), layout_(std::move(layout)), order_(mesh) {}

RecordWriter::RecordWriter(const std::string& path, const mesh::Mesh& mesh, RecordLayout layout)
    : RecordWriter(Nothing{}, path, mesh, std::move(layout)) {
  const std::vector<double> coordinates = place_at_rest();
  base::on_first_rank(mesh.comm, [&] {
    const QuietHdf5 quiet;
    try {
      create(coordinates);
    } catch (const Hdf5Error& error) {
      throw_not_written(path_, error.what());
    }
  });
}

RecordWriter RecordWriter::resume(const std::string& path, const mesh::Mesh& mesh, RecordLayout layout,
                                  std::int64_t steps) {
  RecordWriter writer(Nothing{}, path, mesh, std::move(layout));
  const std::vector<double> coordinates = writer.place_at_rest();
  base::on_first_rank(mesh.comm, [&] {
    const QuietHdf5 quiet;
    try {
      writer.open(coordinates, steps);
    } catch (const Hdf5Error& error) {
      throw_not_resumed(path, error.what());
    }
  });
  return writer;
}

std::vector<double> RecordWriter::place_at_rest() const { return order_.gather(mesh_->coordinates, mesh_->dimension); }

void RecordWriter::create(const std::vector<double>& coordinates) {
  const auto d = static_cast<hsize_t>(mesh_->dimension);
  const hsize_t vertices = coordinates.size() / d, cells = order_.cells().size() / (d + 1);
  Hdf5Handle file = create_hdf5(path_);
  keep_until_flush(file);
  write_attribute(file, "format", std::string(record_format));
  write_attribute(file, "version", std::vector<std::int64_t>{record_version});
  replace_steps(file, 0);
  write_dataset(file, "/mesh/coordinates", coordinates, {vertices, d});
  write_dataset(file, "/mesh/cells", order_.cells(), {cells, d + 1});
  Hdf5Rows time = Hdf5Rows::create(file, "/time", H5T_NATIVE_DOUBLE, {});
  file_ = std::make_unique<File>(File{std::move(file), std::move(time), {}, nullptr});
  for (const RecordLayout::Field& field : layout_.fields) {
    const bool on_edges = field.where == Place::edges;
    if (on_edges && !has_object(file_->file, "/mesh/edges")) {
      write_dataset(file_->file, "/mesh/edges", order_.edges(), {order_.edges().size() / 2, 2});
    }
    std::vector<hsize_t> shape = {on_edges ? order_.edges().size() / 2 : vertices};
    if (field.components > 1) shape.push_back(field.components);
    file_->fields.push_back(
        Hdf5Rows::create(file_->file, "/" + field.name, layout_.single ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE, shape));
  }
  if (layout_.has_marks) {
    file_->marks = std::make_unique<Hdf5Rows>(
        Hdf5Rows::create(file_->file, std::string("/") + record_marks, H5T_NATIVE_SCHAR, {cells}));
  }
  file_->file.flush_file();
}

void RecordWriter::open(const std::vector<double>& coordinates, std::int64_t steps) {
  Hdf5Handle file = open_hdf5(path_, H5F_ACC_RDWR);
  keep_until_flush(file);
  if (read_dataset<double>(file, "/mesh/coordinates") != coordinates ||
      read_dataset<std::int64_t>(file, "/mesh/cells") != order_.cells()) {
    throw_not_resumed(path_, "a record of another mesh");
  }
  const std::int64_t whole = read_integers_attribute(file, "steps").at(0);
  if (whole < steps) throw_not_resumed(path_, fmt::format("{} steps, the checkpoint is after {}", whole, steps));
  Hdf5Rows time = Hdf5Rows::open(file, "/time");
  file_ = std::make_unique<File>(File{std::move(file), std::move(time), {}, nullptr});
  file_->time.cut(steps);
  for (const RecordLayout::Field& field : layout_.fields) {
    file_->fields.push_back(Hdf5Rows::open(file_->file, "/" + field.name));
    file_->fields.back().cut(steps);
  }
  if (layout_.has_marks) {
    file_->marks = std::make_unique<Hdf5Rows>(Hdf5Rows::open(file_->file, std::string("/") + record_marks));
    file_->marks->cut(steps);
  }
  count_steps(*file_);
}

void RecordWriter::write(const RecordStep& step) {
  assert(step.fields.size() == layout_.fields.size());
  std::vector<std::vector<double>> gathered;
  for (std::size_t i = 0; i < step.fields.size(); ++i) {
    gathered.push_back(order_.gather(step.fields[i], layout_.fields[i].components, layout_.fields[i].where));
  }
  std::vector<char> marks;
  if (layout_.has_marks) marks = order_.gather_marks(step.marks);
  base::on_first_rank(mesh_->comm, [&] {
    const QuietHdf5 quiet;
    try {
      for (std::size_t i = 0; i < gathered.size(); ++i) file_->fields[i].append(gathered[i]);
      if (file_->marks) file_->marks->append(marks);
      file_->time.append(std::vector<double>{step.time});
    } catch (const Hdf5Error& error) {
      throw_not_written(path_, error.what());
    }
  });
}

void RecordWriter::count_steps(File& file) {
  file.file.flush_file();
  replace_steps(file.file, static_cast<std::int64_t>(file.time.rows()));
  file.file.flush_file();
}

void RecordWriter::flush() {
  base::on_first_rank(mesh_->comm, [&] {
    const QuietHdf5 quiet;
    try {
      count_steps(*file_);
    } catch (const Hdf5Error& error) {
      throw_not_written(path_, error.what());
    }
  });
}

}  // namespace vocalis::io
