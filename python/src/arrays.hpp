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

/// Vectors and spans of the library as numpy arrays, and numpy arrays as vectors.
namespace octetra::python {

namespace py = pybind11;

/// The type and the count of the numbers that numpy sees in a value of the library. Indices are
/// signed, int32 on a rank and int64 in the whole mesh, as petsc4py and DOLFINx have them; the bits
/// are those of the library's unsigned types, and an index that stands for "none" is -1.
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

/// An array of shape (n, ...) over memory that `owner` keeps, which the array keeps.
[[nodiscard]] py::array array_over(const py::dtype& type, std::vector<py::ssize_t> shape,
                                   const void* data, std::shared_ptr<const void> owner,
                                   bool is_writable);

/// A read-only array of these values, of shape (n,) or (n, numbers of a value), without a copy.
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

/// The same of values that the array is to have for itself; they are not copied.
template <class T, class Allocator>
[[nodiscard]] py::array array_of(std::vector<T, Allocator> values) {
    const auto kept = std::make_shared<const std::vector<T, Allocator>>(std::move(values));
    return view(std::span<const T>(*kept), kept);
}

/// Bytes that are 0 or 1 as booleans, without a copy.
[[nodiscard]] py::array booleans(std::vector<std::uint8_t> bytes);

/// Whole numbers of any type, or any real ones where those of V are real, as values: of shape (n,),
/// or (n, numbers of a value). None of them for None. Throws InputError where a number or the shape
/// does not fit; `name` is what the caller calls them.
template <class V>
[[nodiscard]] std::vector<V> values_of(const std::string& name, const py::handle& given);

/// A whole number from 0. Throws InputError where it is none; `name` is what the caller calls it.
[[nodiscard]] std::uint64_t whole_number(const std::string& name, const py::handle& given);

/// A byte for each cell, and what has them.
struct Marks {
    std::span<const std::uint8_t> bytes;
    py::object owner;
};

/// From booleans, or whole numbers of any type, of which others than 0 mean true. None marks
/// nothing.
[[nodiscard]] Marks marks_of(const py::handle& given, std::size_t cell_count);

/// The same from numbers of cells, in any order.
[[nodiscard]] Marks marks_of_list(const py::handle& given, std::size_t cell_count);

}  // namespace octetra::python
