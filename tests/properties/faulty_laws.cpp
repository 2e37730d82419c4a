#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "distributed/world.hpp"
#include "properties/laws.hpp"
#include "properties/one_level.hpp"

/// Replacements of the laws for tests of shrinking. Each has its own fault, which occurs if more
/// than three cells are marked and a rank other than the first has a cell, hence on two ranks or
/// more.
namespace octetra::properties {
namespace {

bool is_faulty(const Case& c) {
    std::size_t marked = 0;
    for (CellIndex i{0}; i < c.mesh.cells.end_index(); ++i) marked += is_marked(c, i) ? 1U : 0U;
    const int ranks = test::world().size();
    return marked > 3 && std::ranges::any_of(c.cell_to_rank, [&](int r) { return r % ranks > 0; });
}

}  // namespace

/// Aborts.
std::string fault_of_equality(const Case& c) {
    if (is_faulty(c)) std::abort();
    return {};
}

/// Blocks for ever: no other rank takes part.
std::string fault_of_numbering(const Case& c) {
    if (is_faulty(c)) (void)test::world().sum(1);
    return {};
}

/// Reports a broken law.
std::string fault_of_closure(const Case& c) { return is_faulty(c) ? "as it should be" : ""; }

/// Ends the process with success.
std::string fault_of_files(const Case& c) {
    if (is_faulty(c)) std::_Exit(0);
    return {};
}

/// Holds, but takes wall-clock time, as on a loaded machine.
std::string fault_of_geometry(const Case& /*c*/) {
    std::this_thread::sleep_for(std::chrono::seconds(3));
    return {};
}

std::string fault_of_counts(const Case& /*c*/) { return {}; }

std::string fault_of_steps(const Case& /*c*/) { return {}; }
std::string fault_of_sharers(const Case& /*c*/) { return {}; }
std::string fault_of_values(const Case& /*c*/) { return {}; }
std::string fault_of_moving(const Case& /*c*/) { return {}; }
std::string fault_of_numbering_in_steps(const Case& /*c*/) { return {}; }
std::string fault_of_full_coarsening(const Case& /*c*/) { return {}; }
std::string fault_of_survivors(const Case& /*c*/) { return {}; }
std::string fault_of_generations(const Case& /*c*/) { return {}; }
std::string fault_of_volumes(const Case& /*c*/) { return {}; }
std::string fault_of_checkpoints(const Case& /*c*/) { return {}; }
std::string fault_of_refining_again(const Case& /*c*/) { return {}; }

}  // namespace octetra::properties
