#include "core/la/condensation.hpp"

#include <mpi.h>

#include <algorithm>
#include <cassert>

namespace vocalis::la {

namespace {

// Jobs and controls, numbered as in MUMPS's manual.
constexpr int begin = -1, end = -2, analyse = 1, factor = 2, solve = 3;
constexpr int errors = 1, diagnostics = 2, global = 3, level = 4, permutation = 6, spare_memory = 14, keeps = 19,
              part = 26;
constexpr int delayed_pivots = 13, changed_pivots = 25;  // in INFOG
constexpr int no_space = -9, no_integer_space = -8;
constexpr int most_percent = 10000;

std::vector<int> from_one(std::span<const int> indices) {
  std::vector<int> result(indices.begin(), indices.end());
  for (int& index : result) ++index;
  return result;
}

}  // namespace

Condensation::Condensation(const MatrixEntries& entries, std::span<const int> kept)
    : rows_(from_one(entries.rows)),
      columns_(from_one(entries.columns)),
      kept_(from_one(kept)),
      kept_load_(kept.size()),
      load_(entries.size) {
  mumps_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_SELF));
  mumps_.par = 1;
  run(begin);
  const auto control = [&](int number) -> MUMPS_INT& { return mumps_.icntl[number - 1]; };
  control(errors) = control(diagnostics) = control(global) = -1;
  control(level) = 0;
  control(spare_memory) = 100;  // per cent: pivots that move need more than was foreseen
  control(permutation) = 0;     // it would want the values
  control(keeps) = kept_.empty() ? 0 : 1;
  mumps_.n = entries.size;
  mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
  mumps_.irn = rows_.data();
  mumps_.jcn = columns_.data();
  mumps_.size_schur = static_cast<MUMPS_INT>(kept_.size());
  mumps_.listvar_schur = kept_.data();
  mumps_.redrhs = kept_load_.data();
  mumps_.lredrhs = static_cast<MUMPS_INT>(kept_.size());
  mumps_.rhs = load_.data();
  mumps_.nrhs = 1;
  mumps_.lrhs = entries.size;
  run(analyse);
}

Condensation::~Condensation() { run(end); }

void Condensation::run(int job) {
  mumps_.job = job;
  dmumps_c(&mumps_);
}

bool Condensation::factorise(std::span<const double> values) {
  assert(values.size() == rows_.size());
  values_.assign(values.begin(), values.end());  // MUMPS may scale them in place
  mumps_.a = values_.data();
  kept_matrix_.resize(kept_.size() * kept_.size());  // not before it is known to be wanted: it may be large
  mumps_.schur = kept_matrix_.data();
  MUMPS_INT& percent = mumps_.icntl[spare_memory - 1];
  run(factor);
  while ((mumps_.infog[0] == no_space || mumps_.infog[0] == no_integer_space) && percent < most_percent) {
    percent *= 2;
    run(factor);
  }
  return mumps_.infog[0] >= 0 && mumps_.infog[delayed_pivots - 1] == 0 && mumps_.infog[changed_pivots - 1] == 0;
}

std::span<double> Condensation::condense(std::span<const double> load) {
  std::copy(load.begin(), load.end(), load_.begin());
  if (kept_.empty()) return {};
  mumps_.icntl[part - 1] = 1;
  run(solve);
  return kept_load_;
}

std::span<const double> Condensation::expand() {
  mumps_.icntl[part - 1] = kept_.empty() ? 0 : 2;
  run(solve);
  return load_;
}

}  // namespace vocalis::la
