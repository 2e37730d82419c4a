#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

/// Are two meshes the same?
namespace octetra::verify {

enum class Likeness : std::uint8_t {
    identical,        ///< entity by entity, number by number, with the same signs of zeros
    up_to_numbering,  ///< the same vertices, cells, tags and lists, of equal values, with other
                      ///< numbers or other signs of zeros
    different,
};

/// Something that one mesh has and the other has not, or has with another tag.
struct Difference {
    std::string kind;            ///< "vertex", "cell", "facet" or "edge"
    std::vector<Point> corners;  ///< where it is
    std::string in_a;            ///< what it is there: "absent", "region 2", ...
    std::string in_b;
};

struct Comparison {
    Likeness likeness = Likeness::identical;
    /// They would be identical if both counted from the same number.
    bool only_index_base_differs = false;
    /// They would be identical if coordinates and attributes that are -0 were 0.
    bool only_signs_of_zeros_differ = false;
    std::uint64_t difference_count = 0;
    std::vector<Difference> differences;  ///< the first of each kind, in order of coordinates
};

/// Compares two meshes that satisfy the first line of the invariants of struct Mesh (indices in
/// range, coordinates finite). Vertices are told apart by coordinates (-0 equals 0), markers and
/// attributes; where that does not do, by their neighbours' neighbours' neighbours. Of a cell the
/// order of corners matters as far as it turns it over. Up to `kept` differences of each kind are
/// described, all are counted.
[[nodiscard]] Comparison compare(const Mesh& a, const Mesh& b, std::size_t kept = 10);

}  // namespace octetra::verify
