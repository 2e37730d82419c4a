#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <octetra/core/field.hpp>
#include <octetra/core/process_group.hpp>

/// Reads Medit files of values, on one process or several.
namespace octetra {

/// Numbers of entities in the whole mesh.
struct EntityCounts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
};

/// Fields on vertices, or on cells: a row for each entity, with the values of all fields.
struct FieldRows {
    FieldOn on = FieldOn::vertices;
    std::vector<std::size_t> components;  ///< of each field
    std::uint64_t count = 0;              ///< number of rows in the file
    std::uint64_t first = 0;              ///< number of this process's first row
    std::vector<double>
        values;  ///< its rows in the order of the file; see sol_component_position()

    [[nodiscard]] std::size_t width() const {
        return std::accumulate(components.begin(), components.end(), std::size_t{0});
    }
};

struct SolFields {
    std::vector<FieldRows> lists;    ///< of a Medit file at most one on vertices and one on cells
    std::vector<std::string> notes;  ///< on data not kept; equal on all processes
};

/// Reads a whole file. Values are finite, and less than coordinate_limit, so that means do not
/// overflow. Throws InputError "FILE:LINE: message" (of a binary file "FILE: at byte N: message"),
/// also if the number of rows differs from `expected`; or SystemError.
[[nodiscard]] SolFields read_sol(const std::filesystem::path& path,
                                 const std::optional<EntityCounts>& expected);

/// Reads the sections $NodeData and $ElementData of a Gmsh file `.msh`, each a list with one field
/// of 1, 3 or 9 components, whose rows are in the order of the nodes, or of the tetrahedra. Throws
/// as read_sol(), also for a node or tetrahedron without a value.
[[nodiscard]] SolFields read_msh_data(const std::filesystem::path& path,
                                      const EntityCounts& expected);

/// Collective; not to be called within a transaction. Every process reads an even share of the
/// file, in the order of ranks. Returns nothing on all processes if read_sol() would reject it, or
/// if its format is not suitable; text files require one row on each line. Throws std::bad_alloc on
/// all processes if one of them is out of memory.
[[nodiscard]] std::optional<SolFields> read_sol_share(const std::filesystem::path& path,
                                                      const EntityCounts& expected,
                                                      const ProcessGroup& group);

}  // namespace octetra
