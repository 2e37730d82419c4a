#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <octetra/core/mesh.hpp>

/// What must hold of every reader of files, whatever the bytes that it gets: it accepts them or
/// throws an InputError that names file and line, and what it accepts keeps its promises.
/// Fed by libFuzzer (fuzz_reader.cpp) and by the files that were kept (replay_test.cpp).
namespace octetra::test {

/// A promise that a reader broke.
struct BrokenPromise : std::logic_error {
    using std::logic_error::logic_error;
};

/// Puts `input` into files in `folder` and reads them. Throws BrokenPromise, or what the reader
/// throws and should not.
using CheckReader = void (*)(std::string_view input, const std::filesystem::path& folder);

/// `input` is the files .node, .ele, .face and .edge, in this order, with '%' between them; "-" in
/// place of a file stands for none, and so does what is missing at the end.
void check_tetgen(std::string_view input, const std::filesystem::path& folder);
void check_medit(std::string_view input, const std::filesystem::path& folder);
void check_meshb(std::string_view input, const std::filesystem::path& folder);
void check_gmsh(std::string_view input, const std::filesystem::path& folder);
/// Of a mesh of as many vertices and cells as the file says.
void check_sol(std::string_view input, const std::filesystem::path& folder);
void check_solb(std::string_view input, const std::filesystem::path& folder);
void check_maps(std::string_view input, const std::filesystem::path& folder);
void check_cell_list(std::string_view input, const std::filesystem::path& folder);
void check_part_file(std::string_view input, const std::filesystem::path& folder);
/// As it stands, and with hashes that are right.
void check_checkpoint(std::string_view input, const std::filesystem::path& folder);

struct NamedCheck {
    std::string_view name;
    CheckReader check;
};

/// All of them, by the names that corpus/regression/files/ has folders of.
[[nodiscard]] std::span<const NamedCheck> reader_checks();

/// What of the invariants at struct Mesh does not hold, or nothing; those that only_syntax leaves
/// out are not asked for with it.
[[nodiscard]] std::string broken_invariant(const Mesh& mesh, bool only_syntax);

/// Throws BrokenPromise unless the message of an InputError is "FILE: ...", "FILE:LINE: ..." or
/// "FILE: at byte N: ...", the file one of `folder`, the line one that it has or the one behind the
/// last, the byte likewise, all in one line of printable characters.
void check_message(const std::string& message, const std::filesystem::path& folder);

}  // namespace octetra::test
