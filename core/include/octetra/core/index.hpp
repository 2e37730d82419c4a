#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

/// Numbers typed by role. A vertex number does not convert to a cell number, nor to or from a
/// plain integer unless asked: `VertexIndex{7}` and `index.value()`.
namespace octetra {

/// A local (this process's) number, counted from 0, of an entity whose role is `Role`.
template <class Role>
class Index {
public:
    using Value = std::uint32_t;

    /// The number that stands for "no entity".
    static constexpr Value none_value = std::numeric_limits<Value>::max();
    /// How many entities can be numbered at most: 0 .. limit-1.
    static constexpr Value limit = none_value;

    constexpr Index() = default;
    constexpr explicit Index(std::size_t number) : number_(static_cast<Value>(number)) {}

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
using EdgeIndex = Index<struct EdgeRole>;    ///< of an edge in whatever list of edges is meant
using FacetIndex = Index<struct FacetRole>;  ///< of a tagged (boundary or interface) triangle
using CellIndex = Index<struct CellRole>;

/// A number that holds across all processes, counted from 0 in the order of the input file.
enum class GlobalCell : std::uint64_t {};

/// A std::vector that is subscripted by an index of the right role only.
template <class I, class T>
class IndexVector : public std::vector<T> {
    using Base = std::vector<T>;

public:
    using Base::Base;

    [[nodiscard]] T& operator[](I i) { return Base::operator[](i.value()); }
    [[nodiscard]] const T& operator[](I i) const { return Base::operator[](i.value()); }

    /// The index after the last one: the loop is `for (I i{0}; i < v.end_index(); ++i)`.
    [[nodiscard]] I end_index() const { return I{this->size()}; }

    /// Appends, and returns the number that the new element got.
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
