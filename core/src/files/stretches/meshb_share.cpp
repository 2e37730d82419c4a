#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <octetra/core/huge_pages.hpp>

#include "files/input/byte_reader.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/medit/entry_positions.hpp"
#include "files/medit/meshb_layout.hpp"
#include "files/medit/meshb_rows.hpp"
#include "files/stretches/readers.hpp"
#include "files/stretches/shares.hpp"
#include "files/stretches/status.hpp"

namespace octetra {
namespace {

template <class I, std::size_t N>
void refuse_repeated_vertices(const IndexVector<I, std::array<VertexIndex, N>>& list) {
    for (const auto& vertices : list) {
        bool repeated = false;
        for (std::size_t k = 0; k < N; ++k) {
            for (std::size_t j = 0; j < k; ++j) repeated |= vertices[j] == vertices[k];
        }
        if (repeated) throw std::runtime_error("the same vertex twice");
    }
}

/// Reads this process's shares of all lists.
void read_shares(const std::filesystem::path& path, const MeshbLists& sections,
                 const ProcessGroup& group, MeshShare& mesh_share) {
    ByteReader reader(path);
    MeshbRows rows(reader, sections);
    Mesh& lists = mesh_share.lists;
    const RowShare points = share_of_rows(sections.vertices.count, group);
    mesh_share.first_vertex = points.first;
    reserve_in_huge_pages(lists.points, points.count);
    reserve_in_huge_pages(lists.point_markers, points.count);
    rows.append_points(points.first, points.count, lists);
    const auto read = [&](const auto& kind, const MeshbSection& section) {
        const RowShare share = share_of_rows(section.count, group);
        reserve_in_huge_pages(lists.*kind.list, share.count);
        reserve_in_huge_pages(lists.*kind.markers, share.count);
        rows.append(kind, share.first, share.count, lists);
        refuse_repeated_vertices(lists.*kind.list);
        return share.first;
    };
    mesh_share.first_cell = read(cell_kind, sections.tetrahedra);
    mesh_share.first_facet = read(facet_kind, sections.triangles);
    mesh_share.first_edge = read(edge_kind, sections.edges);
    for (const Feature feature : all_features) {
        const RowShare share = share_of_rows(sections.features[feature].count, group);
        reserve_in_huge_pages(lists.features[feature], share.count);
        rows.append_numbers(feature, share.first, share.count, lists.features[feature]);
    }
}

/// Collective. Sends the notes of the first process, each terminated by a zero, to all.
bool take_notes(CollectiveStatus& status, std::vector<std::string>& notes) {
    ProcessGroup::Bytes bytes;
    status.attempt([&] {
        for (const std::string& note : notes) {
            for (const char c : note + '\0') bytes.push_back(static_cast<std::byte>(c));
        }
    });
    if (!status.all_succeeded()) return false;
    bytes = status.group().of_first(std::move(bytes));
    status.attempt([&] {
        notes.clear();
        const auto* const text = reinterpret_cast<const char*>(bytes.data());
        for (std::size_t at = 0; at < bytes.size(); at += notes.back().size() + 1) {
            notes.emplace_back(text + at);
        }
    });
    return status.all_succeeded();
}

}  // namespace

std::optional<MeshShare> read_meshb_share(const std::filesystem::path& path,
                                          const ProcessGroup& group) {
    CollectiveStatus status(group);
    MeshShare mesh_share;
    MeshbLists sections;
    status.attempt([&] {
        if (!group.is_first()) return;
        ByteReader reader(path);
        const MeshbLayout layout = read_meshb_layout(reader);
        sections = layout.lists;
        mesh_share.notes = notes_on(path, layout.lists.has_end, layout.skipped);
    });
    if (!broadcast_from_first(status, sections)) return std::nullopt;
    if (!take_notes(status, mesh_share.notes)) return std::nullopt;
    status.attempt([&] { read_shares(path, sections, group, mesh_share); });
    if (!status.all_succeeded()) return std::nullopt;
    set_common_facts(counts_of(sections), group, mesh_share);
    return mesh_share;
}

}  // namespace octetra
