#include <string>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "fuzz/check_readers.hpp"
#include "support/sealed_checkpoint.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::test {
namespace {

namespace fs = std::filesystem;
using distributed::AdaptiveMesh;
using distributed::Communicator;

/// A few bytes may request more cells than fit in memory.
bool is_small(const CheckpointFacts& facts) {
    constexpr std::uint64_t most = 100'000;
    for (const StepFacts& step : facts.steps) {
        if (step.cells_before > most) return false;
    }
    return facts.cells_now <= most;
}

/// Loads a checkpoint and saves it to another file.
void load_and_save(const fs::path& from, const fs::path& to) {
    std::vector<distributed::Field> fields;
    const AdaptiveMesh mesh = AdaptiveMesh::load(Communicator(), from, {}, &fields);
    mesh.save(to, fields);
}

void check(const fs::path& folder) {
    try {
        if (!is_small(read_checkpoint_facts(folder / "in.octetra"))) return;
        load_and_save(folder / "in.octetra", folder / "out.octetra");
    } catch (const InputError& error) {
        check_message(error.what(), folder);
        return;
    }
    if (read_checkpoint_facts(folder / "out.octetra").cells_now !=
        read_checkpoint_facts(folder / "in.octetra").cells_now) {
        throw BrokenPromise("a checkpoint was loaded and saved, and has other cells");
    }
    try {
        load_and_save(folder / "out.octetra", folder / "again.octetra");
    } catch (const InputError& error) {
        throw BrokenPromise(std::string("what was loaded and saved is refused: ") + error.what());
    }
    if (content_of(folder / "out.octetra") != content_of(folder / "again.octetra")) {
        throw BrokenPromise("a checkpoint that is loaded and saved again is another file");
    }
}

}  // namespace

void check_checkpoint(std::string_view input, const fs::path& folder) {
    std::string bytes(input);
    write_file(folder / "in.octetra", bytes);
    check(folder);
    // Few generated files have the right hashes.
    seal(bytes);
    write_file(folder / "in.octetra", bytes);
    check(folder);
}

}  // namespace octetra::test
