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

/// Reading Medit's files of values, alone or together.
namespace octetra {

/// How many there are in the whole mesh.
struct EntityCounts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
};

/// Fields of vertices, or of cells: for each of these a row, with the values of all the fields.
struct FieldRows {
    FieldOn on = FieldOn::vertices;
    std::vector<std::size_t> components;  ///< of each field
    std::uint64_t count = 0;              ///< rows of the whole
    std::uint64_t first = 0;              ///< number of the first row that this process has
    std::vector<double> values;           ///< of its rows as the file has them; see place_in_sol()

    [[nodiscard]] std::size_t width() const {
        return std::accumulate(components.begin(), components.end(), std::size_t{0});
    }
};

struct SolFields {
    std::vector<FieldRows> lists;    ///< at most one of vertices and one of cells
    std::vector<std::string> notes;  ///< on what is not kept; one process alone is told
};

/// Reads all of a file. Values are finite, and less than coordinate_limit, so that means do not
/// overflow. Throws InputError "FILE:LINE: what is wrong", of a binary file "FILE: at byte N: ...",
/// also where there are not as many rows as `expected` says, if it does; or SystemError.
[[nodiscard]] SolFields read_sol(const std::filesystem::path& path,
                                 const std::optional<EntityCounts>& expected);

/// Collective. Every process reads an even share of the file, those of the first process first.
/// Returns nothing, on all processes, where read_sol() would refuse the file, or it is not in the
/// form that lends itself to it, of text a row on each line. A process that has no memory throws
/// std::bad_alloc, and all others get nothing: whoever calls must tell them.
[[nodiscard]] std::optional<SolFields> read_sol_stretch(const std::filesystem::path& path,
                                                        const EntityCounts& expected,
                                                        const ProcessGroup& group);

}  // namespace octetra
