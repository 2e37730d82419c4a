#include "script/parse_step.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>

#include "commands/fit_options.hpp"
#include "usage_errors.hpp"

namespace octetra::cli {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

/// Returns the word that begins at `at`, and moves `at` behind it. As in a shell, blanks between
/// quotation marks are part of the word, and the marks are not.
std::string word_at(std::string_view line, std::size_t& at) {
    std::string word;
    while (at < line.size() && blanks.find(line[at]) == std::string_view::npos) {
        const char c = line[at++];
        if (c != '"' && c != '\'') {
            word += c;
            continue;
        }
        const std::size_t end = line.find(c, at);
        if (end == std::string_view::npos) {
            throw InputError(fmt::format("the closing quotation mark {} is missing", c));
        }
        word += line.substr(at, end - at);
        at = end + 1;
    }
    return word;
}

std::vector<std::string> words_of(std::string_view line) {
    const auto is_control = [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f;
    };
    if (std::ranges::any_of(line, is_control)) {
        throw InputError("there is a control character in this line: not a text file?");
    }
    std::vector<std::string> words;
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
        words.push_back(word_at(line, at));
        at = line.find_first_not_of(blanks, at);
    }
    return words;
}

/// Returns a hint for an option in a line that belongs on the command line.
std::string options_of_adapt(const std::vector<std::string>& words) {
    constexpr std::array<std::string_view, 11> options{
        "-o",        "--output", "--partition", "--sync",   "--max-cells",      "--verify",
        "--profile", "--trace",  "--quiet",     "--script", "--fix-orientation"};
    for (const std::string& word : words) {
        const std::string_view name = std::string_view(word).substr(0, word.find('='));
        if (std::ranges::find(options, name) == options.end()) continue;
        return fmt::format("; {} is for the command octetra adapt, not for a step{}", name,
                           name == "-o" || name == "--output"
                               ? ": a line save FILE.octetra or write FILE writes the mesh"
                               : "");
    }
    return {};
}

/// Parses the options of a step like those of a subcommand. CLI11 expects words in reverse order.
void parse_words(CLI::App& command, std::vector<std::string> words) {
    std::ranges::reverse(words);
    try {
        command.parse(words);
    } catch (const CLI::ParseError& error) {
        throw InputError(usage_fault(command, error) + options_of_adapt(words));
    }
}

/// A command without --help and without flag values such as --all=3.
struct LineCommand : CLI::App {
    explicit LineCommand(const std::string& word) : CLI::App("", word) {
        set_help_flag();
        option_defaults()->disable_flag_override();
    }
};

Step parse_refine(std::vector<std::string> options) {
    LineCommand command("refine");
    RefineStep step;
    add_refinement_options(command, step.typed, "");
    add_closure_option(command, step.typed);
    add_target_option(command, step.typed);
    parse_words(command, std::move(options));
    complete_levels(command, step.typed);
    group_criteria(command, step.typed.selection);
    step.selection = parse_selection(step.typed.selection);
    step.scheme = parse_scheme(step.typed);
    step.closure = parse_closure(step.typed);
    return step;
}

Step parse_coarsen(std::vector<std::string> options) {
    LineCommand command("coarsen");
    CoarsenStep step;
    add_coarsening_options(command, step.typed, "");
    parse_words(command, std::move(options));
    group_criteria(command, step.typed.selection);
    step.selection = parse_coarsening(step.typed);
    return step;
}

Step parse_fit(std::vector<std::string> options) {
    LineCommand command("fit");
    RefinementOptions typed;
    add_fitting_options(command, typed, "");
    parse_words(command, std::move(options));
    return FitStep{typed, parse_target_size(typed), parse_scheme(typed), parse_closure(typed)};
}

Step parse_rebalance(const std::vector<std::string>& words) {
    if (words.empty()) return RebalanceStep{};
    throw InputError(fmt::format("rebalance takes no options, but {} was given", words.front()));
}

std::string only_name(const std::vector<std::string>& words, std::string_view word,
                      std::string_view example) {
    if (words.size() == 1) return words.front();
    throw InputError(
        fmt::format("{} takes the name of one file, in quotation marks if it has blanks: {} {}",
                    word, word, example));
}

Step parse_write(const std::vector<std::string>& words) {
    return WriteStep{only_name(words, "write", "STEP.vtu")};
}

Step parse_save(const std::vector<std::string>& words) {
    WriteStep step{only_name(words, "save", "STATE.octetra")};
    if (!is_checkpoint(step.path)) {
        throw InputError(fmt::format(
            "save writes .octetra files, not {}; write takes the other formats", step.path));
    }
    return step;
}

struct StepParser {
    std::string_view word;
    Step (*parse)(std::vector<std::string> options);
};

constexpr std::array<StepParser, 6> step_parsers{
    {{"refine", parse_refine},
     {"coarsen", parse_coarsen},
     {"fit", parse_fit},
     {"rebalance", [](std::vector<std::string> words) { return parse_rebalance(words); }},
     {"save", [](std::vector<std::string> words) { return parse_save(words); }},
     {"write", [](std::vector<std::string> words) { return parse_write(words); }}}};

[[noreturn]] void refuse_word(const std::string& word) {
    std::vector<std::string> names;
    for (const auto& [name, parse] : step_parsers) names.emplace_back(name);
    throw InputError(fmt::format("a step begins with one of {}, not '{}'{}", fmt::join(names, ", "),
                                 word, did_you_mean(word, names)));
}

}  // namespace

ScriptStep parse_step(std::string_view line) {
    std::vector<std::string> words = words_of(line);
    const std::string word = words.front();
    const auto* const known =
        std::ranges::find_if(step_parsers, [&](const StepParser& s) { return s.word == word; });
    if (known == step_parsers.end()) refuse_word(word);
    words.erase(words.begin());
    return {0, word, known->parse(std::move(words))};
}

}  // namespace octetra::cli
