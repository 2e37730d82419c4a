#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

/// Named values on the vertices or cells of a mesh, stored with the mesh in files.
namespace octetra {

enum class FieldOn : std::uint32_t { vertices, cells };
enum class FieldType : std::uint32_t { float64, float32, int32, int64 };

[[nodiscard]] constexpr std::size_t size_of(FieldType type) {
    return type == FieldType::float64 || type == FieldType::int64 ? 8 : 4;
}

/// Description of a field on the current mesh: `components` values for each vertex or cell.
struct FieldFacts {
    std::string name;
    FieldOn on = FieldOn::vertices;
    FieldType type = FieldType::float64;
    std::size_t components = 1;

    friend bool operator==(const FieldFacts&, const FieldFacts&) = default;
};

}  // namespace octetra
