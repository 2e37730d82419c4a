#include "properties/report.hpp"

#include <fmt/format.h>

#include "distributed/world.hpp"
#include "properties/case_json.hpp"
#include "properties/judge.hpp"
#include "properties/simpler.hpp"

namespace octetra::properties {
namespace {

std::string name_of(const Finding& finding) {
    std::string content = json_of(finding.refinement).dump();
    for (const Point& p : finding.refinement.mesh.points) {
        content += fmt::format("{} {} {} ", p.x, p.y, p.z);
    }
    return fmt::format("{}-{:016x}", finding.law, std::hash<std::string>{}(content));
}

}  // namespace

std::string kept(const Finding& finding) {
    const auto file = write_finding(finding, found_folder(), name_of(finding));
    return fmt::format(
        "{}: {}\n{} cells, {} levels\nreplay: OCTETRA_FINDING={} {}/tests/support/mpirun.sh {} {} "
        "--gtest_filter='*Findings*'",
        finding.law, finding.fault, finding.refinement.mesh.cells.size(), finding.refinement.levels,
        file.string(), OCTETRA_SOURCE_DIR, test::world().size(), OCTETRA_TEST_PROGRAM);
}

Finding shrunk(Finding finding) {
    const Law& law = law_named(finding.law);
    bool is_smaller = true;
    while (is_smaller) {
        is_smaller = false;
        for (const auto& simplification : simplifications(finding.refinement)) {
            Case simpler = simplification();
            const std::string fault = judge(law, simpler);
            if (fault.empty()) continue;
            finding = {finding.law, fault, std::move(simpler)};
            is_smaller = true;
            break;
        }
    }
    return finding;
}

}  // namespace octetra::properties
