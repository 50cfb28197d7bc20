#pragma once

#include <mpi.h>

#include <string>

#include "core/base/case_table.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling {

/// Reads a tree, whose root has the tables of a case; `file` is where it came from. Collective.
Case read_case_tree(MPI_Comm comm, const std::string& file, base::TomlNode tree);

// The sections of a case file, one function each; `read_case` calls them. All throw UserError.

MeshSettings read_mesh(MPI_Comm comm, base::Table& mesh, const Case& config);  ///< collective
void read_regions(base::Table& root, Case& config);
void read_flow(base::Table& root, Case& config);
void read_given_flow(MPI_Comm comm, base::Table& root, Case& config);  ///< collective
void read_record(base::Table& root, Case& config);                     ///< after the flow
void read_time(base::Table& root, Case& config);
void read_contact(base::Table& root, Case& config);                   ///< after regions, flow and time
void read_acoustics(MPI_Comm comm, base::Table& root, Case& config);  ///< collective
/// The analogies of one [[acoustic]] table, each a voice: `analogy` may be several names.
std::vector<acoustic::AnalogySettings> read_analogies(base::Table& table, const Case& config);
void read_source(MPI_Comm comm, base::Table& root, Case& config);  ///< collective
void read_microphones(base::Table& root, Case& config);
void read_monitors(base::Table& root, Case& config);
void read_statistics(base::Table& root, Case& config);

/// Whether [flow] is a formula or a record instead of settings of a solver.
bool is_flow_given(base::Table& root);

/// The absolute path of a file that is named relative to the case file; resolved.toml gets it, too. Collective.
std::string read_file_name(MPI_Comm comm, base::Table& table, const std::string& key, const Case& config);

/// A name that becomes part of file names and of column names: letters, digits, "_" and "-".
std::string read_plain_name(base::Table& table, const std::string& key);
std::string read_plain_name_or(base::Table& table, const std::string& key, const std::string& fallback);

/// A vector of 2 or 3 components; the third is 0 if it is missing. The mesh decides later which is right.
std::array<double, 3> read_vector(base::Table& table, const std::string& key, const std::string& unit, Case& config);
std::array<double, 3> read_vector_or(base::Table& table, const std::string& key, const std::array<double, 3>& fallback,
                                     const std::string& unit, Case& config);

/// The name of a group of facets; the names of several.
std::string read_group(base::Table& table, Case& config, const std::string& key = "group");
std::vector<std::string> read_groups(base::Table& table, Case& config, const std::string& key = "groups");

/// Throws if a name stands twice. `what` is the kind of thing, "[[region]]", and `key` what names it there.
void reject_duplicates(const base::Table& root, const std::string& what, const std::vector<std::string>& names,
                       const std::string& key = "name");

}  // namespace vocalis::coupling
