#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/communicator.hpp>

#include "arrays.hpp"

/// Values of cells, vertices or other entities: an array of shape (n,) or (n, ...).
namespace octetra::python {

struct Values {
    py::array array;             ///< contiguous
    std::size_t count = 0;       ///< the first dimension
    std::size_t components = 1;  ///< the product of the other dimensions

    /// A writable array of this type for `new_count` entities, over memory that `owner` keeps.
    [[nodiscard]] py::array like(std::size_t new_count, const void* data,
                                 std::shared_ptr<const void> owner) const;
    /// The bytes of the values of one entity. Requires the GIL, as copy() and like() do.
    [[nodiscard]] std::size_t bytes() const {
        return components * static_cast<std::size_t>(array.itemsize());
    }
    /// A copy, as bytes or as numbers of the type of the array.
    template <class T = std::byte>
    [[nodiscard]] std::vector<T> copy() const {
        const auto* data = static_cast<const T*>(array.data());
        return {data, data + static_cast<std::size_t>(array.nbytes()) / sizeof(T)};
    }
    /// An array of this type for the values of other entities, by result of copy().
    template <class T>
    [[nodiscard]] py::array like(std::vector<T> values) const {
        const std::size_t size = values.size() * sizeof(T);
        const auto kept = std::make_shared<const std::vector<T>>(std::move(values));
        return like(bytes() == 0 ? 0 : size / bytes(), kept->data(), kept);
    }
};

/// Throws InputError unless `given` has one or more numbers for each of `expected` entities.
[[nodiscard]] Values values_for(const py::handle& given, std::size_t expected,
                                const std::string& entities);

/// Collective. The values of each rank, which `convert`, called with the GIL, returns. Throws
/// InputError on all ranks if that fails on one, or if types, shapes but for the first dimension,
/// or the texts that `detail` returns differ between ranks: values are exchanged as bytes.
[[nodiscard]] Values values_on_each(const distributed::Communicator& processes,
                                    const std::function<Values()>& convert,
                                    const std::function<std::string(const Values&)>& detail = {});

/// Calls work(T()), where T is the type of the numbers: float64, float32, int32 or int64, the types
/// of fields in files. Throws InputError for others.
auto with_number_type(const py::array& array, auto&& work,
                      const char* accepted = "float64, float32, int32 and int64") {
    const auto is = [&](const py::dtype& type) { return array.dtype().equal(type); };
    if (is(py::dtype::of<double>())) return work(double());
    if (is(py::dtype::of<float>())) return work(float());
    if (is(py::dtype::of<std::int32_t>())) return work(std::int32_t());
    if (is(py::dtype::of<std::int64_t>())) return work(std::int64_t());
    throw InputError("values of type " + py::str(array.dtype()).cast<std::string>() + ": only " +
                     accepted + " are accepted; astype() converts them");
}

/// The same, also for complex128 and complex64.
auto with_field_type(const py::array& array, auto&& work) {
    const auto is = [&](const py::dtype& type) { return array.dtype().equal(type); };
    if (is(py::dtype::of<std::complex<double>>())) return work(std::complex<double>());
    if (is(py::dtype::of<std::complex<float>>())) return work(std::complex<float>());
    return with_number_type(array, work,
                            "complex128, complex64, float64, float32, int32 and int64");
}

}  // namespace octetra::python
