#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/input_order.hpp"

namespace vocalis::io {

/// What a record keeps of each step; docs/flow-record.md is its description for others.
///
/// /                     attributes `format` "vocalis flow record", `version` 1, `steps`: how many are whole, written
///                       last
/// /mesh/coordinates     (vertices, dimension) [m]
/// /mesh/cells           (cells, dimension + 1) rows of coordinates; needed with in_contact
/// /mesh/edges           (edges, 2) likewise; only with fields there
/// /time                 (steps) [s]
/// /NAME                 (steps, vertices) or (steps, vertices, dimension), double or single precision; or at edges
/// /in_contact           (steps, cells) 0 or 1
struct RecordLayout {
  struct Field {
    std::string name;
    int components = 1;
    Place where = Place::vertices;
  };
  std::vector<Field> fields;
  bool has_marks = false;  ///< in_contact
  bool single = false;     ///< precision of the fields
};

inline constexpr const char* record_format = "vocalis flow record";
inline constexpr std::int64_t record_version = 1;
inline constexpr const char* record_marks = "in_contact";

/// One step of all fields, in the order of the layout.
struct RecordStep {
  double time = 0;                          ///< [s]
  std::vector<std::vector<double>> fields;  ///< (vertices or edges, components); ghosts are not read
  std::vector<char> marks;                  ///< (owned cells)
};

}  // namespace vocalis::io
