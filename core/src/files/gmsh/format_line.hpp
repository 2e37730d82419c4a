#pragma once

#include "files/input/byte_reader.hpp"
#include "files/input/line_reader.hpp"

namespace octetra::gmsh {

/// What `$MeshFormat` says: "4.1 1 8" is a binary file of version 4.1.
struct FormatLine {
    bool is_4 = false;  ///< version 4.1, or else 2 to 2.2
    bool is_binary = false;
};

/// Reads the first two lines of a file, of which the second says this.
[[nodiscard]] FormatLine read_format_line(LineReader& reader);

/// Of a binary file: the number 1 follows, and a line end, and shows in which order bytes come.
void find_byte_order(ByteReader& reader);

}  // namespace octetra::gmsh
