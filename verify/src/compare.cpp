#include <octetra/verify/compare.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <octetra/core/standard_arithmetic.hpp>

#include "snap_vertices.hpp"

namespace octetra::verify {
namespace {

/// An identification of a vertex that does not depend on its number.
using Colour = std::uint64_t;
using Colours = IndexVector<VertexIndex, Colour>;

std::uint64_t scramble(std::uint64_t x) {
    x = (x ^ (x >> 32U)) * 0xd6e8feb86659fd93U;
    x = (x ^ (x >> 32U)) * 0xd6e8feb86659fd93U;
    return x ^ (x >> 32U);
}

Colour colour_of(const Mesh& mesh, VertexIndex v) {
    Colour colour = 0;
    const auto mix = [&](double value) {
        colour = scramble(colour ^ std::bit_cast<std::uint64_t>(value + 0.0));  // -0 as 0
    };
    const Point& p = mesh.points[v];
    mix(p.x);
    mix(p.y);
    mix(p.z);
    return colour;
}

bool has_coincident_vertices(const Mesh& mesh) {
    std::vector<Point> points(mesh.points.begin(), mesh.points.end());
    std::sort(points.begin(), points.end());
    return std::adjacent_find(points.begin(), points.end()) != points.end();
}

/// Adds to each vertex's colour the colours of the cells around it, independent of their order.
Colours spread(const Colours& colours, const Mesh& mesh) {
    Colours next = colours;
    for (const CellVertices& cell : mesh.cells) {
        std::uint64_t sum = 0;
        for (const VertexIndex v : cell) sum += scramble(colours[v]);
        for (const VertexIndex v : cell) next[v] += scramble(sum);
    }
    return next;
}

Colours colours_of(const Mesh& mesh, bool separate_coincident) {
    Colours colours;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        colours.push_back(colour_of(mesh, v));
    }
    for (int round = 0; separate_coincident && round < 3; ++round) {
        colours = spread(colours, mesh);
    }
    return colours;
}

/// An entity of N vertices in a form that does not depend on the numbering.
template <std::size_t N>
struct Item {
    std::array<Colour, N> colours{};  ///< in the order of corners
    std::array<Point, N> corners;     ///< ascending
    bool turned = false;              ///< for a cell: an odd permutation of that order
    Marker marker = 0;
    std::vector<double> attributes;
    unsigned features = 0;  ///< bit set of features

    [[nodiscard]] auto place() const { return std::tie(corners, colours); }
    [[nodiscard]] auto tags() const { return std::tie(turned, marker, features); }
};

/// Comparison by value: -0 equals 0, and NaN equals itself and follows all numbers.
bool is_less(double a, double b) { return a < b || (!std::isnan(a) && std::isnan(b)); }
bool is_equal(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool are_equal(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_equal);
}

template <std::size_t N>
bool precedes(const Item<N>& a, const Item<N>& b) {
    if (a.corners != b.corners) return a.corners < b.corners;
    if (a.colours != b.colours) return a.colours < b.colours;
    if (a.turned != b.turned) return b.turned;
    if (a.marker != b.marker) return a.marker < b.marker;
    if (!are_equal(a.attributes, b.attributes)) {
        return std::lexicographical_compare(a.attributes.begin(), a.attributes.end(),
                                            b.attributes.begin(), b.attributes.end(), is_less);
    }
    return a.features < b.features;
}

template <std::size_t N>
Item<N> item_of(const std::array<VertexIndex, N>& vertices, const Mesh& mesh,
                const Colours& colours) {
    std::array<std::pair<Point, Colour>, N> corners;
    for (std::size_t k = 0; k < N; ++k) {
        corners[k] = {mesh.points[vertices[k]], colours[vertices[k]]};
    }
    Item<N> item;
    for (std::size_t i = 1; i < N; ++i) {  // insertion sort, counting exchanges
        for (std::size_t k = i; k > 0 && corners[k] < corners[k - 1]; --k) {
            std::swap(corners[k], corners[k - 1]);
            item.turned = !item.turned;
        }
    }
    for (std::size_t k = 0; k < N; ++k) {
        item.corners[k] = corners[k].first;
        item.colours[k] = corners[k].second;
    }
    return item;
}

template <std::size_t N>
void mark_features(const Mesh& mesh, std::vector<Item<N>>& items) {
    constexpr std::size_t dimension = N - 1;
    for (const Feature f : all_features) {
        if (dimension_of(f) != dimension) continue;
        for (const std::uint64_t i : mesh.features[f]) {
            items[i].features |= 1U << static_cast<unsigned>(f);
        }
    }
}

template <class I, std::size_t N>
std::vector<Item<N>> items_of(const IndexVector<I, std::array<VertexIndex, N>>& list,
                              const IndexVector<I, Marker>& markers, const Mesh& mesh,
                              const Colours& colours) {
    std::vector<Item<N>> items;
    items.reserve(list.size());
    for (I i{0}; i < list.end_index(); ++i) {
        items.push_back(item_of(list[i], mesh, colours));
        if (N != 4) items.back().turned = false;  // facets and edges have no orientation
        if (!markers.empty()) items.back().marker = markers[i];
    }
    mark_features(mesh, items);
    return items;
}

std::vector<Item<1>> vertices_of(const Mesh& mesh, const Colours& colours) {
    std::vector<Item<1>> items;
    items.reserve(mesh.points.size());
    const auto count = static_cast<std::ptrdiff_t>(mesh.attributes_per_point);
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        items.push_back(item_of<1>({v}, mesh, colours));
        if (!mesh.point_markers.empty()) items.back().marker = mesh.point_markers[v];
        const auto first = mesh.point_attributes.begin() + count * std::ptrdiff_t{v.value()};
        items.back().attributes.assign(first, first + count);
    }
    mark_features(mesh, items);
    return items;
}

template <std::size_t N>
std::string shown(const Item<N>& item, std::string_view tag, bool with_turn = false) {
    std::string text = fmt::format("{} {}", tag, item.marker);
    if (with_turn) text += item.turned ? ", corners in odd order" : ", corners in even order";
    if (!item.attributes.empty()) {
        text += fmt::format(", attributes {}", fmt::join(item.attributes, ", "));
    }
    constexpr std::array<std::string_view, feature_count> words{
        ", corner", ", required", ", ridge", ", required", ", required", ", required"};
    for (const Feature f : all_features) {
        const auto bit = static_cast<unsigned>(f);
        if ((item.features >> bit & 1U) != 0) text += words.at(bit);
    }
    return text;
}

class Comparer {
public:
    Comparer(Comparison& result, std::size_t kept) : result_(result), kept_(kept) {}

    /// Merges the sorted lists and reports items that are not in both.
    template <std::size_t N>
    void compare(std::vector<Item<N>> a, std::vector<Item<N>> b, std::string_view kind,
                 std::string_view tag) {
        std::sort(a.begin(), a.end(), precedes<N>);
        std::sort(b.begin(), b.end(), precedes<N>);
        kept_of_kind_ = 0;
        std::size_t i = 0;
        std::size_t k = 0;
        while (i < a.size() || k < b.size()) {
            const bool only_a = k == b.size() || (i < a.size() && a[i].place() < b[k].place());
            const bool only_b = !only_a && (i == a.size() || b[k].place() < a[i].place());
            if (only_a) {
                report(kind, a[i], shown(a[i], tag), "absent");
                ++i;
            } else if (only_b) {
                report(kind, b[k], "absent", shown(b[k], tag));
                ++k;
            } else {
                if (a[i].tags() != b[k].tags() || !are_equal(a[i].attributes, b[k].attributes)) {
                    const bool turned = a[i].turned != b[k].turned;
                    report(kind, a[i], shown(a[i], tag, turned), shown(b[k], tag, turned));
                }
                ++i;
                ++k;
            }
        }
    }

private:
    template <std::size_t N>
    void report(std::string_view kind, const Item<N>& item, std::string in_a, std::string in_b) {
        ++result_.difference_count;
        if (kept_of_kind_++ >= kept_) return;
        result_.differences.push_back({std::string(kind),
                                       {item.corners.begin(), item.corners.end()},
                                       std::move(in_a),
                                       std::move(in_b)});
    }

    Comparison& result_;
    std::size_t kept_;
    std::size_t kept_of_kind_ = 0;
};

/// The integers of a mesh other than tags and the index base.
auto lists_of(const Mesh& mesh) {
    return std::tie(mesh.attributes_per_point, mesh.cells, mesh.facets, mesh.edges, mesh.features);
}

/// Calls compare(tags of a, tags of b) for each list of markers or region tags, while it is true.
bool all_tags(const Mesh& a, const Mesh& b, auto&& compare) {
    return compare(a.point_markers, b.point_markers) && compare(a.regions, b.regions) &&
           compare(a.facet_markers, b.facet_markers) && compare(a.edge_markers, b.edge_markers);
}

/// Whether two lists of tags are equal if a list that is absent stands for zeros.
bool are_equal_tags(const auto& a, const auto& b) {
    const auto are_zeros = [](const auto& tags) {
        return std::ranges::all_of(tags, [](Marker tag) { return tag == 0; });
    };
    return a == b || (a.empty() && are_zeros(b)) || (b.empty() && are_zeros(a));
}

bool are_reals_equal(const Mesh& a, const Mesh& b) {
    return a.points == b.points && are_equal(a.point_attributes, b.point_attributes);
}

/// Returns whether all zeros have equal signs in two meshes whose numbers compare equal.
bool have_zeros_same_signs(const Mesh& a, const Mesh& b) {
    const auto same = [](double x, double y) {
        return std::isnan(x) || std::signbit(x) == std::signbit(y);
    };
    const auto same_point = [&](const Point& p, const Point& q) {
        return same(p.x, q.x) && same(p.y, q.y) && same(p.z, q.z);
    };
    return std::equal(a.points.begin(), a.points.end(), b.points.begin(), same_point) &&
           std::equal(a.point_attributes.begin(), a.point_attributes.end(),
                      b.point_attributes.begin(), same);
}

}  // namespace

Comparison compare(const Mesh& a, const Mesh& b, std::size_t kept) {
    const StandardArithmetic standard;
    Comparison result;
    if (lists_of(a) == lists_of(b) && are_reals_equal(a, b) &&
        all_tags(a, b, [](const auto& x, const auto& y) { return are_equal_tags(x, y); })) {
        result.index_base_differs = a.index_base != b.index_base;
        result.signs_of_zeros_differ = !have_zeros_same_signs(a, b);
        result.zero_tags_differ =
            !all_tags(a, b, [](const auto& x, const auto& y) { return x == y; });
        if (result.index_base_differs || result.signs_of_zeros_differ || result.zero_tags_differ) {
            result.likeness = Likeness::up_to_numbering;
        }
        return result;
    }
    const bool coincident = has_coincident_vertices(a) || has_coincident_vertices(b);
    const Colours of_a = colours_of(a, coincident);
    const Colours of_b = colours_of(b, coincident);
    Comparer comparer(result, kept);
    comparer.compare(vertices_of(a, of_a), vertices_of(b, of_b), "vertex", "marker");
    comparer.compare(items_of(a.cells, a.regions, a, of_a), items_of(b.cells, b.regions, b, of_b),
                     "cell", "region");
    comparer.compare(items_of(a.facets, a.facet_markers, a, of_a),
                     items_of(b.facets, b.facet_markers, b, of_b), "facet", "marker");
    comparer.compare(items_of(a.edges, a.edge_markers, a, of_a),
                     items_of(b.edges, b.edge_markers, b, of_b), "edge", "marker");
    result.likeness =
        result.difference_count == 0 ? Likeness::up_to_numbering : Likeness::different;
    return result;
}

Comparison compare_within(double tolerance, const Mesh& a, Mesh b, std::size_t kept) {
    const StandardArithmetic standard;
    const double greatest = snap_vertices(b, a, tolerance);
    Comparison result = compare(a, b, kept);
    result.greatest_distance = greatest;
    return result;
}

}  // namespace octetra::verify
