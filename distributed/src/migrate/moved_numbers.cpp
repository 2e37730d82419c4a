#include "migrate/moved_numbers.hpp"

#include <cstdint>
#include <span>

#include <octetra/core/cut_runs.hpp>

#include "migrate/exchange_entities.hpp"

namespace octetra::distributed {

IndexVector<VertexIndex, GlobalVertex> moved_numbers(
    const Communicator& processes, const MovedEntities& moved,
    const IndexVector<VertexIndex, GlobalVertex>& numbers) {
    const auto pack = [&](const std::vector<std::uint32_t>& sent) {
        std::vector<std::uint8_t> packed;
        std::uint64_t last = 0;
        for (const std::uint32_t v : sent) {
            const auto number = static_cast<std::uint64_t>(numbers[VertexIndex{v}]);
            append_number(number - last, packed);
            last = number;
        }
        const auto bytes = std::as_bytes(std::span(packed));
        return MessageBytes(bytes.begin(), bytes.end());
    };
    IndexVector<VertexIndex, GlobalVertex> after;
    const auto take = [&](const std::vector<MessageBytes>& messages) {
        after.assign(moved.vertices.count_after, GlobalVertex{0});
        for (std::size_t p = 0; p < messages.size(); ++p) {
            std::span<const std::uint8_t> rest(
                reinterpret_cast<const std::uint8_t*>(messages[p].data()), messages[p].size());
            std::uint64_t number = 0;
            for (const std::uint32_t v : moved.vertices.messages[p].received) {
                std::uint64_t difference = 0;
                (void)take_number(rest, difference);
                number += difference;
                if (v != Migration::repeated) after[VertexIndex{v}] = GlobalVertex{number};
            }
        }
    };
    exchange_entities(processes, moved.partners, moved.vertices, pack, take);
    return after;
}

}  // namespace octetra::distributed
