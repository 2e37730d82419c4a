#include "numbering/cell_numbers.hpp"

#include <limits>

#include "numbering/canonical_runs.hpp"
#include "numbering/ordered_lists.hpp"

namespace octetra::distributed {

std::vector<std::uint64_t> cell_numbers(const DistributedMesh& mesh) {
    return mesh.processes.transaction([&] {
        std::vector<std::uint64_t> numbers(mesh.cells.size());
        const OrderedList<IndexVector<CellIndex, CellVertices>> cells(
            mesh.cells, mesh.cell_ancestors, mesh.adjacency ? &mesh.adjacency->cells : nullptr);
        const CanonicalRuns runs = canonical_runs(mesh.processes, cells.ancestors());
        constexpr auto all = std::numeric_limits<std::uint64_t>::max();
        for_each_between(runs, cells.ancestors(), 0, all,
                         [&](std::uint64_t number, std::size_t position, std::size_t) {
                             const auto before = cells.before();
                             numbers[before.empty() ? position : before[position].value()] = number;
                         });
        return numbers;
    });
}

}  // namespace octetra::distributed
