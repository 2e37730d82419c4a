#pragma once

#include <mpi.h>

#include <cstdlib>

/// For libraries that are preloaded into programs under mpirun. The launchers of MPI name the rank
/// differently in the environment, so MPI itself is asked.
namespace octetra::preloaded {

inline int number_in_environment(const char* name) {
    const char* const text = std::getenv(name);
    return text == nullptr ? 0 : std::atoi(text);
}

/// Returns whether this rank is the one that the variable names. Requires that MPI is started.
inline bool is_rank_in_environment(const char* name) {
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == number_in_environment(name);
}

}  // namespace octetra::preloaded
