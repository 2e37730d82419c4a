#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/exact_value.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Compares marks by indicators with those of one process that has all indicators.
namespace octetra::distributed {
namespace {

using test::exact_unit;
using test::exact_value;
using test::Whole;
using testing::HasSubstr;

using Marks = std::vector<std::uint8_t>;
using Indicators = std::vector<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double greatest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

// ---- by one process
// -------------------------------------------------------------------------------

Marks marked_from(const Indicators& all, double threshold) {
    Marks marks;
    for (const double indicator : all) marks.push_back(indicator >= threshold ? 1 : 0);
    return marks;
}

/// The cells with the `count` greatest indicators, and ties; none whose indicator is 0.
Marks largest(const Indicators& all, std::size_t count) {
    if (count == 0) return Marks(all.size(), 0);
    Indicators sorted = all;
    std::ranges::sort(sorted, std::greater<>());
    return marked_from(all, std::max(sorted[count - 1], least));
}

Marks bulk_of(const Indicators& all, double theta) {
    Indicators sorted = all;
    std::ranges::sort(sorted, std::greater<>());
    Whole total = 0;
    for (const double indicator : all) total += exact_value(indicator);
    const Whole needed = total * exact_value(theta);
    Whole sum = 0;
    std::size_t count = 0;
    while ((sum << exact_unit) < needed) sum += exact_value(sorted[count++]);
    return largest(all, count);
}

Marks maximum_of(const Indicators& all, double share) {
    const double most = all.empty() ? 0 : *std::ranges::max_element(all);
    return marked_from(all, std::max(share * most, least));
}

Marks fraction_of(const Indicators& all, double fraction) {
    const double count = std::ceil(fraction * static_cast<double>(all.size()));
    return largest(all, static_cast<std::size_t>(count));
}

// ---- by all
// ---------------------------------------------------------------------------------------

/// The process of each cell.
using CellRanks = std::vector<int>;

CellRanks at_random(std::size_t cells, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    CellRanks cell_to_rank(cells);
    const auto size = static_cast<std::uint64_t>(test::world().size());
    std::ranges::generate(cell_to_rank, [&] { return static_cast<int>(random() % size); });
    return cell_to_rank;
}

CellRanks all_to(int rank, std::size_t cells) { return CellRanks(cells, rank); }

/// Cells in blocks of numbers; every other process has none.
CellRanks in_blocks(std::size_t cells) {
    const std::size_t with_cells = static_cast<std::size_t>(test::world().size() + 1) / 2;
    CellRanks cell_to_rank(cells);
    for (std::size_t c = 0; c < cells; ++c) {
        cell_to_rank[c] = 2 * static_cast<int>(c * with_cells / cells);
    }
    return cell_to_rank;
}

using Mark = std::vector<std::uint8_t> (*)(const Communicator&, std::span<const double>, double);

/// Collective. The marks of all cells, when they are dealt in this way.
Marks marked_by_all(Mark mark, const Indicators& all, const CellRanks& cell_to_rank,
                    double parameter) {
    const Communicator& world = test::world();
    Indicators own;
    std::vector<std::size_t> cells;
    for (std::size_t c = 0; c < all.size(); ++c) {
        if (cell_to_rank[c] != world.rank()) continue;
        own.push_back(all[c]);
        cells.push_back(c);
    }
    const Marks marks = mark(world, own, parameter);
    EXPECT_EQ(marks.size(), own.size());
    std::vector<std::uint64_t> of_all(all.size(), 0);
    for (std::size_t k = 0; k < marks.size(); ++k) of_all[cells[k]] = 1U + marks[k];
    world.sum(of_all);
    Marks result;
    for (const std::uint64_t m : of_all) result.push_back(static_cast<std::uint8_t>(m - 1));
    return result;
}

struct Way {
    const char* name;
    Mark mark;
    Marks (*expected)(const Indicators& all, double parameter);
};
constexpr std::array<Way, 3> ways{Way{"bulk", mark_bulk, bulk_of},
                                  {"maximum", mark_maximum, maximum_of},
                                  {"fraction", mark_fraction, fraction_of}};

// ---- indicators
// -----------------------------------------------------------------------------------

Indicators drawn(std::size_t count, std::uint64_t seed, auto&& draw) {
    std::mt19937_64 random(seed);
    Indicators indicators(count);
    std::ranges::generate(indicators, [&] { return static_cast<double>(draw(random)); });
    return indicators;
}

struct Drawn {
    const char* name;
    Indicators indicators;
};

std::vector<Drawn> indicators_of_all_sorts() {
    const auto uniform = [](std::mt19937_64& r) {
        return std::generate_canonical<double, 53>(r) + 1;
    };
    const auto ties = [](std::mt19937_64& r) { return r() % 7; };
    const auto any_bits = [](std::mt19937_64& r) {
        return std::bit_cast<double>(r() % std::bit_cast<std::uint64_t>(infinity));
    };
    const auto denormal = [](std::mt19937_64& r) { return static_cast<double>(r() % 50) * least; };
    const auto great = [](std::mt19937_64& r) { return r() % 3 == 0 ? greatest : 1e308; };
    const auto mostly_zero = [](std::mt19937_64& r) { return r() % 20 == 0 ? 0.1 : 0; };
    return {{"uniform", drawn(5000, 1, uniform)},
            {"ties", drawn(500, 2, ties)},
            {"any bits", drawn(500, 3, any_bits)},
            {"denormal", drawn(301, 4, denormal)},
            {"great", drawn(100, 5, great)},
            {"mostly zero", drawn(200, 6, mostly_zero)},
            {"equal", Indicators(300, 0.1)},
            {"zero", Indicators(50, 0)},
            {"negative zero", Indicators(9, -0.0)},
            {"one", {0.3}},
            {"none", {}}};
}

TEST(EstimatorMarks, AreThoseOfOneProcessForAnyPartition) {
    for (const auto& [name, indicators] : indicators_of_all_sorts()) {
        const std::size_t count = indicators.size();
        const std::vector<CellRanks> deals{at_random(count, 1), at_random(count, 2),
                                           in_blocks(count),
                                           all_to(test::world().size() - 1, count)};
        std::size_t next = 0;
        for (const double parameter : {0.5, 0.1, 0.8, 1.0, 1e-300, least}) {
            for (const Way& way : ways) {
                const Marks marks =
                    marked_by_all(way.mark, indicators, deals[next++ % deals.size()], parameter);
                EXPECT_EQ(marks, way.expected(indicators, parameter))
                    << way.name << " " << parameter << " " << name;
            }
        }
    }
}

/// The first cells have exactly half of the sum; with one unit in the last place less, they have
/// not.
TEST(EstimatorMarks, CompareSumsToTheLastBit) {
    std::mt19937_64 random(3);
    const auto whole = [&](std::uint64_t below) { return static_cast<double>(random() % below); };
    Indicators indicators;
    for (int k = 0; k < 1000; ++k) indicators.push_back(1 + whole(3'000'000'000'000'000) * 0x1p-52);
    for (std::size_t k = 0; k < 1000; ++k) {
        const double difference = whole(1'000'000) * 0x1p-53;
        indicators.push_back(indicators[k] / 2 - difference);
        indicators.push_back(indicators[k] / 2 + difference);
    }
    Marks expected(indicators.size(), 0);
    std::fill_n(expected.begin(), 1000, std::uint8_t{1});
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const CellRanks cell_to_rank = at_random(indicators.size(), seed);
        EXPECT_EQ(marked_by_all(mark_bulk, indicators, cell_to_rank, 0.5), expected);
    }
    double& last = indicators.back();
    last = std::nextafter(last, 2);
    const Marks more = marked_by_all(mark_bulk, indicators, in_blocks(indicators.size()), 0.5);
    EXPECT_GT(std::ranges::count(more, 1), 1000);
}

/// No smaller set has the required sum, and the set without its ties has not.
TEST(EstimatorMarks, OfBulkMarkingAreTheFewestThatHaveTheShare) {
    std::mt19937_64 random(4);
    for (int repeated = 0; repeated < 20; ++repeated) {
        const std::size_t count = 1 + random() % 9;
        const auto small = [](std::mt19937_64& r) { return r() % 12; };
        const Indicators indicators = drawn(count, random(), small);
        const double theta = static_cast<double>(1 + random() % 8) / 8;
        double total = 0;
        for (const double indicator : indicators) total += indicator;
        int fewest = static_cast<int>(count);
        for (unsigned set = 0; set < 1U << count; ++set) {
            double sum = 0;
            for (std::size_t c = 0; c < count; ++c) sum += (set >> c & 1U) != 0 ? indicators[c] : 0;
            if (sum >= theta * total) fewest = std::min(fewest, std::popcount(set));
        }
        const Marks marks = marked_by_all(mark_bulk, indicators, at_random(count, random()), theta);
        int marked_without_ties = 0;
        double least_marked = infinity;
        for (std::size_t c = 0; c < count; ++c) {
            if (marks[c] != 0) least_marked = std::min(least_marked, indicators[c]);
        }
        for (std::size_t c = 0; c < count; ++c) {
            EXPECT_EQ(marks[c] != 0, indicators[c] >= least_marked);
            if (indicators[c] > least_marked) ++marked_without_ties;
        }
        EXPECT_GE(std::ranges::count(marks, 1), fewest);
        EXPECT_TRUE(marked_without_ties < fewest || fewest == 0);
    }
}

TEST(EstimatorMarks, OfZerosAreNone) {
    const Communicator& world = test::world();
    for (const Way& way : ways) {
        EXPECT_EQ(way.mark(world, Indicators(3, 0), 1), Marks(3, 0)) << way.name;
        EXPECT_EQ(way.mark(world, Indicators{0, 1, -0.0}, 1), (Marks{0, 1, 0})) << way.name;
        EXPECT_TRUE(way.mark(world, {}, 1).empty());
    }
    EXPECT_EQ(mark_maximum(world, Indicators{0, 1, least}, 0), (Marks{0, 1, 1}));
    EXPECT_EQ(mark_maximum(world, Indicators{0, 1, least}, -0.0), (Marks{0, 1, 1}));
}

// ---- what is refused
// ------------------------------------------------------------------------------

/// Collective. Returns whether the messages are the same on all processes.
bool are_common(const std::string& words) {
    std::vector<char> of_first(words.begin(), words.end());
    test::world().broadcast(of_first);
    const bool same = std::ranges::equal(words, of_first);
    return test::world().sum(same ? 0 : 1) == 0;
}

TEST(EstimatorMarks, RefuseOnAllProcessesWhatIsNoIndicatorOnOne) {
    const Communicator& world = test::world();
    for (const double wrong : {-1.0, -least, nan, -nan, infinity, -infinity}) {
        for (int rank = 0; rank < world.size(); ++rank) {
            for (const Way& way : ways) {
                Indicators own(5, 1);
                if (rank <= world.rank()) own[3] = wrong;
                const auto words =
                    test::thrown_by<InputError>([&] { (void)way.mark(world, own, 0.5); });
                EXPECT_THAT(words, HasSubstr(fmt::format("rank {}: the indicator of cell 3 is {},",
                                                         rank, wrong)));
                EXPECT_TRUE(are_common(words));
            }
        }
    }
}

TEST(EstimatorMarks, RefuseSharesOutOfRangeAndOnesThatDiffer) {
    const Communicator& world = test::world();
    const Indicators own(5, 1);
    for (const Way& way : ways) {
        for (const double wrong : {-0.5, -least, std::nextafter(1.0, 2), infinity, nan}) {
            const bool is_last = world.rank() == world.size() - 1;
            const auto words = test::thrown_by<InputError>(
                [&] { (void)way.mark(world, own, is_last ? wrong : 0.5); });
            EXPECT_THAT(words, HasSubstr(fmt::format("is {}, which is not in", wrong)));
            EXPECT_TRUE(are_common(words));
        }
        if (world.size() == 1) continue;
        const auto words = test::thrown_by<InputError>(
            [&] { (void)way.mark(world, own, world.rank() == 1 ? 0.25 : 0.5); });
        EXPECT_THAT(words, HasSubstr(" is 0.25, and 0.5 on rank 0"));
        EXPECT_TRUE(are_common(words));
    }
    for (const double zero : {0.0, -0.0}) {
        EXPECT_THROW((void)mark_bulk(world, own, zero), InputError);
        EXPECT_THROW((void)mark_fraction(world, own, zero), InputError);
        EXPECT_EQ(mark_maximum(world, own, zero), Marks(5, 1));
    }
}

// ---- what it takes
// --------------------------------------------------------------------------------

TEST(EstimatorMarks, TakeFewAndSmallReductionsHoweverManyCells) {
    for (const std::size_t count : {10U, 10'000U}) {
        const auto any_bits = [](std::mt19937_64& r) {
            return std::bit_cast<double>(r() % std::bit_cast<std::uint64_t>(infinity));
        };
        const Indicators own = drawn(count, 1, any_bits);
        for (const Way& way : ways) {
            const Communicator processes = profiled(test::world(), ProfileDetail::sums);
            (void)way.mark(processes, own, 0.3);
            for (const ProfiledPhase& phase : gather_profile(processes).phases) {
                for (const PhaseCounts& counts : phase.of_rank) {
                    EXPECT_LT(counts.collectives, 25U);
                    EXPECT_LE(counts.collective_bytes, counts.collectives * 8192);
                    EXPECT_EQ(counts.messages, 0U);
                }
            }
        }
    }
}

// ---- in a loop
// ------------------------------------------------------------------------------------

/// Indicators that are large near a corner, and invariant under mirroring.
Indicators indicators_of(std::span<const Point> points, std::span<const CellVertices> cells) {
    Indicators indicators;
    for (const CellVertices& cell : cells) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cell[k].value()];
        const auto [x, y, z] = centroid(corners);
        std::array<double, 3> squares{x * x, y * y, z * z};
        std::ranges::sort(squares);
        indicators.push_back(volume(corners) / (0.1 + (squares[0] + squares[1] + squares[2])));
    }
    return indicators;
}

TEST(EstimatorMarks, LeadASolversLoopToTheMeshOfTheReference) {
    const Mesh whole = test::perturbed_kuhn(3, 0, 1);
    const Partition dealt{.method = PartitionMethod::random, .seed = 3};
    for (const Way& way : ways) {
        AdaptiveMesh mesh = AdaptiveMesh::distribute(
            test::world(), whole, partition_cells(whole, test::world().size(), dealt));
        Mesh expected = whole;
        for (int step = 0; step < 3; ++step) {
            const Indicators own = indicators_of(mesh.points(), mesh.cells());
            (void)mesh.refine(way.mark(test::world(), own, 0.3));
            const Marks marks = way.expected(indicators_of(expected.points, expected.cells), 0.3);
            Selection marked;
            for (std::size_t c = 0; c < marks.size(); ++c) {
                if (marks[c] != 0) marked.cells.push_back(GlobalCell{c});
            }
            expected = reference::refine(expected, marked, Scheme::eight, 1).mesh;
            const Mesh collected = mesh.collect();
            EXPECT_TRUE(collected == expected || !test::world().is_first()) << way.name << step;
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
