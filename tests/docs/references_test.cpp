#include <algorithm>
#include <cctype>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "docs/pages.hpp"

/// Checks that links, paths and test names in the pages exist in the repository.
namespace octetra::test {
namespace {

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) {
        found.push_back((*i)[1]);
    }
    return found;
}

/// Returns whether the path exists; a `*` at its end matches any suffix.
bool exists(const std::string& path) {
    const std::filesystem::path full = repository / path;
    if (!path.ends_with('*')) return std::filesystem::exists(full);
    const std::string beginning = full.filename().string();
    const auto begins_so = [&](const auto& entry) {
        return entry.path().filename().string().starts_with(
            beginning.substr(0, beginning.size() - 1));
    };
    return std::ranges::any_of(std::filesystem::directory_iterator(full.parent_path()), begins_so);
}

class Markdown : public testing::TestWithParam<std::string> {};

TEST_P(Markdown, LinksLeadSomewhere) {
    const std::filesystem::path folder = std::filesystem::path(GetParam()).parent_path();
    for (const std::string& line : page(GetParam()).prose) {
        for (const std::string& target : matches(line, R"(\]\(([^)#\s]+)[^)]*\))")) {
            if (target.starts_with("http")) continue;
            EXPECT_TRUE(std::filesystem::exists(repository / folder / target))
                << GetParam() << " links to " << target;
        }
    }
}

/// The anchor that GitHub makes of a heading: lower case, hyphens for blanks, no other punctuation.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
            anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else if (c == ' ') {
            anchor += '-';
        }
    }
    return anchor;
}

std::vector<std::string> anchors_of(const std::string& page_name) {
    std::vector<std::string> anchors;
    for (const std::string& line : page(page_name).prose) {
        const auto text = line.find_first_not_of('#');
        if (line.starts_with('#') && text != std::string::npos) {
            anchors.push_back(anchor_of(line.substr(text + 1)));
        }
    }
    return anchors;
}

TEST_P(Markdown, LinksIntoPagesLeadToTheirHeadings) {
    const std::filesystem::path folder = std::filesystem::path(GetParam()).parent_path();
    for (const std::string& line : page(GetParam()).prose) {
        for (const std::string& target : matches(line, R"(\]\(((?!http)[^)\s]*#[^)\s]+)\))")) {
            const auto hash = target.find('#');
            const std::string other = target.substr(0, hash);
            const std::string linked =
                other.empty() ? GetParam() : (folder / other).lexically_normal().string();
            EXPECT_THAT(anchors_of(linked), testing::Contains(target.substr(hash + 1)))
                << GetParam() << " links to " << target;
        }
    }
}

/// A path is text in backquotes, or the beginning of a line in a block ```text, whose first
/// component is a folder of the sources.
TEST_P(Markdown, PathsExist) {
    const std::string sources =
        "((?:core|reference|distributed|verify|cli|corpus|tests|tools|bench|docs|cmake|\\.ci)/"
        "[^`\\s]*)";
    const Page content = page(GetParam());
    const auto expect_all = [&](const std::vector<std::string>& lines, const std::string& pattern) {
        for (const std::string& line : lines) {
            for (const std::string& path : matches(line, pattern)) {
                EXPECT_TRUE(exists(path)) << GetParam() << " speaks of " << path;
            }
        }
    };
    expect_all(content.prose, "`" + sources + "`");
    for (const FencedBlock& block : content.blocks) {
        if (block.language == "text") expect_all(block.lines, "^ *" + sources);
    }
}

/// `program.Suite.Case` is a test of that program.
TEST_P(Markdown, TestsExist) {
    for (const std::string& line : page(GetParam()).prose) {
        for (const std::string& name : matches(line, R"(`([a-z]+\.[A-Z]\w*\.[A-Z]\w*)`)")) {
            const auto first = name.find('.');
            const auto last = name.rfind('.');
            std::string declared = "(";
            declared += name.substr(first + 1, last - first - 1);
            declared += ", ";
            declared += name.substr(last + 1);
            declared += ")";
            const auto folder = repository / "tests" / name.substr(0, first);
            ASSERT_TRUE(std::filesystem::exists(folder)) << name;
            std::string session = "\n== ";  // of the file SUITE.txt
            session += name.substr(last + 1);
            session += "\n";
            const auto declares = [&](const auto& entry) {
                const std::string file = entry.path().filename().string();
                const bool is_session = file == name.substr(first + 1, last - first - 1) + ".txt";
                return (is_session || entry.path().extension() == ".cpp") &&
                       content_of(entry.path()).find(is_session ? session : declared) !=
                           std::string::npos;
            };
            EXPECT_TRUE(std::ranges::any_of(std::filesystem::directory_iterator(folder), declares))
                << GetParam() << " names the test " << name;
        }
    }
}

std::vector<std::string> all_pages() {
    std::vector<std::string> names = user_pages();
    names.insert(names.end(),
                 {"ARCHITECTURE.md", "TESTING.md", "CONTRIBUTING.md", "CHANGELOG.md",
                  "corpus/README.md", "bench/README.md", "tests/properties/README.md"});
    return names;
}

INSTANTIATE_TEST_SUITE_P(, Markdown, testing::ValuesIn(all_pages()),
                         [](const auto& test_case) { return name_of_test(test_case.param); });

}  // namespace
}  // namespace octetra::test
