#include "properties/report.hpp"

#include <fmt/format.h>

#include "properties/case_json.hpp"

namespace octetra::properties {

std::string name_of(const Finding& finding) {
    std::string content = json_of(finding.refinement).dump();
    for (const Point& p : finding.refinement.mesh.points) {
        content += fmt::format("{} {} {} ", p.x, p.y, p.z);
    }
    return fmt::format("{}-{:016x}", finding.law, std::hash<std::string>{}(content));
}

std::string counted(std::size_t count, const std::string& what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string size_of(const Case& c) {
    return counted(c.mesh.cells.size(), "cell") + ", " +
           (c.steps.empty() ? counted(static_cast<std::size_t>(c.levels), "level")
                            : counted(c.steps.size(), "step"));
}

std::string description(const Finding& finding, const std::filesystem::path& file) {
    return fmt::format(
        "{}: {}\n{}\nreplay: OCTETRA_FINDING={} {}/tests/support/mpirun.sh {} {} "
        "--gtest_filter='*Findings*'",
        finding.law, finding.fault, size_of(finding.refinement), file.string(), OCTETRA_SOURCE_DIR,
        finding.ranks, OCTETRA_TEST_PROGRAM);
}

std::string kept(const Finding& finding, const std::filesystem::path& folder) {
    return description(finding, write_finding(finding, folder, name_of(finding)));
}

}  // namespace octetra::properties
