#include "comm/same_arguments.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace octetra::distributed {
namespace {

/// Collective. Throws InputError with the first difference; the values are known to differ.
void throw_difference(const Communicator& processes, std::string_view name,
                      const std::string& own) {
    std::vector<char> of_first;
    processes.transaction([&] { of_first.assign(own.begin(), own.end()); });
    processes.broadcast(of_first);
    processes.transaction([&] {
        ProcessGroup::check_same_as_first(processes.rank(), name, own,
                                          {of_first.data(), of_first.size()});
    });
}

}  // namespace

void Communicator::check_same(std::string_view name, const std::string& value) const {
    LocalFailure none;
    agree_on_same(*this, none, name, [&] { return value; });
}

void agree_on_same(const Communicator& processes, LocalFailure& failure, std::string_view name,
                   const std::function<std::string()>& value) {
    std::string own;
    failure.attempt([&] { own = value(); });
    // All hashes are equal if the maximum equals the minimum, which is the complement of the
    // maximal complement.
    constexpr std::uint64_t greatest = LocalFailure::somewhere - 1;
    const std::uint64_t hash = std::hash<std::string>()(own) / 2;
    std::array<std::uint64_t, 2> extremes{hash, greatest - hash};
    if (failure.found()) extremes.fill(LocalFailure::somewhere);
    processes.max(std::span(extremes));
    if (extremes[0] == LocalFailure::somewhere) failure.agree(processes);
    if (extremes[0] != greatest - extremes[1]) throw_difference(processes, name, own);
}

}  // namespace octetra::distributed
