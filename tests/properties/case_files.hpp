#pragma once

#include <filesystem>
#include <string>

#include "properties/case.hpp"

namespace octetra::properties {

/// A case that broke a law: NAME.json, and its mesh as NAME.ele and NAME.node (.face, .edge).
struct Finding {
    std::string law;
    std::string fault;  ///< what the law said when it was found
    Case refinement;
    int ranks = 0;  ///< on how many it was found; 0 where nobody has noted it
};

/// What a finding is called while it is tried: "LAW-running-PID". Who finds one of that name finds
/// what ended the process, or left it waiting.
[[nodiscard]] std::string running_name(const std::string& law);
[[nodiscard]] bool is_running_name(const std::string& name);

/// Writes it into the folder, which is made if need be. The `.json` file.
std::filesystem::path write_finding(const Finding& finding, const std::filesystem::path& folder,
                                    const std::string& name);

/// Reads the files of a `.json` file. Throws where they are not what write_finding writes.
[[nodiscard]] Finding read_finding(const std::filesystem::path& json);

/// Removes all files of that name.
void remove_finding(const std::filesystem::path& folder, const std::string& name);

/// Where findings go: OCTETRA_FOUND, or a folder beside the test programs.
[[nodiscard]] std::filesystem::path found_folder();

}  // namespace octetra::properties
