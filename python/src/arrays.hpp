#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

/// Conversion of vectors and spans to numpy arrays, and of numpy arrays to vectors.
namespace octetra::python {

namespace py = pybind11;

/// The type and the count of the numbers that a value has in numpy. Indices are signed, int32 on a
/// rank and int64 in the whole mesh, as in petsc4py and DOLFINx; their bits are those of the
/// unsigned types of the library, so that the index that means "none" is -1.
template <class T>
struct Numbers {
    using Number = T;
    static constexpr std::size_t count = 1;
    static constexpr bool is_index = false;
};
template <>
struct Numbers<std::uint32_t> {
    using Number = std::int32_t;
    static constexpr std::size_t count = 1;
    static constexpr bool is_index = true;
};
template <>
struct Numbers<std::uint64_t> {
    using Number = std::int64_t;
    static constexpr std::size_t count = 1;
    static constexpr bool is_index = true;
};
template <class Role>
struct Numbers<Index<Role>> : Numbers<std::uint32_t> {};
template <>
struct Numbers<distributed::GlobalVertex> : Numbers<std::uint64_t> {};
template <>
struct Numbers<Point> {
    using Number = double;
    static constexpr std::size_t count = 3;
    static constexpr bool is_index = false;
};
template <class T, std::size_t N>
struct Numbers<std::array<T, N>> {
    using Number = typename Numbers<T>::Number;
    static constexpr std::size_t count = N;
    static constexpr bool is_index = Numbers<T>::is_index;
};

/// An array of shape (n, ...) over memory of `owner`, which the array keeps alive.
[[nodiscard]] py::array array_over(const py::dtype& type, std::vector<py::ssize_t> shape,
                                   const void* data, std::shared_ptr<const void> owner,
                                   bool is_writable);

/// A read-only array of shape (n,) or (n, numbers of a value) over these values, without a copy.
template <class T>
[[nodiscard]] py::array view(std::span<const T> values, std::shared_ptr<const void> owner) {
    using Number = typename Numbers<T>::Number;
    constexpr std::size_t count = Numbers<T>::count;
    static_assert(sizeof(T) == count * sizeof(Number));
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())};
    if (count > 1) shape.push_back(count);
    return array_over(py::dtype::of<Number>(), std::move(shape), values.data(), std::move(owner),
                      false);
}

/// The same, for values that the array owns; they are moved.
template <class T, class Allocator>
[[nodiscard]] py::array array_of(std::vector<T, Allocator> values) {
    const auto kept = std::make_shared<const std::vector<T, Allocator>>(std::move(values));
    return view(std::span<const T>(*kept), kept);
}

/// A boolean array from bytes that are 0 or 1, without a copy.
[[nodiscard]] py::array booleans(std::vector<std::uint8_t> bytes);

/// Values of shape (n,) or (n, numbers of a value), from integers of any type, or from any real
/// numbers if those of V are real; no values for None. Throws InputError if the shape or a number
/// does not fit; `name` is the argument in the message.
template <class V>
[[nodiscard]] std::vector<V> values_of(const std::string& name, const py::handle& given);

/// A byte for each cell, and the object that owns the bytes.
struct Marks {
    std::span<const std::uint8_t> bytes;
    py::object owner;
};

/// Marks from booleans, or from integers of any type that are 0 or one other value, which means
/// true; none for None. Throws InputError.
[[nodiscard]] Marks marks_of(const py::handle& given, std::size_t cell_count);

/// Marks from the numbers of marked cells, in any order. Throws InputError.
[[nodiscard]] Marks marks_of_list(const py::handle& given, std::size_t cell_count);

}  // namespace octetra::python
