#include <octetra/core/unused_vertices.hpp>

#include <algorithm>

namespace octetra {
namespace {

using NewNumbers = IndexVector<VertexIndex, VertexIndex>;

/// Returns the new number of each vertex, none() for those of no cell.
NewNumbers new_numbers_of(const Mesh& mesh) {
    NewNumbers numbers(mesh.points.size(), VertexIndex::none());
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) numbers[v] = VertexIndex{0};
    }
    VertexIndex next{0};
    for (VertexIndex& number : numbers) {
        if (number.is_none()) continue;
        number = next;
        ++next;
    }
    return numbers;
}

/// Keeps the values of the remaining vertices, `count` for each; the list may be empty.
template <class T>
void keep(std::vector<T>& values, std::size_t count, const NewNumbers& numbers) {
    if (values.empty()) return;
    auto to = values.begin();
    auto from = values.begin();
    for (const VertexIndex number : numbers) {
        const auto after = from + static_cast<std::ptrdiff_t>(count);
        to = number.is_none() ? to : std::copy(from, after, to);
        from = after;
    }
    values.erase(to, values.end());
}

void renumber(auto& entities, const NewNumbers& numbers) {
    for (auto& vertices : entities) {
        for (VertexIndex& v : vertices) v = numbers[v];
    }
}

}  // namespace

std::uint64_t drop_unused_vertices(Mesh& mesh) {
    const NewNumbers numbers = new_numbers_of(mesh);
    const auto dropped = static_cast<std::uint64_t>(
        std::ranges::count_if(numbers, [](VertexIndex v) { return v.is_none(); }));
    if (dropped == 0) return 0;
    keep(mesh.points, 1, numbers);
    keep(mesh.point_markers, 1, numbers);
    keep(mesh.point_attributes, mesh.attributes_per_point, numbers);
    renumber(mesh.cells, numbers);
    renumber(mesh.facets, numbers);
    renumber(mesh.edges, numbers);
    for (const Feature feature : {Feature::corners, Feature::required_vertices}) {
        auto& list = mesh.features[feature];
        std::erase_if(list, [&](std::uint64_t v) { return numbers[VertexIndex(v)].is_none(); });
        for (std::uint64_t& v : list) v = numbers[VertexIndex(v)].value();
    }
    return dropped;
}

}  // namespace octetra
