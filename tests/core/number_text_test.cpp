#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/from_chars.hpp>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"
#include "files/output/text_row.hpp"
#include "files/output/text_slices.hpp"
#include "support/temporary_folder.hpp"

/// Conversion of numbers to and from text, several digits at a time.
namespace octetra {
namespace {

std::string text_of(auto number) {
    std::array<char, longest_number> room;
    return {room.data(), put_number(room.data(), number)};
}

/// Numbers of all lengths: the least and the greatest, their neighbours, and some between.
std::vector<std::uint64_t> numbers_of_every_length() {
    std::mt19937_64 random(1);
    std::vector<std::uint64_t> numbers{0, 1, std::numeric_limits<std::uint64_t>::max()};
    for (std::uint64_t power = 10;; power *= 10) {
        for (const std::uint64_t below : {1U, 2U}) numbers.push_back(power - below);
        for (const std::uint64_t above : {0U, 1U}) numbers.push_back(power + above);
        const bool is_last = power > std::numeric_limits<std::uint64_t>::max() / 10;
        const std::uint64_t most = is_last ? std::numeric_limits<std::uint64_t>::max() : power * 10;
        for (int i = 0; i < 100; ++i) numbers.push_back(power + random() % (most - power));
        if (is_last) return numbers;
    }
}

TEST(NumberText, IsThatOfEveryNumberBelowTwoMillion) {
    for (std::uint32_t number = 0; number < 2'000'000; ++number) {
        ASSERT_EQ(text_of(number), fmt::format("{}", number));
    }
}

TEST(NumberText, IsThatOfNumbersOfEveryLength) {
    for (const std::uint64_t number : numbers_of_every_length()) {
        ASSERT_EQ(text_of(number), fmt::format("{}", number));
        const auto sum = static_cast<std::int64_t>(number);
        ASSERT_EQ(text_of(sum), fmt::format("{}", sum));
    }
    using Limits = std::numeric_limits<std::int32_t>;
    for (const std::int32_t number : {Limits::min(), Limits::min() + 1, -10, -1, Limits::max()}) {
        ASSERT_EQ(text_of(number), fmt::format("{}", number));
    }
}

TEST(TextRow, HasASpaceBetweenNumbersAcrossTheFilesBuffer) {
    const test::TemporaryFolder folder;
    std::string expected;
    OutputFile out(folder / "a");
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        TextRow row(out);
        for (std::uint64_t k = 0; k < i % 20; ++k) {
            if (k % 8 == 0 && k > 0) row.reserve_more();
            row.put(i * i * i + k);
            expected += fmt::format("{}{}", k == 0 ? "" : " ", i * i * i + k);
        }
        row.end();
        expected += '\n';
    }
    out.commit();
    EXPECT_TRUE(test::content_of(folder / "a") == expected);
}

/// Files longer than a buffer, without a line end at the end, where the buffer still holds older
/// bytes.
TEST(Fields, HaveTheValueOfNumbersOfEveryLength) {
    const test::TemporaryFolder folder;
    std::vector<std::uint64_t> numbers;
    for (int i = 0; i < 70; ++i) {
        const auto some = numbers_of_every_length();
        numbers.insert(numbers.end(), some.begin(), some.end());
    }
    std::mt19937 random(2);
    for (int round = 0; round < 8; ++round) {
        std::ranges::shuffle(numbers, random);
        std::string text;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::string zeros(random() % 8 == 0 ? random() % 5 : 0, '0');
            constexpr std::array<std::string_view, 4> ends{" ", "\t", "\n", "\r\n"};
            text += zeros + fmt::format("{}", numbers[i]);
            text += i + 1 == numbers.size() ? "" : ends.at(random() % ends.size());
        }
        ASSERT_GT(text.size(), std::size_t{1} << 20U);
        LineReader reader(folder.write("a", text));
        std::vector<std::uint64_t> found;
        while (reader.next()) {
            Fields fields(reader);
            while (!fields.at_end()) found.push_back(fields.unsigned_integer("a number"));
        }
        ASSERT_TRUE(found == numbers);
    }
}

/// No other byte is taken for a digit or for the end of a number.
TEST(Fields, RefuseEveryOtherByteInsideANumber) {
    const test::TemporaryFolder folder;
    for (int byte = 1; byte < 256; ++byte) {
        const char c = static_cast<char>(byte);
        if (c == '\n' || c == '#' || is_blank(c) || (c >= '0' && c <= '9')) continue;
        for (std::size_t length = 1; length <= 17; ++length) {
            for (const std::size_t place : {std::size_t{1}, (length + 1) / 2, length}) {
                std::string number(length, '7');
                number.insert(place, 1, c);
                LineReader reader(folder.write("a", number + " 1\n"));
                ASSERT_TRUE(reader.next());
                Fields fields(reader);
                ASSERT_ANY_THROW((void)fields.unsigned_integer("a number")) << number;
            }
        }
    }
}

TEST(TextLength, IsThatOfTheText) {
    const auto expect = [](auto number) {
        ASSERT_EQ(text_length(number), std::to_string(number).size()) << number;
    };
    std::mt19937_64 random(5);
    for (unsigned shift = 0; shift < 64; ++shift) {
        for (int i = 0; i < 200; ++i) {
            const std::uint64_t number = random() >> shift;
            expect(number);
            expect(static_cast<std::int64_t>(number));
            expect(static_cast<std::int32_t>(number));
        }
    }
    for (std::uint64_t power = 1; power <= 1'000'000'000'000'000'000; power *= 10) {
        for (const std::uint64_t number : {power - 1, power, power + 1}) expect(number);
    }
    expect(std::numeric_limits<std::uint64_t>::max());
    expect(std::numeric_limits<std::int64_t>::min());
    expect(std::numeric_limits<std::int32_t>::min());
}

TEST(TextLength, OfConsecutiveNumbersIsTheirSum) {
    std::vector<std::uint64_t> before{0};
    for (std::uint64_t number = 0; number < 1200; ++number) {
        before.push_back(before.back() + std::to_string(number).size());
    }
    for (std::uint64_t begin = 0; begin <= 1200; ++begin) {
        for (std::uint64_t end = begin; end <= 1200; end += 1 + end / 40) {
            ASSERT_EQ(text_length_between(begin, end), before[end] - before[begin])
                << begin << " to " << end;
        }
    }
    constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(text_length_between(last - 2, last), 40);
    EXPECT_EQ(text_length_between(9'999'999'998, 10'000'000'003), 2 * 10 + 3 * 11);
}

struct Parsed {
    std::ptrdiff_t length;
    std::errc error;
    std::uint64_t bits;
    bool operator==(const Parsed&) const = default;
};

/// Before the number, 7 is stored where it belongs.
Parsed parsed(const std::string& text, auto parse) {
    double number = 7;
    const auto [stop, error] = parse(text.data(), text.data() + text.size(), number);
    return {stop - text.data(), error, std::bit_cast<std::uint64_t>(number)};
}

TEST(FromChars, ByStrtodHasTheResultsOfTheStandardLibrary) {
    const auto expect_same = [](const std::string& text) {
        const auto standard = [](const char* first, const char* last, double& number) {
            return std::from_chars(first, last, number);
        };
        EXPECT_EQ(parsed(text, from_chars_by_strtod), parsed(text, standard)) << text;
    };
    for (const char* const text : {"",       "+1",        " 1",
                                   "-",      "-0",        "0x1p3",
                                   "1e400",  "-1e400",    "1e-400",
                                   "5e-324", "2.2e-308",  "1e",
                                   "1e+",    "1.5e-7,",   ".5",
                                   "5.",     ".",         "-.5e2x",
                                   "inf",    "-Infinity", "infinite",
                                   "1,5",    "1 2",       "1_0",
                                   "--1",    "-+1",       "0.1000000000000000055511151231257827"}) {
        expect_same(text);
    }
    std::mt19937 random(5);
    for (int i = 0; i < 200'000; ++i) {
        std::string text;
        for (auto left = 1 + random() % 12; left > 0; --left) {
            text += "0123456789.-+eExinf, "[random() % 21];
        }
        expect_same(text);
    }
}

/// Lines with and without comments, in a file of several buffers.
TEST(LineReader, RemovesCommentsAtAnyPosition) {
    const test::TemporaryFolder folder;
    std::mt19937 random(3);
    for (const unsigned seldom : {1U, 3U, 50'000U}) {
        std::string text;
        std::vector<std::string> expected;
        while (text.size() < 3'300'000) {
            std::string line(1 + random() % 100, static_cast<char>('a' + random() % 26));
            std::string comment;
            if (random() % seldom == 0) {
                comment = " # " + std::string(random() % 100, '#');
                if (random() % 3 == 0) line.clear();
            }
            text += line + comment + "\n";
            if (!line.empty()) expected.push_back(line);
        }
        LineReader reader(folder.write("a", text));
        std::size_t count = 0;
        while (reader.next()) {
            ASSERT_LT(count, expected.size());
            ASSERT_EQ(reader.line(), expected[count++]);
        }
        ASSERT_EQ(count, expected.size());
    }
}

}  // namespace
}  // namespace octetra
