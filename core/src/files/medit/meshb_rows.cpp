#include "files/medit/meshb_rows.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "files/input/fields.hpp"
#include "files/medit/keywords.hpp"

namespace octetra {
namespace {

/// The number types and the byte order of a version.
template <class IntegerType, class RealType, bool is_swapped>
struct MeshbNumbers {
    using Integer = IntegerType;
    using Real = RealType;

    static constexpr std::size_t point_size = 3 * sizeof(Real) + sizeof(Integer);
    template <std::size_t N>
    static constexpr std::size_t entity_size = (N + 1) * sizeof(Integer);

    static double real(const std::byte* row, std::size_t k) {
        return double{number_at<Real>(row + k * sizeof(Real), is_swapped)};
    }
    static Integer integer(const std::byte* row, std::size_t k) {
        return number_at<Integer>(row + k * sizeof(Integer), is_swapped);
    }
    static Integer point_reference(const std::byte* row) {
        return number_at<Integer>(row + 3 * sizeof(Real), is_swapped);
    }
};

/// Calls work(MeshbNumbers<...>{}) with the types of this format.
template <bool swapped>
void with_numbers(std::int32_t version, auto&& work) {
    switch (version) {
        case 1: return work(MeshbNumbers<std::int32_t, float, swapped>{});
        case 4: return work(MeshbNumbers<std::int64_t, double, swapped>{});
        default: return work(MeshbNumbers<std::int32_t, double, swapped>{});
    }
}
void with_numbers(const MeshbFormat& format, auto&& work) {
    if (format.swapped) return with_numbers<true>(format.version, work);
    with_numbers<false>(format.version, work);
}

bool can_be_coordinate(double x) { return std::abs(x) < coordinate_limit; }  // false for NaN

template <class Integer>
bool is_reference(Integer reference) {
    return reference >= std::numeric_limits<Marker>::min() &&
           reference <= std::numeric_limits<Marker>::max();
}

/// Sets points and markers, whatever the rows contain, and returns whether all rows are valid.
template <class Numbers>
bool take_points(const std::byte* row, std::span<Point> points, Marker* marker) {
    unsigned good = 1;  // avoids a branch for each row
    for (Point& point : points) {
        point = {Numbers::real(row, 0), Numbers::real(row, 1), Numbers::real(row, 2)};
        const auto reference = Numbers::point_reference(row);
        good &= unsigned{can_be_coordinate(point.x)} & unsigned{can_be_coordinate(point.y)} &
                unsigned{can_be_coordinate(point.z)} & unsigned{is_reference(reference)};
        *marker++ = static_cast<Marker>(reference);
        row += Numbers::point_size;
    }
    return good != 0;
}

/// As above, for entities of a file with this many vertices.
template <class Numbers, std::size_t N>
bool take_entities(const std::byte* row, std::uint64_t vertex_count,
                   std::span<std::array<VertexIndex, N>> entities, Marker* marker) {
    bool good = true;
    for (auto& vertices : entities) {
        for (std::size_t k = 0; k < N; ++k) {
            // Zero and negative numbers wrap around.
            const auto index = static_cast<std::uint64_t>(Numbers::integer(row, k)) - 1;
            good &= index < vertex_count;
            vertices[k] = VertexIndex{static_cast<VertexIndex::Value>(index)};
        }
        const auto reference = Numbers::integer(row, N);
        good &= is_reference(reference);
        *marker++ = static_cast<Marker>(reference);
        row += Numbers::template entity_size<N>;
    }
    return good;
}

std::string wrong_reference(std::string_view what, std::int64_t reference) {
    return fmt::format("{} should be a whole number of 32 bits, not {}", what, reference);
}

template <class List>
auto grow(List& list, std::size_t count) {
    const std::size_t before = list.size();
    list.resize(before + count);
    return std::span(list).subspan(before);
}

template <std::size_t N>
constexpr Listed listed = N == 4   ? Listed::cells
                          : N == 3 ? Listed::facets
                                   : Listed::edges;

}  // namespace

const MeshbSection& MeshbRows::section(Listed list) const {
    switch (list) {
        case Listed::cells: return lists_->tetrahedra;
        case Listed::facets: return lists_->triangles;
        case Listed::edges: break;
    }
    return lists_->edges;
}

void MeshbRows::fail_entry(Listed list, std::uint64_t entry, std::string_view what) const {
    const std::size_t vertices = list == Listed::cells ? 4 : list == Listed::facets ? 3 : 2;
    reader_->fail(fmt::format("{} {} of this section: {}", entry_name(list), entry + 1, what),
                  section(list).rows_at + entry * lists_->format.entity_size(vertices));
}

void MeshbRows::append_points(std::uint64_t first, std::uint64_t count, Mesh& mesh) {
    with_numbers(lists_->format,
                 [&]<class Numbers>(Numbers) { append_points_of<Numbers>(first, count, mesh); });
}

template <class Numbers>
void MeshbRows::append_points_of(std::uint64_t first, std::uint64_t count, Mesh& mesh) {
    constexpr std::size_t row_size = Numbers::point_size;
    reader_->seek(lists_->vertices.rows_at + first * row_size);
    while (count > 0) {
        const auto rows = reader_->take_rows(count, row_size, "a vertex");
        const std::size_t some = rows.size() / row_size;
        const auto points = grow(mesh.points, some);
        const auto markers = grow(mesh.point_markers, some);
        if (!take_points<Numbers>(rows.data(), points, markers.data())) {
            refuse_point<Numbers>(rows.data(), first);
        }
        first += some;
        count -= some;
    }
}

/// Throws for the first invalid row, at least one of which exists; the first row is number `first`.
template <class Numbers>
void MeshbRows::refuse_point(const std::byte* row, std::uint64_t first) const {
    const auto fail = [&](const std::string& what) {
        reader_->fail(fmt::format("vertex {} of this section: {}", first + 1, what),
                      lists_->vertices.rows_at + first * Numbers::point_size);
    };
    for (;; row += Numbers::point_size, ++first) {
        constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
        for (std::size_t k = 0; k < names.size(); ++k) {
            const double number = Numbers::real(row, k);
            if (!std::isfinite(number)) fail(not_finite(names[k], fmt::format("{}", number)));
            if (!can_be_coordinate(number)) fail(too_large(names[k], fmt::format("{}", number)));
        }
        const auto reference = Numbers::point_reference(row);
        if (!is_reference(reference)) fail(wrong_reference("the vertex's reference", reference));
    }
}

template <class I, std::size_t N>
void MeshbRows::append(const EntityKind<I, N>& kind, std::uint64_t first, std::uint64_t count,
                       Mesh& mesh) {
    with_numbers(lists_->format,
                 [&]<class Numbers>(Numbers) { append_of<Numbers>(kind, first, count, mesh); });
}

template <class Numbers, class I, std::size_t N>
void MeshbRows::append_of(const EntityKind<I, N>& kind, std::uint64_t first, std::uint64_t count,
                          Mesh& mesh) {
    constexpr std::size_t row_size = Numbers::template entity_size<N>;
    reader_->seek(section(listed<N>).rows_at + first * row_size);
    while (count > 0) {
        const auto rows = reader_->take_rows(count, row_size, "an entry");
        const std::size_t some = rows.size() / row_size;
        const auto entities = grow(mesh.*kind.list, some);
        const auto markers = grow(mesh.*kind.markers, some);
        if (!take_entities<Numbers, N>(rows.data(), lists_->vertices.count, entities,
                                       markers.data())) {
            refuse_entity<Numbers, N>(rows.data(), first);
        }
        first += some;
        count -= some;
    }
}

template <class Numbers, std::size_t N>
void MeshbRows::refuse_entity(const std::byte* row, std::uint64_t first) const {
    for (;; row += Numbers::template entity_size<N>, ++first) {
        for (std::size_t k = 0; k < N; ++k) {
            const std::int64_t number = Numbers::integer(row, k);
            if (number >= 1 && static_cast<std::uint64_t>(number) <= lists_->vertices.count) {
                continue;
            }
            fail_entry(listed<N>, first, no_such_vertex(number, lists_->vertices.count));
        }
        const std::int64_t reference = Numbers::integer(row, N);
        if (!is_reference(reference)) {
            fail_entry(listed<N>, first, wrong_reference("the reference", reference));
        }
    }
}

void MeshbRows::append_numbers(Feature feature, std::uint64_t first, std::uint64_t count,
                               std::vector<std::uint64_t>& numbers) {
    with_numbers(lists_->format, [&]<class Numbers>(Numbers) {
        append_numbers_of<Numbers>(feature, first, count, numbers);
    });
}

template <class Numbers>
void MeshbRows::append_numbers_of(Feature feature, std::uint64_t first, std::uint64_t count,
                                  std::vector<std::uint64_t>& numbers) {
    constexpr std::size_t row_size = sizeof(typename Numbers::Integer);
    const Numbered numbered = numbered_by(feature, counts_of(*lists_));
    const std::uint64_t begin = lists_->features[feature].rows_at;
    reader_->seek(begin + first * row_size);
    while (count > 0) {
        const auto rows = reader_->take_rows(count, row_size, "an entry");
        for (const std::byte* row = rows.data(); row != rows.data() + rows.size();
             row += row_size, ++first, --count) {
            const std::int64_t number = Numbers::integer(row, 0);
            if (number < 1 || static_cast<std::uint64_t>(number) > numbered.count) {
                reader_->fail(
                    fmt::format("entry {} of {}: {}", first + 1, keyword_of(feature).keyword,
                                no_such_entity(numbered, number)),
                    begin + first * row_size);
            }
            numbers.push_back(static_cast<std::uint64_t>(number) - 1);
        }
    }
}

template void MeshbRows::append(const EntityKind<CellIndex, 4>&, std::uint64_t, std::uint64_t,
                                Mesh&);
template void MeshbRows::append(const EntityKind<FacetIndex, 3>&, std::uint64_t, std::uint64_t,
                                Mesh&);
template void MeshbRows::append(const EntityKind<EdgeIndex, 2>&, std::uint64_t, std::uint64_t,
                                Mesh&);

}  // namespace octetra
