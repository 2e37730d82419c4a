#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace octetra::verify {

/// The processes that judge a mesh together: this class is one process alone, a derived one speaks
/// for more. How they talk to each other is nothing that a judge need know.
class Group {
public:
    using Bytes = std::vector<std::byte>;

    Group() = default;
    virtual ~Group() = default;
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;
    Group(Group&&) = delete;
    Group& operator=(Group&&) = delete;

    [[nodiscard]] virtual int rank() const { return 0; }
    [[nodiscard]] virtual int size() const { return 1; }
    [[nodiscard]] bool is_first() const { return rank() == 0; }

    /// Collective. to_each[r], of which there are size(), goes to process r; the result's [r] came
    /// from there.
    [[nodiscard]] virtual std::vector<Bytes> exchange(std::vector<Bytes> to_each) const {
        return to_each;
    }

    [[nodiscard]] static const Group& alone() {
        static const Group group;
        return group;
    }
};

}  // namespace octetra::verify
