#include "fields/read_fields.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/mesh_formats.hpp>
#include <octetra/core/sol_fields.hpp>

#include "fields/requested_values.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Sends the headers of the lists that the first process has read to the others, whose
/// shares of the values are empty.
void broadcast_headers(const Communicator& processes, std::vector<FieldRows>& lists) {
    std::vector<std::uint64_t> headers;
    for (const FieldRows& list : lists) {
        headers.push_back(static_cast<std::uint64_t>(list.on));
        headers.push_back(list.count);
        headers.push_back(list.components.size());
        headers.insert(headers.end(), list.components.begin(), list.components.end());
    }
    processes.broadcast(headers);
    if (processes.is_first()) return;
    for (std::size_t at = 0; at < headers.size();) {
        FieldRows list{.on = static_cast<FieldOn>(headers[at]), .count = headers[at + 1]};
        const std::uint64_t fields = headers[at + 2];
        at += 3;
        for (std::uint64_t f = 0; f < fields; ++f) list.components.push_back(headers[at++]);
        // the share begins at the end, so the first process has all values
        list.first = list.count;
        lists.push_back(std::move(list));
    }
}

/// Collective. The first process reads the whole file, because its format does not allow shares.
SolFields read_on_first(const Communicator& processes, const std::filesystem::path& path,
                        const EntityCounts& counts) {
    SolFields alone;
    if (processes.is_first()) {
        alone = is_sol(path) ? read_sol(path, counts) : read_msh_data(path, counts);
    }
    broadcast_headers(processes, alone.lists);
    return alone;
}

/// Returns field `number` of a list, whose values are stored row by row in `rows`.
Field field_of_rows(const FieldRows& list, const std::vector<double>& rows, std::size_t number,
                    std::size_t first_component) {
    const std::size_t components = list.components[number];
    const std::size_t width = list.width();
    std::vector<double> values;
    values.reserve(rows.size() / width * components);
    for (std::size_t row = 0; row < rows.size(); row += width) {
        for (std::size_t k = 0; k < components; ++k) {
            values.push_back(rows[row + first_component + sol_component_position(k, components)]);
        }
    }
    return {"", list.on, components, std::move(values)};
}

}  // namespace

std::vector<Field> read_fields(const DistributedMesh& mesh, std::span<const CellIndex> cells_before,
                               const CanonicalNumbers& numbers, const std::filesystem::path& path,
                               const std::function<void(const std::string&)>& note) {
    const Communicator& processes = mesh.processes;
    const CanonicalRuns runs = processes.transaction([&] {
        if (!is_sol(path) && format_of(path) != Format::gmsh) {
            throw InputError(
                fmt::format("{}: files of values end in .sol, .solb or .msh", path.native()));
        }
        return canonical_runs(processes, mesh.cell_ancestors);
    });
    const EntityCounts counts{numbers.vertex_count, runs.count};
    std::optional<SolFields> shares;
    if (processes.size() > 1 && is_sol(path)) shares = read_sol_share(path, counts, processes);
    return processes.transaction([&] {
        const SolFields read = shares ? *std::move(shares) : read_on_first(processes, path, counts);
        std::vector<Field> fields;
        for (const FieldRows& list : read.lists) {
            OwnerMap owners = owners_of_shares(processes, list.first, list.count);
            const RequestedValues requested =
                send_requests(processes,
                              list.on == FieldOn::vertices
                                  ? requested_vertices(numbers)
                                  : requested_cells(runs, mesh.cell_ancestors, cells_before),
                              std::move(owners));
            const auto rows = fetch_values(processes, requested, list.values, list.width());
            std::size_t first_component = 0;
            for (std::size_t f = 0; f < list.components.size(); ++f) {
                fields.push_back(field_of_rows(list, rows, f, first_component));
                fields.back().name = sol_field_name(
                    static_cast<std::size_t>(std::ranges::count(fields, list.on, &Field::on)));
                first_component += list.components[f];
            }
        }
        if (processes.is_first()) {
            for (const std::string& what : read.notes) note(what);
            if (fields.empty()) {
                note(fmt::format("{}: there are no fields of vertices or cells", path.native()));
            }
        }
        return fields;
    });
}

}  // namespace octetra::distributed
