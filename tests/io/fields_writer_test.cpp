#include "core/io/fields_writer.hpp"

#include <fstream>

#include "core/io/hdf5_handle.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"
#include "tests/io/rank_0.hpp"
#include "tests/io/temporary_folder.hpp"

using namespace vocalis;
using namespace vocalis::io;

namespace {

mesh::Mesh box(int dimension) {
  const auto whole = dimension == 2 ? mesh::box(MPI_COMM_WORLD, {1, 2, 0}, {4, 3, 0})
                                    : mesh::box(MPI_COMM_WORLD, {1, 2, 3}, {3, 2, 2});
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

/// The coordinates times a factor as a vector field and their sum as a scalar one; ghosts hold rubbish.
void write_step(FieldsWriter& writer, const mesh::Mesh& mesh, long step, double factor) {
  std::vector<double> vectors(mesh.coordinates.size(), -1), sums(mesh.num_vertices(), -1);
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    sums[v] = 0;
    for (int k = 0; k < mesh.dimension; ++k) {
      vectors[v * mesh.dimension + k] = factor * mesh.point(v)[k];
      sums[v] += factor * mesh.point(v)[k];
    }
  }
  writer.write(step, 1e-3 * step, {{"velocity", mesh.dimension, vectors}, {"pressure", 1, sums}});
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t number = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++number;
  return number;
}

/// The file as every rank reads it; nobody changes it before all have read.
struct Stored {
  std::vector<std::string> names;
  std::vector<double> coordinates, velocity, pressure;
  std::vector<std::int64_t> cells;
  std::vector<std::int32_t> region;
  double time = 0;
};

Stored read(const TemporaryFolder& folder, const std::string& step) {
  Stored stored;
  {
    const Hdf5Handle file = open_hdf5(folder.file("fields.h5"), H5F_ACC_RDONLY);
    stored.names = names_in(file);
    stored.coordinates = read_dataset<double>(file, "/mesh/coordinates");
    stored.cells = read_dataset<std::int64_t>(file, "/mesh/cells");
    stored.region = read_dataset<std::int32_t>(file, "/mesh/region");
    stored.velocity = read_dataset<double>(file, step + "/velocity");
    stored.pressure = read_dataset<double>(file, step + "/pressure");
    const Hdf5Handle group(H5Gopen2(file, step.c_str(), H5P_DEFAULT), H5Gclose, step);
    stored.time = read_real_attribute(group, "time");
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return stored;
}

}  // namespace

TEST_CASE("fields lie at their vertices, filled up to three components") {
  const int dimension = GENERATE(2, 3);
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(dimension);
  FieldsWriter writer(MPI_COMM_WORLD, folder.path(), mesh);
  write_step(writer, mesh, 12, 2);
  const Stored stored = read(folder, "/step_00000012");
  CHECK(stored.names == std::vector<std::string>{"mesh", "step_00000012"});
  CHECK(stored.time == 1e-3 * 12);
  const auto vertices = static_cast<std::size_t>(mesh.vertices.num_global);
  REQUIRE_ON_ALL_RANKS(stored.coordinates.size() == 3 * vertices && stored.velocity.size() == 3 * vertices &&
                       stored.pressure.size() == vertices);
  REQUIRE_ON_ALL_RANKS(stored.cells.size() == static_cast<std::size_t>(mesh.cells.num_global * (dimension + 1)));
  CHECK(stored.region == std::vector<std::int32_t>(mesh.cells.num_global, 0));
  for (std::size_t v = 0; v < vertices; ++v) {
    const double* point = stored.coordinates.data() + 3 * v;
    CHECK(stored.pressure[v] == Approx(2 * (point[0] + point[1] + point[2])));
    for (int k = 0; k < 3; ++k) CHECK(stored.velocity[3 * v + k] == 2 * point[k]);
    if (dimension == 2) CHECK(point[2] == 0);
  }
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (int i = 0; i <= dimension; ++i) {
      const auto vertex = stored.cells[(mesh.cells.offset + cell) * (dimension + 1) + i];
      for (int k = 0; k < dimension; ++k) {
        CHECK(stored.coordinates[3 * vertex + k] == mesh.point(mesh.vertices_of(cell)[i])[k]);
      }
    }
  }
}

TEST_CASE("the description lists each step once, and the mesh alone before the first one") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(2);
  FieldsWriter writer(MPI_COMM_WORLD, folder.path(), mesh);
  std::string text = text_of(folder.file("fields.xdmf"));
  CHECK(count(text, "<Grid ") == 1);
  CHECK(count(text, "/mesh/region") == 1);
  MPI_Barrier(MPI_COMM_WORLD);
  write_step(writer, mesh, 1, 1);
  write_step(writer, mesh, 2, 1);
  write_step(writer, mesh, 2, 3);
  text = text_of(folder.file("fields.xdmf"));
  CHECK(count(text, "<Grid ") == 3);
  CHECK(count(text, "<Time Value=\"0.002\"/>") == 1);
  CHECK(count(text, "<Grid ") == count(text, "</Grid>"));
  CHECK(count(text, "fields.h5:/step_00000001/velocity<") == 1);
  CHECK(read(folder, "/step_00000002").velocity[3 * mesh.vertices.offset] == 3 * mesh.coordinates[0]);
}

TEST_CASE("fields that were resumed lose the later steps and go on") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(2);
  {
    FieldsWriter writer(MPI_COMM_WORLD, folder.path(), mesh);
    for (const long step : {0, 10, 20, 30}) write_step(writer, mesh, step, 1);
  }
  on_rank_0([&] { std::filesystem::remove(folder.file("fields.xdmf")); });
  FieldsWriter writer = FieldsWriter::resume(MPI_COMM_WORLD, folder.path(), mesh, 15);
  CHECK(count(text_of(folder.file("fields.xdmf")), "<Time ") == 2);
  MPI_Barrier(MPI_COMM_WORLD);
  write_step(writer, mesh, 16, 5);
  const Stored stored = read(folder, "/step_00000016");
  CHECK(stored.names == std::vector<std::string>{"mesh", "step_00000000", "step_00000010", "step_00000016"});
  const std::string text = text_of(folder.file("fields.xdmf"));
  CHECK(count(text, "<Time ") == 3);
  CHECK(count(text, "AttributeType=\"Vector\"") == 3);
  CHECK(count(text, "AttributeType=\"Scalar\" Center=\"Node\"") == 3);
}

TEST_CASE("fields can be resumed where none are") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(2);
  FieldsWriter writer = FieldsWriter::resume(MPI_COMM_WORLD, folder.path(), mesh, 15);
  write_step(writer, mesh, 16, 1);
  CHECK(read(folder, "/step_00000016").names.size() == 2);
}

TEST_CASE("fields that cannot be written or resumed are an error on every rank") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(2), other = box(3);
  CHECK_THROWS_AS(FieldsWriter(MPI_COMM_WORLD, folder.file("nowhere"), mesh), base::UserError);
  FieldsWriter writer(MPI_COMM_WORLD, folder.path(), mesh);
  CHECK(user_error_of([&] { FieldsWriter::resume(MPI_COMM_WORLD, folder.path(), other, 1); }).find("another mesh") !=
        std::string::npos);
  on_rank_0([&] { std::filesystem::resize_file(folder.file("fields.h5"), 100); });
  CHECK(user_error_of([&] { FieldsWriter::resume(MPI_COMM_WORLD, folder.path(), mesh, 1); }).find("must be whole") !=
        std::string::npos);
  CHECK_THROWS_AS(write_step(writer, mesh, 1, 1), base::UserError);
}
