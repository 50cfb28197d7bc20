// Counts what is sent by MPI's profiling interface: a program may define MPI's functions itself and call the true ones
// by the names PMPI_... (MPI 4.0, chapter 15). PETSc's own counters know neither its solvers' messages nor ours.
// Here are the calls that Vocalis, PETSc and hypre make.
#include "core/base/traffic.hpp"

#include <algorithm>
#include <unordered_map>

namespace vocalis::base {

namespace {

/// Mutable and of the whole process, as MPI itself is: those who send are libraries that know no object of ours.
Traffic sent;

/// Bytes of the persistent sends that exist.
std::unordered_map<MPI_Request, std::int64_t>& persistent_sends() {
  static std::unordered_map<MPI_Request, std::int64_t> bytes;
  return bytes;
}

/// What a caller has no say in, as in calls in place, counts as nothing.
std::int64_t bytes_of(int count, MPI_Datatype type) {
  if (type == MPI_DATATYPE_NULL) return 0;
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<std::int64_t>(count) * size;
}

int size_of(MPI_Comm comm) {
  int size = 1;
  PMPI_Comm_size(comm, &size);
  return size;
}

bool is_root(int root, MPI_Comm comm) {
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  return rank == root;
}

void count_message(std::int64_t bytes) {
  ++sent.messages;
  sent.bytes += bytes;
}

void count_message(int count, MPI_Datatype type, int to) {
  if (to != MPI_PROC_NULL) count_message(bytes_of(count, type));
}

void count_reduction(MPI_Comm comm, std::int64_t bytes) {
  if (size_of(comm) == 1) return;
  ++sent.reductions;
  sent.reduction_bytes += bytes;
}

/// With data of its own for each rank; null: nothing.
void count_reduction(MPI_Comm comm, const int* counts, MPI_Datatype type) {
  std::int64_t sum = 0;
  for (int rank = 0; counts && rank < size_of(comm); ++rank) sum += counts[rank];
  count_reduction(comm, counts ? sum * bytes_of(1, type) : 0);
}

void count_start(MPI_Request request) {
  const auto found = persistent_sends().find(request);
  if (found != persistent_sends().end()) count_message(found->second);
}

void remember(int code, int count, MPI_Datatype type, int to, MPI_Request request) {
  if (code == MPI_SUCCESS && to != MPI_PROC_NULL) persistent_sends()[request] = bytes_of(count, type);
}

}  // namespace

Traffic& Traffic::operator+=(const Traffic& other) {
  messages += other.messages;
  bytes += other.bytes;
  reductions += other.reductions;
  reduction_bytes += other.reduction_bytes;
  return *this;
}

Traffic& Traffic::operator-=(const Traffic& other) {
  messages -= other.messages;
  bytes -= other.bytes;
  reductions -= other.reductions;
  reduction_bytes -= other.reduction_bytes;
  return *this;
}

void Traffic::keep_larger(const Traffic& other) {
  messages = std::max(messages, other.messages);
  bytes = std::max(bytes, other.bytes);
  reductions = std::max(reductions, other.reductions);
  reduction_bytes = std::max(reduction_bytes, other.reduction_bytes);
}

Traffic traffic() { return sent; }

Traffic largest(MPI_Comm comm, const Traffic& traffic) {
  std::int64_t counts[] = {traffic.messages, traffic.bytes, traffic.reductions, traffic.reduction_bytes};
  MPI_Allreduce(MPI_IN_PLACE, counts, 4, MPI_INT64_T, MPI_MAX, comm);
  return {counts[0], counts[1], counts[2], counts[3]};
}

}  // namespace vocalis::base

using namespace vocalis::base;

extern "C" {

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_message(count, type, to);
  return PMPI_Send(data, count, type, to, tag, comm);
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count_message(count, type, to);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count_message(count, type, to);
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}

int MPI_Irsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count_message(count, type, to);
  return PMPI_Irsend(data, count, type, to, tag, comm, request);
}

int MPI_Sendrecv(const void* data, int count, MPI_Datatype type, int to, int tag, void* received, int received_count,
                 MPI_Datatype received_type, int from, int received_tag, MPI_Comm comm, MPI_Status* status) {
  count_message(count, type, to);
  return PMPI_Sendrecv(data, count, type, to, tag, received, received_count, received_type, from, received_tag, comm,
                       status);
}

int MPI_Send_init(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
                  MPI_Request* request) {
  const int code = PMPI_Send_init(data, count, type, to, tag, comm, request);
  remember(code, count, type, to, *request);
  return code;
}

int MPI_Startall(int count, MPI_Request* requests) {
  for (int i = 0; i < count; ++i) count_start(requests[i]);
  return PMPI_Startall(count, requests);
}

int MPI_Request_free(MPI_Request* request) {
  persistent_sends().erase(*request);
  return PMPI_Request_free(request);
}

int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  count_reduction(comm, bytes_of(count, type));
  return PMPI_Allreduce(data, result, count, type, operation, comm);
}

int MPI_Iallreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm,
                   MPI_Request* request) {
  count_reduction(comm, bytes_of(count, type));
  return PMPI_Iallreduce(data, result, count, type, operation, comm, request);
}

int MPI_Reduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, int root,
               MPI_Comm comm) {
  count_reduction(comm, bytes_of(count, type));
  return PMPI_Reduce(data, result, count, type, operation, root, comm);
}

int MPI_Reduce_scatter_block(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
                             MPI_Comm comm) {
  count_reduction(comm, bytes_of(count, type) * size_of(comm));
  return PMPI_Reduce_scatter_block(data, result, count, type, operation, comm);
}

int MPI_Scan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  count_reduction(comm, bytes_of(count, type));
  return PMPI_Scan(data, result, count, type, operation, comm);
}

int MPI_Exscan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  count_reduction(comm, bytes_of(count, type));
  return PMPI_Exscan(data, result, count, type, operation, comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  count_reduction(comm, is_root(root, comm) ? bytes_of(count, type) : 0);
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Gather(const void* data, int count, MPI_Datatype type, void* result, int result_count, MPI_Datatype result_type,
               int root, MPI_Comm comm) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Gather(data, count, type, result, result_count, result_type, root, comm);
}

int MPI_Igather(const void* data, int count, MPI_Datatype type, void* result, int result_count,
                MPI_Datatype result_type, int root, MPI_Comm comm, MPI_Request* request) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Igather(data, count, type, result, result_count, result_type, root, comm, request);
}

int MPI_Gatherv(const void* data, int count, MPI_Datatype type, void* result, const int* counts, const int* starts,
                MPI_Datatype result_type, int root, MPI_Comm comm) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Gatherv(data, count, type, result, counts, starts, result_type, root, comm);
}

int MPI_Igatherv(const void* data, int count, MPI_Datatype type, void* result, const int* counts, const int* starts,
                 MPI_Datatype result_type, int root, MPI_Comm comm, MPI_Request* request) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Igatherv(data, count, type, result, counts, starts, result_type, root, comm, request);
}

int MPI_Scatter(const void* data, int count, MPI_Datatype type, void* result, int result_count,
                MPI_Datatype result_type, int root, MPI_Comm comm) {
  count_reduction(comm, is_root(root, comm) ? bytes_of(count, type) * size_of(comm) : 0);
  return PMPI_Scatter(data, count, type, result, result_count, result_type, root, comm);
}

int MPI_Iscatter(const void* data, int count, MPI_Datatype type, void* result, int result_count,
                 MPI_Datatype result_type, int root, MPI_Comm comm, MPI_Request* request) {
  count_reduction(comm, is_root(root, comm) ? bytes_of(count, type) * size_of(comm) : 0);
  return PMPI_Iscatter(data, count, type, result, result_count, result_type, root, comm, request);
}

int MPI_Scatterv(const void* data, const int* counts, const int* starts, MPI_Datatype type, void* result,
                 int result_count, MPI_Datatype result_type, int root, MPI_Comm comm) {
  count_reduction(comm, is_root(root, comm) ? counts : nullptr, type);
  return PMPI_Scatterv(data, counts, starts, type, result, result_count, result_type, root, comm);
}

int MPI_Iscatterv(const void* data, const int* counts, const int* starts, MPI_Datatype type, void* result,
                  int result_count, MPI_Datatype result_type, int root, MPI_Comm comm, MPI_Request* request) {
  count_reduction(comm, is_root(root, comm) ? counts : nullptr, type);
  return PMPI_Iscatterv(data, counts, starts, type, result, result_count, result_type, root, comm, request);
}

int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* result, int result_count,
                  MPI_Datatype result_type, MPI_Comm comm) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Allgather(data, count, type, result, result_count, result_type, comm);
}

int MPI_Allgatherv(const void* data, int count, MPI_Datatype type, void* result, const int* counts, const int* starts,
                   MPI_Datatype result_type, MPI_Comm comm) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Allgatherv(data, count, type, result, counts, starts, result_type, comm);
}

int MPI_Iallgatherv(const void* data, int count, MPI_Datatype type, void* result, const int* counts, const int* starts,
                    MPI_Datatype result_type, MPI_Comm comm, MPI_Request* request) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type));
  return PMPI_Iallgatherv(data, count, type, result, counts, starts, result_type, comm, request);
}

int MPI_Alltoall(const void* data, int count, MPI_Datatype type, void* result, int result_count,
                 MPI_Datatype result_type, MPI_Comm comm) {
  count_reduction(comm, data == MPI_IN_PLACE ? 0 : bytes_of(count, type) * size_of(comm));
  return PMPI_Alltoall(data, count, type, result, result_count, result_type, comm);
}

int MPI_Alltoallv(const void* data, const int* counts, const int* starts, MPI_Datatype type, void* result,
                  const int* result_counts, const int* result_starts, MPI_Datatype result_type, MPI_Comm comm) {
  count_reduction(comm, data == MPI_IN_PLACE ? nullptr : counts, type);
  return PMPI_Alltoallv(data, counts, starts, type, result, result_counts, result_starts, result_type, comm);
}

int MPI_Barrier(MPI_Comm comm) {
  count_reduction(comm, 0);
  return PMPI_Barrier(comm);
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  count_reduction(comm, 0);
  return PMPI_Ibarrier(comm, request);
}

}  // extern "C"
