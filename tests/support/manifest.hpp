#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace octetra::test {

/// An entry of corpus/manifest.json.
struct CorpusEntry {
    nlohmann::json content;
};

inline void PrintTo(const CorpusEntry& entry, std::ostream* out) {
    *out << entry.content["name"].get<std::string>();
}

inline std::filesystem::path corpus_folder() {
    return std::filesystem::path(OCTETRA_SOURCE_DIR) / "corpus";
}

/// The entries of "meshes" or "bad".
inline std::vector<CorpusEntry> corpus_entries(const std::string& list) {
    std::ifstream in(corpus_folder() / "manifest.json");
    const nlohmann::json manifest = nlohmann::json::parse(in);
    std::vector<CorpusEntry> result;
    for (const nlohmann::json& entry : manifest.at(list)) result.push_back({entry});
    return result;
}

/// One entry for each mesh; some meshes exist in several formats.
inline std::vector<CorpusEntry> different_meshes() {
    std::vector<CorpusEntry> entries = corpus_entries("meshes");
    std::erase_if(entries, [](const CorpusEntry& entry) {
        const auto& tags = entry.content["tags"];
        return std::ranges::find(tags, "same-mesh") != tags.end();
    });
    return entries;
}

/// Removes the entries that test the syntax of files rather than their mesh.
inline std::vector<CorpusEntry> without_odd_files(std::vector<CorpusEntry> entries) {
    std::erase_if(entries, [](const CorpusEntry& entry) {
        const auto& tags = entry.content["tags"];
        return std::ranges::find(tags, "oddity") != tags.end();
    });
    return entries;
}

/// The name of the test for an entry.
inline std::string corpus_name(const testing::TestParamInfo<CorpusEntry>& test_case) {
    std::string name = test_case.param.content["name"];
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return name;
}

}  // namespace octetra::test
