#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_share.hpp>
#include <octetra/distributed/read_parts.hpp>

#include "distributed/world.hpp"
#include "setup/distribute_share.hpp"

namespace octetra::test {

/// The result of reading a file: a mesh and notes, or a message.
struct Outcome {
    Mesh mesh;
    std::vector<std::string> notes;
    std::string error;

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome_of(auto&& read) {
    Outcome outcome;
    try {
        outcome.mesh = read(
            ReadOptions{.note = [&](const std::string& note) { outcome.notes.push_back(note); }});
    } catch (const InputError& error) {
        outcome.notes.clear();
        outcome.error = error.what();
    }
    return outcome;
}

/// Collective. Reads a file serially and collectively, and checks that the mesh is the same, number
/// by number, or that the message is the same on all processes. Returns whether there is a mesh.
inline bool expect_one_outcome(const std::filesystem::path& file, const std::string& partition) {
    const Outcome expected =
        outcome_of([&](const ReadOptions& options) { return read_mesh(file, options); });
    const Outcome found = outcome_of([&](const ReadOptions& options) {
        return distributed::collect(distributed::read_parts(world(), file,
                                                            distributed::parse_partition(partition),
                                                            {options, {}, {}}))
            .mesh;
    });
    EXPECT_EQ(found.error, expected.error) << file;
    if (world().is_first() && found.error.empty()) {
        EXPECT_EQ(found.notes, expected.notes) << file;
        EXPECT_TRUE(found.mesh == expected.mesh) << file;
    }
    auto stretch = read_mesh_share(file, world());
    if (stretch) {
        // Nothing is read serially again unless the file is refused.
        const auto method = distributed::parse_partition(partition).method;
        const auto mesh = distributed::distribute_share(world(), std::move(*stretch), method, {});
        EXPECT_EQ(mesh.has_value(), expected.error.empty()) << file;
        if (mesh) {  // finds duplicates, which collecting would not show
            EXPECT_EQ(world().sum(mesh->cells.size()), expected.mesh.cells.size()) << file;
            EXPECT_EQ(world().sum(mesh->facets.size()), expected.mesh.facets.size()) << file;
            EXPECT_EQ(world().sum(mesh->edges.size()), expected.mesh.edges.size()) << file;
        }
    }
    return expected.error.empty();
}

/// Collective. Returns whether the file has a form that is read collectively.
inline bool is_read_together(const std::filesystem::path& file) {
    return read_mesh_share(file, world()).has_value();
}

}  // namespace octetra::test
