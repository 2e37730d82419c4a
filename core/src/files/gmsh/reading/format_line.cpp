#include "files/gmsh/reading/format_line.hpp"

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "files/input/fields.hpp"

namespace octetra::gmsh {
namespace {

[[noreturn]] void refuse_version(const LineReader& reader, const std::string& version) {
    if (version == "4" || version == "4.0") {
        reader.fail(
            "version 4.0 is not supported: save the mesh in a newer one, with gmsh FILE.msh -save "
            "-format msh41 -o NEW.msh");
    }
    reader.fail(fmt::format("versions 2.2 and 4.1 are supported, not {}", shown(version)));
}

/// Advances to the first line after any sections of comments.
void pass_over_comments(LineReader& reader) {
    while (reader.next()) {
        if (reader.line() != "$Comments") return;
        do {
            if (!reader.next()) reader.fail("the file ends within the section 'Comments'");
        } while (reader.line() != "$EndComments");
    }
    reader.fail("the file ends where the section $MeshFormat should be");
}

}  // namespace

FormatLine read_format_line(LineReader& reader) {
    pass_over_comments(reader);
    if (reader.line().starts_with("$NOD")) {
        reader.fail(
            "version 1 is not supported: save the mesh in a newer one, with gmsh FILE.msh -save "
            "-format msh41 -o NEW.msh");
    }
    if (reader.line() != "$MeshFormat") {
        if (reader.line().starts_with("MFEM")) {
            reader.fail("this is a mesh of MFEM; of .msh files only those of Gmsh are read");
        }
        reader.fail(
            fmt::format("the first section of a Gmsh file, after comments, is $MeshFormat, "
                        "not {}",
                        shown(reader.line())));
    }
    if (!reader.next()) reader.fail("the file ends where its version should be");
    Fields fields(reader);
    const std::string version(fields.text());
    FormatLine format;
    format.is_4 = version == "4.1";
    if (!format.is_4 && version != "2" && version != "2.0" && version != "2.1" &&
        version != "2.2") {
        refuse_version(reader, version);
    }
    const std::uint64_t is_binary = fields.unsigned_integer("the file's type, 0 or 1,");
    if (is_binary > 1) {
        reader.fail(fmt::format("the file's type is 0 (text) or 1 (binary), not {}", is_binary));
    }
    format.is_binary = is_binary == 1;
    const std::uint64_t size = fields.unsigned_integer("the size of numbers");
    fields.expect_end(3);
    if (format.is_binary && size != 8) {
        reader.fail(fmt::format("binary files have numbers of 8 bytes, not {}", size));
    }
    return format;
}

void find_byte_order(ByteReader& reader) {
    const std::uint64_t begin = reader.position();
    const auto one = reader.take<std::int32_t>("the number 1");
    constexpr std::int32_t swapped_one = 0x01000000;
    if (one != 1 && one != swapped_one) {
        reader.fail(fmt::format("the number 1 should be here, not {}", one), begin);
    }
    reader.swap_bytes(one == swapped_one);
}

}  // namespace octetra::gmsh
