#pragma once

#include <filesystem>
#include <string>

#include "properties/case.hpp"

namespace octetra::properties {

/// A case that broke a law: NAME.json, and its mesh as NAME.ele and NAME.node (.face, .edge).
struct Finding {
    std::string law;
    std::string fault;  ///< the fault that the law reported
    Case refinement;
    int ranks = 0;  ///< number of ranks on which it was found; 0 if unknown
};

/// The name of a finding while it is judged: "LAW-running-PID". A file left under such a name
/// records a case that ended or blocked its process.
[[nodiscard]] std::string running_name(const std::string& law);
[[nodiscard]] bool is_running_name(const std::string& name);

/// Writes the finding to the folder, which is created if necessary. Returns the path of the `.json`
/// file.
std::filesystem::path write_finding(const Finding& finding, const std::filesystem::path& folder,
                                    const std::string& name);

/// Reads the files that belong to a `.json` file. Throws if write_finding() did not write them.
[[nodiscard]] Finding read_finding(const std::filesystem::path& json);

/// Removes all files of that name.
void remove_finding(const std::filesystem::path& folder, const std::string& name);

/// The folder of findings: OCTETRA_FOUND, or a folder beside the test programs.
[[nodiscard]] std::filesystem::path found_folder();

}  // namespace octetra::properties
