#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/console.hpp"
#include "support/temporary_folder.hpp"

/// The sessions in this folder: what commands print, write and return.
///
/// Each .txt file is a suite of its name. A line "== NAME" begins a case; the commands before the
/// first case are run before each case, which has a folder of its own. Empty lines and lines that
/// begin with "# " are comments.
namespace octetra::test {
namespace {

class Session : public testing::Test {
public:
    Session(std::string file, std::vector<ConsoleStep> steps)
        : file_(std::move(file)), steps_(std::move(steps)) {}

private:
    void TestBody() override {
        const TemporaryFolder folder;
        run_steps(steps_, folder.path(), file_);
    }

    std::string file_;
    std::vector<ConsoleStep> steps_;
};

void register_sessions(const std::filesystem::path& path) {
    std::vector<ConsoleStep> before;
    std::vector<std::pair<std::string, std::vector<ConsoleStep>>> cases;
    std::ifstream in(path);
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.starts_with("== ")) {
            cases.emplace_back(line.substr(3), before);
        } else if (!line.empty() && !line.starts_with("# ")) {
            take_console_line(cases.empty() ? before : cases.back().second, number, line);
        }
    }
    for (const auto& [name, steps] : cases) {
        testing::RegisterTest(path.stem().c_str(), name.c_str(), nullptr, nullptr, path.c_str(), 1,
                              [file = path.filename().string(), steps = steps]() -> testing::Test* {
                                  return new Session(file, steps);
                              });
    }
}

[[maybe_unused]] const bool are_registered = [] {
    const std::filesystem::path folder = OCTETRA_SOURCE_DIR "/tests/console";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".txt" && entry.path().stem() != "CMakeLists") {
            register_sessions(entry.path());
        }
    }
    return true;
}();

}  // namespace
}  // namespace octetra::test
