#include "properties/case_files.hpp"

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "properties/case_json.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::properties {

namespace fs = std::filesystem;

std::string running_name(const std::string& law) {
    return law + "-running-" + std::to_string(::getpid());
}

bool is_running_name(const std::string& name) { return name.find("-running-") != name.npos; }

fs::path write_finding(const Finding& finding, const fs::path& folder, const std::string& name) {
    fs::create_directories(folder);
    (void)write_mesh(finding.refinement.mesh, folder / (name + ".ele"));
    nlohmann::json json = json_of(finding.refinement);
    json["law"] = finding.law;
    json["fault"] = finding.fault;
    if (finding.ranks > 0) json["ranks"] = finding.ranks;
    // TetGen's files cannot store group names.
    for (const auto& [dimension, tag, group] : finding.refinement.mesh.group_names) {
        json["group_names"].push_back({dimension, tag, group});
    }
    const fs::path file = folder / (name + ".json");
    write_text(json.dump(1) + "\n", file);
    return file;
}

Finding read_finding(const fs::path& file) {
    const auto read = [&] {
        try {
            const auto json = nlohmann::json::parse(test::content_of(file));
            Finding finding{json.at("law"), json.at("fault"), case_of(json),
                            json.value("ranks", 0)};
            for (const auto& name : json.value("group_names", nlohmann::json::array())) {
                finding.refinement.mesh.group_names.push_back({name.at(0), name.at(1), name.at(2)});
            }
            return finding;
        } catch (const nlohmann::json::exception& error) {
            throw std::invalid_argument(file.string() + ": " + error.what());
        }
    };
    Finding finding = read();
    fs::path mesh = file;
    auto names = std::move(finding.refinement.mesh.group_names);
    finding.refinement.mesh = read_mesh(mesh.replace_extension(".ele"));
    finding.refinement.mesh.group_names = std::move(names);
    if (finding.refinement.cell_to_rank.size() != finding.refinement.mesh.cells.size()) {
        throw std::invalid_argument(file.string() + ": cell_to_rank is not one for each cell");
    }
    return finding;
}

void remove_finding(const fs::path& folder, const std::string& name) {
    for (const char* extension : {".json", ".ele", ".node", ".face", ".edge"}) {
        fs::remove(folder / (name + extension));
    }
}

fs::path found_folder() {
    const char* const folder = std::getenv("OCTETRA_FOUND");
    return folder != nullptr ? fs::path(folder) : fs::path(OCTETRA_FOUND_BY_TESTS);
}

}  // namespace octetra::properties
