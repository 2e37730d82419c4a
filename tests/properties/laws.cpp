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

const Law& law_named(const std::string& name) {
    const auto law = std::ranges::find(laws(), name, &Law::name);
    if (law == laws().end()) throw std::out_of_range("there is no law named " + name);
    return *law;
}

}  // namespace octetra::properties
