#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <octetra/core/mesh.hpp>

/// Requirements on every reader of files for arbitrary input: it accepts the input or throws an
/// InputError that names file and line, and accepted input satisfies the invariants. Used by
/// libFuzzer (fuzz_reader.cpp) and for recorded files (replay_test.cpp).
namespace octetra::test {

/// A requirement that a reader has violated.
struct BrokenPromise : std::logic_error {
    using std::logic_error::logic_error;
};

/// Writes `input` to files in `folder` and reads them. Throws BrokenPromise, or an unexpected
/// exception of the reader.
using CheckReader = void (*)(std::string_view input, const std::filesystem::path& folder);

/// `input` consists of the files .node, .ele, .face and .edge, in this order, separated by '%'; "-"
/// in place of a file, or its absence at the end, means no file.
void check_tetgen(std::string_view input, const std::filesystem::path& folder);
void check_medit(std::string_view input, const std::filesystem::path& folder);
void check_meshb(std::string_view input, const std::filesystem::path& folder);
void check_gmsh(std::string_view input, const std::filesystem::path& folder);
/// Reads fields for a mesh of as many vertices and cells as the file claims.
void check_sol(std::string_view input, const std::filesystem::path& folder);
void check_solb(std::string_view input, const std::filesystem::path& folder);
/// Reads the values of a Gmsh file, for the mesh in it.
void check_gmsh_data(std::string_view input, const std::filesystem::path& folder);
/// Reads the input as an expression, and evaluates it.
void check_expression(std::string_view input, const std::filesystem::path& folder);
void check_maps(std::string_view input, const std::filesystem::path& folder);
void check_cell_list(std::string_view input, const std::filesystem::path& folder);
void check_part_file(std::string_view input, const std::filesystem::path& folder);
/// Reads the input as it is, and with corrected hashes.
void check_checkpoint(std::string_view input, const std::filesystem::path& folder);

struct NamedCheck {
    std::string_view name;
    CheckReader check;
};

/// All checks, by the names of the folders in corpus/regression/files/.
[[nodiscard]] std::span<const NamedCheck> reader_checks();

/// Describes an invariant of struct Mesh that is violated, or returns an empty string. With
/// only_syntax, the invariants that it omits are not checked.
[[nodiscard]] std::string broken_invariant(const Mesh& mesh, bool only_syntax);

/// Throws BrokenPromise unless the message of an InputError is "FILE: ...", "FILE:LINE: ..." or
/// "FILE: at byte N: ...", where the file is in `folder`, and the line exists or follows the last
/// one, the byte likewise, in a single line of printable characters.
void check_message(const std::string& message, const std::filesystem::path& folder);

}  // namespace octetra::test
