#pragma once

#include <array>
#include <cstddef>
#include <string_view>

/// Keywords of the Medit format that begin sections of other kinds than a mesh is made of.
namespace octetra {

/// Keywords whose entries are read over, and how many numbers each entry has.
struct SkippedSection {
    std::string_view keyword;
    std::size_t numbers_per_entry;
};
inline constexpr std::array<SkippedSection, 13> skipped_sections{{{"Corners", 1},
                                                                  {"RequiredVertices", 1},
                                                                  {"Ridges", 1},
                                                                  {"RequiredEdges", 1},
                                                                  {"RequiredTriangles", 1},
                                                                  {"RequiredTetrahedra", 1},
                                                                  {"Normals", 3},
                                                                  {"NormalAtVertices", 2},
                                                                  {"NormalAtTriangleVertices", 3},
                                                                  {"Tangents", 3},
                                                                  {"TangentAtVertices", 2},
                                                                  {"SubDomainFromGeom", 4},
                                                                  {"SubDomainFromMesh", 4}}};

inline constexpr std::array<std::string_view, 6> other_cell_shapes{
    "Quadrilaterals", "Hexahedra", "Hexaedra", "Prisms", "Pentahedra", "Pyramids"};

inline constexpr std::array<std::string_view, 3> second_order_sections{"TetrahedraP2",
                                                                       "TrianglesP2", "EdgesP2"};

}  // namespace octetra
