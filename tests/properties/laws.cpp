#include "properties/laws.hpp"

#include <algorithm>
#include <stdexcept>

namespace octetra::properties {

const std::vector<Law>& laws() {
    static const std::vector<Law> all{{"equality", fault_of_equality},
                                      {"numbering", fault_of_numbering},
                                      {"geometry", fault_of_geometry, true},
                                      {"closure", fault_of_closure},
                                      {"files", fault_of_files},
                                      {"counts", fault_of_counts}};
    return all;
}

const std::vector<Law>& history_laws() {
    static const std::vector<Law> all{
        {"every_step_is_the_references", fault_of_steps},
        {"ranks_know_what_they_share", fault_of_sharers},
        {"values_go_along", fault_of_values, true},
        {"moving_cells_changes_nothing", fault_of_moving},
        {"no_step_depends_on_numbering", fault_of_numbering_in_steps},
        {"coarsening_ends_in_the_input", fault_of_full_coarsening},
        {"saving_and_loading_change_nothing", fault_of_checkpoints},
        {"unmarked_cells_stay", fault_of_survivors},
        {"coarsening_goes_back_by_one_generation", fault_of_generations, true},
        {"order_of_marks_does_not_matter", fault_of_order_of_marks, true},
        {"coarsening_leaves_regular_families", fault_of_regular_families, true},
        {"refining_again_gives_the_same", fault_of_refining_again},
        {"volumes_stay", fault_of_volumes, true}};
    return all;
}

const Law& law_named(const std::string& name) {
    for (const auto* of : {&laws(), &history_laws()}) {
        const auto law = std::ranges::find(*of, name, &Law::name);
        if (law != of->end()) return *law;
    }
    throw std::out_of_range("there is no law named " + name);
}

}  // namespace octetra::properties
