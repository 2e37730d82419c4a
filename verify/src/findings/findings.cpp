#include "findings/findings.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "parts/packing.hpp"

namespace octetra::verify {
namespace {

bool entity_is_before(const Entity& a, const Entity& b) {
    return std::tie(a.kind, a.mesh, a.number, a.vertices) <
           std::tie(b.kind, b.mesh, b.number, b.vertices);
}

/// An order that does not depend on the distribution or the order of the checks.
bool is_before(const Violation& a, const Violation& b) {
    if (a.entities != b.entities) {
        return std::lexicographical_compare(a.entities.begin(), a.entities.end(),
                                            b.entities.begin(), b.entities.end(), entity_is_before);
    }
    return std::tie(a.found, a.expected) < std::tie(b.found, b.expected);
}

void join(Facts& a, const Facts& b) {
    a.vertices += b.vertices;
    a.cells += b.cells;
    a.edges += b.edges;
    a.faces += b.faces;
    a.boundary_faces += b.boundary_faces;
    a.unused_vertices += b.unused_vertices;
    a.singular_edges += b.singular_edges;
    a.singular_vertices += b.singular_vertices;
    a.bisected_edges += b.bisected_edges;
    a.rounded_midpoints += b.rounded_midpoints;
    a.cells_kept += b.cells_kept;
    a.deepest = std::max(a.deepest, b.deepest);
    a.rounding_bound = std::max(a.rounding_bound, b.rounding_bound);
}

void join(std::optional<AngleFigures>& a, const std::optional<AngleFigures>& b) {
    if (!a || !b) {
        if (!a) a = b;
        return;
    }
    const bool less =
        b->min_dihedral < a->min_dihedral ||
        (b->min_dihedral == a->min_dihedral && b->min_dihedral_at < a->min_dihedral_at);
    if (less) {
        a->min_dihedral = b->min_dihedral;
        a->min_dihedral_at = b->min_dihedral_at;
    }
    a->max_dihedral = std::max(a->max_dihedral, b->max_dihedral);
    a->min_solid = std::min(a->min_solid, b->min_solid);
    a->min_eta = std::min(a->min_eta, b->min_eta);
}

void join(std::vector<DepthFigures>& a, const std::vector<DepthFigures>& b) {
    for (const DepthFigures& figures : b) {
        const auto at = std::lower_bound(
            a.begin(), a.end(), figures,
            [](const DepthFigures& x, const DepthFigures& y) { return x.depth < y.depth; });
        if (at == a.end() || at->depth != figures.depth) {
            a.insert(at, figures);
            continue;
        }
        at->cells += figures.cells;
        at->min_dihedral = std::min(at->min_dihedral, figures.min_dihedral);
        at->min_eta = std::min(at->min_eta, figures.min_eta);
    }
}

/// Merges all data except the checks and sums, which are the same on all processes.
void join(Verdict& a, Verdict b) {
    for (std::size_t code = 0; code < code_count; ++code) a.counts[code] += b.counts[code];
    join(a.facts, b.facts);
    join(a.angles, b.angles);
    join(a.coarse_angles, b.coarse_angles);
    join(a.by_depth, b.by_depth);
    a.arithmetic.filtered += b.arithmetic.filtered;
    a.arithmetic.exact += b.arithmetic.exact;
    a.search_tests += b.search_tests;
    std::move(b.violations.begin(), b.violations.end(), std::back_inserter(a.violations));
}

template <class Stream>
void pack_or_unpack(Stream& stream, auto& verdict) {
    stream(verdict.counts);
    stream(verdict.facts);
    stream(verdict.angles);
    stream(verdict.coarse_angles);
    stream.list(verdict.by_depth);
    stream(verdict.arithmetic);
    stream(verdict.search_tests);
}

ProcessGroup::Bytes packed(const Verdict& verdict, bool with_violations) {
    Packer pack;
    pack_or_unpack(pack, verdict);
    pack(std::uint64_t{with_violations ? verdict.violations.size() : 0});
    for (std::size_t i = 0; with_violations && i < verdict.violations.size(); ++i) {
        const Violation& violation = verdict.violations[i];
        pack(violation.code);
        pack(std::uint64_t{violation.entities.size()});
        for (const Entity& entity : violation.entities) {
            pack(entity.kind);
            pack(entity.mesh);
            pack(entity.number);
            pack.list(entity.vertices);
        }
        pack.list(violation.found);
        pack.list(violation.expected);
    }
    return std::move(pack.bytes());
}

Verdict unpacked(const ProcessGroup::Bytes& bytes) {
    Unpacker unpack(bytes);
    Verdict verdict;
    pack_or_unpack(unpack, verdict);
    std::uint64_t count = 0;
    unpack(count);
    verdict.violations.resize(count);
    for (Violation& violation : verdict.violations) {
        unpack(violation.code);
        unpack(count);
        violation.entities.resize(count);
        for (Entity& entity : violation.entities) {
            unpack(entity.kind);
            unpack(entity.mesh);
            unpack(entity.number);
            unpack.list(entity.vertices);
        }
        unpack.list(violation.found);
        unpack.list(violation.expected);
    }
    return verdict;
}

}  // namespace

void Findings::use_global_numbers(Entity& entity) const {
    const Numbers& called = numbers(entity.mesh);
    for (VertexIndex& v : entity.vertices) v = called.of(v);
    if (!entity.vertices.empty()) return;
    switch (entity.kind) {
        case Entity::Kind::vertex: entity.number = called.vertices.of(entity.number); break;
        case Entity::Kind::cell: entity.number = called.cells.of(entity.number); break;
        case Entity::Kind::facet: entity.number = called.facets.of(entity.number); break;
        case Entity::Kind::tagged_edge: entity.number = called.edges.of(entity.number); break;
        default: break;  // identified by their vertices
    }
}

void Findings::keep(Violation violation) {
    auto& violations = kept_[static_cast<std::size_t>(violation.code)];
    violations.push_back(std::move(violation));
    // Dropping only when the list has doubled makes the amortised cost small.
    if (violations.size() / 2 > kept_per_code_) drop_surplus(violations);
}

void Findings::drop_surplus(std::vector<Violation>& violations) const {
    const std::size_t kept = std::min(violations.size(), kept_per_code_);
    std::partial_sort(violations.begin(), violations.begin() + static_cast<std::ptrdiff_t>(kept),
                      violations.end(), is_before);
    violations.erase(violations.begin() + static_cast<std::ptrdiff_t>(kept), violations.end());
}

std::string Findings::what_failed() const {
    std::string names;
    for (const Check& check : verdict_.checks) {
        if (check.status != Status::failed) continue;
        if (!names.empty()) names += ", ";
        names += check.name;
    }
    return names.empty() ? names : names + " failed";
}

Verdict Findings::finish() {
    const auto collect_kept = [&] {
        verdict_.violations.clear();
        for (auto& violations : kept_) {
            drop_surplus(violations);
            std::move(violations.begin(), violations.end(),
                      std::back_inserter(verdict_.violations));
            violations.clear();
        }
    };
    collect_kept();
    if (group_->size() == 1) return std::move(verdict_);
    const auto call_cell_as_in_whole = [&](std::optional<AngleFigures>& angles, Which mesh) {
        if (angles) angles->min_dihedral_at = numbers(mesh).of(angles->min_dihedral_at);
    };
    call_cell_as_in_whole(verdict_.angles, Which::fine);
    call_cell_as_in_whole(verdict_.coarse_angles, Which::coarse);

    std::vector<ProcessGroup::Bytes> to_each(static_cast<std::size_t>(group_->size()));
    for (std::size_t r = 0; r < to_each.size(); ++r) to_each[r] = packed(verdict_, r == 0);
    Verdict own = std::exchange(verdict_, {});
    for (ProcessGroup::Bytes& bytes : group_->exchange(std::move(to_each))) {
        join(verdict_, unpacked(bytes));
        bytes = {};
    }
    verdict_.checks = std::move(own.checks);
    verdict_.volumes = std::move(own.volumes);
    verdict_.areas = std::move(own.areas);
    for (Violation& violation : verdict_.violations) {
        kept_[static_cast<std::size_t>(violation.code)].push_back(std::move(violation));
    }
    collect_kept();
    return std::move(verdict_);
}

std::string shown(const Point& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }

}  // namespace octetra::verify
