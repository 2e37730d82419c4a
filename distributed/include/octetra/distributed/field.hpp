#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <octetra/core/files/checkpoint.hpp>

namespace octetra::distributed {

/// Named values on this process's vertices or cells, by local number, `components` for each. All
/// processes have the same fields in the same order; for a vertex that several processes have, the
/// owner's values are used.
struct Field {
    std::string name;
    FieldOn on = FieldOn::vertices;
    std::size_t components = 1;
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>,
                 std::vector<std::int64_t>>
        values;

    friend bool operator==(const Field&, const Field&) = default;
};

}  // namespace octetra::distributed
