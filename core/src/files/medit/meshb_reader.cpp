#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "files/input/byte_reader.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/medit/entry_positions.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/meshb_layout.hpp"
#include "files/medit/meshb_rows.hpp"
#include "files/shares/shares.hpp"

namespace octetra {
namespace {

/// Reads the sections in file order, except that vertices are read first, because entities that
/// refer to them are checked as they are read. If several processes read the file, each reads its
/// share of the rows of each section.
class MeshbReader final : private EntryPositions {
public:
    MeshbReader(const std::filesystem::path& path, const ReadOptions& options, GrowingMesh& growing)
        : reader_(path),
          layout_(read_meshb_layout(reader_)),
          rows_(reader_, layout_.lists),
          options_(&options),
          growing_(&growing) {
        growing.mesh.index_base = 1;
    }

    void read() {
        for (const std::string& note :
             notes_on(reader_.path(), layout_.lists.has_end, layout_.skipped)) {
            options_->note(note);
        }
        read_points();
        std::array<Listed, 3> lists{Listed::cells, Listed::facets, Listed::edges};
        std::ranges::sort(lists, {}, [&](Listed list) { return rows_.section(list).keyword_at; });
        for (const Listed list : lists) read_list(list);
        for (const Feature feature : all_features) read_feature(feature);
        if (!options_->only_syntax) {
            check_listed(growing_->mesh, *options_, reader_.path(), *this, true);
        }
    }

private:
    void read_points() {
        const std::uint64_t count = layout_.lists.vertices.count;
        const auto [first, rows] = share_of_rows(count, growing_->group());
        growing_->expect_points(count, 0, true, rows);
        for (std::uint64_t done = 0; done < rows;) {
            const auto some = std::min<std::uint64_t>(rows - done, growing_->room_for_points());
            rows_.append_points(first + done, some, growing_->mesh);
            growing_->point_complete();
            done += some;
        }
        growing_->points_complete();
    }

    void read_list(Listed list) {
        const MeshbSection& section = rows_.section(list);
        if (!section.is_there()) return;
        switch (list) {
            case Listed::cells: return read_entities(cell_kind, section.count);
            case Listed::facets: return read_entities(facet_kind, section.count);
            case Listed::edges: return read_entities(edge_kind, section.count);
        }
    }

    template <class I, std::size_t N>
    void read_entities(const EntityKind<I, N>& kind, std::uint64_t count) {
        const auto [first, rows] = share_of_rows(count, growing_->group());
        growing_->expect(kind, count, true, rows);
        for (std::uint64_t done = 0; done < rows;) {
            const auto some = std::min<std::uint64_t>(rows - done, growing_->room_for(kind));
            rows_.append(kind, first + done, some, growing_->mesh);
            growing_->entity_complete(kind);
            done += some;
        }
        growing_->all_complete(kind);
    }

    void read_feature(Feature feature) {
        constexpr std::uint64_t at_once = 16384;
        const std::uint64_t count = layout_.lists.features[feature].count;
        const auto [first, rows] = share_of_rows(count, growing_->group());
        growing_->expect_numbers(feature, count, rows);
        std::vector<std::uint64_t>& numbers = growing_->mesh.features[feature];
        for (std::uint64_t done = 0; done < rows; done += at_once) {
            rows_.append_numbers(feature, first + done, std::min(rows - done, at_once), numbers);
            if (growing_->is_streaming()) numbers.clear();
        }
    }

    [[noreturn]] void fail_entry(Listed list, std::uint64_t entry,
                                 std::string_view what) const override {
        rows_.fail_entry(list, entry, what);
    }
    [[nodiscard]] LineOf lines_of(Listed) const override {
        return [](std::uint64_t) { return std::nullopt; };
    }

    ByteReader reader_;
    MeshbLayout layout_;
    MeshbRows rows_;
    const ReadOptions* options_;
    GrowingMesh* growing_;
};

}  // namespace

void read_meshb(const std::filesystem::path& path, const ReadOptions& options,
                GrowingMesh& growing) {
    MeshbReader(path, options, growing).read();
}

}  // namespace octetra
