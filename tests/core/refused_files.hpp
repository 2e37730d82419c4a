#pragma once

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "core/mesh_shares.hpp"
#include "support/temporary_folder.hpp"

/// Tables of files that a reader refuses. A test file of a format has its tables; the test that
/// reads the files is in refused_files_test.cpp.
namespace octetra::test {

/// The text that follows the name of the file in a message: ":LINE: " or ": at byte N: ".
struct Place {
    Place(int line) : text(fmt::format(":{}: ", line)) {}  // NOLINT(google-explicit-constructor)
    Place(std::string other) : text(std::move(other)) {}   // NOLINT(google-explicit-constructor)
    Place(const char* other) : text(other) {}              // NOLINT(google-explicit-constructor)
    std::string text;
};
inline Place at_byte(std::size_t byte) { return fmt::format(": at byte {}: ", byte); }

/// A case of a test: reads a file, and has parts of the message of the InputError expected.
struct RefusedFile {
    std::string name;
    std::function<void()> read;
    std::string place;  ///< file name and position
    std::string what;
};
inline void PrintTo(const RefusedFile& refused, std::ostream* out) { *out << refused.name; }

class RefusedFiles : public testing::TestWithParam<RefusedFile> {};

/// A row of a table: the name of the case, the content of the file, and the message.
template <class Content>
struct Refusal {
    std::string name;
    Content content;
    Place place;
    std::string what;
};

/// The cases of a table, for a file of this name; read(content) reads it.
template <class Content>
auto refusals(const std::string& file, void (*read)(const Content&),
              const std::vector<Refusal<Content>>& rows) {
    std::vector<RefusedFile> cases;
    for (const auto& row : rows) {
        cases.push_back({row.name, [read, content = row.content] { read(content); },
                         "/" + file + row.place.text, row.what});
    }
    return testing::ValuesIn(cases);
}

inline const auto name_of_case = [](const auto& test_case) { return test_case.param.name; };

/// Reads a mesh from a file of this name and content, by one process and by several.
inline Mesh read_content(const std::string& name, const std::string& content,
                         const ReadOptions& options = {}) {
    const TemporaryFolder folder;
    const auto file = folder.write(name, content);
    expect_correct_shares(file);
    return read_mesh(file, options);
}

}  // namespace octetra::test
