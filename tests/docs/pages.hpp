#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

/// Parses the Markdown pages of the repository as far as the tests require.
namespace octetra::test {

inline const std::filesystem::path repository = OCTETRA_SOURCE_DIR;

struct FencedBlock {
    std::string language;  ///< the text after the opening fence
    std::size_t line = 0;  ///< of that fence, from 1
    std::vector<std::string> lines;
};

struct Page {
    std::vector<FencedBlock> blocks;
    std::vector<std::string> prose;  ///< the lines outside the blocks
};

inline Page page(const std::string& name) {
    std::istringstream in(content_of(repository / name));
    Page result;
    bool in_block = false;
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.starts_with("```")) {
            in_block = !in_block;
            if (in_block) result.blocks.push_back({line.substr(3), number, {}});
        } else if (in_block) {
            result.blocks.back().lines.push_back(line);
        } else {
            result.prose.push_back(line);
        }
    }
    return result;
}

/// README.md and the files in docs/: the pages whose examples are run.
inline std::vector<std::string> user_pages() {
    std::vector<std::string> names{"README.md"};
    for (const auto& entry : std::filesystem::directory_iterator(repository / "docs")) {
        if (entry.path().extension() == ".md") {
            names.push_back("docs/" + entry.path().filename().string());
        }
    }
    std::ranges::sort(names);
    return names;
}

/// The name of a page as part of a test name: letters, digits and underscores.
inline std::string name_of_test(std::string page_name) {
    std::ranges::replace_if(
        page_name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return page_name;
}

}  // namespace octetra::test
