#include "properties/team.hpp"

#include <octetra/core/error.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/reference/refine.hpp>

#include "adapt/marks.hpp"
#include "adapt/mesh_state.hpp"
#include "distributed/world.hpp"
#include "level/tuning.hpp"
#include "properties/case_json.hpp"
#include "select/select_cells.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::properties {
namespace {

using distributed::Communicator;

/// A request of the first rank: a refinement, to be collected or, if there is a file, to be
/// written; or a history, if there is a folder.
struct Request {
    Case refinement;
    std::string file;
    std::string folder;
};

void broadcast_text(const std::string& text) {
    std::vector<char> letters(text.begin(), text.end());
    test::world().broadcast(letters);
}

std::string receive_text() {
    std::vector<char> letters;
    test::world().broadcast(letters);
    return {letters.begin(), letters.end()};
}

std::vector<int> folded(std::vector<int> cell_to_rank) {
    for (int& rank : cell_to_rank) rank %= test::world().size();
    return cell_to_rank;
}

/// The kind of level of each rank depends on the case: automatic, always a full sweep with all
/// edges numbered or with the local edge set, or always incremental. Results must not depend on it.
distributed::Tuning tuning_of(std::uint64_t seed) {
    const std::uint64_t turn = (seed + static_cast<std::uint64_t>(test::world().rank())) % 4;
    if (turn == 0) return {};
    constexpr double always = 10;
    return {.incremental_below = turn == 3 ? always : 0, .local_below = turn == 2 ? always : 0};
}

/// Collective. Refines with the closure of the case; the mesh is lost if this is refused.
distributed::DistributedMesh refined(distributed::DistributedMesh part, const Case& c) {
    const distributed::Tuning tuning = tuning_of(c.seed);
    if (c.closure == Closure::longest_edge) {
        distributed::refine(part, c.selection, {c.scheme, c.levels, c.synchronisation}, tuning);
        return part;
    }
    const auto state = distributed::AdaptiveMesh::State::make(std::move(part));
    const auto mark = [&] {
        if (!is_compound(c.selection)) {
            return distributed::mark_cells(state->mesh, c.selection, false);
        }
        return distributed::marked_by_bytes(state->mesh,
                                            distributed::select_cells(state->mesh, c.selection));
    };
    const distributed::StepOptions options{.closure = Closure::regular,
                                           .synchronisation = c.synchronisation};
    for (int level = 1; level <= c.levels; ++level) {
        if (!state->refine(mark, options, tuning).changed) break;
    }
    return std::move(state->mesh);
}

/// Collective. If only some ranks refuse, the outcome on all ranks reports this disagreement.
Outcome carry_out(const Request& request) {
    const Communicator& world = test::world();
    const Case& c = request.refinement;
    Outcome outcome;
    try {
        distributed::DistributedMesh part =
            refined(distributed::distribute(world, c.mesh, folded(c.cell_to_rank)), c);
        if (request.file.empty()) {
            auto [mesh, maps] = distributed::collect(std::move(part));
            outcome = {std::move(mesh), std::move(maps), {}};
        } else {
            distributed::CanonicalMesh canonical(std::move(part));
            (void)distributed::write_mesh(canonical, request.file);
        }
    } catch (const InputError& error) {
        outcome = {.error = error.what()};
    }
    const std::uint64_t refused = world.sum(outcome.error.empty() ? 0 : 1);
    if (refused != 0 && refused != static_cast<std::uint64_t>(world.size())) {
        outcome.error = "refused on " + std::to_string(refused) + " ranks only: " + outcome.error;
    }
    return outcome;
}

void serve_requests() {
    for (std::string text = receive_text(); !text.empty(); text = receive_text()) {
        const auto json = nlohmann::json::parse(text);
        const Request request{case_of(json), json.at("file"), json.at("folder")};
        if (request.folder.empty()) {
            (void)carry_out(request);
        } else {
            (void)adapt_together(request.refinement, request.folder);
        }
    }
}

void broadcast_text(const Request& request) {
    Case without_mesh = request.refinement;
    without_mesh.mesh = {};
    without_mesh.cell_to_rank.clear();
    nlohmann::json json = json_of(without_mesh);
    json["file"] = request.file;
    json["folder"] = request.folder;
    broadcast_text(json.dump());
}

Outcome run_on_all(const Request& request) {
    broadcast_text(request);
    return carry_out(request);
}

}  // namespace

void run_on_first_rank(const std::function<void()>& work) {
    if (!test::world().is_first()) return serve_requests();
    try {
        work();
    } catch (...) {
        broadcast_text("");
        throw;
    }
    broadcast_text("");
}

Outcome refined_by_all(const Case& c) { return run_on_all({c, {}, {}}); }

std::string write_refined_by_all(const Case& c, const std::filesystem::path& file) {
    return run_on_all({c, file.string(), {}}).error;
}

Adapted adapted_by_all(const Case& c) {
    const test::TemporaryFolder folder;
    broadcast_text({c, {}, folder.path().string()});
    return adapt_together(c, folder.path());
}

Outcome refined_by_reference(const Case& c) {
    try {
        auto [mesh, maps] = c.closure == Closure::regular
                                ? reference::refine_regularly(c.mesh, c.selection, c.levels)
                                : reference::refine(c.mesh, c.selection, c.scheme, c.levels);
        return {std::move(mesh), std::move(maps), {}};
    } catch (const InputError& error) {
        return {.error = error.what()};
    }
}

}  // namespace octetra::properties
