#include <octetra/distributed/index_map.hpp>

#include <cstring>
#include <numeric>

#include <octetra/core/index.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/sides.hpp>

namespace octetra::distributed {
namespace {

/// Returns the map with owned entities first, then copies; global numbers are not yet set.
template <class I>
IndexMap<I> owned_first(const Sharing<I>& sharing, std::size_t entity_count) {
    IndexMap<I> map;
    std::vector<bool> is_copy(entity_count, false);
    for (const SharedWith<I>& with : sharing.neighbours()) {
        for (const I i : with.received) is_copy[i.value()] = true;
    }
    map.entities.reserve(entity_count);
    for (std::size_t i = 0; i < entity_count; ++i) {
        if (!is_copy[i]) map.entities.emplace_back(i);
    }
    map.owned_count = map.entities.size();
    for (const SharedWith<I>& with : sharing.neighbours()) {
        map.entities.insert(map.entities.end(), with.received.begin(), with.received.end());
        map.copy_owners.insert(map.copy_owners.end(), with.received.size(), with.rank);
    }
    map.numbers.resize(entity_count);
    return map;
}

/// Collective. Returns 0 followed by the inclusive prefix sums of the counts over the ranks.
std::vector<std::uint64_t> running_sums(const Communicator& processes, std::uint64_t count) {
    std::vector<std::uint64_t> sums{0};
    ProcessGroup::Bytes bytes(sizeof count);
    std::memcpy(bytes.data(), &count, sizeof count);
    for (const ProcessGroup::Bytes& of_one : processes.of_all(std::move(bytes))) {
        std::uint64_t there = 0;
        std::memcpy(&there, of_one.data(), sizeof there);
        sums.push_back(sums.back() + there);
    }
    return sums;
}

}  // namespace

template <class I>
IndexMap<I> make_index_map(const Communicator& processes, const Sharing<I>& sharing,
                           std::size_t entity_count) {
    return processes.transaction([&] {
        IndexMap<I> map = owned_first(sharing, entity_count);
        map.rank_begin = running_sums(processes, map.owned_count);
        std::uint64_t next = map.rank_begin[static_cast<std::size_t>(processes.rank())];
        for (std::size_t k = 0; k < map.owned_count; ++k) {
            map.numbers[map.entities[k].value()] = next++;
        }
        update_copies(processes, sharing, entity_count, map.numbers);
        return map;
    });
}

template IndexMap<VertexIndex> make_index_map(const Communicator&, const Sharing<VertexIndex>&,
                                              std::size_t);
template IndexMap<EdgeIndex> make_index_map(const Communicator&, const Sharing<EdgeIndex>&,
                                            std::size_t);
template IndexMap<FaceIndex> make_index_map(const Communicator&, const Sharing<FaceIndex>&,
                                            std::size_t);
template IndexMap<CellIndex> make_index_map(const Communicator&, const Sharing<CellIndex>&,
                                            std::size_t);

}  // namespace octetra::distributed
