#include "comm/launcher.hpp"

#include <map>
#include <string>

#include <gtest/gtest.h>

namespace octetra::distributed {
namespace {

using Variables = std::map<std::string, std::string>;

bool is_launched_with(const Variables& variables) {
    return is_launched_by_mpi([&](const char* name) -> const char* {
        const auto found = variables.find(name);
        return found == variables.end() ? nullptr : found->second.c_str();
    });
}

TEST(Launcher, IsRecognisedByTheVariablesThatItSets) {
    for (const char* const name :
         {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "MPI_LOCALRANKID",
          "MV2_COMM_WORLD_RANK", "PALS_RANKID", "ALPS_APP_PE", "FLUX_TASK_RANK"}) {
        EXPECT_TRUE(is_launched_with({{name, "0"}})) << name;
    }
}

TEST(Launcher, IsAbsentFromAPlainShell) {
    EXPECT_FALSE(is_launched_with({}));
    EXPECT_FALSE(is_launched_with({{"PATH", "/usr/bin"}, {"SLURM_JOB_ID", "17"}}));
}

TEST(Launcher, OfSlurmIsRecognisedByMoreThanOneTask) {
    EXPECT_TRUE(is_launched_with({{"SLURM_STEP_NUM_TASKS", "2"}}));
    EXPECT_FALSE(is_launched_with({{"SLURM_STEP_NUM_TASKS", "1"}}));
}

TEST(Launcher, IsOverriddenByOctetraMpi) {
    EXPECT_TRUE(is_launched_with({{"OCTETRA_MPI", "1"}}));
    EXPECT_TRUE(is_launched_with({{"OCTETRA_MPI", ""}}));
    EXPECT_FALSE(is_launched_with({{"OCTETRA_MPI", "0"}, {"PMIX_RANK", "0"}}));
}

}  // namespace
}  // namespace octetra::distributed
