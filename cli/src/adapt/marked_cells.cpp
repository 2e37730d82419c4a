#include "adapt/marked_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/canonical_mesh.hpp>

namespace octetra::cli {
namespace {

/// The vertices of a cell by their numbers in the whole mesh, ascending. No two cells have the
/// same.
using CellKey = VertexNumbers<4>;

/// Collective. Every process gets the keys of all, ascending.
std::vector<CellKey> keys_of_all(const std::vector<CellKey>& keys,
                                 const distributed::Communicator& world) {
    std::vector<CellKey> all;
    for (const auto& of_rank : world.gather(keys)) {
        all.insert(all.end(), of_rank.begin(), of_rank.end());
    }
    world.broadcast(all);
    std::ranges::sort(all);
    return all;
}

/// Collective. The keys of the listed cells; slices of the mesh are looked through one after the
/// other, so that none need be large.
std::vector<CellKey> keys_of(const std::vector<GlobalCell>& cells,
                             const distributed::AdaptiveMesh& mesh) {
    const distributed::Communicator& world = mesh.processes();
    distributed::CanonicalMesh whole = mesh.canonical();
    const std::uint64_t count = whole.facts().cells;
    const auto size = static_cast<std::uint64_t>(world.size());
    constexpr std::uint64_t longest_slice = 1 << 16;
    const std::uint64_t slice_length = std::min(longest_slice, (count + size - 1) / size);
    const std::uint64_t step = slice_length * size;
    std::vector<CellKey> keys;
    for (std::uint64_t begin = 0; begin < count; begin += step) {
        const Window window{begin, slice_length, count};
        const auto slice = whole.whole().cells(window);
        const std::uint64_t first = window.begin_of(world.rank());
        auto listed = std::ranges::lower_bound(cells, GlobalCell{first});
        for (; listed != cells.end(); ++listed) {
            const auto place = static_cast<std::uint64_t>(*listed) - first;
            if (place >= slice.size()) break;
            keys.push_back(slice[place]);
            std::ranges::sort(keys.back());
        }
    }
    return keys_of_all(keys, world);
}

}  // namespace

std::vector<std::uint8_t> listed_cells(const distributed::AdaptiveMesh& mesh,
                                       const std::vector<GlobalCell>& cells) {
    const std::vector<CellKey> keys = keys_of(cells, mesh);
    const auto numbers = mesh.vertex_numbers();
    std::vector<std::uint8_t> cell_to_mark;
    cell_to_mark.reserve(mesh.cells().size());
    for (const CellVertices& cell : mesh.cells()) {
        CellKey key;
        for (std::size_t k = 0; k < 4; ++k) {
            key[k] = static_cast<std::uint64_t>(numbers[cell[k].value()]);
        }
        std::ranges::sort(key);
        cell_to_mark.push_back(std::ranges::binary_search(keys, key) ? 1 : 0);
    }
    return cell_to_mark;
}

void add_marked_cells(const distributed::AdaptiveMesh& mesh, const Selection& selection,
                      std::vector<std::uint8_t>& cell_to_mark) {
    Selection criteria = selection;
    criteria.cells.clear();
    const std::vector<Marker> regions =
        criteria.regions.empty() ? std::vector<Marker>{} : mesh.regions();
    const auto points = mesh.points();
    const auto cells = mesh.cells();
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cells[c][k].value()];
        const Marker region = regions.empty() ? Marker{0} : regions[c];
        if (marks(criteria, corners, region, GlobalCell{0})) cell_to_mark[c] = 1;
    }
}

}  // namespace octetra::cli
