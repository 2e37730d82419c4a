#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/index_map.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "shared_values.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

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

py::array sharers(const SharedEntities& of, std::int64_t number) {
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
    return values.like(without_gil([&, copy = values.copy<T>()]() mutable {
        const std::size_t components = values.bytes() / sizeof(T);
        std::visit([&](const auto& sharing) { exchange(*sharing, copy, components); }, of.sharing);
        return std::move(copy);
    }));
}

py::array update_copies(const SharedEntities& of, const py::object& given) {
    const Values values = values_on_each(of.processes, given, of.count, "entities");
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
        throw InputError("operation: booleans are combined by 'or' alone");
    }
    with_number_type(values.array, [](auto) {});
    if (name == "sum") return Operation::sum;
    if (name == "min") return Operation::min;
    if (name == "max") return Operation::max;
    throw InputError("operation: 'sum', 'min' or 'max', and of booleans 'or'");
}

template <class T>
T combined(Operation operation, T a, T b) {
    if (operation == Operation::sum) return a + b;
    return operation == Operation::min ? std::min(a, b) : std::max(a, b);
}

py::array combine(const SharedEntities& of, const py::object& given, const std::string& name) {
    auto operation = Operation::sum;
    const Values values =
        values_on_each(of.processes, given, of.count, "entities", [&](const Values& own) {
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

/// An IndexMap of entities of any kind.
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

IndexMapPointer index_map(const SharedEntities& of) {
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
        "A numbering in which what a rank owns has consecutive numbers, rank by rank, as vectors "
        "and matrices of PETSc and DOLFINx have. It depends on the partition, unlike the numbers "
        "of files.")
        .def_property_readonly("entities", list(&IndexMap::entities),
                               "int32 (n,): this rank's own first, ascending, then the copies, by "
                               "the rank of their owner.")
        .def_readonly("owned_count", &IndexMap::owned_count, "How many are this rank's own.")
        .def_property_readonly("copy_owners", list(&IndexMap::copy_owners),
                               "int32 (n - owned_count,): the owners of entities[owned_count:].")
        .def_property_readonly("numbers", list(&IndexMap::numbers),
                               "int64 (n,): the number of each, by local number.")
        .def_property_readonly("rank_begin", list(&IndexMap::rank_begin),
                               "int64 (ranks + 1,): rank r owns the numbers rank_begin[r] to "
                               "rank_begin[r + 1] - 1.");
}

}  // namespace

void bind_sharing(py::module_& module, MeshClass& mesh) {
    bind_index_map(module);
    py::class_<SharedEntities>(
        module, "Sharing",
        "Which vertices, edges or faces of this rank others have, too: a picture of the mesh as it "
        "was. Each entity has one owner among the ranks that have it.")
        .def_property_readonly("owners", &owners,
                               "int32 (n,): the rank that owns each entity. Made when asked for.")
        .def_property_readonly("shared", &shared,
                               "int32 (k,): those that other ranks have, too; ascending.")
        .def_property_readonly("with_rank", &with_each,
                               "{rank: int32 (k,)}: what each other rank has, too; both have it "
                               "listed in the same order.")
        .def("sharers", &sharers, py::arg("entity"),
             "int32 (k,): the other ranks that have this one, ascending. IndexError if this rank "
             "has no such entity.")
        .def("index_map", &index_map,
             "Collective. Consecutive numbers for what each rank owns, and the numbers of copies.")
        .def("update_copies", &update_copies, py::arg("values"),
             "Collective. Values (n, ...) of any numbers, of which every copy has got its owner's: "
             "a new array.")
        .def(
            "combine", &combine, py::arg("values"), py::arg("operation") = "sum",
            "Collective. Values (n, ...) of float64, float32, int32 or int64, combined over all "
            "ranks that have an entity, the same on all of them: what assembly needs. A new array. "
            "operation: 'sum', 'min' or 'max'; of booleans 'or', true on all ranks that have the "
            "entity where it is true on one.");
    mesh.def(
        "cell_index_map",
        [](Mesh& m) {
            return m.ask([](const od::AdaptiveMesh& now) {
                return std::make_shared<IndexMap>(now.cell_index_map());
            });
        },
        "Collective. Consecutive numbers for this rank's cells, of which there are no copies.");
    mesh.def_property_readonly(
        "vertex_sharing",
        [](const Mesh& m) {
            using Sharing = od::Sharing<VertexIndex>;
            return SharedEntities{m.processes(), m.vertex_count(),
                                  std::make_shared<const Sharing>(m.now().vertex_sharing())};
        },
        "Who else has this rank's vertices, and who owns them.");
}

}  // namespace octetra::python
