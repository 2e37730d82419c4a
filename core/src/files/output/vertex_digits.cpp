#include <octetra/core/mesh_source.hpp>

#include "files/output/number_text.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

template <std::size_t N>
std::uint64_t digits_of(MeshSource& mesh,
                        std::span<const VertexNumbers<N>> (MeshSource::*list)(const Window&),
                        const Window& window, std::uint64_t index_base) {
    std::uint64_t digits = 0;
    const std::uint64_t at_once = lines_of_a_turn(window.count, mesh.group());
    for_each_piece(window, at_once, [&](const Window& piece) {
        for (const VertexNumbers<N>& vertices : (mesh.*list)(piece)) {
            for (const std::uint64_t vertex : vertices) digits += text_length(index_base + vertex);
        }
    });
    return digits;
}

}  // namespace

std::uint64_t MeshSource::cell_digits(const Window& window, std::uint64_t index_base) {
    return digits_of(*this, &MeshSource::cells, window, index_base);
}

std::uint64_t MeshSource::facet_digits(const Window& window, std::uint64_t index_base) {
    return digits_of(*this, &MeshSource::facets, window, index_base);
}

std::uint64_t MeshSource::edge_digits(const Window& window, std::uint64_t index_base) {
    return digits_of(*this, &MeshSource::edges, window, index_base);
}

}  // namespace octetra
