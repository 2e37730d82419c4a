#include "files/checks/conflicts.hpp"

#include <fmt/format.h>

namespace octetra {
namespace {

template <class I>
std::uint64_t number(I entry, const Mesh& mesh) {
    return std::uint64_t{entry.value()} + mesh.index_base;
}

/// Returns for example "cell 2 (line 3)".
template <class I>
std::string with_line(std::string_view name, I entry, const Mesh& mesh, const LineOf& line_of) {
    const std::string numbered = fmt::format("{} {}", name, number(entry, mesh));
    const auto line = line_of(entry.value());
    return line ? fmt::format("{} (line {})", numbered, *line) : numbered;
}

}  // namespace

std::string describe_repeated(const CellPair& cells, const Mesh& mesh, const LineOf& line_of) {
    return fmt::format("cell {} has the vertices of {}: remove one of them",
                       number(cells.cell, mesh), with_line("cell", cells.earlier, mesh, line_of));
}

std::string describe_overlap(const WrongFacets& wrong, const Mesh& mesh, const LineOf& line_of) {
    const auto& [a, b, c] = mesh.facets[wrong.common];
    return fmt::format(
        "cell {} overlaps {}: they lie on the same side of their common face {} {} {}; remove one "
        "of them, or correct its vertices",
        number(wrong.overlap.cell, mesh), with_line("cell", wrong.overlap.earlier, mesh, line_of),
        number(a, mesh), number(b, mesh), number(c, mesh));
}

template <class I>
std::string describe_wrong(const WrongEntry<I>& wrong, std::string_view name,
                           const IndexVector<I, Marker>& markers, const Mesh& mesh,
                           const LineOf& line_of) {
    if (wrong.earlier.is_none()) {
        return fmt::format("{} {} belongs to no cell", name, number(wrong.entry, mesh));
    }
    return fmt::format("{} {} with marker {} is listed already, with marker {}, as {}: remove one",
                       name, number(wrong.entry, mesh), markers[wrong.entry],
                       markers[wrong.earlier], with_line(name, wrong.earlier, mesh, line_of));
}

template std::string describe_wrong(const WrongEntry<FacetIndex>&, std::string_view,
                                    const IndexVector<FacetIndex, Marker>&, const Mesh&,
                                    const LineOf&);
template std::string describe_wrong(const WrongEntry<EdgeIndex>&, std::string_view,
                                    const IndexVector<EdgeIndex, Marker>&, const Mesh&,
                                    const LineOf&);

}  // namespace octetra
