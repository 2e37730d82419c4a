#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/mpi_counter.hpp"
#include "support/temporary_folder.hpp"

namespace octetra {
namespace {

/// All names followed by a parenthesis that begin with the prefix of MPI.
std::set<std::string> mpi_calls_in(const std::filesystem::path& folder) {
    const std::regex call(R"(\b(MPI_[A-Z]\w*)\()");
    std::set<std::string> calls;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const std::string text = test::content_of(entry.path());
        for (std::sregex_iterator i(text.begin(), text.end(), call), end; i != end; ++i) {
            calls.insert((*i)[1]);
        }
    }
    return calls;
}

/// Profiles are compared with the counts of tests/support/mpi_counter.cpp: a new MPI call must be
/// measured by the engine and counted there.
TEST(MpiCalls, ThatSendOrWaitAreAllCounted) {
    const std::set<std::string> neither_send_nor_wait{
        "MPI_Abort",     "MPI_Comm_compare",    "MPI_Comm_dup", "MPI_Comm_rank",
        "MPI_Comm_size", "MPI_Comm_test_inter", "MPI_Finalize", "MPI_Get_count",
        "MPI_Init",      "MPI_Initialized"};
    const auto calls = mpi_calls_in(OCTETRA_SOURCE_DIR "/distributed");
    EXPECT_THAT(calls, testing::Contains("MPI_Isend"));
    EXPECT_THAT(calls, testing::Not(testing::Contains("MPI_Comm_free"))) << "see communicator_of()";
    for (const std::string& call : calls) {
        if (neither_send_nor_wait.contains(call)) continue;
        EXPECT_NE(std::ranges::find(test::counted_calls, call), test::counted_calls.end()) << call;
    }
}

}  // namespace
}  // namespace octetra
