#pragma once

#include <functional>

namespace octetra::distributed {

/// The value of an environment variable, or null, as std::getenv() returns it.
using Environment = std::function<const char*(const char* name)>;

/// Whether a launcher of MPI programs (mpirun, mpiexec, srun, aprun, flux) started this process as
/// one of possibly many. OCTETRA_MPI decides if it is set: 0 is no, anything else yes. Otherwise a
/// variable does that only launchers set; in a process that none of them started, starting MPI
/// would take time for nothing.
[[nodiscard]] bool is_launched_by_mpi(const Environment& environment);

}  // namespace octetra::distributed
