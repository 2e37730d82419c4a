#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/sol_fields.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "files/gmsh/intake/node_numbers.hpp"
#include "files/gmsh/reading/binary_input.hpp"
#include "files/gmsh/reading/entity_groups.hpp"
#include "files/gmsh/reading/format_line.hpp"
#include "files/gmsh/reading/sections_2.hpp"
#include "files/gmsh/reading/sections_4.hpp"
#include "files/gmsh/reading/text_input.hpp"
#include "files/input/byte_reader.hpp"
#include "files/input/line_reader.hpp"

/// The sections $NodeData and $ElementData. Their values refer to the tags of nodes and elements,
/// which are read first.
namespace octetra {
namespace {

using namespace gmsh;

template <class Input>
class DataReader {
public:
    DataReader(Input& in, bool is_4, const EntityCounts& expected)
        : in_(&in), is_4_(is_4), expected_(expected) {}

    SolFields read() {
        while (true) {
            const std::string name = in_->section();
            if (name.empty()) return std::move(fields_);
            if (read_section(name)) {
                in_->end_section(name);
            } else {
                in_->skip_section(name);
            }
        }
    }

private:
    /// Returns false for a section to be skipped.
    bool read_section(const std::string& name) {
        if (name == "Nodes") {
            is_4_ ? read_nodes_4() : read_nodes_2();
            return complete(nodes_, "node");
        }
        if (name == "Elements") {
            if constexpr (Input::has_lines) {
                is_4_ ? read_elements_4() : read_element_lines_2();
            } else {
                is_4_ ? read_elements_4() : read_element_blocks_2();
            }
            return complete(cells_, "element");
        }
        if (name == "NodeData") {
            return read_data(FieldOn::vertices, nodes_, expected_.vertices, "node");
        }
        if (name == "ElementData") {
            return read_data(FieldOn::cells, cells_, expected_.cells, "tetrahedron");
        }
        return false;
    }

    bool complete(NodeNumbers& numbers, std::string_view what) {
        if (const auto repeated = numbers.complete()) {
            in_->fail(fmt::format("a second {} {}", what, repeated->tag));
        }
        return true;
    }

    void read_nodes_2() {
        const std::uint64_t count = read_node_count_2(*in_);
        for (std::uint64_t i = 0; i < count; ++i) {
            nodes_.add(in_->number32("a node's number"));
            (void)in_->point();
        }
    }
    void read_nodes_4() {
        const SectionTotals totals = read_node_totals_4(*in_);
        std::uint64_t left = totals.entries;
        for (std::uint64_t b = 0; b < *totals.blocks; ++b) {
            const NodeBlock block = read_node_block_4(*in_, left);
            left -= block.count;
            for (std::uint64_t i = 0; i < block.count; ++i) {
                nodes_.add(in_->number64("a node's tag"));
            }
            for (std::uint64_t i = 0; i < block.count; ++i) {
                (void)in_->point();
                for (std::size_t k = 0; k < block.parameters; ++k) {
                    in_->skip_real("a parameter of a node");
                }
            }
        }
    }

    void take_element(std::uint64_t type, std::uint64_t tag) {
        if (type == tetrahedron_type) cells_.add(tag);
    }
    void read_elements_4() {
        const SectionTotals totals = read_element_totals_4(*in_);
        const EntityGroups no_groups;
        std::uint64_t left = totals.entries;
        for (std::uint64_t b = 0; b < *totals.blocks; ++b) {
            const ElementBlock block = read_element_block_4(*in_, left, no_groups);
            left -= block.count;
            for (std::uint64_t i = 0; i < block.count; ++i) {
                take_element(block.type, in_->number64("an element's tag"));
                for (std::uint32_t k = 0; k < block.known.nodes; ++k) {
                    (void)in_->number64("a node of an element");
                }
            }
        }
    }
    [[nodiscard]] std::uint32_t nodes_of(std::uint64_t type) const {
        const auto known = element_type(type);
        if (!known) in_->fail(refusal_of_type(type));
        return known->nodes;
    }
    void read_element_lines_2() {
        const std::uint64_t count = read_element_count_2(*in_);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t tag = in_->number32("an element's number");
            const std::uint64_t type = in_->number32("an element's type");
            const std::uint64_t tags = in_->number32("the number of tags");
            take_element(type, tag);
            in_->check_count(tags, 1, sizeof(std::int32_t), "tags");
            for (std::uint64_t k = 0; k < tags; ++k) (void)in_->integer("a tag");
            const std::uint32_t nodes = nodes_of(type);
            for (std::uint32_t k = 0; k < nodes; ++k) (void)in_->number32("a node of an element");
        }
    }
    void read_element_blocks_2() {
        const std::uint64_t count = read_element_count_2(*in_);
        for (std::uint64_t left = count; left > 0;) {
            const ElementBlock2 block = read_element_block_2(*in_, left);
            left -= block.count;
            const std::uint32_t nodes = nodes_of(block.type);
            in_->check_count(block.tags, 1, sizeof(std::int32_t), "tags");
            for (std::uint64_t i = 0; i < block.count; ++i) {
                take_element(block.type, in_->number32("an element's number"));
                for (std::uint64_t k = 0; k < block.tags + nodes; ++k) {
                    (void)in_->integer("a node of an element");
                }
            }
        }
    }

    /// Reads a line with a whole number.
    std::int64_t take_whole_number(std::string_view what) {
        const std::string line(in_->line(what));
        const std::size_t begin = line.find_first_not_of(" \t");
        const std::size_t end = line.find_last_not_of(" \t\r") + 1;
        std::int64_t number = 0;
        if (begin < end) {
            const auto [stop, error] =
                std::from_chars(line.data() + begin, line.data() + end, number);
            if (error == std::errc() && stop == line.data() + end) return number;
        }
        in_->fail(fmt::format("{} should be a whole number, not {}", what, shown(line)));
    }
    std::uint64_t take_number_of(std::string_view what) {
        const std::string name = fmt::format("the number of {}", what);
        const std::int64_t number = take_whole_number(name);
        if (number < 0) in_->fail(fmt::format("{} is negative: {}", name, number));
        return static_cast<std::uint64_t>(number);
    }

    struct DataHead {
        std::uint64_t components = 0;
        std::uint64_t count = 0;
    };
    /// Reads the tags of a section: the name of the view, its time, and the whole numbers of a time
    /// step, the components, the values and possibly a partition.
    DataHead take_head() {
        const std::uint64_t names = take_number_of("string tags");
        for (std::uint64_t k = 0; k < names; ++k) (void)in_->line("a string tag");
        const std::uint64_t reals = take_number_of("real tags");
        for (std::uint64_t k = 0; k < reals; ++k) (void)in_->line("a real tag");
        const std::uint64_t numbers = take_number_of("integer tags");
        if (numbers < 3) in_->fail(fmt::format("{} integer tags, where 3 are needed", numbers));
        DataHead head;
        (void)take_whole_number("a time step");
        head.components = take_number_of("components");
        head.count = take_number_of("values");
        for (std::uint64_t k = 3; k < numbers; ++k) (void)take_whole_number("an integer tag");
        if (head.components != 1 && head.components != 3 && head.components != 9) {
            in_->fail(fmt::format("values have 1, 3 or 9 components, not {}", head.components));
        }
        return head;
    }

    bool read_data(FieldOn on, const NodeNumbers& numbers, std::uint64_t expected,
                   std::string_view what) {
        const DataHead head = take_head();
        if (numbers.size() != expected || head.count != expected) {
            in_->fail(
                fmt::format("{} values and {} tags of this kind of entity, but the mesh has "
                            "{}",
                            head.count, numbers.size(), expected));
        }
        in_->check_count(head.count, 1 + head.components,
                         sizeof(std::int32_t) + head.components * sizeof(double), "values");
        FieldRows rows{.on = on, .components = {head.components}, .count = head.count};
        rows.values.resize(head.count * head.components);
        std::vector<std::uint8_t> has_value(head.count, 0);
        for (std::uint64_t i = 0; i < head.count; ++i) {
            const std::uint64_t place = in_->begin_row("a value");
            const std::uint64_t tag = in_->number32("a tag");
            const VertexIndex entity = numbers.find(tag);
            if (entity == VertexIndex::none()) {
                in_->fail_at(fmt::format("there is no {} {}", what, tag), place);
            }
            if (std::exchange(has_value[entity.value()], std::uint8_t{1}) != 0) {
                in_->fail_at(fmt::format("a second value of {} {}", what, tag), place);
            }
            for (std::size_t k = 0; k < head.components; ++k) {
                rows.values[entity.value() * head.components + k] = in_->real("a value");
            }
        }
        fields_.lists.push_back(std::move(rows));
        return true;
    }

    Input* in_;
    bool is_4_;
    EntityCounts expected_;
    NodeNumbers nodes_;
    NodeNumbers cells_;
    SolFields fields_;
};

}  // namespace

SolFields read_msh_data(const std::filesystem::path& path, const EntityCounts& expected) {
    const StandardArithmetic standard;
    LineReader lines(path);
    const FormatLine format = read_format_line(lines);
    const auto read = [&](auto&& in) {
        in.end_section("MeshFormat");
        return DataReader(in, format.is_4, expected).read();
    };
    if (!format.is_binary) return read(TextInput(lines));
    ByteReader bytes(path);
    bytes.seek(lines.next_position());
    find_byte_order(bytes);
    return read(BinaryInput(bytes));
}

}  // namespace octetra
