#pragma once

#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

/// Indices typed by role. A vertex index converts neither to a cell index nor implicitly to or from
/// an integer; use `VertexIndex{7}` and `index.value()`.
namespace octetra {

/// A local (this process's) index, counted from 0, of an entity with the role `Role`.
template <class Role>
class Index {
public:
    using Value = std::uint32_t;

    /// The value that means "no entity".
    static constexpr Value none_value = std::numeric_limits<Value>::max();
    /// The maximum number of entities: indices are 0 .. limit-1.
    static constexpr Value limit = none_value;

    constexpr Index() = default;
    /// `number` is at most none_value.
    constexpr explicit Index(std::size_t number) : number_(static_cast<Value>(number)) {
        assert(number <= none_value);
    }

    static constexpr Index none() { return Index{none_value}; }

    [[nodiscard]] constexpr Value value() const { return number_; }
    [[nodiscard]] constexpr bool is_none() const { return number_ == none_value; }

    friend constexpr auto operator<=>(Index, Index) = default;

    constexpr Index& operator++() {
        ++number_;
        return *this;
    }

private:
    Value number_ = none_value;
};

using VertexIndex = Index<struct VertexRole>;
using EdgeIndex = Index<struct EdgeRole>;    ///< of an edge in the list of edges in question
using FacetIndex = Index<struct FacetRole>;  ///< of a tagged (boundary or interface) triangle
using CellIndex = Index<struct CellRole>;

/// A global cell number, the same on all processes, counted from 0 in the order of the input file.
enum class GlobalCell : std::uint64_t {};

/// A std::vector subscripted only by an index of the given role.
template <class I, class T>
class IndexVector : public std::vector<T> {
    using Base = std::vector<T>;

public:
    using Base::Base;

    [[nodiscard]] T& operator[](I i) { return Base::operator[](i.value()); }
    [[nodiscard]] const T& operator[](I i) const { return Base::operator[](i.value()); }

    /// The past-the-end index: the loop is `for (I i{0}; i < v.end_index(); ++i)`.
    [[nodiscard]] I end_index() const { return I{this->size()}; }

    /// Appends an element and returns its index.
    I append(T element) {
        this->push_back(std::move(element));
        return I{this->size() - 1};
    }
};

}  // namespace octetra

template <class Role>
struct std::hash<octetra::Index<Role>> {
    std::size_t operator()(octetra::Index<Role> i) const noexcept { return i.value(); }
};
