#include "usage_errors.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace octetra::cli {
namespace {

/// The innermost subcommand parsed, and its name with those before it: "octetra refine".
struct Innermost {
    const CLI::App* app;
    std::string name;
};

Innermost innermost(const CLI::App& program) {
    Innermost found{&program, program.get_name()};
    while (!found.app->get_subcommands().empty()) {
        found.app = found.app->get_subcommands().front();
        found.name += fmt::format(" {}", found.app->get_name());
    }
    return found;
}

/// Returns the command that accepts options unknown to this one, or null.
const CLI::App* falls_through_to(const CLI::App& app) {
    return app.get_fallthrough() ? app.get_parent() : nullptr;
}

/// Returns the words that no command accepted.
std::vector<std::string> words_left(const CLI::App& innermost) {
    std::vector<std::string> words;
    for (const CLI::App* app = &innermost; app != nullptr && words.empty();
         app = falls_through_to(*app)) {
        words = app->remaining();
    }
    return words;
}

/// Returns the edit distance: the number of insertions, deletions and replacements of characters.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// Returns the closest of these names, if it is close enough to be a misspelling, or an empty
/// string. At most half of the letters of a misspelling, without leading dashes, are wrong.
std::string closest_name(std::string_view word, const std::vector<std::string>& names) {
    constexpr std::size_t most = 2;
    const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size());
    std::string best;
    std::size_t least = std::min(most, (word.size() - dashes) / 2) + 1;
    for (const std::string& name : names) {
        const std::size_t found = distance(word, name);
        if (found < least) {
            least = found;
            best = name;
        }
    }
    return best;
}

bool is_option(std::string_view word) {
    return word.size() > 1 && word[0] == '-' &&
           std::string_view(".0123456789").find(word[1]) == std::string_view::npos;
}

/// Returns whether the command is the program, not a subcommand or a step of a script.
bool is_program(const CLI::App& app) {
    return app.get_parent() == nullptr && app.get_require_subcommand_min() > 0;
}

std::string unknown_option(const Innermost& command, std::string_view word) {
    std::vector<std::string> names;
    for (const CLI::App* app = command.app; app != nullptr; app = falls_through_to(*app)) {
        for (const CLI::Option* option : app->get_options()) {
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        }
    }
    const std::string_view name = word.substr(0, word.find('='));
    const std::string has_none = is_program(*command.app)
                                     ? "there is no option"
                                     : command.app->get_name() + " has no option";
    return fmt::format("{} {}{}", has_none, name, did_you_mean(name, names));
}

std::string unknown_subcommand(const Innermost& command, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* subcommand : command.app->get_subcommands({})) {
        names.push_back(subcommand->get_name());
    }
    const std::string is_none =
        is_program(*command.app)
            ? fmt::format("'{}' is not one of {}", word, fmt::join(names, ", "))
            : fmt::format("{} takes one of {}, not '{}'", command.app->get_name(),
                          fmt::join(names, ", "), word);
    return is_none + did_you_mean(word, names);
}

std::string unexpected_word(const Innermost& command, std::string_view word) {
    const bool is_coordinate =
        word.find_first_not_of("0123456789.-+eE") == std::string_view::npos &&
        command.app->get_option_no_throw("--sphere") != nullptr;
    return fmt::format("{} does not expect '{}'{}", command.app->get_name(), word,
                       is_coordinate ? "; the values of an option are one word with commas, as in "
                                       "--sphere X,Y,Z,R"
                                     : "");
}

/// Returns the part of `text` between `before` and a final `after`; empty if there is none.
std::string between(std::string_view text, std::string_view before, std::string_view after) {
    const auto begin = text.find(before);
    if (begin == std::string_view::npos || !text.ends_with(after)) return {};
    text.remove_prefix(begin + before.size());
    return std::string(text.substr(0, text.size() - after.size()));
}

/// Returns "-n, --parts" for an option with a short and a long name.
std::string both_names(const CLI::App& command, const std::string& name) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    if (option == nullptr || option->get_snames().empty()) return name;
    return fmt::format("-{}, {}", option->get_snames().front(), name);
}

/// Rewords CLI11's messages on missing options and wrong numbers of values.
std::string reworded(const CLI::App& command, std::string_view said) {
    if (const std::string name = between(said, "", " is required"); name.starts_with("--")) {
        return both_names(command, name) + " is required";
    }
    const std::string_view option = said.substr(0, said.find_first_of(": "));
    if (said.ends_with(" was given a disallowed flag override")) {
        return fmt::format("--{} takes no value", option);
    }
    if (const std::string value = between(said, ": 1 required ", " missing"); !value.empty()) {
        return fmt::format("{} requires a value, {}", option, value);
    }
    if (const std::string given = between(said, " required but received ", ""); !given.empty()) {
        const std::string most = between(said.substr(0, said.find(" required")), ": At Most ", "");
        return fmt::format("{} takes no more than {} value{}, not {}", option, most,
                           most == "1" ? "" : "s", given);
    }
    return std::string(said);
}

/// Returns the message for an option that took the name of another as its value, or an empty
/// string.
std::string option_as_value(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& word : option->results()) {
            const std::string name = word.substr(0, word.find('='));
            if (!is_option(name) || command.get_option_no_throw(name) == nullptr) continue;
            return fmt::format("{} requires a value, {}: {} is an option", option->get_name(),
                               option->get_type_name(), name);
        }
    }
    return {};
}

/// CLI11 lists unaccepted words in reverse order, and requests a subcommand even if there is an
/// unknown word in its place.
std::string usage_problem(const Innermost& command, const CLI::ParseError& error) {
    if (std::string what = option_as_value(*command.app); !what.empty()) return what;
    const std::vector<std::string> words = words_left(*command.app);
    const bool lacks_subcommand = command.app->get_require_subcommand_min() > 0;
    const bool has_extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    const bool lacks_something = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (words.empty() || !(lacks_subcommand || has_extras || lacks_something)) {
        return reworded(*command.app, error.what());
    }
    if (lacks_subcommand) {
        return is_option(words.front()) ? unknown_option(command, words.front())
                                        : unknown_subcommand(command, words.front());
    }
    const auto option = std::ranges::find_if(words, is_option);
    if (option != words.end()) return unknown_option(command, *option);
    return has_extras ? unexpected_word(command, words.front())
                      : reworded(*command.app, error.what());
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
    const std::string meant = closest_name(word, names);
    return meant.empty() ? std::string() : fmt::format("; did you mean {}?", meant);
}

std::string usage_fault(const CLI::App& program, const CLI::ParseError& error) {
    return usage_problem(innermost(program), error);
}

std::string usage_error(const CLI::App& program, const CLI::ParseError& error) {
    const Innermost command = innermost(program);
    const std::string what = usage_problem(command, error);
    return fmt::format("{}{} {} --help", what, what.ends_with('?') ? " See" : "; see",
                       command.name);
}

}  // namespace octetra::cli
