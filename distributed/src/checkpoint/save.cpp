#include "checkpoint/save.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/places.hpp>
#include <octetra/distributed/profile.hpp>

#include "comm/all_or_none.hpp"
#include "history/cut_roots.hpp"
#include "numbering/canonical_runs.hpp"
#include "output/canonical_slices.hpp"
#include "output/slices.hpp"

namespace octetra::distributed {
namespace {

/// As many as a checkpoint's table may tell of.
constexpr std::size_t most_components = std::size_t{1} << 20U;

FieldFacts facts_of(const Field& field) {
    return {.name = field.name,
            .on = field.on,
            .type = static_cast<FieldType>(field.values.index()),
            .components = field.components};
}

std::size_t value_count(const Field& field) {
    return std::visit([](const auto& values) { return values.size(); }, field.values);
}

/// Throws InputError for fields that do not fit this process's part.
void check_sizes(const SavedMesh& saved, std::span<const Field> fields) {
    std::set<std::pair<FieldOn, std::string>> names;
    for (const Field& field : fields) {
        const bool on_vertices = field.on == FieldOn::vertices;
        const std::size_t entities =
            on_vertices ? saved.mesh->points.size() : saved.mesh->cells.size();
        if (value_count(field) != entities * field.components) {
            throw InputError(
                fmt::format("field '{}' has {} values; {} with {} components take {}", field.name,
                            value_count(field),
                            fmt::format("{} {}", entities, on_vertices ? "vertices" : "cells"),
                            field.components, entities * field.components));
        }
        if (!is_name(field.name)) {
            throw InputError("the name of a field is no UTF-8, or has a control character");
        }
        if (!names.insert({field.on, field.name}).second) {
            throw InputError(fmt::format("two fields are called '{}'", field.name));
        }
        if (field.components > most_components) {
            throw InputError(
                fmt::format("field '{}' has more than {} components", field.name, most_components));
        }
    }
}

/// Collective. Throws InputError where processes have other fields than the first one has.
void check_same(const Communicator& processes, std::span<const Field> fields) {
    std::vector<std::uint8_t> told;
    for (const Field& field : fields) {
        const FieldFacts facts = facts_of(field);
        told.push_back(static_cast<std::uint8_t>(facts.on));
        told.push_back(static_cast<std::uint8_t>(facts.type));
        append_number(facts.components, told);
        append_number(facts.name.size(), told);
        told.insert(told.end(), facts.name.begin(), facts.name.end());
    }
    std::vector<std::uint8_t> of_first = told;
    processes.broadcast(of_first);
    if (processes.max(of_first == told ? 0 : 1) == 0) return;
    throw InputError("processes save different fields");
}

CheckpointFacts facts_of(const SavedMesh& saved, const MeshFacts& input,
                         std::span<const Field> fields, std::uint64_t cells_now) {
    CheckpointFacts facts{.vertices = input.vertices,
                          .cells = input.cells,
                          .facets = input.facets,
                          .edges = input.edges,
                          .attributes_per_point = input.attributes_per_point,
                          .index_base = input.index_base,
                          .has_point_markers = input.has_point_markers,
                          .has_regions = input.has_regions,
                          .has_facet_markers = input.has_facet_markers,
                          .has_edge_markers = input.has_edge_markers,
                          .vertices_now = saved.numbers->vertex_count,
                          .cells_now = cells_now,
                          .steps = std::vector<StepFacts>(saved.steps.size()),
                          .fields = {},
                          .group_names = input.group_names.list()};
    std::ranges::transform(fields, std::back_inserter(facts.fields),
                           [](const Field& field) { return facts_of(field); });
    return facts;
}

/// This process's roots, in their order, as messages to whoever writes their blocks.
class RootSender {
public:
    explicit RootSender(const SavedMesh& saved)
        : ancestors_(&saved.mesh->cell_ancestors), apart_(readers(saved.steps)) {}

    /// Collective. What the slice of this process gets, by root.
    std::vector<CutRuns> bring(const Window& window, const Communicator& processes,
                               std::size_t step_count) {
        std::vector<std::vector<std::uint8_t>> outboxes(static_cast<std::size_t>(processes.size()));
        for (int rank = 0; rank < processes.size(); ++rank) {
            pack(window.begin_of(rank), window.end_of(rank),
                 outboxes[static_cast<std::size_t>(rank)]);
        }
        const auto inboxes = processes.all_to_all(outboxes);
        return together(inboxes,
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
            apart_.skip_whole(std::exchange(whole_, 0));
            bytes.clear();
            (void)apart_.append_next(bytes);
            append_number(roots[next_] - begin, outbox);
            append_number(bytes.size(), outbox);
            outbox.insert(outbox.end(), bytes.begin(), bytes.end());
        }
    }

    static std::vector<CutRuns> together(const std::vector<std::vector<std::uint8_t>>& inboxes,
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
        RootsTogether joined(step_count);
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
    RootsApart<CutReader> apart_;
    std::size_t next_ = 0;     ///< of this process's roots
    std::uint64_t whole_ = 0;  ///< roots before it that were never cut and are yet to be passed
};

/// Collective.
void put_cuts(CheckpointWriter& writer, const SavedMesh& saved) {
    const Communicator& processes = saved.mesh->processes;
    RootSender sender(saved);
    std::vector<StepFacts> facts(saved.steps.size());
    std::vector<std::byte> block;
    writer.put_section(Section::cuts, [&](const Window& window) {
        const auto steps = sender.bring(window, processes, saved.steps.size());
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

/// Collective. Brings values of vertices or cells to slices, and writes them.
class FieldWriter {
public:
    FieldWriter(CheckpointWriter& writer, const SavedMesh& saved, const CanonicalRuns& cells)
        : writer_(&writer), saved_(&saved), cells_(&cells) {}

    template <class T>
    void put(std::size_t number, const Field& field, const std::vector<T>& values) {
        std::vector<T> slice;
        const int rank = processes().rank();
        writer_->put_section(field_section(number), [&](const Window& window) {
            slice.resize((window.end_of(rank) - window.begin_of(rank)) * field.components);
            for (std::size_t k = 0; k < field.components; ++k) {
                const auto emit_values = [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
                    for_each(field.on, begin, end, [&](std::uint64_t entity, std::size_t local) {
                        emit(entity, values[local * field.components + k]);
                    });
                };
                bring_to_slices<T>(processes(), window, emit_values,
                                   [&](std::uint32_t position, const T& value) {
                                       slice[position * field.components + k] = value;
                                   });
            }
            return std::as_bytes(std::span<const T>(slice));
        });
    }

private:
    [[nodiscard]] const Communicator& processes() const { return saved_->mesh->processes; }

    /// Calls visit(number, local number) for what this process has to tell of begin .. end-1.
    void for_each(FieldOn on, std::uint64_t begin, std::uint64_t end, auto&& visit) const {
        if (on == FieldOn::cells) {
            for_each_between(*cells_, saved_->mesh->cell_ancestors, begin, end,
                             [&](std::uint64_t number, std::size_t place, std::size_t) {
                                 visit(number, saved_->cells_before.empty()
                                                   ? place
                                                   : saved_->cells_before[place].value());
                             });
            return;
        }
        const auto& numbers = saved_->numbers->of_vertex;
        const auto from = std::ranges::lower_bound(numbers, GlobalVertex{begin});
        for (VertexIndex v{static_cast<std::size_t>(from - numbers.begin())};
             v < numbers.end_index() && numbers[v] < GlobalVertex{end}; ++v) {
            if (saved_->sharing->is_owned(v)) {
                visit(static_cast<std::uint64_t>(numbers[v]), v.value());
            }
        }
    }

    CheckpointWriter* writer_;
    const SavedMesh* saved_;
    const CanonicalRuns* cells_;
};

/// Collective. A process may fail anywhere in it.
void write_checkpoint(const SavedMesh& saved, std::span<const Field> fields,
                      const std::filesystem::path& path) {
    const Communicator& processes = saved.mesh->processes;
    check_sizes(saved, fields);
    check_same(processes, fields);
    if (processes.is_first()) check_place(path);

    CanonicalSlices input(*saved.input);
    const CanonicalRuns cells = canonical_runs(processes, saved.mesh->cell_ancestors);
    CheckpointWriter writer(path, processes, facts_of(saved, input.facts(), fields, cells.count));
    writer.put_input(input);
    put_cuts(writer, saved);
    FieldWriter field_writer(writer, saved, cells);
    for (std::size_t f = 0; f < fields.size(); ++f) {
        std::visit([&](const auto& values) { field_writer.put(f, fields[f], values); },
                   fields[f].values);
    }
    writer.commit();
}

}  // namespace

void save(const SavedMesh& saved, std::span<const Field> fields,
          const std::filesystem::path& path) {
    const Communicator& processes = saved.mesh->processes;
    const Phase phase(processes, "save");
    all_or_none(processes, [&] { write_checkpoint(saved, fields, path); });
}

}  // namespace octetra::distributed
