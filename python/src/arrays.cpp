#include "arrays.hpp"

#include <cstddef>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/mesh.hpp>

#include "arguments.hpp"

namespace octetra::python {
namespace {

py::array any_array(const py::handle& given) {
    return py::module_::import("numpy").attr("asarray")(given);
}

bool is_whole(const py::array& array) {
    return array.dtype().kind() == 'i' || array.dtype().kind() == 'u';
}

/// Refuses an array of objects, which numpy makes of integers that exceed 64 bits, and of what is
/// no number, if an element explains why numpy made it.
void refuse_object(const std::string& name, const std::string& expected, const py::array& given) {
    for (const py::handle& object : given.attr("flat")) {
        if (!py::isinstance<py::int_>(object)) refuse(name, expected, object);
        if (object.attr("bit_length")().cast<std::size_t>() > 64) {
            refuse(name, "integers that fit into 64 bits", object);
        }
    }
}

[[noreturn]] void refuse_array(const std::string& name, const std::string& expected,
                               const py::array& given) {
    if (given.dtype().kind() == 'O') refuse_object(name, expected, given);
    throw InputError(fmt::format("{} must be {}, not {} of shape {}", name, expected,
                                 py::str(given.dtype()).cast<std::string>(),
                                 py::str(given.attr("shape")).cast<std::string>()));
}

/// Has an array of integers more than one value other than 0?
bool has_several_values(const py::array& array) {
    const py::object set = array[array.attr("__ne__")(0)];
    return py::len(set) > 0 && set.attr("min")().not_equal(set.attr("max")());
}

using Bytes = py::array_t<std::uint8_t>;

/// Marks of cells, none of which is set.
Bytes no_marks(std::size_t cell_count) {
    Bytes marks(static_cast<py::ssize_t>(cell_count));
    std::memset(marks.mutable_data(), 0, cell_count);
    return marks;
}

Marks owned(Bytes bytes) {
    return {{bytes.data(), static_cast<std::size_t>(bytes.size())}, std::move(bytes)};
}

}  // namespace

py::array array_over(const py::dtype& type, std::vector<py::ssize_t> shape, const void* data,
                     std::shared_ptr<const void> owner, bool is_writable) {
    auto kept = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
    const py::capsule capsule(kept.get(), [](void* pointer) {
        delete static_cast<std::shared_ptr<const void>*>(pointer);
    });
    (void)kept.release();
    static const double nothing = 0;  // without an address, numpy would allocate memory
    if (data == nullptr) data = &nothing;
    py::array array(type, std::move(shape), data, capsule);
    if (!is_writable) array.attr("setflags")(py::arg("write") = false);
    return array;
}

py::array booleans(std::vector<std::uint8_t> bytes) {
    return array_of(std::move(bytes)).attr("view")("bool");
}

template <class V>
std::vector<V> values_of(const std::string& name, const py::handle& given) {
    using Number = typename Numbers<V>::Number;
    constexpr std::size_t columns = Numbers<V>::count;
    constexpr bool is_real = std::is_floating_point_v<Number>;
    if (given.is_none()) return {};
    const py::array array = any_array(given);
    const std::string expected =
        fmt::format("{} of shape {}", is_real ? "numbers" : "integers",
                    columns == 1 ? "(n,)" : fmt::format("(n, {})", columns));
    if (array.size() == 0) return {};
    const bool fits_shape =
        columns == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
    if (!fits_shape || !(is_whole(array) || (is_real && array.dtype().kind() == 'f'))) {
        refuse_array(name, expected, array);
    }
    const auto numbers = py::array_t<Number, py::array::c_style | py::array::forcecast>(array);
    if constexpr (Numbers<V>::is_index) {
        const py::object least = array.attr("min")();
        if (least.attr("__lt__")(0).template cast<bool>()) {
            throw InputError(fmt::format("{} must be integers from 0; the least is {}", name,
                                         py::str(least).cast<std::string>()));
        }
    }
    if (!is_real && !numbers.attr("__eq__")(array).attr("all")().template cast<bool>()) {
        refuse_array(name, fmt::format("numbers that fit into {} bits", 8 * sizeof(Number)), array);
    }
    std::vector<V> values(static_cast<std::size_t>(array.shape(0)));
    static_assert(std::is_trivially_copyable_v<V> && sizeof(V) == columns * sizeof(Number));
    std::memcpy(static_cast<void*>(values.data()), numbers.data(), values.size() * sizeof(V));
    return values;
}

template std::vector<double> values_of(const std::string&, const py::handle&);
template std::vector<std::int32_t> values_of(const std::string&, const py::handle&);
template std::vector<std::uint64_t> values_of(const std::string&, const py::handle&);
template std::vector<Point> values_of(const std::string&, const py::handle&);
template std::vector<EdgeVertices> values_of(const std::string&, const py::handle&);
template std::vector<std::array<std::uint64_t, 2>> values_of(const std::string&, const py::handle&);
template std::vector<std::array<std::uint64_t, 3>> values_of(const std::string&, const py::handle&);
template std::vector<std::array<std::uint64_t, 4>> values_of(const std::string&, const py::handle&);

Marks marks_of(const py::handle& given, std::size_t cell_count) {
    if (given.is_none()) return owned(no_marks(cell_count));
    // Contiguous booleans, the usual case, are used without a copy and without calls of numpy.
    if (py::isinstance<py::array_t<bool>>(given)) {
        const auto booleans = py::reinterpret_borrow<py::array_t<bool>>(given);
        if (booleans.ndim() == 1 && booleans.shape(0) == static_cast<py::ssize_t>(cell_count) &&
            (booleans.flags() & py::array::c_style) != 0) {
            const void* bytes = booleans.data();
            return {{static_cast<const std::uint8_t*>(bytes), cell_count}, booleans};
        }
    }
    py::array array = any_array(given);
    const bool is_boolean = array.dtype().kind() == 'b';
    if (array.size() == 0 && array.ndim() == 1 && cell_count == 0) {
        return owned(no_marks(0));
    }
    if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != cell_count ||
        !(is_boolean || is_whole(array))) {
        const char* const hint = is_whole(array) ? " (numbers of cells are passed as cells=)" : "";
        refuse_array("marks",
                     fmt::format("a boolean or integer for each of {} cells{}", cell_count, hint),
                     array);
    }
    if (!is_boolean && has_several_values(array)) {
        throw InputError(
            "marks that are integers must be 0 or one other value, which means true, and these "
            "have several other values; numbers of cells are passed as cells=");
    }
    if (!is_boolean) array = array.attr("__ne__")(0);
    return owned(
        Bytes(py::module_::import("numpy").attr("ascontiguousarray")(array).attr("view")("uint8")));
}

Marks marks_of_list(const py::handle& given, std::size_t cell_count) {
    const auto cells = values_of<std::uint64_t>("cells", given);
    Bytes marks = no_marks(cell_count);
    for (const std::uint64_t cell : cells) {
        if (cell >= cell_count) {
            throw InputError(
                fmt::format("cells has number {}, and this rank has {} cells", cell, cell_count));
        }
        marks.mutable_data()[cell] = 1;
    }
    return owned(std::move(marks));
}

}  // namespace octetra::python
