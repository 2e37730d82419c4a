#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <octetra/core/features.hpp>

/// Keywords of the Medit format for sections other than the lists of a mesh.
namespace octetra {

/// Code of a keyword that exists only in text files.
inline constexpr std::int32_t no_code = -1;

/// A keyword of text files, and its code in binary files.
struct MeditKeyword {
    std::string_view keyword;
    std::int32_t code;
};

/// Sections of the features, in the order of all_features. Each entry is the number of an entity.
inline constexpr std::array<MeditKeyword, feature_count> feature_sections{
    {{"Corners", 13},
     {"RequiredVertices", 15},
     {"Ridges", 14},
     {"RequiredEdges", 16},
     {"RequiredTriangles", 17},
     {"RequiredTetrahedra", 12}}};

[[nodiscard]] inline const MeditKeyword& keyword_of(Feature feature) {
    return feature_sections.at(static_cast<std::size_t>(feature));
}
/// Returns the position of the feature section with this keyword or code, or feature_count if there
/// is none.
[[nodiscard]] std::size_t feature_with(auto MeditKeyword::*member, const auto& value) {
    const auto found = std::ranges::find(feature_sections, value, member);
    return static_cast<std::size_t>(found - feature_sections.begin());
}

/// Keywords of sections that are skipped, and the number of numbers per entry in text.
struct SkippedSection {
    std::string_view keyword;
    std::size_t numbers_per_entry;
    std::int32_t code;
};
inline constexpr std::array<SkippedSection, 14> skipped_sections{
    {{"Normals", 3, 60},
     {"NormalAtVertices", 2, 20},
     {"NormalAtTriangleVertices", 3, 21},
     {"Tangents", 3, 59},
     {"TangentAtVertices", 2, 61},
     {"SubDomainFromGeom", 4, 29},
     {"SubDomainFromMesh", 4, no_code},
     {"VertexOnGeometricVertex", 2, 31},
     {"VertexOnGeometricEdge", 3, 32},
     {"VertexOnGeometricTriangle", 4, 33},
     {"VertexOnGeometricQuadrilateral", 4, 34},
     {"EdgeOnGeometricEdge", 2, 35},
     {"ParallelTriangleCommunicators", 2, no_code},
     {"ParallelVertexCommunicators", 2, no_code}}};

/// Keywords of ParMmg without a count: numbers follow up to the next keyword.
inline constexpr std::array<std::string_view, 3> sections_without_count{
    {"NumberOfPartitions", "ParallelCommunicatorTriangles", "ParallelCommunicatorVertices"}};

/// Cells of other shapes. Some keywords have two spellings.
inline constexpr std::array<MeditKeyword, 6> other_cell_shapes{{{"Quadrilaterals", 7},
                                                                {"Hexahedra", 10},
                                                                {"Hexaedra", 10},
                                                                {"Prisms", 9},
                                                                {"Pentahedra", 9},
                                                                {"Pyramids", 49}}};

inline constexpr std::array<MeditKeyword, 3> second_order_sections{
    {{"TetrahedraP2", 30}, {"TrianglesP2", 24}, {"EdgesP2", 25}}};
/// Message for a section of second-order elements.
inline constexpr std::string_view no_second_order =
    "second-order elements ({}) are not supported: generate the mesh with first-order elements, "
    "in Gmsh with -order 1";

}  // namespace octetra
