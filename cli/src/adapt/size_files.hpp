#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/background.hpp>
#include <octetra/distributed/field.hpp>

#include "script/read_script.hpp"

namespace octetra::cli {

/// The fields of the current mesh, and those of background meshes.
struct CarriedFields {
    std::vector<distributed::Field> all;
    std::size_t sizes = 0;  ///< the number of fields at the end that files of --size have
    std::vector<distributed::Background> backgrounds;

    /// The fields that results have: all but those of --size.
    [[nodiscard]] std::span<const distributed::Field> written() const {
        return std::span(all).first(all.size() - sizes);
    }
};

inline constexpr std::string_view reference_lacks_size_files =
    "--size with a file cannot be combined with --engine reference, which has no fields: omit it; "
    "the default engine makes the same mesh";

/// Returns whether a step has --size FILE.
[[nodiscard]] bool has_size_file(const Script& script);

/// Collective. Appends the fields and background meshes of the files that the steps pass to --size;
/// each has the name of its file. Throws InputError for a file that does not fit the mesh or has
/// another number of fields than one, for a background mesh with a size that is not above 0, and if
/// the mesh has a field of this name.
void read_size_files(const distributed::AdaptiveMesh& mesh, const Script& script,
                     CarriedFields& fields);

}  // namespace octetra::cli
