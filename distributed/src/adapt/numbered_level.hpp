#pragma once

#include <cstdint>

#include "adapt/mesh_state.hpp"
#include "level/planned_level.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {

/// The numbers of a level's new vertices; removed by the destructor unless they are kept.
class NewNumbers {
public:
    explicit NewNumbers(CanonicalNumbers& numbers)
        : numbers_(&numbers), end_(numbers.of_vertex.end_index()), count_(numbers.vertex_count) {}
    ~NewNumbers() {
        if (numbers_ != nullptr) numbers_->forget_from(end_, count_);
    }
    NewNumbers(const NewNumbers&) = delete;
    NewNumbers& operator=(const NewNumbers&) = delete;
    NewNumbers(NewNumbers&&) = delete;
    NewNumbers& operator=(NewNumbers&&) = delete;
    void keep() noexcept { numbers_ = nullptr; }

private:
    CanonicalNumbers* numbers_;
    VertexIndex end_;
    std::uint64_t count_;
};

/// A bisected level with the numbers and sharers of its new vertices, ready to be committed to the
/// state of its mesh. Destroying the object without commit() restores the state.
class NumberedLevel {
public:
    /// Collective. Numbers the new vertices of a level that bisect_level() has bisected.
    NumberedLevel(AdaptiveMesh::State& state, PlannedLevel plan);

    /// Changes the state, and returns the description of the level. To be called once.
    Adaptation commit() noexcept;

private:
    AdaptiveMesh::State* state_;
    PlannedLevel plan_;
    NewNumbers new_numbers_;
    SharingBuilder<VertexIndex> shared_;
    Adaptation adaptation_;
};

}  // namespace octetra::distributed
