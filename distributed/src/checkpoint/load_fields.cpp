#include "checkpoint/load_fields.hpp"

#include <cstdint>
#include <utility>

#include "comm/local_failure.hpp"
#include "numbering/canonical_runs.hpp"
#include "setup/homes.hpp"

namespace octetra::distributed {
namespace {

/// What this process wants the values of, and who reads them.
struct Wanted {
    std::vector<std::uint64_t> numbers;  ///< ascending, in the whole mesh
    std::vector<std::uint32_t> local;    ///< and by this process's numbers
    Homes homes;
    Requests<> requests;

    Wanted(const Communicator& processes, std::uint64_t count)
        : homes(homes_of_blocks(count, block_length, processes.size())) {}
};

Wanted wanted_vertices(const Communicator& processes, const CanonicalNumbers& numbers) {
    LocalFailure failure;
    Wanted wanted(processes, numbers.vertex_count);
    for (VertexIndex v{0}; v < numbers.of_vertex.end_index(); ++v) {
        wanted.numbers.push_back(static_cast<std::uint64_t>(numbers.of_vertex[v]));
        wanted.local.push_back(v.value());
    }
    wanted.requests = request(processes, wanted.homes, wanted.numbers, failure);
    return wanted;
}

Wanted wanted_cells(const DistributedMesh& mesh, std::span<const CellIndex> cells_before) {
    LocalFailure failure;
    const CanonicalRuns runs = canonical_runs(mesh.processes, mesh.cell_ancestors);
    Wanted wanted(mesh.processes, runs.count);
    for_each_between(runs, mesh.cell_ancestors, 0, runs.count,
                     [&](std::uint64_t number, std::size_t place, std::size_t) {
                         wanted.numbers.push_back(number);
                         wanted.local.push_back(cells_before.empty()
                                                    ? static_cast<std::uint32_t>(place)
                                                    : cells_before[place].value());
                     });
    wanted.requests = request(mesh.processes, wanted.homes, wanted.numbers, failure);
    return wanted;
}

/// Collective.
template <class T>
std::vector<T> values_of(const Communicator& processes, const CheckpointReader& file,
                         std::size_t number, std::size_t components, const Wanted& wanted) {
    LocalFailure failure;
    std::vector<T> home;
    const std::uint64_t begin = wanted.homes.begin_of(processes.rank());
    const std::uint64_t end = wanted.homes.end_of(processes.rank());
    failure.attempt([&] { home = file.read<T>(field_section(number), begin, end); });
    failure.agree(processes);
    const auto come = fetch(processes, wanted.requests, home, begin, failure, components);
    std::vector<T> values(come.size());
    for (std::size_t i = 0; i < wanted.local.size(); ++i) {
        for (std::size_t k = 0; k < components; ++k) {
            values[wanted.local[i] * components + k] = come[i * components + k];
        }
    }
    return values;
}

}  // namespace

std::vector<Field> load_fields(const DistributedMesh& mesh, std::span<const CellIndex> cells_before,
                               const CanonicalNumbers& numbers, const CheckpointReader& file) {
    std::vector<Field> fields;
    if (file.facts().fields.empty()) return fields;
    const Communicator& processes = mesh.processes;
    const Wanted vertices = wanted_vertices(processes, numbers);
    const Wanted cells = wanted_cells(mesh, cells_before);
    for (std::size_t f = 0; f < file.facts().fields.size(); ++f) {
        const FieldFacts& facts = file.facts().fields[f];
        const Wanted& wanted = facts.on == FieldOn::vertices ? vertices : cells;
        Field field{facts.name, facts.on, facts.components, {}};
        const auto load = [&]<class T>(T) {
            field.values = values_of<T>(processes, file, f, facts.components, wanted);
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
