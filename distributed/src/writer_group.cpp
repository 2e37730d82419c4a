#include "writer_group.hpp"

#include <string>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/agreement.hpp>

namespace octetra::distributed {

WriterGroup::Share ProcessGroup::share_of(std::uint64_t number) const {
    return {processes_.sum_before(number), processes_.sum(number)};
}

std::uint64_t ProcessGroup::of_first(std::uint64_t number) const {
    std::vector<std::uint64_t> numbers{number};
    processes_.broadcast(numbers);
    return numbers.front();
}

void ProcessGroup::on_first(const std::function<void()>& work) const {
    distributed::on_first(processes_, work);
}

/// All hear of the failure of the lowest rank that has one.
void ProcessGroup::agree(const std::string& failure) const {
    if (processes_.sum(failure.empty() ? 0 : 1) == 0) return;
    const auto failures = processes_.gather(std::vector<char>(failure.begin(), failure.end()));
    std::vector<char> told;
    for (const auto& one : failures) {
        if (told.empty()) told = one;
    }
    processes_.broadcast(told);
    throw SystemError(std::string(told.begin(), told.end()));
}

}  // namespace octetra::distributed
