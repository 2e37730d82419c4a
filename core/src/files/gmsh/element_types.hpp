#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Element types by the numbers that Gmsh assigns to them.
namespace octetra::gmsh {

/// The size of a node in a binary file of versions 2 to 2.2.
inline constexpr std::size_t node_bytes_2 = sizeof(std::int32_t) + 3 * sizeof(double);

inline constexpr std::uint64_t line_type = 1;
inline constexpr std::uint64_t triangle_type = 2;
inline constexpr std::uint64_t tetrahedron_type = 4;

enum class Shape {
    point,
    line,
    triangle,
    quadrangle,
    tetrahedron,
    hexahedron,
    prism,
    pyramid,
};
inline constexpr std::size_t shape_count = 8;

struct ElementType {
    Shape shape;
    std::uint32_t nodes;
};

/// Returns the shape and the number of nodes of a type, or nothing for a type whose number of nodes
/// is unknown.
[[nodiscard]] std::optional<ElementType> element_type(std::uint64_t number);

/// Returns the reason why a file with elements of this type cannot be read, or an empty string.
[[nodiscard]] std::string refusal_of_type(std::uint64_t number);

/// Returns whether both nodes of a line are the same. Gmsh writes such lines for a curve that is a
/// single point.
template <std::size_t N>
[[nodiscard]] bool is_degenerate_line(const std::array<std::uint64_t, N>& nodes) {
    return N == 2 && nodes.front() == nodes.back();
}

/// Returns "tetrahedra" etc.
[[nodiscard]] std::string_view plural(Shape shape);

/// Returns whether the shape is three-dimensional.
[[nodiscard]] inline bool is_solid(Shape shape) { return shape >= Shape::tetrahedron; }

}  // namespace octetra::gmsh
