#include "checkpoint/save.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>
#include <vector>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/distributed/profile.hpp>

#include "history/cut_roots.hpp"
#include "numbering/canonical_runs.hpp"
#include "output/canonical_slices.hpp"
#include "output/check_fields.hpp"
#include "output/field_slices.hpp"

namespace octetra::distributed {
namespace {

CheckpointFacts facts_of(const SavedMesh& saved, const MeshFacts& input,
                         std::span<const Field> fields, std::uint64_t cells_now) {
    CheckpointFacts facts{
        .vertices = input.vertices,
        .cells = input.cells,
        .facets = input.facets,
        .edges = input.edges,
        .attributes_per_point = input.attributes_per_point,
        .index_base = input.index_base,
        .has_point_markers = input.has_point_markers,
        .has_regions = input.has_regions,
        .has_facet_markers = input.has_facet_markers,
        .has_edge_markers = input.has_edge_markers,
        .features = input.features,
        .vertices_now = saved.numbers->vertex_count,
        .cells_now = cells_now,
        .closure = saved.steps.empty() ? Closure::longest_edge : saved.mesh->closure,
        .steps = std::vector<StepFacts>(saved.steps.size()),
        .fields = {},
        .group_names = input.group_names.list(),
        .state = *saved.state};
    std::ranges::transform(fields, std::back_inserter(facts.fields),
                           [](const Field& field) { return facts_of(field); });
    return facts;
}

/// Sends this process's roots, in order, to the processes that write their blocks.
class RootSender {
public:
    explicit RootSender(const SavedMesh& saved)
        : ancestors_(&saved.mesh->cell_ancestors), splitter_(readers(saved.steps)) {}

    /// Collective. Returns the steps of the roots in this process's slice.
    std::vector<CutRuns> receive_slice(const Window& window, const Communicator& processes,
                                       std::size_t step_count) {
        std::vector<std::vector<std::uint8_t>> outboxes(static_cast<std::size_t>(processes.size()));
        for (int rank = 0; rank < processes.size(); ++rank) {
            pack(window.begin_of(rank), window.end_of(rank),
                 outboxes[static_cast<std::size_t>(rank)]);
        }
        const auto inboxes = processes.all_to_all(outboxes);
        return joined_steps(inboxes,
                            window.end_of(processes.rank()) - window.begin_of(processes.rank()),
                            step_count);
    }

private:
    static std::vector<CutReader> readers(std::span<const CutRuns> steps) {
        std::vector<CutReader> all;
        for (const CutRuns& step : steps) all.emplace_back(step.bytes());
        return all;
    }

    void pack(std::uint64_t begin, std::uint64_t end, std::vector<std::uint8_t>& outbox) {
        const auto& [roots, first, markers] = *ancestors_;
        std::vector<std::uint8_t> bytes;
        for (; next_ < roots.size() && roots[next_] < end; ++next_) {
            if (first[next_ + 1] - first[next_] == 1) {
                ++whole_;
                continue;
            }
            splitter_.skip_whole(std::exchange(whole_, 0));
            bytes.clear();
            (void)splitter_.append_next(bytes);
            append_number(roots[next_] - begin, outbox);
            append_number(bytes.size(), outbox);
            outbox.insert(outbox.end(), bytes.begin(), bytes.end());
        }
    }

    static std::vector<CutRuns> joined_steps(const std::vector<std::vector<std::uint8_t>>& inboxes,
                                             std::uint64_t length, std::size_t step_count) {
        std::vector<std::pair<std::uint64_t, RootBytes>> roots;
        for (const auto& inbox : inboxes) {
            for (RootBytes rest = inbox; !rest.empty();) {
                std::uint64_t position = 0;
                std::uint64_t size = 0;
                (void)take_number(rest, position);
                (void)take_number(rest, size);
                roots.emplace_back(position, rest.first(size));
                rest = rest.subspan(size);
            }
        }
        std::ranges::sort(roots, {}, [](const auto& root) { return root.first; });
        RootJoiner joined(step_count);
        std::uint64_t next = 0;
        for (const auto& [position, bytes] : roots) {
            joined.append_whole(position - next);
            (void)joined.append(bytes);
            next = position + 1;
        }
        joined.append_whole(length - next);
        return std::move(joined).finish();
    }

    const AncestorMap* ancestors_;
    RootSplitter<CutReader> splitter_;
    std::size_t next_ = 0;     ///< index of the next root of this process
    std::uint64_t whole_ = 0;  ///< preceding uncut roots that are not yet skipped
};

/// Collective. Writes the history.
void put_cuts(CheckpointWriter& writer, const SavedMesh& saved) {
    const Communicator& processes = saved.mesh->processes;
    RootSender sender(saved);
    std::vector<StepFacts> facts(saved.steps.size());
    std::vector<std::byte> block;
    writer.put_section(Section::cuts, [&](const Window& window) {
        const auto steps = sender.receive_slice(window, processes, saved.steps.size());
        const bool has_slice = window.begin_of(processes.rank()) < window.end_of(processes.rank());
        block = has_slice ? cuts_block(steps, facts) : std::vector<std::byte>{};
        return std::span<const std::byte>(block);
    });
    for (std::size_t t = 0; t < facts.size(); ++t) {
        writer.facts().steps[t] = {processes.sum(facts[t].cells_before),
                                   processes.sum(facts[t].cells_cut),
                                   processes.sum(facts[t].bytes)};
    }
}

/// Collective. Throws if the state cannot be saved, or differs between processes.
void check_state(const Communicator& processes, const std::optional<SavedState>& state) {
    std::vector<std::uint8_t> bytes;
    if (state) {
        if (const std::string wrong = wrong_in(*state); !wrong.empty()) throw InputError(wrong);
        append_number(std::bit_cast<std::uint64_t>(state->time), bytes);
        append_number(static_cast<std::uint64_t>(state->step), bytes);
        bytes.insert(bytes.end(), state->text.begin(), state->text.end());
    }
    std::vector<std::uint8_t> of_first = bytes;
    processes.broadcast(of_first);
    if (processes.max(of_first == bytes ? 0 : 1) == 0) return;
    throw InputError("processes have different times, steps or texts for a checkpoint");
}

/// Collective. A process may fail at any point.
void write_checkpoint(const SavedMesh& saved, std::span<const Field> fields,
                      const std::filesystem::path& path) {
    const Communicator& processes = saved.mesh->processes;
    check_sizes(*saved.mesh, fields);
    check_same(processes, fields);
    check_state(processes, *saved.state);
    if (processes.is_first()) check_output_path(path);

    CanonicalSlices input(*saved.input);
    const CanonicalRuns cells = canonical_runs(processes, saved.mesh->cell_ancestors);
    CheckpointWriter writer(path, processes, facts_of(saved, input.facts(), fields, cells.count));
    writer.put_input(input);
    put_cuts(writer, saved);
    FieldSlices slices({.fields = fields,
                        .processes = &processes,
                        .numbers = saved.numbers,
                        .sharing = saved.sharing,
                        .cell_ancestors = &saved.mesh->cell_ancestors,
                        .cells_before = saved.cells_before,
                        .cell_runs = &cells});
    for (std::size_t f = 0; f < fields.size(); ++f) {
        writer.put_section(field_section(f),
                           [&](const Window& window) { return slices.values(f, window); });
    }
    writer.commit();
}

}  // namespace

void save(const SavedMesh& saved, std::span<const Field> fields,
          const std::filesystem::path& path) {
    const Communicator& processes = saved.mesh->processes;
    const Phase phase(processes, "save");
    processes.transaction([&] { write_checkpoint(saved, fields, path); });
}

}  // namespace octetra::distributed
