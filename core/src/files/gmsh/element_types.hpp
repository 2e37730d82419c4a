#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// The kinds of elements that Gmsh numbers.
namespace octetra::gmsh {

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

/// What is known of a type; nothing of one whose number of nodes is not known.
[[nodiscard]] std::optional<ElementType> element_type(std::uint64_t number);

/// Why a file cannot be read if it has elements of this type; else nothing.
[[nodiscard]] std::string refusal_of_type(std::uint64_t number);

/// Has a line the same node twice? Gmsh makes such lines where a curve is a single point.
template <std::size_t N>
[[nodiscard]] bool is_degenerate_line(const std::array<std::uint64_t, N>& nodes) {
    return N == 2 && nodes.front() == nodes.back();
}

/// "tetrahedra"
[[nodiscard]] std::string_view plural(Shape shape);

/// Does a cell have this shape, a tetrahedron or any other?
[[nodiscard]] inline bool is_solid(Shape shape) { return shape >= Shape::tetrahedron; }

}  // namespace octetra::gmsh
