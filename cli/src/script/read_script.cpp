#include "script/read_script.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/files/lists.hpp>

#include "script/parse_step.hpp"

namespace octetra::cli {
namespace {

constexpr std::string_view standard_input = "-";

/// Returns the unmodified lines of a stream that can be read only once, or of a file.
std::vector<TextLine> raw_lines(std::istream& in) {
    std::vector<TextLine> lines;
    std::uint64_t number = 0;
    for (std::string text; std::getline(in, text);) lines.push_back({++number, text});
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (!lines.empty() && lines.front().text.starts_with(byte_order_mark)) {
        lines.front().text.erase(0, byte_order_mark.size());
    }
    return lines;
}

/// Returns the place of the # that begins a comment, or npos. In quotation marks it begins none.
std::size_t comment_in(std::string_view line) {
    char quotation_mark = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const char c = line[at];
        if (quotation_mark != 0) {
            if (c == quotation_mark) quotation_mark = 0;
        } else if (c == '"' || c == '\'') {
            quotation_mark = c;
        } else if (c == '#') {
            return at;
        }
    }
    return std::string_view::npos;
}

std::vector<TextLine> without_comments(std::vector<TextLine> lines) {
    constexpr std::string_view blanks = " \t\r";
    for (TextLine& line : lines) {
        line.text.erase(std::min(comment_in(line.text), line.text.size()));
        line.text.erase(line.text.find_last_not_of(blanks) + 1);
        line.text.erase(0, line.text.find_first_not_of(blanks));
    }
    std::erase_if(lines, [](const TextLine& line) { return line.text.empty(); });
    return lines;
}

/// Reads a pipe or device as a stream, a regular file by read_lines().
std::vector<TextLine> lines_in(const std::filesystem::path& path) {
    if (path == standard_input) return without_comments(raw_lines(std::cin));
    std::error_code error;
    const auto type = std::filesystem::status(path, error).type();
    using Type = std::filesystem::file_type;
    if (type != Type::fifo && type != Type::character && type != Type::socket) {
        return without_comments(read_lines(path));
    }
    std::ifstream in(path);
    return without_comments(raw_lines(in));
}

/// Collective. Returns on all processes the lines read by the first.
std::vector<TextLine> lines_of(const std::filesystem::path& path,
                               const distributed::Communicator& world) {
    std::vector<std::uint64_t> numbers;
    std::vector<char> text;
    world.on_first([&] {
        for (const TextLine& line : lines_in(path)) {
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

std::string hint_of_comment(const std::filesystem::path& path, std::uint64_t number) {
    if (!std::filesystem::is_regular_file(path)) return {};
    std::ifstream in(path);
    for (const auto& [at, text] : raw_lines(in)) {
        const auto comment = comment_in(text);
        if (at != number || comment == 0 || comment == std::string::npos) continue;
        if (text[comment - 1] == ' ' || text[comment - 1] == '\t') return {};
        return "; # begins a comment, also within a word";
    }
    return {};
}

Script read_script(const std::filesystem::path& path, const distributed::Communicator& world) {
    const bool is_piped = path == standard_input;
    Script script{is_piped ? "stdin" : path, is_piped, {}};
    for (const auto& [number, text] : lines_of(path, world)) {
        try {
            script.steps.push_back(parse_step(text));
            script.steps.back().line = number;
        } catch (const InputError& error) {
            throw wrong_line(script.path, number, error.what() + hint_of_comment(path, number));
        }
    }
    if (script.steps.empty()) throw wrong_line(script.path, 1, "there is no step in this file");
    return script;
}

InputError wrong_line(const Script& script, const ScriptStep& step, std::string_view what) {
    if (script.path.empty()) return InputError(std::string(what));
    return wrong_line(script.path, step.line, what);
}

}  // namespace octetra::cli
