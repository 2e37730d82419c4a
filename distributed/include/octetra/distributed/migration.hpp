#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/value_kind.hpp>

namespace octetra::distributed {

/// Lists of values, one for each cell or vertex: that of entity i is values[begin[i]] ..
/// values[begin[i + 1] - 1].
template <class T>
struct ValueLists {
    std::vector<std::uint64_t> begin{0};
    std::vector<T> values;

    friend bool operator==(const ValueLists&, const ValueLists&) = default;
};

/// Where the cells of an AdaptiveMesh went when it was rebalanced, and with them its vertices:
/// brings along what a program has for each. It stays valid whatever becomes of the mesh.
///
/// All processes call its functions, in the same order. They throw alike on all processes:
/// InputError where values do not fit the mesh as it was, or two processes pass different kinds of
/// values: another T, another number of components, lists, values of other entities; OutOfMemory if
/// one process has no memory.
class Migration {
public:
    /// Nothing has moved, of whatever mesh: values stay as they are.
    Migration() = default;

    /// Has anything moved, on any process? The same on all.
    [[nodiscard]] bool changed() const { return changed_; }

    /// Collective. Values of cells, `components` for each: takes those of this process's cells as
    /// they were, and gives those of the cells as they are.
    template <class T>
    [[nodiscard]] std::vector<T> cells(std::vector<T> values, std::size_t components = 1) const {
        return moved(cells_, std::move(values), components);
    }
    template <class T>
    [[nodiscard]] ValueLists<T> cells(ValueLists<T> lists) const {
        return moved(cells_, std::move(lists));
    }
    /// Collective. The same of vertices. Of a vertex that several processes have, all have the same
    /// values, and whoever keeps it keeps its own.
    template <class T>
    [[nodiscard]] std::vector<T> vertices(std::vector<T> values, std::size_t components = 1) const {
        return moved(vertices_, std::move(values), components);
    }
    template <class T>
    [[nodiscard]] ValueLists<T> vertices(ValueLists<T> lists) const {
        return moved(vertices_, std::move(lists));
    }

    // For who moves cells.

    /// What is in a message from one process to another, or to itself: some of its entities, in an
    /// order that both know.
    struct Message {
        std::vector<std::uint32_t> sent;      ///< to the other process, by the numbers they had
        std::vector<std::uint32_t> received;  ///< from there, by the numbers that they have
    };
    /// In Message::received: the entity has come from another process already.
    static constexpr std::uint32_t repeated = std::numeric_limits<std::uint32_t>::max();

    struct Entities {
        std::size_t count_before = 0;
        std::size_t count_after = 0;
        std::vector<Message> messages;  ///< one for each partner
    };
    /// Nothing has moved of a part with so many cells and vertices: values that fit it stay as they
    /// are.
    Migration(Communicator processes, std::size_t cell_count, std::size_t vertex_count)
        : knows_counts_(true),
          processes_(std::move(processes)),
          cells_{cell_count, cell_count, {}},
          vertices_{vertex_count, vertex_count, {}} {}
    /// Partners ascend by rank, and are mutual; each process is one of its own.
    Migration(Communicator processes, std::vector<int> partners, Entities cells, Entities vertices)
        : changed_(true),
          knows_counts_(true),
          processes_(std::move(processes)),
          partners_(std::move(partners)),
          cells_(std::move(cells)),
          vertices_(std::move(vertices)) {}

private:
    /// Makes room for so many values, and says where.
    using Allocate = std::function<std::byte*(std::size_t)>;

    /// Collective. Where nothing has moved.
    void check_values(const Entities& entities, std::size_t count,
                      const detail::ValueKind& kind) const;
    void check_lists(const Entities& entities, std::span<const std::uint64_t> begin,
                     std::size_t count, const detail::ValueKind& kind) const;
    /// Collective.
    void move_values(const Entities& entities, std::span<const std::byte> values,
                     const detail::ValueKind& kind, const Allocate& allocate) const;
    /// Collective. As ValueLists.
    void move_lists(const Entities& entities, std::span<const std::uint64_t> begin,
                    std::span<const std::byte> values, const detail::ValueKind& kind,
                    std::vector<std::uint64_t>& begin_after, const Allocate& allocate) const;

    template <class T>
    [[nodiscard]] detail::ValueKind kind_of(const Entities& entities,
                                            std::size_t components) const {
        return &entities == &cells_ ? detail::kind_of<T, CellIndex>(components)
                                    : detail::kind_of<T, VertexIndex>(components);
    }

    template <class T>
    [[nodiscard]] std::vector<T> moved(const Entities& entities, std::vector<T> values,
                                       std::size_t components) const {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        const detail::ValueKind kind = kind_of<T>(entities, components);
        if (!changed_) {
            check_values(entities, values.size(), kind);
            return values;
        }
        std::vector<T> after;
        move_values(entities, std::as_bytes(std::span(values)), kind, [&](std::size_t count) {
            after.resize(count * components);
            return std::as_writable_bytes(std::span(after)).data();
        });
        return after;
    }
    template <class T>
    [[nodiscard]] ValueLists<T> moved(const Entities& entities, ValueLists<T> lists) const {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        detail::ValueKind kind = kind_of<T>(entities, 1);
        kind.are_lists = true;
        if (!changed_) {
            check_lists(entities, lists.begin, lists.values.size(), kind);
            return lists;
        }
        ValueLists<T> after{.begin = {}, .values = {}};  // which takes no memory yet
        move_lists(entities, lists.begin, std::as_bytes(std::span(lists.values)), kind, after.begin,
                   [&](std::size_t count) {
                       after.values.resize(count);
                       return std::as_writable_bytes(std::span(after.values)).data();
                   });
        return after;
    }

    bool changed_ = false;
    bool knows_counts_ = false;  ///< of a mesh, which values are to fit
    Communicator processes_;
    std::vector<int> partners_;
    Entities cells_;
    Entities vertices_;
};

}  // namespace octetra::distributed
