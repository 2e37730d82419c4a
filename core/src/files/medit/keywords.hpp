#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// Keywords of the Medit format that begin sections of other kinds than a mesh is made of.
namespace octetra {

/// Of a keyword that only text files have.
inline constexpr std::int32_t no_code = -1;

/// A keyword as text files have it, and its code in binary ones.
struct MeditKeyword {
    std::string_view keyword;
    std::int32_t code;
};

/// Keywords whose entries are read over, and how many numbers each entry has in text.
struct SkippedSection {
    std::string_view keyword;
    std::size_t numbers_per_entry;
    std::int32_t code;
};
inline constexpr std::array<SkippedSection, 13> skipped_sections{
    {{"Corners", 1, 13},
     {"RequiredVertices", 1, 15},
     {"Ridges", 1, 14},
     {"RequiredEdges", 1, 16},
     {"RequiredTriangles", 1, 17},
     {"RequiredTetrahedra", 1, 12},
     {"Normals", 3, 60},
     {"NormalAtVertices", 2, 20},
     {"NormalAtTriangleVertices", 3, 21},
     {"Tangents", 3, 59},
     {"TangentAtVertices", 2, 61},
     {"SubDomainFromGeom", 4, 29},
     {"SubDomainFromMesh", 4, no_code}}};

/// Of some there are two spellings.
inline constexpr std::array<MeditKeyword, 6> other_cell_shapes{{{"Quadrilaterals", 7},
                                                                {"Hexahedra", 10},
                                                                {"Hexaedra", 10},
                                                                {"Prisms", 9},
                                                                {"Pentahedra", 9},
                                                                {"Pyramids", 49}}};

inline constexpr std::array<MeditKeyword, 3> second_order_sections{
    {{"TetrahedraP2", 30}, {"TrianglesP2", 24}, {"EdgesP2", 25}}};

}  // namespace octetra
