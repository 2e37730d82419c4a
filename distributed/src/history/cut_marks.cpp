#include "history/cut_marks.hpp"

#include <utility>

#include <fmt/format.h>

#include <octetra/core/cut_runs.hpp>
#include <octetra/core/error.hpp>

#include "history/cuts.hpp"
#include "level/incremental/adjacency.hpp"

namespace octetra::distributed {
namespace {

/// Iterates over the descendants of a root.
class Descendants {
public:
    Descendants(const DistributedMesh& mesh, std::size_t root)
        : mesh_(&mesh),
          root_(static_cast<std::uint32_t>(root)),
          cell_(mesh.cell_ancestors.first[root]) {}

    [[nodiscard]] bool at_end() const {
        if (mesh_->adjacency == nullptr) {
            return cell_.value() == mesh_->cell_ancestors.first[root_ + 1];
        }
        return cell_.is_none();
    }
    CellIndex next() {
        const CellIndex cell = cell_;
        if (mesh_->adjacency == nullptr) {
            ++cell_;
        } else {
            cell_ = mesh_->adjacency->cells.next(cell_);
        }
        return cell;
    }

private:
    const DistributedMesh* mesh_;
    std::uint32_t root_;
    CellIndex cell_;
};

[[noreturn]] void refuse(const DistributedMesh& mesh, std::size_t root) {
    throw InputError(
        fmt::format("the history does not match the mesh: its steps record a different number of "
                    "descendants of cell {}",
                    mesh.cell_ancestors.roots[root]));
}

}  // namespace

CutMarks::CutMarks(CutRoots cuts) : cuts_(std::move(cuts)) {
    std::size_t begin = 0;
    for (const CutRoots::Root& root : cuts_.roots) {
        at_.push_back(begin);
        begin += root.bytes;
    }
}

bool CutMarks::next_is_uniform(const DistributedMesh& mesh) const {
    if (cuts_.roots.size() != mesh.cell_ancestors.roots.size()) return false;
    for (std::size_t k = 0; k < cuts_.roots.size(); ++k) {
        std::span<const std::uint8_t> bytes = std::span(cuts_.bytes).subspan(at_[k]);
        std::uint64_t size = 0;
        (void)take_number(bytes, size);
        if (size == 0) return false;
        CutReader runs(bytes.first(size));
        if (runs.next().cut != cut_into(all_edges, 8) || !runs.at_end()) return false;
    }
    return true;
}

std::span<const std::uint8_t> CutMarks::take(std::size_t k) {
    const auto all = std::span<const std::uint8_t>(cuts_.bytes).subspan(at_[k]);
    auto rest = all;
    std::uint64_t size = 0;
    (void)take_number(rest, size);
    at_[k] += all.size() - rest.size() + size;
    return rest.first(size);
}

MarkedCells CutMarks::next(const DistributedMesh& mesh) {
    MarkedCells marked;
    for (std::size_t k = 0; k < cuts_.roots.size(); ++k) {
        const auto bytes = take(k);
        if (bytes.empty()) continue;
        Descendants cells(mesh, cuts_.roots[k].index);
        for (CutReader runs(bytes); !runs.at_end();) {
            CutRun run = runs.next();
            for (; run.count > 0; --run.count) {
                if (cells.at_end()) refuse(mesh, cuts_.roots[k].index);
                const CellIndex cell = cells.next();
                if (run.cut == 0) continue;
                marked.cells.push_back(cell);
                marked.edges.push_back(edges_of(run.cut));
            }
        }
        if (!cells.at_end()) refuse(mesh, cuts_.roots[k].index);
    }
    marked.count = marked.cells.size();
    marked.tested = marked.count;
    return marked;
}

MarkedCells CutMarks::next_of_all(const DistributedMesh& mesh) {
    for (std::size_t k = 0; k < cuts_.roots.size(); ++k) (void)take(k);
    return {.all = true,
            .cells = {},
            .edges = {},
            .count = mesh.cells.size(),
            .tested = mesh.cells.size()};
}

}  // namespace octetra::distributed
