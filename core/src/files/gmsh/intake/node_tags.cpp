#include "files/gmsh/intake/node_tags.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>

#include "files/shares/gather.hpp"

namespace octetra::gmsh {
namespace {

struct TagsFound {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t most = 0;
    std::uint64_t count = 0;
    std::uint64_t are_consecutive = 1;
};

TagsFound facts_of_tags(const NodeNumbers& nodes) {
    TagsFound found;
    found.count = nodes.size();
    found.are_consecutive = nodes.are_consecutive() ? 1 : 0;
    for (std::uint64_t k = 0; k < nodes.size(); ++k) {
        found.least = std::min(found.least, nodes.tag(k));
        found.most = std::max(found.most, nodes.tag(k));
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

NodeTags::NodeTags(const ProcessGroup& group, const NodeNumbers& here)
    : group_(&group), processes_(static_cast<std::uint32_t>(group.size())) {
    const TagsFound all = merged(gather(group, facts_of_tags(here)));
    if (all.count == 0) return;
    if (all.most - all.least >= VertexIndex::limit) throw InputError("tags are far apart");
    least_ = all.least;
    tag_span_ = all.most - all.least + 1;
    are_consecutive_ = all.are_consecutive == 1;
    if (are_consecutive_) return;
    constexpr std::uint64_t gaps = 4;  // the same limit as for tables of NodeNumbers
    is_dense_ = tag_span_ < gaps * all.count;
    block_ = static_cast<Offset>((tag_span_ - 1) / processes_ + 1);
    send_to_owners(here);
}

void NodeTags::send_to_owners(const NodeNumbers& here) {
    const std::uint64_t first = group_->sum_before(here.size());
    Outboxes out(processes_);
    const auto offset_of = [&](std::uint64_t k) {
        return static_cast<Offset>(here.tag(k) - least_);
    };
    for (std::uint64_t k = 0; k < here.size(); ++k) out.counts[owner_of(offset_of(k))] += 2;
    out.make_room();
    for (std::uint64_t k = 0; k < here.size(); ++k) {
        const std::size_t owner = owner_of(offset_of(k));
        out.put(owner, offset_of(k));
        out.put(owner, static_cast<Word>(first + k));
    }
    for (const ProcessGroup::Bytes& pairs : group_->exchange(std::move(out.bytes))) {
        for (std::size_t k = 0; k < pairs.size() / sizeof(Word); k += 2) {
            tags_here_.add(word_at(pairs, k));
            numbers_.push_back(word_at(pairs, k + 1));
        }
    }
    if (tags_here_.complete()) throw InputError("a tag is listed twice");
}

/// Replaces offsets by vertex numbers.
void NodeTags::answer(ProcessGroup::Bytes& offsets) const {
    for (std::size_t k = 0; k < offsets.size() / sizeof(Word); ++k) {
        const VertexIndex here = tags_here_.find(word_at(offsets, k));
        if (here.is_none()) throw InputError("there is no such node");
        put_word(offsets, k, numbers_[here.value()]);
    }
}

template <class I, std::size_t N>
void NodeTags::number(IndexVector<I, std::array<VertexIndex, N>>& list) const {
    if (are_consecutive_) return;
    constexpr std::size_t at_once = std::size_t{1} << 18U;  // limits the size of messages
    const std::uint64_t most = std::ranges::max(gather(*group_, std::uint64_t{list.size()}));
    for (std::uint64_t done = 0; done < most; done += at_once) {
        const auto left = std::span(list).subspan(std::min<std::size_t>(done, list.size()));
        const auto rows = left.first(std::min(at_once, left.size()));
        Outboxes out(processes_);
        for (const auto& row : rows) {
            for (const VertexIndex v : row) ++out.counts[owner_of(v.value())];
        }
        out.make_room();
        for (const auto& row : rows) {
            for (const VertexIndex v : row) out.put(owner_of(v.value()), v.value());
        }
        auto received = group_->exchange(std::move(out.bytes));
        for (ProcessGroup::Bytes& offsets : received) answer(offsets);
        received = group_->exchange(std::move(received));
        std::vector<std::size_t> taken(processes_, 0);
        for (auto& row : rows) {
            for (VertexIndex& v : row) {
                const std::size_t owner = owner_of(v.value());
                v = VertexIndex{word_at(received[owner], taken[owner]++)};
            }
        }
    }
}

template void NodeTags::number(IndexVector<CellIndex, CellVertices>&) const;
template void NodeTags::number(IndexVector<FacetIndex, FacetVertices>&) const;
template void NodeTags::number(IndexVector<EdgeIndex, EdgeVertices>&) const;

}  // namespace octetra::gmsh
