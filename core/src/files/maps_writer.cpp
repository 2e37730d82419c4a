#include <octetra/core/maps.hpp>

#include "files/output_file.hpp"

namespace octetra {

void write_maps(const RefinementMaps& maps, const std::filesystem::path& path) {
    OutputFile out(path);
    const auto number = [&](auto index) {
        return std::uint64_t{index.value()} + maps.first_number;
    };
    out.put(std::string_view{"cells "});
    out.put(maps.cell_to_parent.size());
    out.put(std::string_view{"\n"});
    for (CellIndex c{0}; c < maps.cell_to_parent.end_index(); ++c) {
        out.put(number(c));
        out.put(' ');
        out.put(number(maps.cell_to_parent[c]));
        out.put('\n');
    }
    out.put(std::string_view{"midpoints "});
    out.put(maps.midpoint_to_edge.size());
    out.put(std::string_view{"\n"});
    VertexIndex midpoint = maps.first_midpoint;
    for (const auto& [a, b] : maps.midpoint_to_edge) {
        out.put(number(midpoint));
        out.put(' ');
        out.put(number(a));
        out.put(' ');
        out.put(number(b));
        out.put('\n');
        ++midpoint;
    }
    out.commit();
}

}  // namespace octetra
