#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

void Communicator::check_same(std::string_view name, const std::string& value) const {
    if (size() == 1) return;
    transaction([&] {
        // All hashes are equal if the maximum equals the minimum, which is the complement of the
        // maximal complement.
        const std::uint64_t hash = std::hash<std::string>()(value);
        const std::array<std::uint64_t, 2> extremes = agreed_max({hash, ~hash});
        if (extremes[0] == ~extremes[1]) return;
        std::vector<char> of_first(value.begin(), value.end());
        broadcast(of_first);
        check_same_as_first(rank(), name, value, {of_first.data(), of_first.size()});
        agree_on_success();
    });
}

}  // namespace octetra::distributed
