#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <octetra/core/field.hpp>

/// Medit's files of values, `.sol` in text and `.solb` in binary, which stand beside a mesh and
/// have values of its vertices and cells: scalars, vectors of 3 components, symmetric tensors of 6
/// and full ones of 9. They have no names for them.
namespace octetra {

/// Has this file the extension of such files?
[[nodiscard]] bool is_sol(const std::filesystem::path& path);

/// The file that fields go to when a mesh is written at `path`: of a Medit mesh `NAME.sol` beside
/// `NAME.mesh`, or `NAME.solb` beside `NAME.meshb`; of all others none.
[[nodiscard]] std::optional<std::filesystem::path> sol_beside(const std::filesystem::path& path);

/// Can such a file hold this field, to the bit? Those of 1, 3, 6 or 9 components can be held but
/// for whole numbers of 64 bits.
[[nodiscard]] bool sol_can_hold(const FieldFacts& field);

/// Where in the row of a field of so many components this one stands. A symmetric tensor is xx, yy,
/// zz, xy, yz, xz as in VTK, and in Medit's files column by column, xx, xy, yy, xz, yz, zz.
[[nodiscard]] std::size_t place_in_sol(std::size_t component, std::size_t components);

/// What the field of vertices, or of cells, is called that is the number-th in its list, counted
/// from 1: "sol_1" ...
[[nodiscard]] std::string name_in_sol(std::size_t number);

}  // namespace octetra
