#include "files/checkpoint/table.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/format.h>

#include <octetra/core/check_group_names.hpp>
#include <octetra/core/error.hpp>

namespace octetra {
namespace {

constexpr std::uint64_t point_markers = 1;
constexpr std::uint64_t regions = 2;
constexpr std::uint64_t facet_markers = 4;
constexpr std::uint64_t edge_markers = 8;
constexpr std::uint64_t group_names = 16;
constexpr std::uint64_t features = 32;
constexpr std::uint64_t state = 64;
constexpr std::uint64_t regular_closure = 128;

std::uint64_t flags_of(const CheckpointFacts& facts) {
    return (facts.has_point_markers ? point_markers : 0U) | (facts.has_regions ? regions : 0U) |
           (facts.has_facet_markers ? facet_markers : 0U) |
           (facts.has_edge_markers ? edge_markers : 0U) |
           (facts.group_names.empty() ? 0U : group_names) |
           (has_any(facts.features) ? features : 0U) | (facts.state ? state : 0U) |
           (facts.closure == Closure::regular ? regular_closure : 0U);
}

void put(std::vector<std::byte>& bytes, const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
}
void put(std::vector<std::byte>& bytes, std::uint64_t number) {
    put(bytes, &number, sizeof number);
}

/// The part of a table that has not been parsed yet.
class Table {
public:
    Table(const std::filesystem::path& path, std::span<const std::byte> bytes)
        : path_(&path), rest_(bytes) {}

    std::uint64_t number() {
        std::uint64_t value = 0;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::uint64_t number_to(std::uint64_t most, std::string_view what) {
        const std::uint64_t value = number();
        if (value > most) fail(fmt::format("{} {}; at most {} allowed", value, what, most));
        return value;
    }
    /// Reads the number of items that follow, each of which takes at least this many bytes.
    std::size_t count(std::size_t bytes_each, std::string_view what) {
        return static_cast<std::size_t>(number_to(rest_.size() / bytes_each, what));
    }
    std::string text() {
        const auto bytes = take(count(1, "bytes of a name"));
        std::string text(bytes.size(), '\0');
        std::memcpy(text.data(), bytes.data(), bytes.size());
        return text;
    }
    [[nodiscard]] std::size_t size() const { return rest_.size(); }

    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(
            fmt::format("{}: the table of this checkpoint is wrong: {}", path_->native(), what));
    }

private:
    std::span<const std::byte> take(std::size_t size) {
        if (rest_.size() < size) fail("it is too short");
        const auto bytes = rest_.first(size);
        rest_ = rest_.subspan(size);
        return bytes;
    }

    const std::filesystem::path* path_;
    std::span<const std::byte> rest_;
};

/// More than any file can hold; prevents overflow in computations with counts.
constexpr std::uint64_t most_entities = std::uint64_t{1} << 56U;

void put_group_names(std::vector<std::byte>& bytes, const std::vector<GroupName>& names) {
    if (names.empty()) return;  // compatible with files of earlier versions
    put(bytes, names.size());
    for (const GroupName& group : names) {
        put(bytes, static_cast<std::uint64_t>(group.dimension));
        put(bytes, static_cast<std::uint64_t>(std::int64_t{group.tag}));
        put(bytes, group.name.size());
        put(bytes, group.name.data(), group.name.size());
    }
}

void read_group_names(Table& table, std::vector<GroupName>& names) {
    names.resize(table.count(3 * sizeof(std::uint64_t), "names of groups"));
    for (GroupName& group : names) {
        group.dimension = static_cast<std::int32_t>(table.number_to(3, "as a dimension"));
        const auto tag = static_cast<std::int64_t>(table.number());
        if (!std::in_range<Marker>(tag)) table.fail("the tag of a group is out of range");
        group.tag = static_cast<Marker>(tag);
        group.name = table.text();
    }
    if (const std::string wrong = wrong_in(names); !wrong.empty()) table.fail(wrong);
}

void put_state(std::vector<std::byte>& bytes, const SavedState& saved) {
    put(bytes, &saved.time, sizeof saved.time);
    put(bytes, static_cast<std::uint64_t>(saved.step));
    put(bytes, saved.text.size());
    put(bytes, saved.text.data(), saved.text.size());
}

SavedState read_state(Table& table) {
    SavedState saved;
    saved.time = std::bit_cast<double>(table.number());
    saved.step = static_cast<std::int64_t>(table.number());
    saved.text = table.text();
    if (const std::string wrong = wrong_in(saved); !wrong.empty()) table.fail(wrong);
    return saved;
}

void read_facts(Table& table, CheckpointFacts& facts) {
    for (std::uint64_t* count : {&facts.vertices, &facts.cells, &facts.facets, &facts.edges,
                                 &facts.vertices_now, &facts.cells_now}) {
        *count = table.number_to(most_entities, "entities of a kind");
    }
    facts.attributes_per_point = table.number_to(1U << 20U, "attributes of a vertex");
    facts.index_base = static_cast<std::uint32_t>(table.number_to(1, "as the index base"));
    const std::uint64_t flags = table.number_to(255, "as flags");
    facts.has_point_markers = (flags & point_markers) != 0;
    facts.has_regions = (flags & regions) != 0;
    facts.has_facet_markers = (flags & facet_markers) != 0;
    facts.has_edge_markers = (flags & edge_markers) != 0;
    if ((flags & regular_closure) != 0) facts.closure = Closure::regular;
    facts.steps.resize(table.count(3 * sizeof(std::uint64_t), "steps"));
    for (StepFacts& step : facts.steps) {
        step.cells_before = table.number();
        step.cells_cut = table.number();
        step.bytes = table.number();
    }
    facts.fields.resize(table.count(4 * sizeof(std::uint64_t), "fields"));
    for (FieldFacts& field : facts.fields) {
        field.on = static_cast<FieldOn>(table.number_to(1, "as where a field is"));
        field.type = static_cast<FieldType>(table.number_to(3, "as the type of a field"));
        field.components = table.number_to(1U << 20U, "components of a field");
        field.name = table.text();
        if (!is_name(field.name)) table.fail("the name of a field is not printable text");
    }
    if ((flags & group_names) != 0) read_group_names(table, facts.group_names);
    if ((flags & features) != 0) {
        for (const Feature f : all_features) {
            facts.features[f] = table.number_to(entities_with(f, facts), "entities with a feature");
        }
    }
    if ((flags & state) != 0) facts.state = read_state(table);
}

}  // namespace

std::uint64_t entities_with(Feature feature, const CheckpointFacts& facts) {
    return std::array{facts.vertices, facts.edges, facts.facets, facts.cells}.at(
        dimension_of(feature));
}

std::uint64_t hash_of(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::size_t section_count(const CheckpointFacts& facts) {
    return first_field + facts.fields.size();
}

std::size_t byte_of_step(std::size_t step) {
    constexpr std::size_t numbers_before = 10;
    constexpr std::size_t numbers_of_step = 3;
    return (numbers_before + numbers_of_step * step) * sizeof(std::uint64_t);
}

std::vector<std::byte> table_of(const CheckpointFacts& facts,
                                const std::vector<BlockEntry>& blocks) {
    std::vector<std::byte> bytes;
    for (const std::uint64_t number :
         {facts.vertices, facts.cells, facts.facets, facts.edges, facts.vertices_now,
          facts.cells_now, std::uint64_t{facts.attributes_per_point},
          std::uint64_t{facts.index_base}, flags_of(facts)}) {
        put(bytes, number);
    }
    put(bytes, facts.steps.size());
    for (const StepFacts& step : facts.steps) {
        put(bytes, step.cells_before);
        put(bytes, step.cells_cut);
        put(bytes, step.bytes);
    }
    put(bytes, facts.fields.size());
    for (const FieldFacts& field : facts.fields) {
        put(bytes, static_cast<std::uint64_t>(field.on));
        put(bytes, static_cast<std::uint64_t>(field.type));
        put(bytes, field.components);
        put(bytes, field.name.size());
        put(bytes, field.name.data(), field.name.size());
    }
    put_group_names(bytes, facts.group_names);
    if (has_any(facts.features)) {  // otherwise compatible with earlier versions
        for (const std::uint64_t count : facts.features) put(bytes, count);
    }
    if (facts.state) put_state(bytes, *facts.state);
    put(bytes, blocks.data(), blocks.size() * sizeof(BlockEntry));
    return bytes;
}

void read_table(const std::filesystem::path& path, std::span<const std::byte> table_bytes,
                std::uint64_t table_begin, CheckpointFacts& facts,
                std::vector<BlockEntry>& blocks) {
    Table table(path, table_bytes);
    read_facts(table, facts);
    std::uint64_t expected = 0;
    for (std::size_t s = 0; s < section_count(facts); ++s) {
        expected += shape_of(facts, static_cast<Section>(s)).blocks();
    }
    if (table.size() % sizeof(BlockEntry) != 0 || table.size() / sizeof(BlockEntry) != expected) {
        table.fail(fmt::format("its contents need {} blocks, but it lists {} bytes of them",
                               expected, table.size()));
    }
    blocks.resize(expected);
    std::uint64_t end = sizeof(CheckpointHeader);
    std::size_t next = 0;
    for (std::size_t s = 0; s < section_count(facts); ++s) {
        const SectionShape shape = shape_of(facts, static_cast<Section>(s));
        for (std::uint64_t b = 0; b < shape.blocks(); ++b, ++next) {
            const std::uint64_t size = table.number();
            blocks[next] = {size, table.number()};
            const std::uint64_t fixed = shape.length_of(b) * shape.entity_size;
            if (size > table_begin - end || (shape.entity_size > 0 && size != fixed)) {
                table.fail(fmt::format("{} bytes for block {} of the {}", size, b,
                                       name_of(facts, static_cast<Section>(s))));
            }
            end += size;
        }
    }
    if (end != table_begin) table.fail("its blocks do not fill the file");
}

}  // namespace octetra
