#include "core/io/record_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"
#include "core/base/mpi.hpp"
#include "core/io/match_points.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

constexpr double same_place = 1e-7;  // of the mesh's size: vertices nearer than that are one

/// reason  what was found
[[noreturn]] void throw_incomplete(const std::string& path, const std::string& reason) {
  throw UserError("the flow record " + path + " must be whole", reason,
                  "it was cut off or is damaged: run the case that wrote it again, or go on with it (resume)");
}

[[noreturn]] void throw_other_mesh(const std::string& path, const std::string& reason) {
  throw UserError("the flow record " + path + " must be of the flow's mesh of this case", reason,
                  "replay it with the mesh that it was recorded on");
}

double size_of(const std::vector<double>& coordinates, int dimension) {
  double result = 0;
  for (int k = 0; k < dimension; ++k) {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = k; i < coordinates.size(); i += dimension) {
      low = std::min(low, coordinates[i]);
      high = std::max(high, coordinates[i]);
    }
    result = std::max(result, high - low);
  }
  return result;
}

void check_format(hid_t file, const std::string& path) {
  if (H5Aexists(file, "format") <= 0 || H5Aexists(file, "version") <= 0) {
    throw UserError(path + " must be a flow record", "a file without the attributes format and version",
                    "give the flow_record.h5 of a run folder, or write one as docs/flow-record.md says");
  }
  const std::int64_t version = read_integers_attribute(file, "version").at(0);
  if (version == record_version) return;
  throw UserError(fmt::format("the flow record {} must have the version {}", path, record_version),
                  std::to_string(version), "replay it with the version of Vocalis that wrote it");
}

/// A file that HDF5 cannot open was cut off, if it is one of HDF5 at all.
Hdf5Handle open_record(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw UserError("the flow record " + path + " must be there", "no such file",
                    "record the flow with a [record] table in its case");
  }
  try {
    Hdf5Handle file = open_hdf5(path, H5F_ACC_RDONLY);
    check_format(file, path);
    return file;
  } catch (const Hdf5Error& error) {
    throw_incomplete(path, error.what());
  }
}

std::vector<double> coordinates_of(hid_t file, const std::string& path, int dimension) {
  const Hdf5Rows rows = Hdf5Rows::open(file, "/mesh/coordinates");
  if (rows.shape() != std::vector<hsize_t>{static_cast<hsize_t>(dimension)}) {
    throw_other_mesh(path, fmt::format("/mesh/coordinates of {} numbers a vertex", rows.width()));
  }
  return read_dataset<double>(file, "/mesh/coordinates");
}

/// Where each cell (edge) of the mesh stands in the record, by its vertices.
std::vector<std::int64_t> rows_of_items(const std::string& path, const std::vector<std::int64_t>& recorded,
                                        const std::vector<std::int64_t>& items,
                                        const std::vector<std::int64_t>& vertex_row, std::size_t corners) {
  std::map<std::vector<std::int64_t>, std::int64_t> known;
  for (std::size_t at = 0; at + corners <= recorded.size(); at += corners) {
    std::vector<std::int64_t> vertices(recorded.begin() + at, recorded.begin() + at + corners);
    std::sort(vertices.begin(), vertices.end());
    known[vertices] = static_cast<std::int64_t>(at / corners);
  }
  std::vector<std::int64_t> rows;
  for (std::size_t at = 0; at < items.size(); at += corners) {
    std::vector<std::int64_t> vertices;
    for (std::size_t i = at; i < at + corners; ++i) vertices.push_back(vertex_row[items[i]]);
    std::sort(vertices.begin(), vertices.end());
    const auto found = known.find(vertices);
    if (found == known.end()) throw_other_mesh(path, corners > 2 ? "other cells" : "other edges");
    rows.push_back(found->second);
  }
  return rows;
}

}  // namespace

RecordReader::RecordReader(const std::string& path, const mesh::Mesh& mesh, std::vector<RecordLayout::Field> needed,
                           const std::vector<RecordLayout::Field>& optional)
    : path_(path), mesh_(mesh), order_(mesh), layout_{.fields = std::move(needed)} {
  const std::vector<double> coordinates = order_.gather(mesh.coordinates, mesh.dimension);
  std::vector<std::int32_t> has_optional(optional.size() + 1, 0);
  base::on_first_rank(mesh.comm, [&] {
    const QuietHdf5 quiet;
    try {
      open(coordinates, optional);
    } catch (const Hdf5Error& error) {
      throw_incomplete(path_, error.what());
    }
    for (std::size_t i = 0; i < optional.size(); ++i) has_optional[i] = has(optional[i].name);
    has_optional.back() = layout_.has_marks;
  });
  base::broadcast(mesh.comm, has_optional);
  base::broadcast(mesh.comm, times_);
  for (std::size_t i = 0; i < optional.size(); ++i) {
    if (has_optional[i] && !has(optional[i].name)) layout_.fields.push_back(optional[i]);
  }
  layout_.has_marks = has_optional.back() != 0;
}

void RecordReader::open(const std::vector<double>& coordinates, const std::vector<RecordLayout::Field>& optional) {
  file_ = std::make_unique<File>(File{open_record(path_), {}, nullptr, {}, {}, {}});
  if (H5Aexists(file_->file, "steps") <= 0) throw_incomplete(path_, "no attribute `steps`");
  const std::int64_t steps = read_integers_attribute(file_->file, "steps").at(0);
  if (steps < 2) throw_incomplete(path_, fmt::format("{} steps, two are the least", steps));
  find_mesh(coordinates);
  read_times(steps);
  open_fields(steps, optional);
}

void RecordReader::read_times(std::int64_t steps) {
  times_ = read_dataset<double>(file_->file, "/time");
  if (times_.size() < static_cast<std::size_t>(steps)) {
    throw_incomplete(path_, fmt::format("{} of {} times", times_.size(), steps));
  }
  times_.resize(steps);
  const double first = times_.front();
  for (double& time : times_) time -= first;
  for (std::size_t n = 1; n < times_.size(); ++n) {
    if (times_[n] > times_[n - 1] && std::isfinite(times_[n])) continue;
    throw UserError("the times of the flow record " + path_ + " must rise",
                    fmt::format("{} s after {} s", times_[n], times_[n - 1]), "mend /time");
  }
}

void RecordReader::find_mesh(const std::vector<double>& coordinates) {
  const int d = mesh_.dimension;
  const std::vector<double> recorded = coordinates_of(file_->file, path_, d);
  const double distance = same_place * size_of(coordinates, d);
  if (recorded == coordinates) {
    for (std::int64_t v = 0; v < mesh_.vertices.num_global; ++v) file_->vertex_row.push_back(v);
  } else {
    file_->vertex_row = match_points(recorded, coordinates, d, distance);
  }
  const auto missing = std::count(file_->vertex_row.begin(), file_->vertex_row.end(), -1);
  if (missing > 0) {
    throw_other_mesh(
        path_, fmt::format("{} of {} vertices without one row at their place", missing, file_->vertex_row.size()));
  }
  const auto rows = [&](const char* name, const std::vector<std::int64_t>& items, int corners) {
    if (!has_object(file_->file, name)) return std::vector<std::int64_t>();
    return rows_of_items(path_, read_dataset<std::int64_t>(file_->file, name), items, file_->vertex_row, corners);
  };
  file_->cell_row = rows("/mesh/cells", order_.cells(), d + 1);
  file_->edge_row = rows("/mesh/edges", order_.edges(), 2);
}

void RecordReader::open_fields(std::int64_t steps, const std::vector<RecordLayout::Field>& optional) {
  for (const RecordLayout::Field& field : optional) {
    if (has_object(file_->file, "/" + field.name)) layout_.fields.push_back(field);
  }
  const hsize_t vertices = Hdf5Rows::open(file_->file, "/mesh/coordinates").rows();
  const auto check_shape = [&](const Hdf5Rows& rows, const std::string& name, const std::vector<hsize_t>& shape) {
    if (rows.shape() != shape) {
      throw UserError("the dataset " + name + " of the flow record " + path_ + " must have a row a step",
                      fmt::format("rows of the shape ({})", fmt::join(rows.shape(), ", ")),
                      fmt::format("write rows of the shape ({})", fmt::join(shape, ", ")));
    }
    if (rows.rows() >= static_cast<hsize_t>(steps)) return;
    throw_incomplete(path_, fmt::format("{} has {} of {} steps", name, rows.rows(), steps));
  };
  for (const RecordLayout::Field& field : layout_.fields) {
    file_->fields.push_back(Hdf5Rows::open(file_->file, "/" + field.name));
    const bool on_edges = field.where == Place::edges;
    std::vector<hsize_t> shape = {on_edges ? Hdf5Rows::open(file_->file, "/mesh/edges").rows() : vertices};
    if (field.components > 1) shape.push_back(field.components);
    check_shape(file_->fields.back(), "/" + field.name, shape);
  }
  const std::string marks = std::string("/") + record_marks;
  if (!has_object(file_->file, marks)) return;
  layout_.has_marks = true;
  file_->marks = std::make_unique<Hdf5Rows>(Hdf5Rows::open(file_->file, marks));
  const hsize_t cells = Hdf5Rows::open(file_->file, "/mesh/cells").rows();
  check_shape(*file_->marks, marks, {cells});
}

bool RecordReader::has(const std::string& field) const { return index_of(field) < layout_.fields.size(); }

std::size_t RecordReader::index_of(const std::string& field) const {
  return std::find_if(layout_.fields.begin(), layout_.fields.end(),
                      [&](const RecordLayout::Field& known) { return known.name == field; }) -
         layout_.fields.begin();
}

std::vector<double> RecordReader::read(const std::string& field, std::int64_t step) const {
  const std::size_t index = index_of(field);
  assert(index < layout_.fields.size() && step < static_cast<std::int64_t>(times_.size()));
  const int width = layout_.fields[index].components;
  const Place where = layout_.fields[index].where;
  std::vector<double> all;
  base::on_first_rank(mesh_.comm, [&] {
    const QuietHdf5 quiet;
    std::vector<double> row;
    try {
      file_->fields[index].read(step, row);
    } catch (const Hdf5Error& error) {
      throw_incomplete(path_, fmt::format("step {}: {}", step, error.what()));
    }
    for (const std::int64_t at : where == Place::edges ? file_->edge_row : file_->vertex_row) {
      all.insert(all.end(), row.begin() + at * width, row.begin() + (at + 1) * width);
    }
    if (std::all_of(all.begin(), all.end(), [](double value) { return std::isfinite(value); })) return;
    throw UserError("the numbers of the flow record " + path_ + " must be finite",
                    fmt::format("/{} of step {} has others", field, step), "mend it");
  });
  return order_.scatter(all, width, where);
}

std::vector<char> RecordReader::read_marks(std::int64_t step) const {
  std::vector<char> all;
  base::on_first_rank(mesh_.comm, [&] {
    const QuietHdf5 quiet;
    std::vector<char> row;
    try {
      file_->marks->read(step, row);
    } catch (const Hdf5Error& error) {
      throw_incomplete(path_, fmt::format("step {}: {}", step, error.what()));
    }
    for (const std::int64_t at : file_->cell_row) all.push_back(row[at]);
  });
  return order_.scatter_marks(all);
}

}  // namespace vocalis::io
