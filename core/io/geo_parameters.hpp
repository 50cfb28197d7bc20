#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace vocalis::io {

/// Values for parameters of a Gmsh geometry by their names: a number, or a list of numbers.
using GeoValues = std::map<std::string, std::variant<double, std::vector<double>>>;

/// A Gmsh geometry and all files that it includes or merges, as far as they can be read. One rank, not collective.
std::vector<std::string> geo_files(const std::string& path);

/// Names of the parameters of a Gmsh geometry: those in its `DefineConstant[...]` lists, and in the files that it
/// includes. One rank, not collective. A file that is missing has none.
std::vector<std::string> geo_parameters(const std::string& path);

}  // namespace vocalis::io
