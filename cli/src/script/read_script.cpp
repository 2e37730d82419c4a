#include "script/read_script.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/files/lists.hpp>

#include "script/parse_step.hpp"

namespace octetra::cli {
namespace {

/// Collective. All processes get the lines that the first one has read.
std::vector<TextLine> lines_of(const std::filesystem::path& path,
                               const distributed::Communicator& world) {
    std::vector<std::uint64_t> numbers;
    std::vector<char> text;
    world.on_first([&] {
        for (const TextLine& line : read_lines(path)) {
            numbers.push_back(line.number);
            text.insert(text.end(), line.text.begin(), line.text.end());
            text.push_back('\n');
        }
    });
    world.broadcast(numbers);
    world.broadcast(text);
    std::vector<TextLine> lines;
    auto begin = text.begin();
    for (const std::uint64_t number : numbers) {
        const auto end = std::find(begin, text.end(), '\n');
        lines.push_back({number, std::string(begin, end)});
        begin = end + 1;
    }
    return lines;
}

InputError wrong_line(const std::filesystem::path& path, std::uint64_t line,
                      std::string_view what) {
    return InputError(fmt::format("{}:{}: {}", path.native(), line, what));
}

}  // namespace

Script read_script(const std::filesystem::path& path, const distributed::Communicator& world) {
    Script script{path, {}};
    for (const auto& [number, text] : lines_of(path, world)) {
        try {
            script.steps.push_back(parse_step(text));
            script.steps.back().line = number;
        } catch (const InputError& error) {
            throw wrong_line(path, number, error.what());
        }
    }
    if (script.steps.empty()) throw wrong_line(path, 1, "there is no step in this file");
    return script;
}

InputError wrong_line(const Script& script, const ScriptStep& step, std::string_view what) {
    if (script.path.empty()) return InputError(std::string(what));
    return wrong_line(script.path, step.line, what);
}

}  // namespace octetra::cli
