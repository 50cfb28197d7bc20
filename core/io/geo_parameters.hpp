#pragma once

#include <string>
#include <vector>

namespace vocalis::io {

/// A Gmsh geometry and all files that it includes or merges, as far as they can be read. One rank, not collective.
std::vector<std::string> geo_files(const std::string& path);

/// Names of the parameters of a Gmsh geometry: those in its `DefineConstant[...]` lists, and in the files that it
/// includes. One rank, not collective. A file that is missing has none.
std::vector<std::string> geo_parameters(const std::string& path);

}  // namespace vocalis::io
