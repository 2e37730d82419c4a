#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/verify.hpp>

#include "commands/commands.hpp"
#include "commands/distinct_files.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "commands/refinement_options.hpp"
#include "commands/verify/coarsened.hpp"
#include "negative_answer.hpp"
#include "verdict/check_progress.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

struct VerifyCommandOptions {
    std::string first;   ///< the mesh, or the coarse one
    std::string second;  ///< the fine one, or empty
    bool fast = false;
    std::optional<double> min_dihedral;
    std::string report;
    std::string maps;
    RefinementOptions refinement;
    bool has_refinement_options =
        false;  ///< whether such options were given, even with default values
    bool has_scheme = false;
    std::string before;  ///< the checkpoint before coarsening
    bool outside = false;
};

/// Limits the size of a report; all violations are counted.
constexpr std::size_t described_of_each_code = 100'000;

constexpr std::string_view no_request =
    "the refinement rule was not checked: give the request of refine, as in --all --levels 2";

/// Parses the options for a coarsened mesh, except for the parts that need the checkpoint.
Coarsened coarsened_of(const VerifyCommandOptions& given) {
    if (given.before.empty()) {
        if (given.outside) throw InputError("verify: --outside requires --coarsened-from");
        return {};
    }
    if (!is_checkpoint(given.before)) {
        throw InputError(
            fmt::format("--coarsened-from: {} has no history: it takes a .octetra file, as octetra "
                        "coarsen does",
                        given.before));
    }
    if (!given.second.empty()) {
        throw InputError("verify: --coarsened-from takes one mesh, the coarsened one, not two");
    }
    if (given.has_scheme) {
        throw InputError("verify: --scheme applies to refinement, not to coarsening");
    }
    const RefinementOptions& typed = given.refinement;
    Coarsened asked{given.before, {typed.selection, given.outside, typed.levels}, {}};
    asked.selection = parse_coarsening(asked.typed);
    check_verifiable(asked.selection);
    return asked;
}

/// Parses the options of the verifier, except for the parts of the selection that need the mesh.
verify::VerifyOptions options_of(const VerifyCommandOptions& given) {
    verify::VerifyOptions options{.fast = given.fast,
                                  .min_dihedral = given.min_dihedral,
                                  .kept_per_code = described_of_each_code};
    if (given.before.empty() && has_criterion(given.refinement.selection)) {
        options.request = {parse_selection(given.refinement.selection),
                           parse_scheme(given.refinement), given.refinement.levels};
        check_verifiable(options.request->selection);
    }
    const std::string& fine = given.before.empty() ? given.second : given.first;
    const std::string no_place = "the format of the fine mesh cannot hold them";
    if (!fine.empty() && !can_hold_attributes(fine)) options.attributes_lost = no_place;
    if (!fine.empty() && !can_hold_vertex_markers(fine)) options.vertex_markers_lost = no_place;
    options.closure = parse_closure(given.refinement);
    if (options.closure == Closure::regular) {
        if (given.second.empty()) {
            throw InputError("verify: --closure regular requires COARSE and REFINED");
        }
        if (is_checkpoint(given.first) && !read_checkpoint_facts(given.first).steps.empty()) {
            throw InputError(fmt::format(
                "verify: with --closure regular, COARSE must have no history, unlike {}: "
                "refinement replaces its transition cells; pass the input of the history",
                given.first));
        }
    }
    if (given.second.empty() && options.request) {
        throw InputError("verify: a selection can be checked only with COARSE and REFINED");
    }
    if (given.second.empty() && !given.maps.empty()) {
        throw InputError("verify: --maps can be checked only with COARSE and REFINED");
    }
    if (given.before.empty() && !options.request && given.has_refinement_options) {
        throw InputError(
            "verify: --levels, --scheme and --seed require a selection, as in --all "
            "--levels 2");
    }
    if (given.fast && given.min_dihedral) {
        throw InputError("verify: --min-dihedral cannot be checked with --fast");
    }
    return options;
}

verify::Verdict judge(const VerifyCommandOptions& given, verify::VerifyOptions options,
                      JudgedFiles& judged) {
    const Mesh first = read_without_checks(given.first);
    if (given.second.empty()) {
        judged = {.fine = given.first, .fine_index_base = first.index_base};
        return verify_mesh(first, options);
    }
    const Mesh second = read_without_checks(given.second);
    judged = {given.second, given.first, second.index_base, first.index_base};
    if (options.request) {
        check_regions(given.refinement.selection, first.regions, ProcessGroup::alone());
        complete_selection(
            options.request->selection, given.refinement.selection,
            {first.index_base, first.cells.size(), SharedGroupNames(first.group_names)});
    }
    std::optional<RefinementMaps> maps;
    if (!given.maps.empty()) {
        maps = read_maps(given.maps, first.index_base);  // with the numbering of refine
        options.maps = &*maps;
    }
    return verify_refinement(first, second, options);
}

/// Collective. No process holds the whole mesh.
verify::MeshSlice read_slice(const std::string& path, const distributed::Communicator& world) {
    if (is_checkpoint(path)) {
        const auto mesh = distributed::AdaptiveMesh::load(world, path);
        auto canonical = mesh.canonical();
        return verify::slice_of(canonical.whole());
    }
    return verify::read_slice(path, {.only_syntax = true, .note = note}, world);
}

/// Collective. Broadcasts the maps from the first process.
void share_maps(RefinementMaps& maps, const distributed::Communicator& world) {
    world.broadcast(maps.cell_to_parent);
    world.broadcast(maps.midpoint_to_edge);
    std::vector<VertexIndex> first_midpoint{maps.first_midpoint};
    world.broadcast(first_midpoint);
    maps.first_midpoint = first_midpoint.front();
}

/// Collective. Every process verifies a part; none holds a whole mesh.
verify::Verdict verify_distributed(const VerifyCommandOptions& given, verify::VerifyOptions options,
                                   JudgedFiles& judged, const distributed::Communicator& world) {
    verify::MeshSlice first = read_slice(given.first, world);
    const std::uint32_t index_base = first.lists.index_base;
    if (given.second.empty()) {
        judged = {.fine = given.first, .fine_index_base = index_base};
        return verify_mesh(std::move(first), world, options);
    }
    verify::MeshSlice second = read_slice(given.second, world);
    judged = {given.second, given.first, second.lists.index_base, index_base};
    if (options.request) {
        Selection& selection = options.request->selection;
        check_regions(given.refinement.selection, first.lists.regions, world);
        complete_selection(
            selection, given.refinement.selection,
            {index_base, first.totals.cells, SharedGroupNames(first.lists.group_names)}, world);
    }
    RefinementMaps maps;
    if (!given.maps.empty()) {
        world.on_first([&] { maps = read_maps(given.maps, index_base); });
        share_maps(maps, world);
        options.maps = &maps;
    }
    return verify_refinement(std::move(first), std::move(second), world, options);
}

/// The rule of the longest-edge closure does not hold for a mesh that the regular closure made.
void check_closure(const VerifyCommandOptions& given, const verify::VerifyOptions& options) {
    if (!options.request || options.closure == Closure::regular) return;
    if (!is_checkpoint(given.second)) return;
    if (read_checkpoint_facts(given.second).closure != Closure::regular) return;
    throw InputError(fmt::format(
        "{}: the mesh was refined with the regular closure: repeat the command with --closure "
        "regular",
        given.second));
}

/// Collective. Returns whether the mesh is valid.
bool run(const VerifyCommandOptions& given, const distributed::Communicator& world) {
    verify::VerifyOptions options = options_of(given);
    const Coarsened coarsened = coarsened_of(given);
    world.on_first([&] {
        check_closure(given, options);
        if (given.report.empty()) return;
        check_side_file("--report", given.report);
        check_distinct_files(
            {mesh_named("MESH", given.first), mesh_named("REFINED", given.second),
             mesh_named("--coarsened-from", given.before), file_named("--maps", given.maps),
             file_named("--cells", given.refinement.selection.cells_file)},
            {file_named("--report", given.report)});
    });
    const bool has_no_request = given.before.empty() && !given.second.empty() && !options.request;
    CheckProgress progress;
    if (world.is_first()) options.progress = progress.progress_callback();
    JudgedFiles judged;
    verify::Verdict verdict;
    if (!given.before.empty()) {
        world.on_first([&] {
            verdict = judge_coarsened(coarsened, read_without_checks(given.first), given.first,
                                      options, judged);
        });
    } else if (world.size() == 1) {
        verdict = judge(given, options, judged);
    } else {
        verdict = verify_distributed(given, options, judged, world);
    }
    progress.clear();
    if (has_no_request) {
        verdict.checks.push_back({"8T-LE", verify::Status::skipped, std::string(no_request)});
    }
    world.on_first([&] {
        print_verdict(verdict, judged);
        if (!given.report.empty()) write_text(format_json(verdict, judged), given.report);
    });
    return world.of_first(std::uint64_t{verdict.valid() ? 1U : 0U}) != 0;
}

}  // namespace

void add_verify(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<VerifyCommandOptions>();
    CLI::App* command = program.add_subcommand(
        "verify",
        "Verify a mesh, or one as the refinement or coarsening of another, in exact arithmetic");
    command->add_option("MESH", options->first, "the mesh; with REFINED, the coarse mesh")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    command
        ->add_option("REFINED", options->second, "the mesh to be verified as a refinement of MESH")
        ->type_name("")
        ->check(file_name_validator());
    command->add_flag("--fast", options->fast,
                      "skip checks that need spatial searches, exact sums or angles");
    add_number<double>(*command, "--min-dihedral", options->min_dihedral, {0, 180, "0 to 180"},
                       "check, exactly, that no dihedral angle is less than D degrees")
        ->type_name("D");
    command->add_option("--report", options->report, "also write all findings, as JSON")
        ->type_name("FILE")
        ->check(file_name_validator());
    command
        ->add_option("--maps", options->maps,
                     "also check the parents and midpoints written by refine --maps")
        ->type_name("FILE")
        ->check(file_name_validator());
    command
        ->add_option(
            "--coarsened-from", options->before,
            "verify MESH as the result of coarsening this mesh in the cells selected below")
        ->type_name("STATE.octetra")
        ->check(file_name_validator());
    command->add_flag("--outside", options->outside,
                      "with --coarsened-from: select the cells that no criterion selects");
    add_refinement_options(*command, options->refinement,
                           "Verify the 8T-LE refinement of these cells (as for refine) or, with "
                           "--coarsened-from, their coarsening");
    add_closure_option(
        *command, options->refinement,
        "regular: check that REFINED results from the regular closure of the selection or,\n"
        "without one, of some cells [longest-edge]");
    command->footer(
        "Exit status: 0 valid; 1 not valid; 2 bad usage, or a file that cannot be read;\n"
        "3 the system failed: memory, disk; 128 + its number: a signal ended a rank, for example\n"
        "137 if it was killed.\n"
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.1.ele\n"
        "  octetra verify fine.1.ele\n"
        "  octetra verify gear.1.ele fine.1.ele --sphere 1,0,0.1,0.3 --levels 2\n"
        "  octetra refine gear.1.ele --random 0.1 --closure regular -o regular.1.ele\n"
        "  octetra verify gear.1.ele regular.1.ele --random 0.1 --closure regular\n"
        "  octetra refine gear.1.ele --all -o fine.octetra\n"
        "  octetra coarsen fine.octetra --sphere 1,0,0.1,0.3 -o coarser.octetra\n"
        "  octetra verify coarser.octetra --coarsened-from fine.octetra --sphere 1,0,0.1,0.3\n"
        "  mpirun -n 4 octetra verify gear.1.ele fine.1.ele");
    command->callback([options, command, world] {
        options->has_refinement_options = has_refinement_options(*command);
        options->has_scheme = was_given(*command, "scheme");
        group_criteria(*command, options->refinement.selection);
        if (!run(*options, world)) throw NegativeAnswer{};
    });
}

}  // namespace octetra::cli
