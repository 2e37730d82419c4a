#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verdict.hpp>

namespace octetra::verify {

/// Collects what the checks find into a verdict.
class Findings {
public:
    explicit Findings(std::size_t kept_per_code) : kept_per_code_(kept_per_code) {}

    /// Counts a violation, and describes it unless enough of its kind have been:
    /// describe() returns {entities, found, expected}.
    void add(Code code, auto&& describe) {
        ++count_;
        if (verdict_.counts[static_cast<std::size_t>(code)]++ >= kept_per_code_) return;
        Description description = describe();
        verdict_.violations.push_back({code, std::move(description.entities),
                                       std::move(description.found),
                                       std::move(description.expected)});
    }

    /// Runs a check: it has failed if it adds violations. What it returns is its note.
    /// Returns whether it has passed.
    bool run(std::string_view name, auto&& check) {
        const std::uint64_t before = count_;
        const auto start = std::chrono::steady_clock::now();
        std::string note = check();
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        const bool clean = count_ == before;
        verdict_.checks.push_back({std::string(name), clean ? Status::passed : Status::failed,
                                   std::move(note), passed.count()});
        return clean;
    }

    void skip(std::string_view name, std::string_view why) {
        verdict_.checks.push_back({std::string(name), Status::skipped, std::string(why), 0});
    }

    struct Description {
        std::vector<Entity> entities;
        std::string found;
        std::string expected;
    };

    [[nodiscard]] Verdict& verdict() { return verdict_; }
    [[nodiscard]] Facts& facts() { return verdict_.facts; }
    [[nodiscard]] Arithmetic& arithmetic() { return verdict_.arithmetic; }

private:
    std::size_t kept_per_code_;
    std::uint64_t count_ = 0;
    Verdict verdict_;
};

[[nodiscard]] inline Entity entity(Entity::Kind kind, std::size_t number, Which mesh) {
    return {.kind = kind, .mesh = mesh, .number = static_cast<std::uint32_t>(number)};
}
[[nodiscard]] inline Entity entity(VertexIndex v, Which mesh = Which::fine) {
    return entity(Entity::Kind::vertex, v.value(), mesh);
}
[[nodiscard]] inline Entity entity(CellIndex c, Which mesh = Which::fine) {
    return entity(Entity::Kind::cell, c.value(), mesh);
}
[[nodiscard]] inline Entity entity(FacetIndex f, Which mesh = Which::fine) {
    return entity(Entity::Kind::facet, f.value(), mesh);
}
[[nodiscard]] inline Entity entity(EdgeIndex e, Which mesh = Which::fine) {
    return entity(Entity::Kind::listed_edge, e.value(), mesh);
}
[[nodiscard]] inline Entity entity(const FacetVertices& face, Which mesh = Which::fine) {
    return {Entity::Kind::face, mesh, 0, {face.begin(), face.end()}};
}
[[nodiscard]] inline Entity entity(const EdgeVertices& edge, Which mesh = Which::fine) {
    return {Entity::Kind::edge, mesh, 0, {edge.begin(), edge.end()}};
}
[[nodiscard]] inline Entity entity(const CellVertices& piece, Which mesh = Which::fine) {
    return {Entity::Kind::piece, mesh, 0, {piece.begin(), piece.end()}};
}

}  // namespace octetra::verify
