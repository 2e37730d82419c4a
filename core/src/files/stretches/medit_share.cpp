#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string_view>

#include <octetra/core/huge_pages.hpp>

#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/input_file.hpp"
#include "files/input/line_reader.hpp"
#include "files/medit/entry_positions.hpp"
#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"
#include "files/stretches/keyword_scan.hpp"
#include "files/stretches/readers.hpp"
#include "files/stretches/shares.hpp"
#include "files/stretches/status.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// The entries of a section, between its count and the next keyword.
struct SectionPlan {
    std::uint64_t count = 0;
    std::uint64_t is_there = 0;
    FileRange bytes;
};

/// A section that is skipped, skipped_sections[kind].
struct SkippedPlan {
    std::uint64_t kind = 0;
    std::uint64_t keyword_line = 0;
    SectionPlan section;
};

/// The sections that the first process finds between the keywords.
struct MeditPlan {
    SectionPlan vertices;
    SectionPlan tetrahedra;
    SectionPlan triangles;
    SectionPlan edges;
    PerFeature<SectionPlan> features;
    std::array<SkippedPlan, 2 * skipped_sections.size()> skipped{};
    std::uint64_t skipped_count = 0;
    std::uint64_t has_end = 0;
};

[[noreturn]] void throw_unsuitable() { throw std::runtime_error("not one entity a line"); }

/// A keyword and the number after it, which may be on the next line.
class SectionHead {
public:
    SectionHead(const fs::path& path, std::uint64_t begin, std::uint64_t end)
        : reader_(path, begin, end), end_(end) {
        if (!reader_.next()) throw_unsuitable();
        Fields fields(reader_);
        keyword_ = fields.text();
        if (keyword_ == "End") {
            if (!fields.at_end()) throw_unsuitable();
            return;
        }
        if (fields.at_end()) {
            if (!reader_.next()) throw_unsuitable();
            fields = Fields(reader_);
        }
        number_ = fields.unsigned_integer("a number");
        if (!fields.at_end()) throw_unsuitable();
    }

    [[nodiscard]] const std::string& keyword() const { return keyword_; }
    [[nodiscard]] std::uint64_t number() const { return number_; }

    /// To be called if the keyword has no entries: throws if any follow.
    void expect_nothing() {
        if (reader_.next()) throw_unsuitable();
    }
    void take_entries(SectionPlan& section, std::size_t field_count) const {
        if (section.is_there == 1) throw_unsuitable();
        reader_.check_count(number_, field_count, "entries");
        section = {number_, 1, {reader_.next_position(), end_}};
    }

private:
    LineReader reader_;
    std::uint64_t end_;
    std::string keyword_;
    std::uint64_t number_ = 0;
};

/// Handles keywords that are not lists of the mesh.
void plan_other(SectionHead& head, std::uint64_t keyword_line, MeditPlan& plan) {
    if (std::ranges::find(other_cell_shapes, head.keyword(), &MeditKeyword::keyword) !=
        other_cell_shapes.end()) {
        if (head.number() != 0) throw_unsuitable();
        return head.expect_nothing();
    }
    const std::size_t feature = feature_with(&MeditKeyword::keyword, head.keyword());
    if (feature < feature_count) {
        return head.take_entries(plan.features[all_features.at(feature)], 1);
    }
    const auto skipped =
        std::ranges::find(skipped_sections, head.keyword(), &SkippedSection::keyword);
    if (skipped == skipped_sections.end() || plan.skipped_count == plan.skipped.size()) {
        throw_unsuitable();
    }
    SkippedPlan& one = plan.skipped[plan.skipped_count++];
    one.kind = static_cast<std::uint64_t>(skipped - skipped_sections.begin());
    one.keyword_line = keyword_line;
    head.take_entries(one.section, skipped->numbers_per_entry);
}

void plan_section(SectionHead& head, std::uint64_t keyword_line, bool is_last, MeditPlan& plan) {
    if (head.keyword() == "End") {
        plan.has_end = 1;
        head.expect_nothing();
        if (!is_last) throw_unsuitable();
    } else if (head.keyword() == "Dimension") {
        head.expect_nothing();
        if (head.number() != 3) throw_unsuitable();
    } else if (head.keyword() == "Vertices") {
        head.take_entries(plan.vertices, 4);
    } else if (head.keyword() == "Tetrahedra") {
        head.take_entries(plan.tetrahedra, 5);
    } else if (head.keyword() == "Triangles") {
        head.take_entries(plan.triangles, 4);
    } else if (head.keyword() == "Edges") {
        head.take_entries(plan.edges, 3);
    } else {
        plan_other(head, keyword_line, plan);
    }
}

MeditPlan medit_plan(const fs::path& path, const std::vector<NumberedLine>& keywords,
                     std::uint64_t file_size) {
    MeditPlan plan;
    if (keywords.empty() || LineReader(path, 0, keywords.front().position).next())
        throw_unsuitable();
    for (std::size_t k = 0; k < keywords.size(); ++k) {
        const bool is_last = k + 1 == keywords.size();
        SectionHead head(path, keywords[k].position,
                         is_last ? file_size : keywords[k + 1].position);
        if (k > 0) {
            plan_section(head, keywords[k].number, is_last, plan);
            continue;
        }
        head.expect_nothing();
        if (head.keyword() != "MeshVersionFormatted" || head.number() < 1 || head.number() > 4) {
            throw_unsuitable();
        }
    }
    const bool ends_too_early = plan.has_end == 0 && plan.tetrahedra.is_there == 0;
    if (plan.vertices.is_there == 0 || ends_too_early) throw_unsuitable();
    return plan;
}

/// Reads this process's share of each section.
class MeditShares {
public:
    MeditShares(const fs::path& path, const MeditPlan& plan, const ProcessGroup& group)
        : path_(&path), plan_(&plan), group_(&group) {}

    void read(Mesh& lists) {
        read_share(
            plan_->vertices, 4,
            [&](std::size_t room) {
                reserve_in_huge_pages(lists.points, room);
                reserve_in_huge_pages(lists.point_markers, room);
            },
            [&](Fields& fields, const LineReader&) {
                const double x = fields.coordinate("x");
                const double y = fields.coordinate("y");
                const double z = fields.coordinate("z");
                lists.points.push_back({x, y, z});
                lists.point_markers.push_back(fields.marker("the vertex's reference"));
            });
        read_list(plan_->tetrahedra, cell_kind, lists);
        read_list(plan_->triangles, facet_kind, lists);
        read_list(plan_->edges, edge_kind, lists);
        for (const Feature feature : all_features) read_feature(feature, lists.features[feature]);
        for (std::size_t k = 0; k < plan_->skipped_count; ++k) read_over(k);
    }

    /// Collective. Returns false on all processes if the number of entries differs from the
    /// announced one.
    [[nodiscard]] bool number(MeshShare& mesh_share) const {
        bool are_consistent = true;
        const auto number = [&](std::size_t read, const SectionPlan& section) {
            return number_share(*group_, read, section.count, are_consistent);
        };
        const Mesh& lists = mesh_share.lists;
        mesh_share.first_vertex = number(lists.points.size(), plan_->vertices);
        mesh_share.first_cell = number(lists.cells.size(), plan_->tetrahedra);
        mesh_share.first_facet = number(lists.facets.size(), plan_->triangles);
        mesh_share.first_edge = number(lists.edges.size(), plan_->edges);
        for (const Feature feature : all_features) {
            (void)number(lists.features[feature].size(), plan_->features[feature]);
        }
        for (std::size_t k = 0; k < plan_->skipped_count; ++k) {
            (void)number(read_over_[k], plan_->skipped[k].section);
        }
        return are_consistent;
    }

private:
    void read_share(const SectionPlan& section, std::size_t field_count, auto&& make_room,
                    auto&& read_entry) {
        if (section.is_there == 0) return;
        const FileRange share =
            share_of_lines(*path_, section.bytes, group_->rank(), group_->size());
        make_room(room_for(section.count, share.size(), section.bytes.size()));
        LineReader reader(*path_, share.begin, share.end);
        while (reader.next()) {
            Fields fields(reader);
            read_entry(fields, reader);
            fields.expect_end(field_count);
        }
    }

    template <class I, std::size_t N>
    void read_list(const SectionPlan& section, const EntityKind<I, N>& kind, Mesh& lists) {
        auto& list = lists.*kind.list;
        auto& markers = lists.*kind.markers;
        const std::uint64_t vertex_count = plan_->vertices.count;
        const auto read_entry = [&](Fields& fields, const LineReader& reader) {
            std::array<VertexIndex, N> vertices;
            for (VertexIndex& vertex : vertices) {
                const std::uint64_t index = fields.unsigned_integer("a vertex number") - 1;
                // 0 wraps around
                if (index >= vertex_count) reader.fail("there is no such vertex");
                vertex = VertexIndex{index};
            }
            for (std::size_t k = 0; k < N; ++k) {
                for (std::size_t j = 0; j < k; ++j) {
                    if (vertices[j] == vertices[k]) reader.fail("the same vertex twice");
                }
            }
            list.push_back(vertices);
            markers.push_back(fields.marker("the reference"));
        };
        read_share(
            section, N + 1,
            [&](std::size_t room) {
                reserve_in_huge_pages(list, room);
                reserve_in_huge_pages(markers, room);
            },
            read_entry);
    }

    void read_feature(Feature feature, std::vector<std::uint64_t>& numbers) {
        const std::uint64_t count = numbered_by(feature, counts_of(*plan_)).count;
        read_share(
            plan_->features[feature], 1, [&](std::size_t room) { numbers.reserve(room); },
            [&](Fields& fields, const LineReader& reader) {
                const std::uint64_t number = fields.unsigned_integer("a number") - 1;
                if (number >= count) reader.fail("there is no such entity");  // 0 wraps around
                numbers.push_back(number);
            });
    }

    void read_over(std::size_t k) {
        const SkippedPlan& skipped = plan_->skipped[k];
        const std::size_t numbers = skipped_sections.at(skipped.kind).numbers_per_entry;
        const auto read_entry = [&](Fields& fields, const LineReader&) {
            for (std::size_t i = 0; i < numbers; ++i) {
                (void)fields.real("a number of this section");
            }
            ++read_over_[k];
        };
        read_share(
            skipped.section, numbers, [](std::size_t) {}, read_entry);
    }

    const fs::path* path_;
    const MeditPlan* plan_;
    const ProcessGroup* group_;
    std::array<std::uint64_t, 2 * skipped_sections.size()> read_over_{};  // number of entries
};

}  // namespace

std::optional<MeshShare> read_medit_share(const fs::path& path, const ProcessGroup& group) {
    CollectiveStatus status(group);
    std::uint64_t file_size = 0;
    status.attempt([&] {
        if (group.is_first()) file_size = InputFile(path).size();
    });
    if (!broadcast_from_first(status, file_size)) return std::nullopt;
    const auto keywords = scan_for_keywords(status, path, file_size);
    if (!keywords) return std::nullopt;
    MeditPlan plan;
    status.attempt([&] {
        if (group.is_first()) plan = medit_plan(path, *keywords, file_size);
    });
    if (!broadcast_from_first(status, plan)) return std::nullopt;

    MeshShare mesh_share;
    MeditShares shares(path, plan, group);
    status.attempt([&] {
        shares.read(mesh_share.lists);
        for (const SkippedPlan& one : std::span(plan.skipped).first(plan.skipped_count)) {
            if (one.section.count == 0) continue;
            mesh_share.notes.push_back(note_on_skipped(path, one.keyword_line, one.section.count,
                                                       skipped_sections.at(one.kind).keyword));
        }
        if (plan.has_end == 0) mesh_share.notes.push_back(note_on_missing_end(path));
    });
    if (!status.all_succeeded() || !shares.number(mesh_share)) return std::nullopt;
    set_common_facts(counts_of(plan), group, mesh_share);
    return mesh_share;
}

}  // namespace octetra
