#pragma once

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/verify/verdict.hpp>
#include <octetra/verify/verify.hpp>

#include "parts/exchange.hpp"
#include "parts/numbers.hpp"

namespace octetra::verify {

/// Collects what the checks find, on all processes of a group, into one verdict. Each violation is
/// added by the process in whose domain it lies, and by no other.
class Findings {
public:
    explicit Findings(std::size_t kept_per_code, const ProcessGroup& group = ProcessGroup::alone(),
                      Progress progress = {})
        : kept_per_code_(kept_per_code), group_(&group), progress_(std::move(progress)) {}

    /// From here on entities of this mesh are those of a part, called so in the whole one; or, with
    /// null, of the whole one. Keeps the pointer.
    void translate(Which mesh, const Numbers* numbers) {
        numbers_[static_cast<std::size_t>(mesh)] = numbers;
    }
    [[nodiscard]] const Numbers& numbers(Which mesh) const {
        static const Numbers the_same;
        const Numbers* numbers = numbers_[static_cast<std::size_t>(mesh)];
        return numbers == nullptr ? the_same : *numbers;
    }

    /// Counts and describes a violation: describe() returns {entities, found, expected}. Of each
    /// code the first ones are kept, in the order of is_before().
    void add(Code code, auto&& describe) {
        ++count_;
        ++verdict_.counts[static_cast<std::size_t>(code)];
        Description description = describe();
        for (Entity& entity : description.entities) call_as_in_whole(entity);
        keep({code, std::move(description.entities), std::move(description.found),
              std::move(description.expected)});
    }

    /// Collective. Runs a check: it has failed if any process adds violations. What it returns is
    /// its note, of what has been shown if it has passed. Returns whether it has.
    bool run(std::string_view name, auto&& check) {
        const std::uint64_t before = count_;
        const auto start = std::chrono::steady_clock::now();
        running_ = name;
        tell_progress(0);
        std::string note = check();
        const bool clean = sum(*group_, count_ - before) == 0;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        if (!clean) note.clear();
        verdict_.checks.push_back({std::string(name), clean ? Status::passed : Status::failed,
                                   std::move(note), passed.count()});
        return clean;
    }

    /// Whoever listens hears what share of the running check is done.
    void tell_progress(double share) const {
        if (progress_) progress_(running_, share);
    }

    /// On all processes.
    void skip(std::string_view name, std::string_view why) {
        verdict_.checks.push_back({std::string(name), Status::skipped, std::string(why), 0});
    }

    /// Which checks have failed until now, as the reason to skip another: "cover failed". Empty
    /// if none has; the same on all processes.
    [[nodiscard]] std::string what_failed() const;

    /// Collective. The verdict, whole on the first process; the others have all but the violations.
    [[nodiscard]] Verdict finish();

    struct Description {
        std::vector<Entity> entities;
        std::string found;
        std::string expected;
    };

    [[nodiscard]] const ProcessGroup& group() const { return *group_; }
    [[nodiscard]] Verdict& verdict() { return verdict_; }
    [[nodiscard]] Facts& facts() { return verdict_.facts; }  ///< until finish(), of this process
    [[nodiscard]] Arithmetic& arithmetic() { return verdict_.arithmetic; }

private:
    void call_as_in_whole(Entity& entity) const;
    void keep(Violation violation);
    void drop_surplus(std::vector<Violation>& violations) const;

    std::size_t kept_per_code_;
    const ProcessGroup* group_;
    Progress progress_;
    std::string_view running_;
    std::array<const Numbers*, 3> numbers_{};  ///< by Which
    std::uint64_t count_ = 0;
    std::array<std::vector<Violation>, code_count> kept_;
    Verdict verdict_;
};

/// Steps of the running check, about `total`; tells of some.
class Steps {
public:
    Steps(const Findings& findings, std::uint64_t total) : findings_(&findings), total_(total) {}

    void operator()() {
        if (++done_ % steps_per_report != 0) return;
        findings_->tell_progress(
            done_ < total_ ? static_cast<double>(done_) / static_cast<double>(total_) : 1);
    }

private:
    static constexpr std::uint64_t steps_per_report = 1024;

    const Findings* findings_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
};

/// The coordinates of a point, for messages.
[[nodiscard]] std::string shown(const Point& p);

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
    return entity(Entity::Kind::tagged_edge, e.value(), mesh);
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
