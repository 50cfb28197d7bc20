#include "core/io/xdmf.hpp"

#include <fmt/format.h>

namespace vocalis::io {

namespace {

/// A dataset of fields.h5. type "Float" with 8 bytes, or "Int" with 4 or 8.
std::string item(const std::string& shape, const char* type, int bytes, const std::string& dataset) {
  return fmt::format(R"(<DataItem Dimensions="{}" NumberType="{}" Precision="{}" Format="HDF">fields.h5:{}</DataItem>)",
                     shape, type, bytes, dataset);
}

std::string mesh_elements(const XdmfMesh& mesh) {
  const auto cells = item(fmt::format("{} {}", mesh.num_cells, mesh.dimension + 1), "Int", 8, "/mesh/cells");
  const auto points = item(fmt::format("{} 3", mesh.num_vertices), "Float", 8, "/mesh/coordinates");
  const auto regions = item(std::to_string(mesh.num_cells), "Int", 4, "/mesh/region");
  return fmt::format(
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
      "        <Attribute Name=\"region\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n",
      mesh.dimension == 2 ? "Triangle" : "Tetrahedron", mesh.num_cells, cells, points, regions);
}

std::string field_element(const XdmfMesh& mesh, long step, const XdmfField& field) {
  const bool is_scalar = field.components == 1;
  const auto shape = is_scalar ? std::to_string(mesh.num_vertices) : fmt::format("{} 3", mesh.num_vertices);
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", field.name,
                     is_scalar ? "Scalar" : "Vector",
                     item(shape, "Float", 8, "/" + step_group(step) + "/" + field.name));
}

}  // namespace

std::string step_group(long step) { return fmt::format("step_{:08d}", step); }

std::string xdmf_step(const XdmfMesh& mesh, long step, double time, const std::vector<XdmfField>& fields) {
  std::string text = fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n",
                                 step_group(step), time) +
                     mesh_elements(mesh);
  for (const XdmfField& field : fields) text += field_element(mesh, step, field);
  return text + "      </Grid>\n";
}

std::string xdmf_file(const XdmfMesh& mesh, const std::vector<std::string>& steps) {
  std::string text = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
  if (steps.empty()) {
    text += "      <Grid Name=\"mesh\" GridType=\"Uniform\">\n" + mesh_elements(mesh) + "      </Grid>\n";
  } else {
    text += "    <Grid Name=\"steps\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const std::string& step : steps) text += step;
    text += "    </Grid>\n";
  }
  return text + "  </Domain>\n</Xdmf>\n";
}

}  // namespace vocalis::io
