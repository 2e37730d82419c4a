#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <octetra/core/field.hpp>

/// Medit's solution files, `.sol` in text and `.solb` in binary, which accompany a mesh and hold
/// values on its vertices and cells: scalars, vectors of 3 components, symmetric tensors of 6 and
/// full tensors of 9. Fields have no names in them.
namespace octetra {

/// Returns whether the path has the extension of a solution file.
[[nodiscard]] bool is_sol(const std::filesystem::path& path);

/// Returns the file to which fields are written with a mesh at `path`: `NAME.sol` for a Medit mesh
/// `NAME.mesh`, `NAME.solb` for `NAME.meshb`, none for other formats.
[[nodiscard]] std::optional<std::filesystem::path> sol_path_for(const std::filesystem::path& path);

/// Returns whether a solution file can hold this field exactly: fields of 1, 3, 6 or 9 components
/// can be held unless they are 64-bit integers.
[[nodiscard]] bool sol_can_hold(const FieldFacts& field);

/// Returns the position of this component in a row of a field with this many components. A
/// symmetric tensor is xx, yy, zz, xy, yz, xz as in VTK; Medit files store it column by column: xx,
/// xy, yy, xz, yz, zz.
[[nodiscard]] std::size_t sol_component_position(std::size_t component, std::size_t components);

/// Returns the name of the field with this number, counted from 1, in the list of the vertices or
/// of the cells: "sol_1" ...
[[nodiscard]] std::string sol_field_name(std::size_t number);

}  // namespace octetra
