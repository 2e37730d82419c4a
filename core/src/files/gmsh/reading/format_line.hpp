#pragma once

#include "files/input/byte_reader.hpp"
#include "files/input/line_reader.hpp"

namespace octetra::gmsh {

/// The content of `$MeshFormat`: "4.1 1 8" is a binary file of version 4.1.
struct FormatLine {
    bool is_4 = false;  ///< version 4.1, or else 2 to 2.2
    bool is_binary = false;
};

/// Reads the first two lines of a file, the second of which contains the format.
[[nodiscard]] FormatLine read_format_line(LineReader& reader);

/// For a binary file: reads the number 1 and the line end, which follow the format line, and sets
/// the byte order accordingly.
void find_byte_order(ByteReader& reader);

}  // namespace octetra::gmsh
