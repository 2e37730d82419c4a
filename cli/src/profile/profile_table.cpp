#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "grouped.hpp"
#include "profile/format_profile.hpp"
#include "profile/spread.hpp"

namespace octetra::cli {
namespace {

using distributed::GatheredProfile;
using distributed::PhaseCounts;
using distributed::ProfiledLevel;
using distributed::ProfiledPhase;

void add_to(PhaseCounts& sum, const PhaseCounts& counts) {
    sum.computing_seconds += counts.computing_seconds;
    sum.communicating_seconds += counts.communicating_seconds;
    sum.messages += counts.messages;
    sum.bytes += counts.bytes;
    sum.collectives += counts.collectives;
    sum.collective_bytes += counts.collective_bytes;
    sum.rounds += counts.rounds;
}

void add_to(std::vector<PhaseCounts>& sums, const ProfiledPhase& phase) {
    sums.resize(phase.of_rank.size());
    for (std::size_t r = 0; r < sums.size(); ++r) add_to(sums[r], phase.of_rank[r]);
}

/// Returns the phases summed over levels, with the rest of the run last.
std::vector<ProfiledPhase> summed_over_levels(const GatheredProfile& profile) {
    std::vector<ProfiledPhase> sums;
    for (const ProfiledPhase& phase : profile.phases) {
        auto sum = std::ranges::find(sums, phase.name, &ProfiledPhase::name);
        if (sum == sums.end()) sum = sums.insert(sum, {.name = phase.name});
        add_to(sum->of_rank, phase);
    }
    std::stable_partition(sums.begin(), sums.end(),
                          [](const ProfiledPhase& p) { return p.name != "rest"; });
    return sums;
}

/// Formats bytes in decimal units, with about three digits.
std::string formatted_bytes(double bytes) {
    constexpr std::array<std::string_view, 5> units{"B", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= 999.5 && unit + 1 < units.size(); ++unit) bytes /= 1000;
    return fmt::format("{:.{}f} {}", bytes, unit > 0 && bytes < 99.95 ? 1 : 0, units[unit]);
}

std::string formatted_bytes(std::uint64_t bytes) {
    return formatted_bytes(static_cast<double>(bytes));
}

/// The unit of time: milliseconds for short runs.
struct Unit {
    std::string_view name = "s";
    double per_second = 1;
    int digits = 3;
};

Unit unit_of(const GatheredProfile& profile) {
    constexpr double short_run = 10;
    if (spread(profile.seconds_of_rank).max >= short_run) return {};
    return {"ms", 1000, 1};
}

std::string times(const std::vector<double>& seconds_of_rank, const Unit& unit) {
    const auto seconds = spread(seconds_of_rank);
    std::string text;
    for (const double s : {seconds.min, seconds.mean, seconds.max}) {
        text += fmt::format(" {:8.{}f}", s * unit.per_second, unit.digits);
    }
    return text;
}

std::string phase_line(std::string_view name, const std::vector<PhaseCounts>& of_rank,
                       const Unit& unit) {
    return fmt::format("{:<17}{} {} {:>10} {:>9} {:>6}\n", name,
                       times(each(of_rank, &PhaseCounts::computing_seconds), unit),
                       times(each(of_rank, &PhaseCounts::communicating_seconds), unit),
                       grouped(spread(each(of_rank, &PhaseCounts::messages)).sum),
                       formatted_bytes(spread(each(of_rank, &PhaseCounts::bytes)).sum),
                       spread(each(of_rank, &PhaseCounts::rounds)).max);
}

std::string_view display_name(std::string_view phase) {
    if (phase == "level") return "rest of levels";
    return phase;
}

std::string phase_table(const GatheredProfile& profile) {
    const std::size_t ranks = profile.seconds_of_rank.size();
    const Unit unit = unit_of(profile);
    std::string text = fmt::format(
        "{:<17} {:>26}  {:>26}\n", fmt::format("{} rank{}", ranks, ranks == 1 ? "" : "s"),
        fmt::format("computing, {}", unit.name), fmt::format("communicating, {}", unit.name));
    text += fmt::format("{:<17} {:>8} {:>8} {:>8}  {:>8} {:>8} {:>8} {:>10} {:>9} {:>6}\n", "phase",
                        "min", "mean", "max", "min", "mean", "max", "messages", "bytes", "rounds");
    std::vector<PhaseCounts> total;
    for (const ProfiledPhase& phase : summed_over_levels(profile)) {
        text += phase_line(display_name(phase.name), phase.of_rank, unit);
        add_to(total, phase);
    }
    return text + phase_line("total", total, unit);
}

std::string level_line(const GatheredProfile& profile, const ProfiledLevel& level) {
    std::vector<PhaseCounts> counts(level.cells_of_rank.size());
    for (const ProfiledPhase& phase : profile.phases) {
        if (phase.level == level.level) add_to(counts, phase);
    }
    const auto cells = spread(level.cells_of_rank);
    const std::string what =
        fmt::format("{:<7} {:>15} {:>16} {:>15.1f} {:>15}",
                    level.level == 0 ? "before" : std::to_string(level.level), grouped(cells.sum),
                    grouped(cells.min), cells.mean, grouped(cells.max));
    if (level.level == 0) return what + "\n";
    return what + fmt::format(" {:>10} {:>9} {:>6}\n",
                              grouped(spread(each(counts, &PhaseCounts::messages)).sum),
                              formatted_bytes(spread(each(counts, &PhaseCounts::bytes)).sum),
                              spread(each(counts, &PhaseCounts::rounds)).max);
}

std::string level_table(const GatheredProfile& profile) {
    if (profile.levels.empty()) return {};
    std::string text =
        fmt::format("\n{:<7} {:>15} {:>16} {:>15} {:>15} {:>10} {:>9} {:>6}\n", "level", "cells",
                    "of a rank: min", "mean", "max", "messages", "bytes", "rounds");
    for (const ProfiledLevel& level : profile.levels) text += level_line(profile, level);
    return text;
}

}  // namespace

std::string format_profile_table(const GatheredProfile& profile) {
    const auto memory = spread(profile.peak_memory_of_rank);
    return phase_table(profile) + level_table(profile) +
           fmt::format("\npeak memory of a rank: min {}, mean {}, max {}\n",
                       formatted_bytes(memory.min), formatted_bytes(memory.mean),
                       formatted_bytes(memory.max)) +
           "Seconds are wall clock; communicating includes waiting. Reductions and broadcasts are "
           "no\n"
           "messages; the JSON file counts them.\n";
}

}  // namespace octetra::cli
