#include "adapt/adaptation.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/verify/verify.hpp>

#include "adapt/judge_result.hpp"
#include "adapt/predicted_by_steps.hpp"
#include "adapt/run_script.hpp"
#include "adapt/write_result.hpp"
#include "answer.hpp"
#include "commands/files_apart.hpp"
#include "commands/mesh_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/profile_options.hpp"
#include "commands/report_line.hpp"
#include "commands/share_out.hpp"
#include "script/check_script.hpp"
#include "script/read_script.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {
namespace {

/// Refuses outputs that cannot be written, or would take the place of an input or of each other.
void check_files(const AdaptationOptions& options, const Script& script,
                 const distributed::Partition& partition, int ranks) {
    check_output(options.output, ranks);
    std::vector<NamedFiles> read{mesh_named("MESH", options.input.path),
                                 file_named("--script", script.path),
                                 file_named("--partition", partition.path)};
    const std::vector<NamedFiles> lists = files_read_by(script);
    read.insert(read.end(), lists.begin(), lists.end());
    const std::vector<NamedFiles> written{mesh_to_write("-o", options.output, ranks),
                                          file_named("--profile", options.profile.profile),
                                          file_named("--trace", options.profile.trace)};
    for (const NamedFiles& beside : {written[1], written[2]}) {
        for (const auto& file : beside.files) check_side_file(beside.argument, file);
    }
    check_files_apart(read, written);
    check_outputs_of(script, read, written, ranks);
    check_lists_of(script);
}

/// Collective.
void write_and_report(const distributed::AdaptiveMesh& mesh, const AdaptationOptions& options,
                      Stopwatch& watch) {
    const std::string lost = write_result(mesh, options.output);
    const std::uint64_t cells = mesh.processes().sum(mesh.cells().size());
    if (!mesh.processes().is_first()) return;
    if (!lost.empty()) note(lost);
    report_line(options.quiet, fmt::format("wrote {}", options.output), mesh.vertex_count(), cells,
                watch.lap());
}

/// Collective. Tells on the first process what is known of the mesh before it is there.
MeshFacts facts_of_checkpoint(const std::string& path) {
    const CheckpointFacts facts = read_checkpoint_facts(path);
    if (!facts.fields.empty()) {
        note(fmt::format("the {} field{} of {} do{} not come along", facts.fields.size(),
                         facts.fields.size() == 1 ? "" : "s", path,
                         facts.fields.size() == 1 ? "es" : ""));
    }
    return {.vertices = facts.vertices_now,
            .cells = facts.cells_now,
            .index_base = facts.index_base,
            .has_regions = facts.has_regions};
}

/// Collective. By rcb unless another method is asked for: then no process has all of the input.
distributed::AdaptiveMesh load(const AdaptationOptions& options,
                               const distributed::Communicator& world) {
    if (!options.parallel.partition) {
        return distributed::AdaptiveMesh::load(world, options.input.path);
    }
    return distributed::AdaptiveMesh::load(world, options.input.path,
                                           partition_of(options.parallel));
}

}  // namespace

void adapt(const AdaptationOptions& options, const Script& script,
           const distributed::Communicator& world) {
    const distributed::Partition partition = partition_of(options.parallel);
    const distributed::StepOptions steps{.synchronisation = synchronisation_of(options.parallel),
                                         .max_cells = options.max_cells};
    const bool has_history = is_checkpoint(options.input.path);
    Stopwatch watch;
    Mesh mesh;
    MeshFacts input;  // on the first process
    distributed::in_phase(world, "read", [&] {
        world.on_first([&] {
            check_files(options, script, partition, world.size());
            if (has_history) {
                input = facts_of_checkpoint(options.input.path);
            } else {
                mesh = read_input(options.input);
                input = WholeMesh(mesh).facts();
            }
            check_regions_of(script, input);
        });
    });
    verify::MeshSlice coarse;
    if (options.verify) {
        Mesh input_of_history;
        world.on_first([&] {
            if (has_history) input_of_history = read_checkpoint(options.input.path).input;
        });
        coarse = verify::share_out(has_history ? input_of_history : mesh, world);
    }
    auto adaptive =
        has_history ? distributed::in_phase(world, "read", [&] { return load(options, world); })
                    : distributed::AdaptiveMesh(share_out(
                          std::move(mesh), partition, world,
                          [&](const Mesh& whole) { return predicted_by_steps(whole, script); }));
    if (world.is_first()) {
        report_line(options.quiet, fmt::format("read {}", options.input.path), input.vertices,
                    input.cells, watch.lap());
    }
    run_script(adaptive, script, {input, steps, options.quiet}, watch);
    const Judgement judgement{.fine = options.output, .coarse = options.input.path};
    const bool valid = !options.verify || is_valid_result(adaptive, std::move(coarse), judgement);
    if (valid) write_and_report(adaptive, options, watch);
    write_profile(world, options.profile, options.quiet);
    if (!valid) throw AnswerIsNo{};
}

}  // namespace octetra::cli
