#include <algorithm>
#include <cmath>
#include <set>

#include "core/io/gmsh_reader.hpp"
#include "tests/all_ranks.hpp"
#include "tests/io/rank_0.hpp"
#include "tests/io/temporary_folder.hpp"

using namespace vocalis;
using namespace vocalis::io;

namespace {

/// A square of side 1 m with a circle of radius 0.2 m in it, which is a region of its own.
const std::string disc_in_square = R"(
DefineConstant[ size = 0.1 ];
Point(1) = {0, 0, 0, size}; Point(2) = {1, 0, 0, size}; Point(3) = {1, 1, 0, size}; Point(4) = {0, 1, 0, size};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(5) = {0.4, 0.5, 0, size}; Point(6) = {0.6, 0.5, 0, size}; Point(7) = {0.4, 0.7, 0, size};
Point(8) = {0.2, 0.5, 0, size}; Point(9) = {0.4, 0.3, 0, size};
Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 8}; Circle(7) = {8, 5, 9}; Circle(8) = {9, 5, 6};
Transfinite Curve{5:8} = 1 + Ceil(0.3 / size);
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5:8};
Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};
)";
const std::string names =
    "Physical Surface(\"fluid\") = {1}; Physical Surface(\"disc\") = {2}; Physical Curve(\"circle\") = {5:8};\n";

double distance_from_axis(const double* point) { return std::hypot(point[0] - 0.4, point[1] - 0.5); }

/// How far the curved middles are from the circle at most. Rank 0.
double distance_from_circle(const mesh::WholeMesh& mesh) {
  double result = 0;
  for (std::size_t first = 0; first < mesh.curved_points.size(); first += mesh.dimension) {
    result = std::max(result, std::abs(distance_from_axis(mesh.curved_points.data() + first) - 0.2));
  }
  return result;
}

/// Area of the disc on P2 cells, around its middle: triangles below the chords and two thirds of chord times sagitta.
double disc_area(const mesh::WholeMesh& mesh) {
  double area = 0;
  for (std::size_t edge = 0; 2 * edge < mesh.curved_edges.size(); ++edge) {
    const double* a = mesh.coordinates.data() + 2 * mesh.curved_edges[2 * edge];
    const double* b = mesh.coordinates.data() + 2 * mesh.curved_edges[2 * edge + 1];
    const double* middle = mesh.curved_points.data() + 2 * edge;
    const double chord = std::hypot(a[0] - b[0], a[1] - b[1]);
    const double height = distance_from_axis(std::array{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}.data());
    area += 0.5 * chord * height + 2.0 / 3 * chord * (distance_from_axis(middle) - height);
  }
  return area;
}

/// A mesh file of one triangle with six nodes, one of them in the middle of the first edge, (0, 0) to (1, 0).
std::string one_triangle(const std::string& middle) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"fluid\"\n$EndPhysicalNames\n"
         "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 " +
         middle + "\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n$EndElements\n";
}

}  // namespace

TEST_CASE("the middles of curved edges lie on the drawn circle, and the rest of the mesh does not change") {
  const TemporaryFolder folder;
  const std::string path = folder.write("disc.geo", disc_in_square + names);
  const mesh::WholeMesh straight = mesh_geometry(MPI_COMM_WORLD, path, {});
  const mesh::WholeMesh curved = mesh_geometry(MPI_COMM_WORLD, path, {}, true);
  CHECK(straight.curved_edges.empty());
  CHECK(curved.coordinates == straight.coordinates);
  CHECK(curved.cell_vertices == straight.cell_vertices);
  CHECK(curved.cell_region == straight.cell_region);
  CHECK(curved.facet_vertices == straight.facet_vertices);
  CHECK(curved.facet_group == straight.facet_group);
  CHECK(curved.curved_edges.size() == curved.facet_vertices.size());
  CHECK(distance_from_circle(curved) < 1e-14);
  // The disc's edges, cut into equal parts, each have their middle in the middle.
  for (std::size_t i = 0; i < curved.curved_edges.size(); ++i) {
    const double* end = curved.coordinates.data() + 2 * curved.curved_edges[i];
    const double* middle = curved.curved_points.data() + i / 2 * 2;
    CHECK(std::hypot(end[0] - middle[0], end[1] - middle[1]) == Approx(2 * 0.2 * std::sin(M_PI / 4 / 6)));
  }
}

TEST_CASE("the area of a disc of curved cells errs with the fourth power of their size", "[serial]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("disc.geo", disc_in_square + names);
  std::vector<double> errors;
  for (const double size : {0.1, 0.05}) {
    const mesh::WholeMesh mesh = mesh_geometry(MPI_COMM_WORLD, path, {{"size", size}}, true);
    errors.push_back(std::abs(disc_area(mesh) - 0.04 * M_PI));
  }
  CHECK(std::log2(errors[0] / errors[1]) == Approx(4).margin(0.1));
}

TEST_CASE("curved edges of tetrahedra lie on the drawn cylinder") {
  const TemporaryFolder folder;
  const std::string path = folder.write("cylinder.geo", disc_in_square + R"(
    out() = Extrude {0, 0, 0.4} { Surface{1}; };
    Physical Volume("fluid") = {out(1)}; Physical Surface("cylinder") = {out({6:9})};
)");
  const mesh::WholeMesh mesh = mesh_geometry(MPI_COMM_WORLD, path, {{"size", 0.2}}, true);
  CHECK(mesh.dimension == 3);
  CHECK(distance_from_circle(mesh) < 1e-10);
  // All edges of the group's triangles are curved, but for those that run along the axis.
  std::set<std::array<std::int64_t, 2>> wanted, found;
  for (std::size_t facet = 0; facet < mesh.facet_group.size(); ++facet) {
    for (const auto& [i, j] : mesh::edges_of_cell(2)) {
      const auto [a, b] = std::minmax(mesh.facet_vertices[3 * facet + i], mesh.facet_vertices[3 * facet + j]);
      const double *one = mesh.coordinates.data() + 3 * a, *other = mesh.coordinates.data() + 3 * b;
      if (std::hypot(one[0] - other[0], one[1] - other[1]) > 1e-6) wanted.insert({a, b});
    }
  }
  for (std::size_t i = 0; i < mesh.curved_edges.size(); i += 2) {
    found.insert({mesh.curved_edges[i], mesh.curved_edges[i + 1]});
    const double* a = mesh.coordinates.data() + 3 * mesh.curved_edges[i];
    const double* b = mesh.coordinates.data() + 3 * mesh.curved_edges[i + 1];
    CHECK(std::abs(mesh.curved_points[i / 2 * 3 + 2] - 0.5 * (a[2] + b[2])) < 1e-10);
  }
  CHECK(found == wanted);
  if (base::rank(MPI_COMM_WORLD) == 0) CHECK(found.size() > 16);
}

TEST_CASE("a file of second-order cells brings its own middles, or is read without") {
  const TemporaryFolder folder;
  const std::string drawn = folder.write("disc.geo", disc_in_square + names);
  const std::string file = folder.file("disc.msh");
  const std::string saving =
      folder.write("saving.geo", disc_in_square + names + "Mesh.ElementOrder = 2;\nMesh 2;\nSave \"" + file + "\";\n");
  const mesh::WholeMesh from_geometry = mesh_geometry(MPI_COMM_WORLD, drawn, {}, true);
  const mesh::WholeMesh from_saving = mesh_geometry(MPI_COMM_WORLD, saving, {}, true);
  const mesh::WholeMesh from_file = read_mesh(MPI_COMM_WORLD, file, true);
  const mesh::WholeMesh corners = read_mesh(MPI_COMM_WORLD, file);
  CHECK(from_saving.curved_edges == from_geometry.curved_edges);
  CHECK(from_file.curved_edges == from_geometry.curved_edges);
  CHECK(distance_from_circle(from_file) < 1e-10);
  CHECK(from_file.cell_vertices == from_geometry.cell_vertices);
  CHECK(from_file.facet_vertices == from_geometry.facet_vertices);
  CHECK(corners.curved_edges.empty());
  CHECK(corners.cell_vertices == from_geometry.cell_vertices);
}

TEST_CASE("bad curved cells are refused on every rank in words that help") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const auto read = [&](const std::string& middle) {
    return read_mesh(MPI_COMM_WORLD, folder.write("one.msh", one_triangle(middle)), true);
  };
  const mesh::WholeMesh good = read("0.5 -0.1 0");
  if (base::rank(MPI_COMM_WORLD) == 0) {
    CHECK(good.curved_edges == std::vector<std::int64_t>{0, 1});
    CHECK(good.curved_points == std::vector<double>{0.5, -0.1});
  }
  CHECK_THAT(error_of([&] { read("0.5 0.4 0"); }), Contains("inside out") && Contains("\"fluid\""));
  CHECK_THAT(error_of([&] { read("nan 0 0"); }), Contains("finite") && Contains("node 4"));
}
