#include <fstream>

#include "core/io/hdf5_handle.hpp"
#include "core/io/match_points.hpp"
#include "core/io/record_reader.hpp"
#include "core/io/record_writer.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"
#include "tests/io/rank_0.hpp"
#include "tests/io/temporary_folder.hpp"

using namespace vocalis;
using namespace vocalis::io;
using Catch::Matchers::Contains;

namespace {

mesh::Mesh box(std::array<int, 3> cells = {5, 4, 0}) {
  return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 2, cells[2] > 0 ? 1.0 : 0.0}, cells));
}

RecordLayout layout_of(const mesh::Mesh& mesh, bool single = false) {
  return {.fields = {{"pressure", 1}, {"velocity", mesh.dimension}}, .has_marks = true, .single = single};
}

/// Numbers that tell their vertex by its place, and their step.
RecordStep step_of(const mesh::Mesh& mesh, int step) {
  RecordStep result{.time = 0.5 + 0.1 * step, .fields = {{}, {}}, .marks = {}};
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    result.fields[0].push_back(step + x[0] / 3 + 7 * x[1]);
    for (int k = 0; k < mesh.dimension; ++k) result.fields[1].push_back(x[k] * (step + 1) / 3);
  }
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const double x = mesh.point(mesh.vertices_of(cell)[0])[0];
    result.marks.push_back(static_cast<char>(x * 100 > 10 * step));
  }
  return result;
}

void write_steps(const std::string& path, const mesh::Mesh& mesh, int steps, bool single = false) {
  RecordWriter writer(path, mesh, layout_of(mesh, single));
  for (int n = 0; n < steps; ++n) writer.write(step_of(mesh, n));
  writer.flush();
}

RecordReader reader_of(const std::string& path, const mesh::Mesh& mesh) {
  return {path, mesh, {{"pressure", 1}, {"velocity", mesh.dimension}}, {{"displacement", mesh.dimension}}};
}

/// Whether a step holds what `step_of` gave.
bool holds(const RecordReader& reader, const mesh::Mesh& mesh, int step) {
  const RecordStep wanted = step_of(mesh, step);
  const bool same = reader.read("pressure", step) == wanted.fields[0];
  const bool same_too = reader.read("velocity", step) == wanted.fields[1];
  return reader.read_marks(step) == wanted.marks && same && same_too;
}

}  // namespace

TEST_CASE("a record gives back what was written, at all vertices and cells") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(GENERATE(std::array<int, 3>{5, 4, 0}, std::array<int, 3>{3, 2, 2}));
  const std::string path = folder.file("record.h5");
  write_steps(path, mesh, 3);
  const RecordReader reader = reader_of(path, mesh);
  REQUIRE_ON_ALL_RANKS(reader.times().size() == 3);
  CHECK(reader.times()[0] == 0);
  CHECK(reader.times()[2] == Approx(0.2));
  CHECK(reader.has("velocity"));
  CHECK_FALSE(reader.has("displacement"));
  for (const int n : {0, 2, 1}) CHECK(holds(reader, mesh, n));
}

TEST_CASE("a record keeps what lies in the middles of edges") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box(GENERATE(std::array<int, 3>{5, 4, 0}, std::array<int, 3>{3, 2, 2}));
  const std::string path = folder.file("record.h5");
  RecordStep step{.time = 0, .fields = {{}}, .marks = {}};
  for (std::int32_t edge = 0; edge < mesh.edges.num_local(); ++edge) {
    const double *a = mesh.point(mesh.edge_vertices[2 * edge]), *b = mesh.point(mesh.edge_vertices[2 * edge + 1]);
    for (int k = 0; k < mesh.dimension; ++k) step.fields[0].push_back(a[k] + b[k]);
  }
  const RecordLayout::Field field = {"velocity_of_edges", mesh.dimension, Place::edges};
  {
    RecordWriter writer(path, mesh, {.fields = {field}, .has_marks = false, .single = false});
    writer.write(step);
    step.time = 1;
    writer.write(step);
    writer.flush();
  }
  const RecordReader reader(path, mesh, {}, {field});
  REQUIRE_ON_ALL_RANKS(reader.has("velocity_of_edges"));
  CHECK(reader.read("velocity_of_edges", 1) == step.fields[0]);
}

TEST_CASE("a record can be read by another number of ranks", "[ranks]") {
  const TemporaryFolder folder;
  const std::string path = folder.file("record.h5");
  {
    const mesh::Mesh alone = mesh::distribute(MPI_COMM_SELF, mesh::box(MPI_COMM_SELF, {1, 2, 0}, {5, 4, 0}));
    on_rank_0([&] { write_steps(path, alone, 2); });
  }
  const mesh::Mesh mesh = box();
  const RecordReader reader = reader_of(path, mesh);
  CHECK(holds(reader, mesh, 0));
  CHECK(holds(reader, mesh, 1));
}

TEST_CASE("single precision keeps seven digits in half of the bytes") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box();
  const std::string path = folder.file("record.h5");
  write_steps(path, mesh, 2, true);
  const auto read = reader_of(path, mesh).read("pressure", 1), wanted = step_of(mesh, 1).fields[0];
  for (std::size_t v = 0; v < wanted.size(); ++v) CHECK(read[v] == Approx(wanted[v]).epsilon(1e-7));
  CHECK(read != wanted);
}

TEST_CASE("a record that goes on drops what was recorded after its last step") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box();
  const std::string path = folder.file("record.h5");
  write_steps(path, mesh, 5);
  {
    RecordWriter writer = RecordWriter::resume(path, mesh, layout_of(mesh), 3);
    for (const int n : {3, 4, 5}) writer.write(step_of(mesh, n));
    writer.flush();
  }
  {
    const RecordReader reader = reader_of(path, mesh);
    REQUIRE_ON_ALL_RANKS(reader.times().size() == 6);
    for (int n = 0; n < 6; ++n) CHECK(holds(reader, mesh, n));
  }
  CHECK_THAT(user_error_of([&] { RecordWriter::resume(path, mesh, layout_of(mesh), 7); }), Contains("6 steps"));
  const mesh::Mesh other = box({4, 4, 0});
  CHECK_THAT(user_error_of([&] { RecordWriter::resume(path, other, layout_of(other), 2); }), Contains("another mesh"));
}

TEST_CASE("what was not flushed is no part of a record") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box();
  const std::string path = folder.file("record.h5"), copy = folder.file("copy.h5");
  RecordWriter writer(path, mesh, layout_of(mesh));
  for (int n = 0; n < 5; ++n) {
    writer.write(step_of(mesh, n));
    if (n % 2 == 0) writer.flush();
  }
  for (int n = 5; n < 400; ++n) writer.write(step_of(mesh, n));
  on_rank_0([&] { std::filesystem::copy_file(path, copy); });  // as a crash would leave it
  const RecordReader reader = reader_of(copy, mesh);
  REQUIRE_ON_ALL_RANKS(reader.times().size() == 5);
  for (int n = 0; n < 5; ++n) CHECK(holds(reader, mesh, n));
  CHECK_THAT(user_error_of([&] { reader_of(folder.file("none.h5"), mesh); }), Contains("no such file"));
}

TEST_CASE("a record that is cut off, damaged, incomplete or of another mesh is refused") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box();
  const std::string path = folder.file("record.h5");
  write_steps(path, mesh, 4);
  const auto size = std::filesystem::file_size(path);
  const auto error_of = [&](const mesh::Mesh& on) { return user_error_of([&] { reader_of(path, on); }); };
  const mesh::Mesh other = box({4, 4, 0}), space = box({3, 2, 2});
  CHECK_THAT(error_of(other), Contains("must be of the flow's mesh") && Contains("vertices"));
  CHECK_THAT(error_of(space), Contains("must be of the flow's mesh") && Contains("2 numbers a vertex"));
  const auto change = [&](const std::function<void(hid_t)>& work) {
    on_rank_0([&] {
      Hdf5Handle file = open_hdf5(path, H5F_ACC_RDWR);
      work(file);
      file.close_file();
    });
  };
  change([](hid_t file) { Hdf5Rows::open(file, "/velocity").cut(3); });
  CHECK_THAT(error_of(mesh), Contains("must be whole") && Contains("3 of 4 steps"));
  change([](hid_t file) { H5Adelete(file, "steps"); });
  CHECK_THAT(error_of(mesh), Contains("must be whole") && Contains("steps"));
  change([](hid_t file) { H5Adelete(file, "format"); });
  CHECK_THAT(error_of(mesh), Contains("must be a flow record"));
  on_rank_0([&] { std::filesystem::resize_file(path, size / 2); });
  CHECK_THAT(error_of(mesh), Contains("must be whole") && Contains("remedy"));
}

TEST_CASE("damage within a record is found when the step is read") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box();
  const std::string path = folder.file("record.h5");
  write_steps(path, mesh, 3);
  on_rank_0([&] {
    haddr_t address = 0;
    hsize_t bytes = 0;
    {
      const Hdf5Handle file = open_hdf5(path, H5F_ACC_RDONLY);
      const Hdf5Handle data(H5Dopen2(file, "/pressure", H5P_DEFAULT), H5Dclose, "pressure");
      const Hdf5Handle space(H5Dget_space(data), H5Sclose, "space");
      unsigned mask = 0;
      hsize_t offset[2];
      H5Dget_chunk_info(data, space, 1, offset, &mask, &address, &bytes);
    }
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(address + bytes / 2));
    file.put('!').put('!');
  });
  const RecordReader reader = reader_of(path, mesh);
  CHECK(user_error_of([&] { reader.read("pressure", 0); }).empty());
  CHECK_THAT(user_error_of([&] { reader.read("pressure", 1); }), Contains("must be whole") && Contains("step 1"));
}

TEST_CASE("a record of others may have its vertices in any order, and more of them") {
  const TemporaryFolder folder;
  const mesh::Mesh mesh = box();
  const std::string path = folder.file("others.h5");
  const std::vector<double> inside = InputOrder(mesh).gather(mesh.coordinates, 2);
  on_rank_0([&] {
    const std::size_t count = inside.size() / 2 + 1;
    std::vector<double> coordinates = {9, 9}, pressure, velocity;  // one vertex more
    for (std::size_t v = inside.size() / 2; v-- > 0;) {
      coordinates.insert(coordinates.end(), {inside[2 * v] + 1e-9, inside[2 * v + 1]});
    }
    for (int n = 0; n < 2; ++n) {
      for (std::size_t i = 0; i < coordinates.size(); i += 2) {
        pressure.push_back(n + coordinates[i] + 3 * coordinates[i + 1]);
        velocity.insert(velocity.end(), {coordinates[i], coordinates[i + 1]});
      }
    }
    Hdf5Handle file = create_hdf5(path);
    write_attribute(file, "format", std::string(record_format));
    write_attribute(file, "version", std::vector<std::int64_t>{1});
    write_attribute(file, "steps", std::vector<std::int64_t>{2});
    write_dataset(file, "/mesh/coordinates", coordinates, {count, 2});
    write_dataset(file, "/time", std::vector<double>{3, 4}, {2});
    write_dataset(file, "/pressure", pressure, {2, count});
    write_dataset(file, "/velocity", velocity, {2, count, 2});
    file.close_file();
  });
  const RecordReader reader = reader_of(path, mesh);
  const std::vector<double> pressure = reader.read("pressure", 1);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    CHECK(pressure[v] == Approx(1 + mesh.point(v)[0] + 3 * mesh.point(v)[1]));
  }
  CHECK_FALSE(reader.has_marks());
}

TEST_CASE("a point that two rows claim is nobody's", "[serial]") {
  const std::vector<double> points = {0, 0, 1, 0, 1, 1e-9, 0, 1};
  CHECK(match_points(points, {0, 1, 1, 0, 1e-9, 0, 2, 2}, 2, 1e-8) == std::vector<std::int64_t>{3, -1, 0, -1});
}
