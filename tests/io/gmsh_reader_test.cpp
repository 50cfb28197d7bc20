#include "core/io/gmsh_reader.hpp"

#include "core/io/geo_parameters.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/all_ranks.hpp"
#include "tests/io/rank_0.hpp"
#include "tests/io/temporary_folder.hpp"

using namespace vocalis;
using namespace vocalis::io;

namespace {

const std::string rectangle = R"(
DefineConstant[ width = 1, // [m], not a parameter: depth = 2,
  height = {0.5, Min 0, Max 1, Name "Parameters/height"}, steps = 2 ];
/* DefineConstant[ hidden = 1 ]; */
Point(1) = {0, 0, 0, 0.3}; Point(2) = {width, 0, 0, 0.3};
Point(3) = {width, height, 0, 0.3}; Point(4) = {0, height, 0, 0.3};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
)";
const std::string names = "Physical Surface(\"fluid\") = {1}; Physical Curve(\"inlet\") = {4};\n";

/// A mesh file of format 2.2 with two triangles in region 1 "fluid".
std::string two_triangles(const std::string& third_point, const std::string& cells) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"fluid\"\n$EndPhysicalNames\n"
         "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 " +
         third_point + "\n4 0 1 0\n9 7 7 0\n$EndNodes\n$Elements\n" + cells + "$EndElements\n";
}
const std::string good_cells = "2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 4 3\n";

std::string error_of_file(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const std::string path = folder.write(name, text);
  return error_of([&] { read_mesh(MPI_COMM_WORLD, path); });
}

double measure(const mesh::Mesh& mesh) {
  double sum = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) sum += mesh::signed_volume(mesh, mesh.vertices_of(cell));
  return base::sum(mesh.comm, sum);
}

}  // namespace

TEST_CASE("a geometry is meshed with its parameters, and forgets them afterwards") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rectangle.geo", rectangle + names);
  const mesh::WholeMesh wide = mesh_geometry(MPI_COMM_WORLD, path, {{"width", 3.0}, {"height", 2.0}});
  CHECK(wide.dimension == 2);
  CHECK(wide.region_names == std::vector<std::string>{"fluid"});
  CHECK(wide.group_names == std::vector<std::string>{"inlet"});
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, wide);
  CHECK(measure(mesh) == Approx(6));
  double length = 0;
  for (const auto& facet : mesh::facets_of_group(mesh, "inlet")) {
    length += mesh::facet_geometry(mesh, facet.cell, facet.index).measure;
  }
  CHECK(base::sum(MPI_COMM_WORLD, length) == Approx(2));
  const mesh::WholeMesh plain = mesh_geometry(MPI_COMM_WORLD, path, {});
  CHECK(measure(mesh::distribute(MPI_COMM_WORLD, plain)) == Approx(0.5));
}

TEST_CASE("a parameter of a geometry may be a list of numbers") {
  const TemporaryFolder folder;
  const std::string path = folder.write("stairs.geo", R"(SetFactory("OpenCASCADE");
DefineConstant[ heights() = {{1, 2}}, unit = 1 ];
For i In {0 : #heights() - 1}
  Rectangle(i + 1) = {i, 0, 0, 1, heights(i) * unit};
  all(i) = i + 1;
EndFor
Physical Surface("steps") = {all()};
)");
  const auto area = [&](const GeoValues& values) {
    return measure(mesh::distribute(MPI_COMM_WORLD, mesh_geometry(MPI_COMM_WORLD, path, values)));
  };
  CHECK(area({}) == Approx(3));
  CHECK(area({{"heights", std::vector<double>{2, 3, 4}}, {"unit", 0.5}}) == Approx(4.5));
  CHECK(area({{"heights", std::vector<double>{7}}}) == Approx(7));
}

TEST_CASE("the same geometry gives the same mesh") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rectangle.geo", rectangle + names);
  const mesh::WholeMesh first = read_mesh(MPI_COMM_WORLD, path), second = read_mesh(MPI_COMM_WORLD, path);
  CHECK(first.coordinates == second.coordinates);
  CHECK(first.cell_vertices == second.cell_vertices);
}

TEST_CASE("a box of tetrahedra has volumes for regions and surfaces for groups") {
  const TemporaryFolder folder;
  const std::string path = folder.write("box.geo", rectangle + R"(
    out() = Extrude {0, 0, 2} { Surface{1}; };
    Physical Volume("air") = {out(1)}; Physical Surface("floor") = {1};
)");
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, read_mesh(MPI_COMM_WORLD, path));
  CHECK(mesh.dimension == 3);
  CHECK(measure(mesh) == Approx(1));
  double area = 0;
  for (const auto& facet : mesh::facets_of_group(mesh, "floor")) {
    area += mesh::facet_geometry(mesh, facet.cell, facet.index).measure;
  }
  CHECK(base::sum(MPI_COMM_WORLD, area) == Approx(0.5));
}

TEST_CASE("a mesh file is read: clockwise cells are turned, unused vertices left out") {
  const TemporaryFolder folder;
  const std::string path = folder.write("two.msh", two_triangles("1 1 0", good_cells));
  const mesh::WholeMesh mesh = read_mesh(MPI_COMM_WORLD, path);
  if (base::rank(MPI_COMM_WORLD) == 0) {
    CHECK(mesh.coordinates == std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1});
    CHECK(mesh.cell_vertices == std::vector<std::int64_t>{0, 1, 2, 0, 2, 3});
    CHECK(mesh.cell_region == std::vector<std::int32_t>{0, 0});
  } else {
    CHECK(mesh.num_cells() == 0);
  }
}

TEST_CASE("names of parameters come from DefineConstant, included files too", "[serial]") {
  const TemporaryFolder folder;
  folder.write("inner.geo", rectangle);
  const std::string path = folder.write("outer.geo", "DefineConstant[ a = 1 ];\nInclude \"inner.geo\";\n" + names);
  CHECK(geo_parameters(path) == std::vector<std::string>{"a", "width", "height", "steps"});
}

TEST_CASE("bad meshes are refused on every rank in words that help") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const std::string good = folder.write("good.geo", rectangle + names);

  CHECK_THAT(error_of([&] { read_mesh(MPI_COMM_WORLD, folder.file("missing.geo")); }), Contains("missing.geo"));
  CHECK_THAT(error_of([&] { read_mesh(MPI_COMM_WORLD, folder.path()); }), Contains("folder"));
  CHECK_THAT(error_of([&] {
               mesh_geometry(MPI_COMM_WORLD, good, {{"widht", 1.0}});
             }),
             Contains("did you mean \"width\""));
  CHECK_THAT(error_of([&] {
               mesh_geometry(MPI_COMM_WORLD, good, {{"hidden", 1.0}});
             }),
             Contains("mesh.parameters.hidden"));
  CHECK_THAT(error_of_file(folder, "syntax.geo", rectangle + "\nPlane Surfac(2) = {1};\n"),
             Contains("line 10") && Contains("syntax error"));
  CHECK_THAT(error_of_file(folder, "no_line_break.geo", rectangle + "Physical Surface(\"a\") = {1};"),
             Contains("last line"));
  // Gmsh's parser must not remember the broken file.
  const mesh::WholeMesh after = read_mesh(MPI_COMM_WORLD, good);
  CHECK(after.region_names.size() == 1);

  CHECK_THAT(error_of_file(folder, "points.geo", "Point(1) = {0, 0, 0, 1};\n"), Contains("no cells"));
  CHECK_THAT(error_of_file(folder, "empty.msh", ""), Contains("empty.msh"));
  CHECK_THAT(error_of_file(folder, "no_region.geo", rectangle), Contains("belong to none"));
  CHECK_THAT(error_of_file(folder, "two_regions.geo",
                           rectangle + "Physical Surface(\"a\") = {1}; Physical Surface(\"b\") = {1};\n"),
             Contains("2 regions"));
  CHECK_THAT(error_of_file(folder, "unnamed.geo", rectangle + "Physical Surface(7) = {1};\n"), Contains("group 7"));
  CHECK_THAT(error_of_file(folder, "unnamed_facets.geo", rectangle + names + "Physical Curve(8) = {1};\n"),
             Contains("group 8"));
  CHECK_THAT(error_of_file(folder, "quadrilaterals.geo", rectangle + names + "Recombine Surface{1};\n"),
             Contains("Quad"));
  CHECK_THAT(error_of_file(folder, "third_order.geo", rectangle + names + "Mesh.ElementOrder = 3;\n"),
             Contains("Mesh.ElementOrder"));
  CHECK_THAT(
      error_of_file(folder, "tilted.geo", rectangle + names + "Rotate {{1, 0, 0}, {0, 0, 0}, 1} { Surface{1}; }\n"),
      Contains("z = 0"));
  CHECK_THAT(error_of_file(folder, "flat.msh", two_triangles("0.5 0 0", good_cells)), Contains("volume"));
  CHECK_THAT(error_of_file(folder, "nan.msh", two_triangles("nan 1 0", good_cells)), Contains("finite"));
  const std::string whole = two_triangles("1 1 0", good_cells);
  CHECK_THAT(error_of_file(folder, "cut.msh", whole.substr(0, whole.find("4 0 1"))), Contains("cut.msh"));
  const std::string two = folder.write("two.msh", whole);
  CHECK_THAT(error_of([&] { mesh_geometry(MPI_COMM_WORLD, two, {{"width", 1.0}}); }), Contains("only a .geo file"));
}

TEST_CASE("the broken meshes kept for the whole program are refused by name") {
  const std::string folder = VOCALIS_SOURCE_DIR "/tests/broken_cases/";
  for (const std::string name :
       {"empty.geo", "bad_syntax.geo", "no_groups.geo", "only_curves.geo", "letter.msh", "truncated.msh",
        "flat_cell.msh", "nan_node.msh", "missing_node.msh", "quadrangle.msh"}) {
    CHECK_THAT(error_of([&] { read_mesh(MPI_COMM_WORLD, folder + name); }), Catch::Contains(name));
  }
}
