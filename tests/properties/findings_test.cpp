#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "properties/case_files.hpp"
#include "properties/judge.hpp"
#include "properties/team.hpp"

/// Regression tests of findings: corpus/regression/, or the one file that OCTETRA_FINDING names.
namespace octetra::properties {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of_findings() {
    if (const char* const one = std::getenv("OCTETRA_FINDING"); one != nullptr) return {one};
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(OCTETRA_SOURCE_DIR "/corpus/regression")) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

class Findings : public testing::TestWithParam<fs::path> {};

TEST_P(Findings, BreakTheirLawNoMore) {
    run_on_first_rank([] {
        const Finding finding = read_finding(GetParam());
        EXPECT_EQ(judge(law_named(finding.law), finding.refinement), "");
    });
}

std::string name_of(const testing::TestParamInfo<fs::path>& file) {
    std::string name = file.param.stem().string();
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(, Findings, testing::ValuesIn(files_of_findings()), name_of);

}  // namespace
}  // namespace octetra::properties
