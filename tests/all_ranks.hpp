#pragma once

#include <mpi.h>

#include <catch2/catch.hpp>

/// Requires a condition on every rank of the world together. A plain REQUIRE that fails on one rank leaves the others
/// waiting in their next collective for ever; this one stops all of them. Collective.
#define REQUIRE_ON_ALL_RANKS(condition)                                       \
  do {                                                                        \
    int here_ = (condition) ? 1 : 0;                                          \
    int everywhere_ = 0;                                                      \
    CHECK(here_ == 1);                                                        \
    MPI_Allreduce(&here_, &everywhere_, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD); \
    INFO("the condition on all ranks: " #condition);                          \
    REQUIRE(everywhere_ == 1);                                                \
  } while (false)
