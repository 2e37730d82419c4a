#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/mesh_formats.hpp>

#include "files/checkpoint/table.hpp"
#include "files/input/input_file.hpp"

namespace octetra {
namespace {

[[noreturn]] void refuse_as_checkpoint(const InputFile& file, std::string_view reason) {
    const char* const hint =
        is_checkpoint(file.path())
            ? ""
            : "; octetra.read(), in C++ AdaptiveMesh::read(), reads meshes of other formats";
    file.fail(fmt::format("is not a checkpoint: {}{}", reason, hint));
}

CheckpointTrailer read_trailer(const InputFile& file) {
    CheckpointHeader header;
    CheckpointTrailer trailer;
    if (file.size() < sizeof header) {
        refuse_as_checkpoint(file, "the file is too short");
    }
    file.read(0, &header, sizeof header);
    if (header.magic != checkpoint_magic) {
        refuse_as_checkpoint(file, "it does not begin with the signature");
    }
    if (header.byte_order != CheckpointHeader{}.byte_order) {
        file.fail("the byte order differs from that of this machine");
    }
    if (header.version != CheckpointHeader{}.version) {
        file.fail(fmt::format("is a checkpoint of version {}; this program reads version {}",
                              header.version, CheckpointHeader{}.version));
    }
    if (file.size() < sizeof header + sizeof trailer) {
        file.fail("the checkpoint is cut off; it has no table");
    }
    const std::uint64_t table_end = file.size() - sizeof trailer;
    file.read(table_end, &trailer, sizeof trailer);
    if (trailer.magic != checkpoint_magic) {
        file.fail(
            "the checkpoint has no valid end: it was cut off or modified; write or copy it again");
    }
    if (trailer.table_begin < sizeof header || trailer.table_begin > table_end ||
        trailer.table_size != table_end - trailer.table_begin) {
        file.fail(
            "the checkpoint's trailer is invalid: it states a wrong position or size of the table");
    }
    return trailer;
}

}  // namespace

struct CheckpointReader::Parts {
    InputFile file;
    CheckpointFacts facts;
    std::uint64_t table_begin = 0;
    std::vector<BlockEntry> blocks;
    std::vector<std::uint64_t> begin;              ///< position of each block
    std::vector<std::size_t> first_of_section{0};  ///< index of its first block

    explicit Parts(const std::filesystem::path& path) : file(path) {
        const CheckpointTrailer trailer = read_trailer(file);
        table_begin = trailer.table_begin;
        const auto table = file.read(trailer.table_begin, trailer.table_size);
        if (hash_of(table) != trailer.table_hash) {
            file.fail("the checkpoint is damaged: the hash of its table does not match");
        }
        read_table(path, table, trailer.table_begin, facts, blocks);
        std::uint64_t position = sizeof(CheckpointHeader);
        for (const BlockEntry& block : blocks) {
            begin.push_back(position);
            position += block.size;
        }
        for (std::size_t s = 0; s < section_count(facts); ++s) {
            first_of_section.push_back(first_of_section.back() +
                                       shape_of(facts, static_cast<Section>(s)).blocks());
        }
    }
};

CheckpointReader::CheckpointReader(const std::filesystem::path& path)
    : parts_(std::make_unique<Parts>(path)) {}
CheckpointReader::~CheckpointReader() = default;

const CheckpointFacts& CheckpointReader::facts() const { return parts_->facts; }

void CheckpointReader::fail(Section section, std::uint64_t block, const std::string& what) const {
    parts_->file.fail(
        fmt::format("block {} of the {}: {}", block, name_of(facts(), section), what));
}

std::vector<std::byte> CheckpointReader::read_block(Section section, std::uint64_t block) const {
    const std::size_t number = parts_->first_of_section[static_cast<std::size_t>(section)] + block;
    const BlockEntry& entry = parts_->blocks[number];
    auto bytes = parts_->file.read(parts_->begin[number], entry.size);
    const std::uint64_t hash = hash_of(bytes);
    if (hash != entry.hash) {
        fail(section, block,
             fmt::format("damaged: its hash is {:016x}, and should be {:016x}", hash, entry.hash));
    }
    return bytes;
}

std::vector<std::byte> CheckpointReader::read_bytes(Section section, std::uint64_t begin,
                                                    std::uint64_t end) const {
    const SectionShape shape = shape_of(facts(), section);
    std::vector<std::byte> bytes;
    if (shape.count == 0) return bytes;
    bytes.reserve((end - begin) * shape.entity_size);
    for (std::uint64_t i = begin; i < end;) {
        const std::uint64_t block = i / block_length;
        const std::uint64_t first = block * block_length;
        const std::uint64_t stop = std::min(end, first + shape.length_of(block));
        const auto all = read_block(section, block);
        const auto wanted =
            std::span(all).subspan((i - first) * shape.entity_size, (stop - i) * shape.entity_size);
        bytes.insert(bytes.end(), wanted.begin(), wanted.end());
        i = stop;
    }
    return bytes;
}

std::vector<std::uint64_t> CheckpointReader::read_numbers(Section section, std::uint64_t begin,
                                                          std::uint64_t end) const {
    std::vector<std::uint64_t> numbers;
    if (vertex_number_size(facts()) == sizeof(std::uint64_t)) {
        numbers = read<std::uint64_t>(section, begin, end);
    } else {
        const auto narrow = read<std::uint32_t>(section, begin, end);
        numbers.assign(narrow.begin(), narrow.end());
    }
    const std::uint64_t count = facts().vertices;
    const auto wrong =
        std::ranges::find_if(numbers, [&](std::uint64_t number) { return number >= count; });
    if (wrong != numbers.end()) {
        const auto per_entity =
            shape_of(facts(), section).entity_size / vertex_number_size(facts());
        const auto place = static_cast<std::uint64_t>(wrong - numbers.begin()) / per_entity;
        fail(
            section, (begin + place) / block_length,
            fmt::format("entity {} has vertex {}, but there are {}", begin + place, *wrong, count));
    }
    return numbers;
}

std::vector<std::uint64_t> CheckpointReader::read_features(Feature feature, std::uint64_t begin,
                                                           std::uint64_t end) const {
    const Section section = feature_section(feature);
    auto numbers = read<std::uint64_t>(section, begin, end);
    const std::uint64_t count = entities_with(feature, facts());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] < count && (i == 0 || numbers[i - 1] < numbers[i])) continue;
        fail(section, (begin + i) / block_length,
             fmt::format("found {}; numbers must ascend and be less than {}", numbers[i], count));
    }
    return numbers;
}

std::vector<Point> CheckpointReader::read_points(std::uint64_t begin, std::uint64_t end) const {
    std::vector<Point> points = read<Point>(Section::points, begin, end);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto fits = [](double x) { return std::abs(x) < coordinate_limit; };
        if (fits(points[i].x) && fits(points[i].y) && fits(points[i].z)) continue;  // and finite
        fail(Section::points, (begin + i) / block_length,
             fmt::format("vertex {} has a coordinate that is not finite, or too large", begin + i));
    }
    return points;
}

std::vector<std::vector<CutRun>> CheckpointReader::read_cuts(std::uint64_t block,
                                                             std::vector<StepFacts>& found) const {
    const auto raw = read_block(Section::cuts, block);
    std::span<const std::uint8_t> rest(reinterpret_cast<const std::uint8_t*>(raw.data()),
                                       raw.size());
    const auto refuse = [&](std::size_t step) {
        fail(Section::cuts, block, fmt::format("the data of step {} are invalid", step + 1));
    };
    std::vector<std::vector<CutRun>> steps(facts().steps.size());
    std::uint64_t cells = shape_of(facts(), Section::cuts).length_of(block);
    found.resize(steps.size());
    for (std::size_t t = 0; t < steps.size(); ++t) {
        std::uint64_t size = 0;
        if (!take_number(rest, size) || size > rest.size()) refuse(t);
        found[t].cells_before += cells;
        found[t].bytes += size;
        if (size == 0) {
            steps[t].push_back({0, cells});
            continue;
        }
        std::uint64_t covered = 0;
        std::uint64_t made = 0;
        for (CutReader reader(rest.first(size)); !reader.at_end();) {
            const CutRun run = reader.next();
            if (run.count == 0 || run.count > cells - covered) refuse(t);
            covered += run.count;
            made += run.count * child_count_of(run.cut);
            if (run.cut != 0) found[t].cells_cut += run.count;
            steps[t].push_back(run);
        }
        if (covered != cells || made > facts().cells_now) refuse(t);
        rest = rest.subspan(size);
        cells = made;
    }
    if (!rest.empty()) fail(Section::cuts, block, "extra bytes after the data of the last step");
    return steps;
}

void CheckpointReader::check_steps(const std::vector<StepFacts>& found) const {
    for (std::size_t t = 0; t < found.size(); ++t) {
        const StepFacts& said = facts().steps[t];
        if (said == found[t]) continue;
        parts_->file.fail(fmt::format(
            "at byte {}: the table has {} cells before step {}, {} of them cut, in {} bytes; the "
            "cuts have {}, {} and {}",
            parts_->table_begin + byte_of_step(t), said.cells_before, t + 1, said.cells_cut,
            said.bytes, found[t].cells_before, found[t].cells_cut, found[t].bytes));
    }
}

CheckpointFacts read_checkpoint_facts(const std::filesystem::path& path) {
    return CheckpointReader(path).facts();
}

bool is_checkpoint(const std::filesystem::path& path) {
    return format_of(path) == Format::checkpoint;
}

}  // namespace octetra
