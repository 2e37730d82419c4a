#pragma once

#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"
#include "files/input/tokens.hpp"

/// The beginning of all Medit text files.
namespace octetra {

/// Throws InputError unless the file begins as a Medit text file.
inline void take_medit_head(Tokens& tokens, const LineReader& reader) {
    if (const std::string_view token = tokens.text(); token != "MeshVersionFormatted") {
        if (token == "MFEM") {
            reader.fail("this is a mesh of MFEM; of .mesh files only those of Medit are read");
        }
        reader.fail(
            fmt::format("a Medit file begins with MeshVersionFormatted, not {}; if it is binary, "
                        "its name should end in .meshb or .solb",
                        shown(token)));
    }
    const std::uint64_t version = tokens.unsigned_integer("the format's version");
    if (version < 1 || version > 4) {
        reader.fail(fmt::format("the Medit format has versions 1 to 4, not {}", version));
    }
}

/// Reads the value that follows the keyword Dimension.
inline void take_medit_dimension(Tokens& tokens, const LineReader& reader) {
    const std::uint64_t dimension = tokens.unsigned_integer("the dimension");
    if (dimension != 3) reader.fail(fmt::format("dimension 3 expected, {} found", dimension));
}

}  // namespace octetra
