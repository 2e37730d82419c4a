#include "comm/launcher.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace octetra::distributed {

bool is_launched_by_mpi(const Environment& environment) {
    if (const char* const choice = environment("OCTETRA_MPI"); choice != nullptr) {
        return std::string_view(choice) != "0";
    }
    constexpr std::array set_by_launchers{
        "OMPI_COMM_WORLD_SIZE",  // Open MPI
        "PMIX_RANK",             // PMIx: Open MPI 5, srun --mpi=pmix
        "PMI_RANK",              // PMI: MPICH, Intel MPI, srun --mpi=pmi2
        "PMI_SIZE",              // PMI
        "MPI_LOCALRANKID",       // Hydra of MPICH and Intel MPI
        "MV2_COMM_WORLD_RANK",   // MVAPICH
        "PALS_RANKID",           // Cray PALS
        "ALPS_APP_PE",           // Cray ALPS
        "FLUX_TASK_RANK",        // Flux
    };
    const auto is_set = [&](const char* name) { return environment(name) != nullptr; };
    if (std::ranges::any_of(set_by_launchers, is_set)) return true;
    // srun sets it for one task, too, and so do shells that it starts for interactive work.
    const char* const tasks = environment("SLURM_STEP_NUM_TASKS");
    return tasks != nullptr && std::string_view(tasks) != "1";
}

}  // namespace octetra::distributed
