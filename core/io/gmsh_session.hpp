#pragma once

#include <string>

#include "core/io/geo_parameters.hpp"

namespace vocalis::io {

/// Gmsh's library with one model in it, from the constructor to the end of the scope. One rank, not collective; one at
/// a time, for the library is a global.
class GmshSession {
 public:
  /// Opens a file, and meshes it if it came without cells. If `curved`, the linear cells of a geometry get nodes in the
  /// middles of their edges, on its curves and surfaces. Throws UserError with Gmsh's own words.
  GmshSession(const std::string& path, const GeoValues& parameters, bool curved);
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

 private:
  void open(const std::string& path, const GeoValues& parameters, bool curved);
};

}  // namespace vocalis::io
