#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/index_map.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "shared_values.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

/// One entity, for messages.
const char* entity_of(const SharedEntities& of) {
    constexpr std::array names{"vertex", "edge", "face"};
    return names[of.sharing.index()];
}

/// Collective. The values of each rank; `detail` as for values_on_each().
Values shared_values(const SharedEntities& of, const std::function<py::object()>& convert,
                     const std::function<std::string(const Values&)>& detail = {}) {
    return values_on_each(
        of.processes, [&] { return values_for(convert(), of.count, "entities"); },
        [&](const Values& own) {
            return fmt::format(" for each {}{}", entity_of(of), detail ? detail(own) : "");
        });
}

/// The rank that owns each entity.
py::array owners(const SharedEntities& of) {
    return std::visit(
        [&]<class I>(const SharedEntities::Pointer<I>& sharing) {
            std::vector<std::int32_t> all(of.count, sharing->rank());
            for (const I i : sharing->shared()) all[i.value()] = sharing->owner(i);
            return array_of(std::move(all));
        },
        of.sharing);
}

py::array shared(const SharedEntities& of) {
    return std::visit(
        [](const auto& sharing) { return view(std::span(sharing->shared()), sharing); },
        of.sharing);
}

py::array sharers(const SharedEntities& of, const Arguments& arguments) {
    const auto number = integer_from<std::int64_t>("entity", arguments.values<1>()[0]);
    if (number < 0 || static_cast<std::uint64_t>(number) >= of.count) {
        throw py::index_error(fmt::format("entity {}, and this rank has {}", number, of.count));
    }
    const auto entity = static_cast<std::size_t>(number);
    return std::visit(
        [&]<class I>(const SharedEntities::Pointer<I>& sharing) {
            return view(sharing->sharers(I{entity}), sharing);
        },
        of.sharing);
}

py::dict with_each(const SharedEntities& of) {
    py::dict all;
    std::visit(
        [&](const auto& sharing) {
            for (const auto& with : sharing->neighbours()) {
                all[py::int_(with.rank)] = view(std::span(with.entities), sharing);
            }
        },
        of.sharing);
    return all;
}

/// Collective. A copy of the values after exchange(sharing, copy, components).
template <class T>
py::array exchanged(const SharedEntities& of, const Values& values, auto&& exchange) {
    const std::size_t components = values.bytes() / sizeof(T);
    return values.like(without_gil([&, copy = values.copy<T>()]() mutable {
        std::visit([&](const auto& sharing) { exchange(*sharing, copy, components); }, of.sharing);
        return std::move(copy);
    }));
}

py::array update_copies(const SharedEntities& of, const Arguments& arguments) {
    const Values values = shared_values(of, [&] { return arguments.values<1>()[0]; });
    const auto update = [&](const auto& sharing, auto& copy, std::size_t components) {
        od::update_copies(of.processes, sharing, of.count, copy, components);
    };
    return exchanged<std::byte>(of, values, update);
}

bool is_boolean(const Values& values) { return values.array.dtype().kind() == 'b'; }

enum class Operation { sum, min, max, either };

Operation operation_for(const Values& values, const std::string& name) {
    if (is_boolean(values)) {
        if (name == "or") return Operation::either;
        throw InputError("operation must be 'or' for booleans");
    }
    with_number_type(values.array, [](auto) {});
    if (name == "sum") return Operation::sum;
    if (name == "min") return Operation::min;
    if (name == "max") return Operation::max;
    throw InputError("operation must be 'sum', 'min' or 'max', or 'or' for booleans");
}

template <class T>
T combined(Operation operation, T a, T b) {
    if (operation == Operation::sum) return a + b;
    return operation == Operation::min ? std::min(a, b) : std::max(a, b);
}

py::array combine(const SharedEntities& of, const Arguments& arguments) {
    auto operation = Operation::sum;
    std::string name;
    const Values values = shared_values(
        of,
        [&] {
            const auto [given, operation_name] = arguments.values<2>();
            name = string_from("operation", operation_name);
            return given;
        },
        [&](const Values& own) {
            operation = operation_for(own, name);
            return fmt::format(", combined by '{}'", name);
        });
    if (is_boolean(values)) {
        return exchanged<std::uint8_t>(
            of, values, [&](const auto& sharing, auto& copy, std::size_t components) {
                od::combine_everywhere(of.processes, sharing, of.count, copy, std::logical_or<>{},
                                       components);
            });
    }
    return with_number_type(values.array, [&]<class T>(T) {
        const auto combine_all = [&](const auto& sharing, auto& copy, std::size_t components) {
            od::combine_everywhere(
                of.processes, sharing, of.count, copy,
                [=](T a, T b) { return combined(operation, a, b); }, components);
        };
        return exchanged<T>(of, values, combine_all);
    });
}

/// An index map of entities of any kind.
struct IndexMap {
    std::vector<std::uint32_t> entities;
    std::size_t owned_count = 0;
    std::vector<int> copy_owners;
    std::vector<std::uint64_t> numbers;
    std::vector<std::uint64_t> rank_begin;

    template <class I>
    explicit IndexMap(od::IndexMap<I> map)
        : owned_count(map.owned_count),
          copy_owners(std::move(map.copy_owners)),
          numbers(std::move(map.numbers)),
          rank_begin(std::move(map.rank_begin)) {
        for (const I i : map.entities) entities.push_back(i.value());
    }
};
using IndexMapPointer = std::shared_ptr<IndexMap>;

IndexMapPointer index_map(const SharedEntities& of, const Arguments& arguments) {
    convert_on_each(of.processes, [&] { arguments.check(); });
    return without_gil([&] {
        return std::visit(
            [&](const auto& sharing) {
                return std::make_shared<IndexMap>(
                    od::make_index_map(of.processes, *sharing, of.count));
            },
            of.sharing);
    });
}

void bind_index_map(py::module_& module) {
    const auto list = [](auto of) {
        return [of](const IndexMapPointer& map) {
            return view(std::span(std::as_const((*map).*of)), map);
        };
    };
    py::class_<IndexMap, IndexMapPointer>(
        module, "IndexMap",
        "A numbering in which the entities that a rank owns have consecutive numbers, in the order "
        "of ranks, as vectors and matrices of PETSc and DOLFINx need it. It depends on the "
        "partition, in contrast to the numbers in files.")
        .def_property_readonly("entities", list(&IndexMap::entities),
                               "int32 (n,): local numbers of the owned entities, ascending, and "
                               "then of the copies, ordered by the rank of their owner.")
        .def_readonly("owned_count", &IndexMap::owned_count,
                      "int: the number of entities that this rank owns.")
        .def_property_readonly("copy_owners", list(&IndexMap::copy_owners),
                               "int32 (n - owned_count,): the owners of entities[owned_count:].")
        .def_property_readonly("numbers", list(&IndexMap::numbers),
                               "int64 (n,): the number of each entity, indexed by local number.")
        .def_property_readonly("rank_begin", list(&IndexMap::rank_begin),
                               "int64 (ranks + 1,): rank r owns the numbers rank_begin[r] to "
                               "rank_begin[r + 1] - 1.");
}

}  // namespace

void bind_sharing(py::module_& module, MeshClass& mesh) {
    bind_index_map(module);
    py::class_<SharedEntities> sharing(
        module, "Sharing",
        "The vertices, edges or faces that this rank shares with other ranks, and their owners. "
        "Each entity has one owner among the ranks that have it. A sharing describes the mesh at "
        "the time of the call.");
    sharing
        .def_property_readonly("owners", &owners,
                               "int32 (n,): the rank that owns each entity. Computed on access.")
        .def_property_readonly("shared", &shared,
                               "int32 (k,): the entities that other ranks have as well, ascending.")
        .def_property_readonly("with_rank", &with_each,
                               "{rank: int32 (k,)}: the entities shared with each other rank, in "
                               "the same order on both ranks.");
    def_method(sharing, "sharers", "entity", &sharers,
               "int32 (k,): the other ranks that have an entity, ascending. Raises IndexError if "
               "this rank has no such entity.");
    def_method(sharing, "index_map", "", &index_map,
               "Collective. An IndexMap: consecutive numbers for the entities that each rank owns, "
               "and the numbers of copies.");
    def_method(sharing, "update_copies", "values", &update_copies,
               "Collective. Sets the values of every copy to those of the owner. values: (n, ...) "
               "of any numbers. Returns a new array.");
    def_method(sharing, "combine", "values, operation='sum'", &combine,
               "Collective. Combines the values of all copies of each entity, as assembly needs; "
               "the result is the same on all ranks that have the entity. values: (n, ...) of "
               "float64, float32, int32, int64 or bool. operation: 'sum', 'min' or 'max' for "
               "numbers, 'or' for booleans. Returns a new array.");
    def_method(
        mesh, "cell_index_map", "",
        [](Mesh& m, const Arguments& arguments) {
            return m.ask(arguments, [](const od::AdaptiveMesh& now) {
                return std::make_shared<IndexMap>(now.cell_index_map());
            });
        },
        "Collective. An IndexMap: consecutive numbers for this rank's cells, which have no "
        "copies.");
    mesh.def_property_readonly(
        "vertex_sharing",
        [](const Mesh& m) {
            using Sharing = od::Sharing<VertexIndex>;
            return SharedEntities{m.processes(), m.vertex_count(),
                                  std::make_shared<const Sharing>(m.now().vertex_sharing())};
        },
        "Sharing: the ranks that share this rank's vertices, and their owners.");
}

}  // namespace octetra::python
