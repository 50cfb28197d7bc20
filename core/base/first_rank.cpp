#include "core/base/first_rank.hpp"

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::base {

void on_first_rank(MPI_Comm comm, const std::function<void()>& work) {
  std::vector<char> problem;
  if (rank(comm) == 0) {
    try {
      work();
    } catch (const UserError& error) {
      const std::string words = error.what();
      problem.assign(words.begin(), words.end());
    }
  }
  broadcast(comm, problem);
  if (!problem.empty()) throw UserError(std::string(problem.begin(), problem.end()));
}

}  // namespace vocalis::base
