#pragma once

#include <mpi.h>

#include <string>

namespace vocalis::base {

/// The text of a small file (at most 16 MB): rank 0 reads, all ranks get it, so that all parse the same words.
/// what   what the file is for, for the message: "case file"
/// Collective. Throws UserError on every rank if it is missing, a folder, not readable, or too large.
std::string read_text(MPI_Comm comm, const std::string& path, const std::string& what);

}  // namespace vocalis::base
