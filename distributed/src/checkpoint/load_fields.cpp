#include "checkpoint/load_fields.hpp"

#include <cstdint>
#include <utility>

#include "fields/requested_values.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Reads and fetches the values of field `number`.
template <class T>
std::vector<T> values_of(const Communicator& processes, const CheckpointReader& file,
                         std::size_t number, std::size_t components,
                         const RequestedValues& requested) {
    const std::uint64_t begin = requested.owners.begin_of(processes.rank());
    const std::uint64_t end = requested.owners.end_of(processes.rank());
    const std::vector<T> owned = file.read<T>(field_section(number), begin, end);
    return fetch_values(processes, requested, owned, components);
}

}  // namespace

std::vector<Field> load_fields(const DistributedMesh& mesh, std::span<const CellIndex> cells_before,
                               const CanonicalNumbers& numbers, const CheckpointReader& file) {
    std::vector<Field> fields;
    if (file.facts().fields.empty()) return fields;
    const Communicator& processes = mesh.processes;
    const auto from_blocks = [&](RequestedEntities entities, std::uint64_t count) {
        return send_requests(processes, std::move(entities),
                             owners_of_blocks(count, block_length, processes.size()));
    };
    const RequestedValues vertices = from_blocks(requested_vertices(numbers), numbers.vertex_count);
    const CanonicalRuns runs = canonical_runs(processes, mesh.cell_ancestors);
    const RequestedValues cells =
        from_blocks(requested_cells(runs, mesh.cell_ancestors, cells_before), runs.count);
    for (std::size_t f = 0; f < file.facts().fields.size(); ++f) {
        const FieldFacts& facts = file.facts().fields[f];
        const RequestedValues& requested = facts.on == FieldOn::vertices ? vertices : cells;
        Field field{facts.name, facts.on, facts.components, {}};
        const auto load = [&]<class T>(T) {
            field.values = values_of<T>(processes, file, f, facts.components, requested);
        };
        switch (facts.type) {
            case FieldType::float64: load(double{}); break;
            case FieldType::float32: load(float{}); break;
            case FieldType::int32: load(std::int32_t{}); break;
            case FieldType::int64: load(std::int64_t{}); break;
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

}  // namespace octetra::distributed
