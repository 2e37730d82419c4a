#include "setup/number_check.hpp"

#include <bit>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::distributed {
namespace {

struct Listed {
    std::uint64_t number = 0;
    Point point;
    Marker marker = 0;
    std::uint32_t is_used = 0;
    std::uint64_t hash_of_attributes = 0;
};

bool same(const Listed& a, const Listed& b) {
    // -0 equals 0
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    return bits(a.point.x) == bits(b.point.x) && bits(a.point.y) == bits(b.point.y) &&
           bits(a.point.z) == bits(b.point.z) && a.marker == b.marker;
}

/// Returns a hash; equal attributes have equal hashes.
std::uint64_t hash_of(std::span<const double> attributes) {
    std::uint64_t hash = 0;
    for (const double value : attributes) {
        // -0 equals 0
        hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32U;
    }
    return hash;
}

/// This process's block of the numbers 0 .. count - 1.
struct Block {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::uint64_t length = 0;

    Block(const Communicator& processes, std::uint64_t count)
        : length(count / static_cast<std::uint64_t>(processes.size()) + 1) {
        begin = std::min(count, length * static_cast<std::uint64_t>(processes.rank()));
        end = std::min(count, begin + length);
    }
};

[[noreturn]] void refuse_missing(std::uint64_t number, const char* what) {
    throw InputError(fmt::format("{} {} is missing: no process lists it", what, number));
}

/// Compares the entries of all processes for the vertices of a block. Returns for each entry, in
/// the order received, whether its sender keeps the vertex.
std::vector<std::vector<std::uint8_t>> answers_to(const std::vector<std::vector<Listed>>& inboxes,
                                                  const Block& block) {
    constexpr int no_rank = -1;
    struct Known {
        Listed listed;
        int first = no_rank;
        bool is_used = false;
    };
    std::vector<Known> known(block.end - block.begin);
    for (std::size_t rank = 0; rank < inboxes.size(); ++rank) {
        for (const Listed& listed : inboxes[rank]) {
            Known& of = known[listed.number - block.begin];
            if (of.first == no_rank) {
                of.listed = listed;
                of.first = static_cast<int>(rank);
            } else if (!same(of.listed, listed)) {
                throw InputError(
                    fmt::format("vertex {}: ranks {} and {} have different points or markers",
                                listed.number, of.first, rank));
            } else if (of.listed.hash_of_attributes != listed.hash_of_attributes) {
                throw InputError(fmt::format("vertex {}: ranks {} and {} have different attributes",
                                             listed.number, of.first, rank));
            }
            of.is_used = of.is_used || listed.is_used != 0;
        }
    }
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i].first == no_rank) refuse_missing(block.begin + i, "vertex");
    }
    std::vector<std::vector<std::uint8_t>> answers(inboxes.size());
    for (std::size_t rank = 0; rank < inboxes.size(); ++rank) {
        for (const Listed& listed : inboxes[rank]) {
            const Known& of = known[listed.number - block.begin];
            const bool keeps =
                of.is_used ? listed.is_used != 0 : of.first == static_cast<int>(rank);
            answers[rank].push_back(keeps ? 1 : 0);
        }
    }
    return answers;
}

}  // namespace

CheckedVertices check_vertices(
    const Communicator& processes, const std::vector<std::uint64_t>& numbers,
    const std::vector<std::uint8_t>& used, const std::function<Point(std::size_t)>& point_at,
    const std::function<Marker(std::size_t)>& marker_at,
    const std::function<std::span<const double>(std::size_t)>& attributes_at) {
    // Limits the memory that is allocated by the number of listed vertices, not by the greatest
    // number.
    const std::uint64_t listed = processes.sum(numbers.size());
    const std::uint64_t greatest = processes.max(numbers.empty() ? 0 : numbers.back());
    if (listed == 0) return {};
    if (greatest >= listed) {
        throw InputError(fmt::format("vertices are numbered up to {}, and only {} are listed",
                                     greatest, listed));
    }
    CheckedVertices checked{.count = greatest + 1, .keeps = {}};
    const Block block(processes, checked.count);
    std::vector<std::vector<Listed>> outboxes(static_cast<std::size_t>(processes.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        outboxes[numbers[i] / block.length].push_back(
            {numbers[i], point_at(i), marker_at(i), used[i], hash_of(attributes_at(i))});
    }
    const auto inboxes = processes.all_to_all(outboxes);
    // Numbers ascend, so the answers arrive in their order.
    for (const auto& from_one : processes.all_to_all(answers_to(inboxes, block))) {
        checked.keeps.insert(checked.keeps.end(), from_one.begin(), from_one.end());
    }
    return checked;
}

void check_complete(const Communicator& processes, const std::vector<std::uint64_t>& numbers,
                    std::uint64_t count, const char* what) {
    const Block block(processes, count);
    std::vector<std::vector<std::uint64_t>> outboxes(static_cast<std::size_t>(processes.size()));
    for (const std::uint64_t number : numbers) {
        if (number >= count) {
            throw InputError(fmt::format("rank {}: {} {} is too large: there are {}",
                                         processes.rank(), what, number, count));
        }
        outboxes[number / block.length].push_back(number);
    }
    const auto inboxes = processes.all_to_all(outboxes);
    std::vector<bool> met(block.end - block.begin, false);
    for (const auto& inbox : inboxes) {
        for (const std::uint64_t number : inbox) {
            if (met[number - block.begin]) {
                throw InputError(fmt::format("{} {} is listed twice", what, number));
            }
            met[number - block.begin] = true;
        }
    }
    for (std::size_t i = 0; i < met.size(); ++i) {
        if (!met[i]) refuse_missing(block.begin + i, what);
    }
}

}  // namespace octetra::distributed
