#include "files/gmsh/node_tags.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace octetra::gmsh {
namespace {

struct TagsFound {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t most = 0;
    std::uint64_t count = 0;
    std::uint64_t are_consecutive = 1;
};

TagsFound facts_of_tags(const std::vector<std::uint64_t>& tags) {
    TagsFound found;
    found.count = tags.size();
    for (std::size_t k = 0; k < tags.size(); ++k) {
        found.least = std::min(found.least, tags[k]);
        found.most = std::max(found.most, tags[k]);
        if (tags[k] != tags[0] + k) found.are_consecutive = 0;
    }
    return found;
}

/// Returns the facts about the tags of all processes.
TagsFound merged(const std::vector<TagsFound>& found) {
    TagsFound all;
    for (const TagsFound& one : found) {
        if (one.count == 0) continue;
        if (one.are_consecutive == 0 || (all.count > 0 && one.least != all.most + 1)) {
            all.are_consecutive = 0;
        }
        all.least = std::min(all.least, one.least);
        all.most = std::max(all.most, one.most);
        all.count += one.count;
    }
    return all;
}

using Word = std::uint32_t;

Word word_at(const ProcessGroup::Bytes& bytes, std::size_t k) {
    Word word;
    std::memcpy(&word, bytes.data() + k * sizeof word, sizeof word);
    return word;
}
void put_word(ProcessGroup::Bytes& bytes, std::size_t k, Word word) {
    std::memcpy(bytes.data() + k * sizeof word, &word, sizeof word);
}

/// Buffers of words to each process.
struct Outboxes {
    std::vector<ProcessGroup::Bytes> bytes;
    std::vector<std::size_t> counts;

    explicit Outboxes(std::size_t processes) : bytes(processes), counts(processes, 0) {}

    /// To be called after all words were counted, before they are put.
    void make_room() {
        for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k].resize(counts[k] * sizeof(Word));
        std::ranges::fill(counts, 0);
    }
    void put(std::size_t process, Word word) { put_word(bytes[process], counts[process]++, word); }
};

}  // namespace

std::optional<NodeTags> NodeTags::make(CollectiveStatus& status,
                                       const std::vector<std::uint64_t>& tags,
                                       std::uint64_t first) {
    const auto found = of_each(status, facts_of_tags(tags));
    if (!status.all_succeeded()) return std::nullopt;
    const TagsFound all = merged(found);
    if (all.count == 0) return NodeTags(0, 0);
    if (all.most - all.least >= VertexIndex::limit) return std::nullopt;
    NodeTags result(all.least, all.most - all.least + 1);
    result.are_consecutive_ = all.are_consecutive == 1;
    if (result.are_consecutive_) return result;
    result.processes_ = static_cast<std::uint32_t>(status.group().size());
    constexpr std::uint64_t gaps = 4;  // the same limit as for tables of NodeNumbers
    result.is_dense_ = result.tag_span_ < gaps * all.count;
    result.block_ = static_cast<Offset>((result.tag_span_ - 1) / result.processes_ + 1);
    if (!result.send_to_owners(status, tags, first)) return std::nullopt;
    return result;
}

bool NodeTags::send_to_owners(CollectiveStatus& status, const std::vector<std::uint64_t>& tags,
                              std::uint64_t first) {
    Outboxes out(processes_);
    status.attempt([&] {
        const auto offset_of = [&](std::size_t k) { return static_cast<Offset>(tags[k] - least_); };
        for (std::size_t k = 0; k < tags.size(); ++k) out.counts[owner_of(offset_of(k))] += 2;
        out.make_room();
        for (std::size_t k = 0; k < tags.size(); ++k) {
            const std::size_t owner = owner_of(offset_of(k));
            out.put(owner, offset_of(k));
            out.put(owner, static_cast<Word>(first + k));
        }
    });
    if (!status.all_succeeded()) return false;
    status.attempt([&] {
        for (const ProcessGroup::Bytes& pairs : status.group().exchange(std::move(out.bytes))) {
            for (std::size_t k = 0; k < pairs.size() / sizeof(Word); k += 2) {
                tags_here_.add(word_at(pairs, k));
                numbers_.push_back(word_at(pairs, k + 1));
            }
        }
        if (tags_here_.complete()) throw std::runtime_error("a tag is listed twice");
    });
    return status.all_succeeded();
}

/// Replaces offsets by vertex numbers.
void NodeTags::answer(ProcessGroup::Bytes& offsets) const {
    for (std::size_t k = 0; k < offsets.size() / sizeof(Word); ++k) {
        const VertexIndex here = tags_here_.find(word_at(offsets, k));
        if (here.is_none()) throw std::runtime_error("there is no such node");
        put_word(offsets, k, numbers_[here.value()]);
    }
}

template <class I, std::size_t N>
bool NodeTags::number(CollectiveStatus& status,
                      IndexVector<I, std::array<VertexIndex, N>>& list) const {
    if (are_consecutive_) return true;
    constexpr std::size_t at_once = std::size_t{1} << 18U;  // limits the size of messages
    const auto counts = of_each(status, std::uint64_t{list.size()});
    if (!status.all_succeeded()) return false;
    const std::uint64_t most = *std::ranges::max_element(counts);
    for (std::uint64_t done = 0; done < most; done += at_once) {
        const auto left = std::span(list).subspan(std::min<std::size_t>(done, list.size()));
        const auto rows = left.first(std::min(at_once, left.size()));
        Outboxes out(processes_);
        std::vector<ProcessGroup::Bytes> received;
        status.attempt([&] {
            for (const auto& row : rows) {
                for (const VertexIndex v : row) ++out.counts[owner_of(v.value())];
            }
            out.make_room();
            for (const auto& row : rows) {
                for (const VertexIndex v : row) out.put(owner_of(v.value()), v.value());
            }
        });
        if (!status.all_succeeded()) return false;
        status.attempt([&] {
            received = status.group().exchange(std::move(out.bytes));
            for (ProcessGroup::Bytes& offsets : received) answer(offsets);
        });
        if (!status.all_succeeded()) return false;
        status.attempt([&] {
            received = status.group().exchange(std::move(received));
            std::vector<std::size_t> taken(processes_, 0);
            for (auto& row : rows) {
                for (VertexIndex& v : row) {
                    const std::size_t owner = owner_of(v.value());
                    v = VertexIndex{word_at(received[owner], taken[owner]++)};
                }
            }
        });
        if (!status.all_succeeded()) return false;
    }
    return true;
}

template bool NodeTags::number(CollectiveStatus&, IndexVector<CellIndex, CellVertices>&) const;
template bool NodeTags::number(CollectiveStatus&, IndexVector<FacetIndex, FacetVertices>&) const;
template bool NodeTags::number(CollectiveStatus&, IndexVector<EdgeIndex, EdgeVertices>&) const;

}  // namespace octetra::gmsh
