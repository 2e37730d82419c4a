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

/// Lists of values of variable length, one for each cell or vertex: the list of entity i is
/// values[begin[i]] .. values[begin[i + 1] - 1].
template <class T>
struct ValueLists {
    std::vector<std::uint64_t> begin{0};
    std::vector<T> values;

    friend bool operator==(const ValueLists&, const ValueLists&) = default;
};

/// The movement of the cells and vertices of an AdaptiveMesh between processes, by which a program
/// moves its own data for them. It stays valid independently of later changes of the mesh.
///
/// All functions are collective unless stated otherwise. They throw on all processes: InputError if
/// values do not fit the mesh before the migration, or two processes pass different kinds of values
/// (another T, number of components, lists instead of values, other entities); OutOfMemory if one
/// runs out of memory.
class Migration {
public:
    /// A migration of any mesh in which nothing moves: values are returned unchanged.
    Migration() = default;

    /// Returns whether anything moved on any process; the same on all. Not collective.
    [[nodiscard]] bool changed() const { return changed_; }

    /// Collective. Moves values of cells, `components` for each: takes those of this process's
    /// cells before the migration, and returns those of its cells after it.
    template <class T>
    [[nodiscard]] std::vector<T> cells(std::vector<T> values, std::size_t components = 1) const {
        return moved(cells_, std::move(values), components);
    }
    template <class T>
    [[nodiscard]] ValueLists<T> cells(ValueLists<T> lists) const {
        return moved(cells_, std::move(lists));
    }
    /// Collective. The same for vertices. All processes that have a vertex must pass the same
    /// values for it; a process that keeps a vertex keeps its own.
    template <class T>
    [[nodiscard]] std::vector<T> vertices(std::vector<T> values, std::size_t components = 1) const {
        return moved(vertices_, std::move(values), components);
    }
    template <class T>
    [[nodiscard]] ValueLists<T> vertices(ValueLists<T> lists) const {
        return moved(vertices_, std::move(lists));
    }

    // Interface for the code that migrates cells.

    /// The message from this process to a partner, which may be itself, and from there: entities in
    /// an order that both know.
    struct Message {
        std::vector<std::uint32_t> sent;      ///< local numbers before the migration
        std::vector<std::uint32_t> received;  ///< local numbers after it
    };
    /// In Message::received: the entity was already received from another process.
    static constexpr std::uint32_t repeated = std::numeric_limits<std::uint32_t>::max();

    struct Entities {
        std::size_t count_before = 0;
        std::size_t count_after = 0;
        std::vector<Message> messages;  ///< one for each partner
    };
    /// A migration in which nothing moves, of a part with these numbers of cells and vertices:
    /// values that fit it are returned unchanged.
    Migration(Communicator processes, std::size_t cell_count, std::size_t vertex_count)
        : has_counts_(true),
          processes_(std::move(processes)),
          cells_{cell_count, cell_count, {}},
          vertices_{vertex_count, vertex_count, {}} {}
    /// Partners are ascending by rank and symmetric; each process is among its own partners.
    Migration(Communicator processes, std::vector<int> partners, Entities cells, Entities vertices)
        : changed_(true),
          has_counts_(true),
          processes_(std::move(processes)),
          partners_(std::move(partners)),
          cells_(std::move(cells)),
          vertices_(std::move(vertices)) {}

private:
    /// Allocates a buffer for this number of values and returns its address.
    using Allocate = std::function<std::byte*(std::size_t)>;

    /// Collective. Checks the arguments if nothing has moved.
    void check_values(const Entities& entities, std::size_t count,
                      const detail::ValueKind& kind) const;
    void check_lists(const Entities& entities, std::span<const std::uint64_t> begin,
                     std::size_t count, const detail::ValueKind& kind) const;
    /// Collective.
    void move_values(const Entities& entities, std::span<const std::byte> values,
                     const detail::ValueKind& kind, const Allocate& allocate) const;
    /// Collective. The arguments are as in ValueLists.
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
        ValueLists<T> after{.begin = {}, .values = {}};  // allocates nothing yet
        move_lists(entities, lists.begin, std::as_bytes(std::span(lists.values)), kind, after.begin,
                   [&](std::size_t count) {
                       after.values.resize(count);
                       return std::as_writable_bytes(std::span(after.values)).data();
                   });
        return after;
    }

    bool changed_ = false;
    bool has_counts_ = false;  ///< whether values must fit the counts below
    Communicator processes_;
    std::vector<int> partners_;
    Entities cells_;
    Entities vertices_;
};

}  // namespace octetra::distributed
