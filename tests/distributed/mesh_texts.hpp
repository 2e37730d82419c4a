#pragma once

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "distributed/outcomes.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/temporary_folder.hpp"

/// Meshes as the text of files, for tests that modify the text and read it on several processes.
namespace octetra::test {

inline const std::vector<std::string> partitions{"rcb", "block"};

/// Collective. Writes on the first process; afterwards the file exists for all.
inline void write_on_first(const auto& write) {
    if (world().is_first()) write();
    (void)world().max(0);
}

/// A mesh in one file or several, with their contents.
struct Files {
    std::string extension;  ///< of the file that is read
    std::vector<std::pair<std::string, std::string>> texts{};

    void write(const SharedFolder& folder) const {
        write_on_first([&] {
            for (const auto& [ending, text] : texts) {
                const std::filesystem::path file = folder / ("m" + ending);
                std::filesystem::remove(file);
                write_file(file, text);
            }
        });
    }
    [[nodiscard]] std::string& text(const std::string& ending) {
        return std::ranges::find(texts, ending, &std::pair<std::string, std::string>::first)
            ->second;
    }
};

/// Collective. The files that write_mesh() makes of a mesh.
inline Files files_of(const Mesh& mesh, const std::string& extension,
                      const WriteOptions& options = {}) {
    const TemporaryFolder folder;  // one for each process
    Files files{extension};
    (void)write_mesh(mesh, folder / ("m" + extension), options);
    for (const std::string ending :
         {".node", ".ele", ".face", ".edge", ".mesh", ".meshb", ".msh"}) {
        const std::filesystem::path file = folder / ("m" + ending);
        if (std::filesystem::exists(file)) files.texts.emplace_back(ending, content_of(file));
    }
    return files;
}

/// Collective. Writes the files and reads them serially and collectively. Returns whether there is
/// a mesh.
inline bool expect_one_outcome(const Files& files) {
    const SharedFolder folder;
    files.write(folder);
    bool is_mesh = true;
    for (const std::string& partition : partitions) {
        is_mesh = expect_one_outcome(folder / ("m" + files.extension), partition);
    }
    (void)world().max(0);  // before the folder is removed
    return is_mesh;
}

/// Collective. Returns whether the files are read collectively.
inline bool are_read_together(const Files& files) {
    const SharedFolder folder;
    files.write(folder);
    const bool together = is_read_together(folder / ("m" + files.extension));
    (void)world().max(0);
    return together;
}

inline std::string replaced(std::string text, const std::string& old, const std::string& by) {
    for (std::size_t at = text.find(old); at != std::string::npos;
         at = text.find(old, at + by.size())) {
        text.replace(at, old.size(), by);
    }
    return text;
}

struct Case {
    std::string name;
    Files files;
    bool is_mesh = true;
    bool together = true;  ///< false if one process may have to read it alone or to refuse it
};

/// Changes a text at random positions, like an editor, a disk or a faulty program.
inline std::string mutated(std::string text, std::mt19937_64& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const auto line = [&](std::size_t at) {
        const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
        const std::size_t end = text.find('\n', at);
        return std::pair(begin, end == std::string::npos ? text.size() : end + 1);
    };
    const std::string some = "0123456789 -+.e#\n\r\tnE";
    for (std::size_t times = 1 + below(2); times > 0 && !text.empty(); --times) {
        const std::size_t at = below(text.size());
        const auto [begin, end] = line(at);
        const std::string copy = text.substr(begin, end - begin);
        switch (below(9)) {
            case 0: text[at] = static_cast<char>(random()); break;
            case 1: text[at] = some[below(some.size())]; break;
            case 2: text.erase(at, 1); break;
            case 3: text.insert(at, 1, some[below(some.size())]); break;
            case 4: text.erase(begin, end - begin); break;
            case 5: text.insert(begin, copy); break;
            case 6: text.insert(line(below(text.size())).first, copy); break;
            case 7: {  // one line replaces another, and the count stays
                const auto [other, its_end] = line(below(text.size()));
                text.replace(other, its_end - other, copy);
                break;
            }
            default: {  // one number of a line replaces another
                const auto [other, its_end] = line(below(text.size()));
                const std::size_t from = text.find_first_of("0123456789", other);
                if (from == std::string::npos || from >= its_end) break;
                text[at] = text[from];
            }
        }
    }
    return text;
}

}  // namespace octetra::test
