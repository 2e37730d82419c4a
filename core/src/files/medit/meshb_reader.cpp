#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "files/input/byte_reader.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/medit/entry_positions.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/meshb_layout.hpp"
#include "files/medit/meshb_rows.hpp"

namespace octetra {
namespace {

/// Reads the sections in file order, except that vertices are read first, because entities that
/// refer to them are checked as they are read.
class MeshbReader final : private EntryPositions {
public:
    /// If `sink` is null, reads the mesh into memory.
    MeshbReader(const std::filesystem::path& path, const ReadOptions& options, MeshSink* sink)
        : reader_(path),
          layout_(read_meshb_layout(reader_)),
          rows_(reader_, layout_.lists),
          options_(&options),
          growing_(sink, true) {
        growing_.mesh.index_base = 1;
    }

    /// Returns the mesh unless it is streamed.
    Mesh read() {
        for (const std::string& note :
             notes_on(reader_.path(), layout_.lists.has_end, layout_.skipped)) {
            options_->note(note);
        }
        read_points();
        std::array<Listed, 3> lists{Listed::cells, Listed::facets, Listed::edges};
        std::ranges::sort(lists, {}, [&](Listed list) { return rows_.section(list).keyword_at; });
        for (const Listed list : lists) read_list(list);
        for (const Feature feature : all_features) read_feature(feature);
        if (!growing_.is_streaming()) {
            check_listed(growing_.mesh, *options_, reader_.path(), *this, true);
        }
        growing_.finish();
        return std::move(growing_.mesh);
    }

private:
    void read_points() {
        const std::uint64_t count = layout_.lists.vertices.count;
        growing_.expect_points(count, 0, true);
        for (std::uint64_t done = 0; done < count;) {
            const auto some = std::min<std::uint64_t>(count - done, growing_.room_for_points());
            rows_.append_points(done, some, growing_.mesh);
            growing_.point_complete();
            done += some;
        }
        growing_.points_complete();
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
        growing_.expect(kind, count, true);
        for (std::uint64_t done = 0; done < count;) {
            const auto some = std::min<std::uint64_t>(count - done, growing_.room_for(kind));
            rows_.append(kind, done, some, growing_.mesh);
            growing_.entity_complete(kind);
            done += some;
        }
        growing_.all_complete(kind);
    }

    void read_feature(Feature feature) {
        constexpr std::uint64_t at_once = 16384;
        const std::uint64_t count = layout_.lists.features[feature].count;
        std::vector<std::uint64_t>& numbers = growing_.mesh.features[feature];
        for (std::uint64_t done = 0; done < count; done += at_once) {
            rows_.append_numbers(feature, done, std::min(count - done, at_once), numbers);
            if (growing_.is_streaming()) numbers.clear();
        }
        sort_unique(numbers);
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
    GrowingMesh growing_;
};

}  // namespace

Mesh read_meshb(const std::filesystem::path& path, const ReadOptions& options) {
    return MeshbReader(path, options, nullptr).read();
}

void stream_meshb(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options) {
    (void)MeshbReader(path, options, &sink).read();
}

}  // namespace octetra
