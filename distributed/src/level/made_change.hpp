#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace octetra::distributed {

/// A change that was made to a mesh: the destructor reverts it unless keep() was called.
class MadeChange {
public:
    MadeChange() = default;
    virtual ~MadeChange() = default;
    MadeChange(const MadeChange&) = delete;
    MadeChange& operator=(const MadeChange&) = delete;
    MadeChange(MadeChange&&) = delete;
    MadeChange& operator=(MadeChange&&) = delete;

    virtual void keep() noexcept = 0;
};

/// Changes in the order in which they were made: the destructor reverts them, the last one first,
/// unless they are kept.
class MadeChanges {
public:
    MadeChanges() = default;
    ~MadeChanges() {
        while (!changes_.empty()) changes_.pop_back();
    }
    MadeChanges(const MadeChanges&) = delete;
    MadeChanges& operator=(const MadeChanges&) = delete;
    MadeChanges(MadeChanges&&) = delete;
    MadeChanges& operator=(MadeChanges&&) = delete;

    /// Adds the change that `make()` makes and returns.
    void add(auto&& make) {
        changes_.emplace_back();  // its memory first: a change that was made must be listed
        changes_.back() = make();
    }
    void keep() noexcept {
        for (const auto& change : changes_) change->keep();
        changes_.clear();
    }

private:
    std::vector<std::unique_ptr<MadeChange>> changes_;
};

}  // namespace octetra::distributed
