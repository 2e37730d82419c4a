#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/world.hpp"
#include "support/manifest.hpp"

/// Every mesh of the corpus, by every scheme, partition and synchronisation, against the reference.
namespace octetra::distributed {
namespace {

using test::CorpusEntry;

class CorpusEquality : public testing::TestWithParam<CorpusEntry> {
protected:
    static std::filesystem::path file() {
        const auto& entry = GetParam().content;
        if (entry.contains("file")) {
            return test::corpus_folder() / entry["file"].get<std::string>();
        }
        return std::filesystem::path(OCTETRA_GENERATED_CORPUS) /
               (entry["name"].get<std::string>() + ".ele");
    }
    const Mesh mesh = read_mesh(file());
    /// Enough for small meshes to grow, and for large ones to end.
    const int levels = mesh.cells.size() < 100 ? 4 : mesh.cells.size() < 1000 ? 3 : 2;
};

/// A refinement, or the error it ended in.
struct Outcome {
    Mesh mesh;
    RefinementMaps maps;
    std::string error;

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome_of(auto&& refine) {
    try {
        auto result = refine();
        return {std::move(result.mesh), std::move(result.maps), {}};
    } catch (const InputError& error) {
        return {.error = error.what()};
    }
}

TEST_P(CorpusEquality, ByEverySchemePartitionAndSynchronisation) {
    const Communicator& world = test::world();
    const std::vector<Selection> selections{{.random = RandomShare{0.15, 4}},
                                            {.cells = {GlobalCell{0}}}};
    for (const Selection& selection : selections) {
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            const Outcome expected =
                world.is_first()
                    ? outcome_of([&] { return reference::refine(mesh, selection, scheme, levels); })
                    : Outcome{};
            for (const std::string method : {"lepp", "dual", "block", "random:1", "random:2"}) {
                const auto parts = partition_cells(mesh, world.size(), parse_partition(method));
                for (const auto synchronisation :
                     {Synchronisation::neighbour, Synchronisation::gateway}) {
                    const Outcome found = outcome_of([&] {
                        DistributedMesh part = distribute(world, mesh, parts);
                        refine(part, selection, {scheme, levels, synchronisation});
                        return collect(std::move(part));
                    });
                    if (!world.is_first()) continue;
                    ASSERT_EQ(found.error, expected.error) << method;
                    ASSERT_TRUE(found == expected) << method;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, CorpusEquality, testing::ValuesIn(test::corpus_entries("meshes")),
                         test::corpus_name);

}  // namespace
}  // namespace octetra::distributed
