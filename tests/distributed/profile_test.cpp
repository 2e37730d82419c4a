#include <chrono>
#include <ctime>
#include <numeric>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/mpi_counter.hpp"

/// Compares a profile with the counts of a library between the program and MPI, and with a clock.
namespace octetra::distributed {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double>(end - begin).count();
}

test::MpiCounts counted_since(const test::MpiCounts& before) {
    const test::MpiCounts now = test::mpi_counts();
    return {now.messages - before.messages, now.bytes - before.bytes,
            now.collectives - before.collectives, now.collective_bytes - before.collective_bytes,
            now.nanoseconds - before.nanoseconds};
}

/// The parallel work of a run of the program.
SynchronisationCounts run(const Communicator& processes, Synchronisation synchronisation) {
    const Mesh mesh = test::perturbed_kuhn(4, 0.3, 5);
    const auto parts = in_phase(processes, "partition",
                                [&] { return partition_cells(mesh, processes.size(), {}); });
    DistributedMesh part = distribute(processes, mesh, parts);
    const auto counts = refine(part, {.random = RandomShare{0.1, 3}},
                               {.levels = 3, .synchronisation = synchronisation});
    (void)collect(std::move(part));
    std::vector<int> numbers(100);
    processes.broadcast(numbers);
    std::vector<std::uint64_t> addends(100);
    processes.sum(addends);
    return counts;
}

PhaseCounts sum_over_phases(const GatheredProfile& profile, std::size_t rank,
                            const std::string& only = {}) {
    PhaseCounts sum;
    for (const ProfiledPhase& phase : profile.phases) {
        if (!only.empty() && phase.name != only) continue;
        const PhaseCounts& c = phase.of_rank[rank];
        sum.computing_seconds += c.computing_seconds;
        sum.communicating_seconds += c.communicating_seconds;
        sum.messages += c.messages;
        sum.bytes += c.bytes;
        sum.collectives += c.collectives;
        sum.collective_bytes += c.collective_bytes;
        sum.rounds += c.rounds;
    }
    return sum;
}

class Profiled : public testing::TestWithParam<Synchronisation> {};

TEST_P(Profiled, CountsAreThoseSeenBetweenTheProgramAndMpi) {
    const Communicator processes = profiled(test::world(), ProfileDetail::sums);
    const test::MpiCounts before = test::mpi_counts();
    (void)run(processes, GetParam());
    const auto counted = test::world().gather(std::vector{counted_since(before)});
    const GatheredProfile profile = gather_profile(processes);
    for (std::size_t r = 0; r < counted.size(); ++r) {
        const test::MpiCounts& expected = counted[r].front();
        const PhaseCounts sum = sum_over_phases(profile, r);
        EXPECT_EQ(sum.messages, expected.messages);
        EXPECT_EQ(sum.bytes, expected.bytes);
        EXPECT_EQ(sum.collectives, expected.collectives);
        EXPECT_EQ(sum.collective_bytes, expected.collective_bytes);
        EXPECT_GE(sum.communicating_seconds, static_cast<double>(expected.nanoseconds) * 1e-9);
        EXPECT_EQ(expected.messages > 0, test::world().size() > 1);
        EXPECT_EQ(expected.collectives > 0, test::world().size() > 1);
    }
}

TEST_P(Profiled, SynchronisationCountsAreThoseOfItsPhase) {
    const Communicator processes = profiled(test::world(), ProfileDetail::sums);
    const auto counted = test::world().gather(std::vector{run(processes, GetParam())});
    const GatheredProfile profile = gather_profile(processes);
    for (std::size_t r = 0; r < counted.size(); ++r) {
        const SynchronisationCounts& expected = counted[r].front();
        const PhaseCounts sum = sum_over_phases(profile, r, "synchronise");
        EXPECT_EQ(sum.rounds, expected.rounds);
        EXPECT_EQ(sum.messages, expected.messages);
        EXPECT_EQ(sum.bytes, expected.bytes);
        EXPECT_EQ(expected.rounds > 0, test::world().size() > 1);
    }
}

TEST_P(Profiled, SecondsOfAllPhasesAreThoseOfTheRun) {
    const auto before = Clock::now();
    const Communicator processes = profiled(test::world(), ProfileDetail::sums);
    const auto begin = Clock::now();
    (void)run(processes, GetParam());
    const double inside = seconds_between(begin, Clock::now());
    const GatheredProfile profile = gather_profile(processes);
    const double around = seconds_between(before, Clock::now());
    const auto insides = test::world().gather(std::vector{inside});
    const auto arounds = test::world().gather(std::vector{around});
    constexpr double nanosecond = 1e-9;  // the figures are summed in another order
    for (std::size_t r = 0; r < insides.size(); ++r) {
        const PhaseCounts sum = sum_over_phases(profile, r);
        const double seconds = sum.computing_seconds + sum.communicating_seconds;
        EXPECT_GE(seconds + nanosecond, insides[r].front());
        EXPECT_LE(seconds - nanosecond, arounds[r].front());
        EXPECT_NEAR(seconds, profile.seconds_of_rank[r], nanosecond);
    }
}

TEST_P(Profiled, LevelsHaveTheirCellsAndPhases) {
    const Communicator processes = profiled(test::world(), ProfileDetail::sums);
    (void)run(processes, GetParam());
    const GatheredProfile profile = gather_profile(processes);
    if (!test::world().is_first()) {
        EXPECT_TRUE(profile.phases.empty());
        EXPECT_TRUE(profile.levels.empty());
        return;
    }
    ASSERT_EQ(profile.levels.size(), 4U);
    std::uint64_t cells_before = 0;
    for (std::size_t l = 0; l < 4; ++l) {
        EXPECT_EQ(profile.levels[l].level, static_cast<int>(l));
        const auto& cells = profile.levels[l].cells_of_rank;
        ASSERT_EQ(cells.size(), static_cast<std::size_t>(test::world().size()));
        const auto sum = std::accumulate(cells.begin(), cells.end(), std::uint64_t{0});
        EXPECT_GT(sum, cells_before);
        cells_before = sum;
    }
    const auto& at_first = profile.levels.front().cells_of_rank;
    EXPECT_EQ(std::accumulate(at_first.begin(), at_first.end(), std::uint64_t{0}), 6U * 4 * 4 * 4);
    for (const std::string name : {"level", "number edges", "select", "synchronise", "closure",
                                   "bisect edges", "bisect tetrahedra", "interfaces"}) {
        for (const int level : {1, 2, 3}) {
            EXPECT_TRUE(std::ranges::any_of(profile.phases,
                                            [&](const ProfiledPhase& phase) {
                                                return phase.name == name && phase.level == level;
                                            }))
                << name << " of level " << level;
        }
    }
}

TEST_P(Profiled, SpansNestAndAddUp) {
    const Communicator processes = profiled(test::world(), ProfileDetail::spans);
    (void)run(processes, GetParam());
    const GatheredProfile profile = gather_profile(processes);
    for (std::size_t r = 0; r < profile.spans_of_rank.size(); ++r) {
        std::vector<Span> around;
        PhaseCounts sum;
        std::int64_t communicating = 0;
        for (const Span& span : profile.spans_of_rank[r]) {
            const std::int64_t end = span.begin_nanoseconds + span.nanoseconds;
            while (!around.empty() && around.back().begin_nanoseconds + around.back().nanoseconds <=
                                          span.begin_nanoseconds) {
                around.pop_back();
            }
            if (!around.empty()) {
                EXPECT_FALSE(around.back().is_communication) << "something inside a communication";
                EXPECT_LE(end, around.back().begin_nanoseconds + around.back().nanoseconds);
            }
            around.push_back(span);
            if (!span.is_communication) continue;
            communicating += span.nanoseconds;
            sum.messages += span.messages;
            sum.bytes += span.bytes;
        }
        const PhaseCounts expected = sum_over_phases(profile, r);
        EXPECT_NEAR(static_cast<double>(communicating) * 1e-9, expected.communicating_seconds,
                    1e-9);
        EXPECT_EQ(sum.messages, expected.messages);
        EXPECT_EQ(sum.bytes, expected.bytes);
    }
}

INSTANTIATE_TEST_SUITE_P(, Profiled,
                         testing::Values(Synchronisation::neighbour, Synchronisation::gateway));

void sleep_milliseconds(int count) {
    std::this_thread::sleep_for(std::chrono::milliseconds(count));
}

TEST(Phase, AssignsTheInnerPhaseItsTimeAndTheOuterOneTheRest) {
    const Communicator alone = profiled(Communicator(), ProfileDetail::sums);
    {
        const Phase outer(alone, "outer", 2);
        sleep_milliseconds(4);
        EXPECT_THROW(in_phase(alone, "inner",
                              [] {
                                  sleep_milliseconds(8);
                                  throw std::runtime_error("a phase that ends so, ends");
                              }),
                     std::runtime_error);
        sleep_milliseconds(4);
    }
    sleep_milliseconds(2);
    const GatheredProfile profile = gather_profile(alone);
    ASSERT_EQ(profile.phases.size(), 3U);
    const auto expect = [&](std::size_t i, const char* name, int level, double seconds) {
        const ProfiledPhase& phase = profile.phases[i];
        EXPECT_EQ(phase.name, name);
        EXPECT_EQ(phase.level, level);
        EXPECT_GE(phase.of_rank.front().computing_seconds, seconds);
        EXPECT_EQ(phase.of_rank.front().communicating_seconds, 0);
    };
    expect(0, "rest", 0, 0.002);
    expect(1, "outer", 2, 0.008);
    expect(2, "inner", 2, 0.008);
    EXPECT_GT(profile.peak_memory_of_rank.front(), 1'000'000U);
}

TEST(Phase, OfTheProcessorsTimeHasNoneWhileItSleeps) {
    const Communicator alone =
        profiled(Communicator(), ProfileDetail::sums, ProfileClock::processor);
    in_phase(alone, "asleep", [] { sleep_milliseconds(200); });
    in_phase(alone, "at work", [] {
        const std::clock_t begin = std::clock();
        while (std::clock() - begin < CLOCKS_PER_SEC / 100) {
        }
    });
    const GatheredProfile profile = gather_profile(alone);
    const auto seconds_of = [&](std::size_t i) {
        return profile.phases[i].of_rank.front().computing_seconds;
    };
    ASSERT_EQ(profile.phases.size(), 3U);
    EXPECT_LT(seconds_of(1), 0.1);
    EXPECT_GE(seconds_of(2), 0.009);
}

TEST(Profile, IsGatheredOnlyWhereThereIsOneAndNoPhaseIsOpen) {
    EXPECT_THROW((void)gather_profile(Communicator()), std::logic_error);
    const Communicator alone = profiled(Communicator(), ProfileDetail::sums);
    const Phase open(alone, "open");
    EXPECT_THROW((void)gather_profile(alone), std::logic_error);
}

}  // namespace
}  // namespace octetra::distributed
