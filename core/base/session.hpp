#pragma once

namespace vocalis::base {

/// Starts MPI and PETSc, and ends them when it goes out of scope: the first object of every program, so that whatever
/// owns a PETSc object dies before it. PETSc takes its options from `argv`; PETSc errors return a code (see `check`).
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

}  // namespace vocalis::base
