#include <string>

#include <fmt/format.h>

#include "grouped.hpp"
#include "info/print_statistics.hpp"
#include "terminal.hpp"

namespace octetra::cli {

void print_history(const History& history) {
    const CheckpointFacts& facts = history.facts;
    print("\n{:<12}{:>17}{:>17}{:>17}{:>15}\n", "Step", "cells before", "cells cut", "cells after",
          "bytes");
    for (std::size_t t = 0; t < facts.steps.size(); ++t) {
        const StepFacts& step = facts.steps[t];
        const std::uint64_t after =
            t + 1 < facts.steps.size() ? facts.steps[t + 1].cells_before : facts.cells_now;
        print("  {:<10}{:>17}{:>17}{:>17}{:>15}\n", t + 1, grouped(step.cells_before),
              grouped(step.cells_cut), grouped(after), grouped(step.bytes));
    }
    print("\n{:<12}{:>17}{:>17}\n", "Level", "after step", "vertices");
    for (std::size_t k = 0; k < history.levels.size(); ++k) {
        const LevelFacts& level = history.levels[k];
        print("  {:<10}{:>17}{:>17}\n", k, level.step, grouped(level.vertices));
    }
    if (facts.closure == Closure::regular) {
        print("closure: regular; a step is a generation of cells\n");
    }
    for (const FieldFacts& field : facts.fields) {
        print(
            "field '{}': {} on {}\n", field.name,
            field.components == 1 ? "1 component" : fmt::format("{} components", field.components),
            field.on == FieldOn::vertices ? "vertices" : "cells");
    }
    if (!facts.state) return;
    print("time {}, step {}\n", facts.state->time, facts.state->step);
    if (!facts.state->text.empty()) print("text: {}\n", facts.state->text);
}

}  // namespace octetra::cli
