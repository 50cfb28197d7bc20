#include "core/io/gmsh_reader.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <exception>
#include <fstream>
#include <functional>
#include <regex>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/io/gmsh_model.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

/// Gmsh for the time of one reading. Parameters have to be set on its command line: nothing else reaches the parser.
class GmshSession {
 public:
  explicit GmshSession(const std::map<std::string, double>& parameters) {
    std::vector<std::string> arguments = {"vocalis"};
    for (const auto& [name, value] : parameters) {
      arguments.insert(arguments.end(), {"-setnumber", name, fmt::format("{:.17g}", value)});
    }
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    gmsh::initialize(static_cast<int>(pointers.size()), pointers.data(), false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.MaxNumThreads1D", 1);
    gmsh::option::setNumber("Mesh.MaxNumThreads2D", 1);
    gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1);
    gmsh::logger::start();
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// What Gmsh complained about since the session began.
  static std::string complaints() {
    std::vector<std::string> lines;
    gmsh::logger::get(lines);
    std::string text;
    for (const std::string& line : lines) {
      if (line.starts_with("Error")) text += (text.empty() ? "" : "; ") + line;
    }
    return text;
  }
};

/// Names that a geometry, or a file that it includes, gives to parameters.
std::vector<std::string> defined_parameters(const std::string& path) {
  std::vector<std::string> names;
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  static const std::regex block("DefineConstant\\s*\\[([^\\]]*)\\]"), name("(?:^|[\\s,])([A-Za-z_]\\w*)\\s*=");
  for (std::sregex_iterator i(text.begin(), text.end(), block), end; i != end; ++i) {
    const std::string inside = std::regex_replace((*i)[1].str(), std::regex("//[^\n]*"), "");
    for (std::sregex_iterator j(inside.begin(), inside.end(), name); j != end; ++j) names.push_back((*j)[1]);
  }
  static const std::regex include("\\bInclude\\s+\"([^\"]+)\"");
  const std::string folder = path.substr(0, path.find_last_of('/') + 1);
  for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
    const auto more = defined_parameters(folder + (*i)[1].str());
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

void check_parameters(const std::string& path, const std::map<std::string, double>& parameters) {
  const std::vector<std::string> names = defined_parameters(path);
  for (const auto& [name, value] : parameters) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw UserError("mesh.parameters may set what the geometry " + path + " defines by DefineConstant", name,
                    base::did_you_mean(name, names));
  }
}

void open(const std::string& path) {
  if (!std::ifstream(path)) throw UserError("the mesh must be a file that can be read", path, "check its name");
  try {
    gmsh::open(path);
  } catch (...) {
    throw UserError("Gmsh could not read " + path, GmshSession::complaints(), "correct the file");
  }
  const std::string complaints = GmshSession::complaints();
  if (!complaints.empty()) throw UserError("Gmsh could not read " + path, complaints, "correct the file");
}

/// Runs `read` on rank 0; a UserError there becomes one everywhere.
mesh::WholeMesh on_rank_0(MPI_Comm comm, const std::function<mesh::WholeMesh()>& read) {
  mesh::WholeMesh whole;
  std::vector<char> message;
  if (base::rank(comm) == 0) {
    try {
      whole = read();
    } catch (const UserError& error) {
      const std::string text = error.what();
      message.assign(text.begin(), text.end());
    }
  }
  base::broadcast(comm, message);
  if (!message.empty()) throw UserError(std::string(message.begin(), message.end()));
  std::vector<std::int32_t> dimension = {whole.dimension};
  base::broadcast(comm, dimension);
  whole.dimension = dimension[0];
  whole.region_names = mesh::broadcast_names(comm, whole.region_names);
  whole.group_names = mesh::broadcast_names(comm, whole.group_names);
  return whole;
}

}  // namespace

mesh::WholeMesh mesh_geometry(MPI_Comm comm, const std::string& path, const std::map<std::string, double>& parameters) {
  return on_rank_0(comm, [&] {
    check_parameters(path, parameters);
    const GmshSession session(parameters);
    open(path);
    try {
      gmsh::model::mesh::generate(gmsh::model::getDimension());
    } catch (...) {
      throw UserError("Gmsh could not mesh " + path, GmshSession::complaints(),
                      "check the geometry and its parameters in Gmsh itself");
    }
    return extract_model(path);
  });
}

mesh::WholeMesh read_mesh(MPI_Comm comm, const std::string& path) {
  return on_rank_0(comm, [&] {
    const GmshSession session({});
    open(path);
    return extract_model(path);
  });
}

}  // namespace vocalis::io
