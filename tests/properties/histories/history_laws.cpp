#include <algorithm>
#include <string>

#include "properties/draw.hpp"
#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/bits.hpp"

/// The laws that compare one history with another.
namespace octetra::properties {
namespace {

std::string in_step(std::size_t k, const std::string& fault) {
    return "step " + std::to_string(k + 1) + ": " + fault;
}

std::string difference(const Stage& found, const Stage& expected) {
    // For a step that would make too many cells, the reference states only the beginning of the
    // message.
    if (found.refusal.empty() != expected.refusal.empty() ||
        !found.refusal.starts_with(expected.refusal)) {
        return "refused as '" + found.refusal + "', not as '" + expected.refusal + "'";
    }
    if (!(found.mesh.cells == expected.mesh.cells)) return "the cells differ";
    if (test::bits(found.mesh) != test::bits(expected.mesh)) return "the points differ";
    if (!(found.mesh == expected.mesh)) return "tags, markers or attributes differ";
    if (found.changed != expected.changed) return "only one engine reports a change";
    return {};
}

std::string first_difference(const std::vector<Stage>& found, const std::vector<Stage>& expected) {
    if (found.size() != expected.size()) return "the numbers of stages differ";
    for (std::size_t k = 0; k < found.size(); ++k) {
        const std::string fault = difference(found[k], expected[k]);
        if (!fault.empty()) return in_step(k, fault);
    }
    return {};
}

bool is_the_same(const Mesh& a, const Mesh& b) { return a == b && test::bits(a) == test::bits(b); }

bool reloads(const Step& step) { return step.action == Action::reload; }

bool moves(const Step& step) {
    return step.action == Action::rebalance || step.action == Action::scatter;
}

}  // namespace

std::string fault_of_steps(const Case& c) {
    const Adapted adapted = adapted_by_all(c);
    const std::string fault = first_difference(adapted.stages, adapted_by_reference(c).stages);
    return fault.empty() ? adapted.fault_of_numbers : fault;
}

std::string fault_of_sharers(const Case& c) { return adapted_by_all(c).fault_of_sharers; }

std::string fault_of_values(const Case& c) {
    const Adapted adapted = adapted_by_all(c);
    const ReferenceHistory expected = adapted_by_reference(c);
    const Mesh* input = &c.mesh;
    for (std::size_t k = 0; k < c.steps.size(); ++k) {
        const Mesh& mesh = expected.stages[k].mesh;
        if (c.steps[k].action == Action::rewrite) input = &mesh;
        if (!(adapted.stages[k].mesh.cells == mesh.cells)) return in_step(k, "the cells differ");
        const std::string fault =
            fault_of_values_on(mesh, expected.maps[k], *input, adapted.values[k], exact_grid_scale);
        if (!fault.empty()) return in_step(k, fault);
    }
    return {};
}

std::string fault_of_moving(const Case& c) {
    Case resting = c;
    // After migration the result of the previous step is no longer known.
    std::erase_if(resting.steps, [](const Step& step) {
        return step.action == Action::take_back || step.action == Action::again;
    });
    std::erase_if(resting.steps, moves);
    Case moving = resting;
    moving.steps.clear();
    Draw draw(c.seed);
    for (const Step& step : resting.steps) {
        moving.steps.push_back({.action = draw.chance(0.7) ? Action::scatter : Action::rebalance});
        moving.steps.push_back(step);
    }
    for (Case* each : {&moving, &resting}) each->steps.push_back({.action = Action::reload});
    const Adapted moved = adapted_by_all(moving);
    const Adapted rested = adapted_by_all(resting);

    std::vector<Stage> others;
    for (std::size_t k = 0; k < moving.steps.size(); ++k) {
        const Stage& stage = moved.stages[k];
        if (!moves(moving.steps[k])) {
            others.push_back(stage);
        } else if (!is_the_same(stage.mesh, k == 0 ? c.mesh : moved.stages[k - 1].mesh)) {
            return in_step(k, "moving makes another mesh");
        }
    }
    const std::string fault = first_difference(others, rested.stages);
    if (!fault.empty()) return "without moving: " + fault;
    return moved.checkpoint == rested.checkpoint
               ? ""
               : "without moving the checkpoint in the end has other bytes";
}

std::string fault_of_full_coarsening(const Case& drawn) {
    const Case c = without_rewrites(drawn);
    const auto refinements = std::ranges::count_if(c.steps, [](const Step& step) {
        return step.action == Action::refine || step.action == Action::again;
    });
    // Each call takes back at least one refinement, and the last call nothing.
    Case there_and_back = c;
    there_and_back.steps.insert(there_and_back.steps.end(),
                                static_cast<std::size_t>(refinements) + 1,
                                {.action = Action::coarsen, .selection = {.all = true}});
    const Adapted adapted = adapted_by_all(there_and_back);
    const ReferenceHistory expected = adapted_by_reference(there_and_back);
    const std::string fault = first_difference(adapted.stages, expected.stages);
    if (!fault.empty()) return fault;
    for (std::size_t k = c.steps.size(); k < adapted.stages.size(); ++k) {
        if (!adapted.stages[k].refusal.empty()) return {};  // larger cells would be flat
        const bool is_input = expected.before[k].steps.empty();
        if (is_input == adapted.stages[k].changed) {
            return in_step(k, is_input ? "changes the input" : "takes nothing back");
        }
    }
    return is_the_same(adapted.stages.back().mesh, c.mesh) ? "" : "the input does not come back";
}

std::string fault_of_checkpoints(const Case& c) {
    Case with = c;
    // After loading the result of the previous step is no longer known.
    std::erase_if(with.steps, [](const Step& step) {
        return step.action == Action::take_back || step.action == Action::again;
    });
    if (std::ranges::none_of(with.steps, reloads)) {
        Draw draw(c.seed);
        const auto at = static_cast<std::ptrdiff_t>(draw.below(with.steps.size() + 1));
        with.steps.insert(with.steps.begin() + at,
                          {.action = Action::reload, .ranks = draw.between(1, 4)});
    }
    Case without = with;
    std::erase_if(without.steps, reloads);
    for (Case* each : {&with, &without}) each->steps.push_back({.action = Action::reload});
    const Adapted stopped = adapted_by_all(with);
    const Adapted never_stopped = adapted_by_all(without);

    std::vector<Stage> others;
    for (std::size_t k = 0; k < with.steps.size(); ++k) {
        const Stage& stage = stopped.stages[k];
        if (reloads(with.steps[k]) &&
            !is_the_same(stage.mesh, k == 0 ? c.mesh : stopped.stages[k - 1].mesh)) {
            return in_step(k, "another mesh is loaded than was saved");
        }
        if (!reloads(with.steps[k]) || k + 1 == with.steps.size()) others.push_back(stage);
    }
    const std::string fault = first_difference(others, never_stopped.stages);
    if (!fault.empty()) return "without stopping: " + fault;
    if (stopped.checkpoint != never_stopped.checkpoint) {
        return "the final checkpoint differs without stopping";
    }
    return {};
}

std::string fault_of_refining_again(const Case& c) {
    Case back_and_forth = c;
    back_and_forth.closure = Closure::longest_edge;
    Draw draw(c.seed);
    Step step{.action = Action::refine};
    const auto last =
        std::ranges::find(c.steps.rbegin(), c.steps.rend(), Action::refine, &Step::action);
    if (last != c.steps.rend()) step = *last;
    if (last == c.steps.rend() || draw.chance(0.5)) {
        step.selection = {.random = RandomShare{draw.unit(), draw.any()}};
    }
    back_and_forth.steps.insert(back_and_forth.steps.end(),
                                {step, {.action = Action::take_back}, {.action = Action::again}});
    const auto stages = adapted_by_all(back_and_forth).stages;
    const std::size_t end = stages.size();
    const Mesh& before = end == 3 ? c.mesh : stages[end - 4].mesh;
    if (!is_the_same(stages[end - 2].mesh, before)) return "the step is not taken back";
    if (!is_the_same(stages[end - 1].mesh, stages[end - 3].mesh)) {
        return "refining again gives another mesh";
    }
    return {};
}

}  // namespace octetra::properties
