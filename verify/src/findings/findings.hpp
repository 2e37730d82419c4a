#pragma once

#include <algorithm>
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

/// Collects the results of the checks on all processes of a group into one verdict. Each violation
/// is added only by the process in whose domain it lies.
class Findings {
public:
    explicit Findings(std::size_t kept_per_code, const ProcessGroup& group = ProcessGroup::alone(),
                      Progress progress = {})
        : kept_per_code_(kept_per_code), group_(&group), progress_(std::move(progress)) {}

    /// From this call on, entities of this mesh have local numbers, which `numbers` maps to those
    /// of the whole mesh; null means that they already have numbers of the whole mesh. Keeps the
    /// pointer.
    void translate(Which mesh, const Numbers* numbers) {
        numbers_[static_cast<std::size_t>(mesh)] = numbers;
    }
    [[nodiscard]] const Numbers& numbers(Which mesh) const {
        static const Numbers the_same;
        const Numbers* numbers = numbers_[static_cast<std::size_t>(mesh)];
        return numbers == nullptr ? the_same : *numbers;
    }

    /// Counts and describes a violation: describe() returns {entities, found, expected}. For each
    /// code, the first ones in the order of is_before() are kept.
    void add(Code code, auto&& describe) {
        ++count_;
        ++verdict_.counts[static_cast<std::size_t>(code)];
        Description description = describe();
        for (Entity& entity : description.entities) use_global_numbers(entity);
        keep({code, std::move(description.entities), std::move(description.found),
              std::move(description.expected)});
    }

    /// Collective. Runs a check, which fails if any process adds violations. The check returns a
    /// note on what it has proved if it passes. Returns whether it passed.
    bool run(std::string_view name, auto&& check) {
        const std::uint64_t before = count_;
        const auto start = std::chrono::steady_clock::now();
        running_ = name;
        reported_ = 0;
        report_progress(0);
        std::string note = check();
        const bool clean = sum(*group_, count_ - before) == 0;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        if (!clean) note.clear();
        verdict_.checks.push_back({std::string(name), clean ? Status::passed : Status::failed,
                                   std::move(note), passed.count()});
        return clean;
    }

    /// Reports the completed fraction of the running check, of which parts may be done in several
    /// ways. Never reports less than before.
    void report_progress(double share) {
        reported_ = std::max(reported_, share);
        if (progress_) progress_(running_, reported_);
    }

    /// Collective. Records that a check was skipped.
    void skip(std::string_view name, std::string_view why) {
        verdict_.checks.push_back({std::string(name), Status::skipped, std::string(why), 0});
    }

    /// Returns the checks that have failed so far, as the reason to skip another: "cover failed".
    /// Empty if there are none; the same on all processes.
    [[nodiscard]] std::string what_failed() const;

    /// Collective. Returns the verdict, complete on the first process; without the violations on
    /// others.
    [[nodiscard]] Verdict finish();

    struct Description {
        std::vector<Entity> entities;
        std::string found;
        std::string expected;
    };

    [[nodiscard]] const ProcessGroup& group() const { return *group_; }
    [[nodiscard]] Verdict& verdict() { return verdict_; }
    [[nodiscard]] Facts& facts() { return verdict_.facts; }  ///< of this process until finish()
    [[nodiscard]] Arithmetic& arithmetic() { return verdict_.arithmetic; }

private:
    void use_global_numbers(Entity& entity) const;
    void keep(Violation violation);
    void drop_surplus(std::vector<Violation>& violations) const;

    std::size_t kept_per_code_;
    const ProcessGroup* group_;
    Progress progress_;
    std::string_view running_;
    double reported_ = 0;
    std::array<const Numbers*, 3> numbers_{};  ///< indexed by Which
    std::uint64_t count_ = 0;
    std::array<std::vector<Violation>, code_count> kept_;
    Verdict verdict_;
};

/// Counts the steps of the running check, about `total`, and reports progress from time to time.
class Steps {
public:
    Steps(Findings& findings, std::uint64_t total) : findings_(&findings), total_(total) {}

    void operator()() {
        if (++done_ % steps_per_report != 0) return;
        findings_->report_progress(
            done_ < total_ ? static_cast<double>(done_) / static_cast<double>(total_) : 1);
    }

private:
    static constexpr std::uint64_t steps_per_report = 1024;

    Findings* findings_;
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
