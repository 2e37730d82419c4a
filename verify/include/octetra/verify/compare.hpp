#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

/// Comparison of two meshes, up to the numbering of their entities.
namespace octetra::verify {

enum class Likeness : std::uint8_t {
    identical,        ///< equal entity by entity, including the signs of zeros
    up_to_numbering,  ///< the same vertices, cells, tags and lists, with equal values, but
                      ///< different numbering or signs of zeros
    different,
};

/// An entity that only one of the meshes has, or that has different tags in them.
struct Difference {
    std::string kind;            ///< "vertex", "cell", "facet" or "edge"
    std::vector<Point> corners;  ///< coordinates of its vertices
    std::string in_a;            ///< its state there: "absent", "region 2", ...
    std::string in_b;
};

struct Comparison {
    Likeness likeness = Likeness::identical;
    /// The differences of meshes that are the same up to numbering, if there are no others:
    bool index_base_differs = false;     ///< the first number in files
    bool signs_of_zeros_differ = false;  ///< of coordinates or attributes
    bool zero_tags_differ = false;       ///< one has a list of tags that are all 0, the other none
    /// The greatest distance between vertices that the tolerance has made equal.
    double greatest_distance = 0;
    std::uint64_t difference_count = 0;
    std::vector<Difference> differences;  ///< the first ones of each kind, by coordinates
};

/// Compares two meshes that satisfy the first invariant of struct Mesh (indices in range,
/// coordinates finite). Vertices are matched by coordinates (-0 equals 0), markers and attributes;
/// vertices for which these coincide, by their neighbourhood up to distance three. The order of a
/// cell's corners matters only up to even permutations. All differences are counted; up to `kept`
/// of each kind are described.
[[nodiscard]] Comparison compare(const Mesh& a, const Mesh& b, std::size_t kept = 10);

/// The same after each vertex of `b` has been moved to the nearest vertex of `a`, if their distance
/// is at most `tolerance` (finite, 0 or more). Attributes are compared without a tolerance.
[[nodiscard]] Comparison compare_within(double tolerance, const Mesh& a, Mesh b,
                                        std::size_t kept = 10);

}  // namespace octetra::verify
