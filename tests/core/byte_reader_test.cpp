#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>

#include "files/input/byte_reader.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

template <class T>
std::string bytes_of(T number) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(number);
    return {bytes.data(), bytes.size()};
}

/// The same number in the opposite byte order.
template <class T>
std::string reversed_bytes_of(T number) {
    std::string bytes = bytes_of(number);
    std::ranges::reverse(bytes);
    return bytes;
}

std::string refusal(const auto& work) { return test::thrown_by<InputError>(work); }

TEST(ByteReader, TakesNumbersOfEverySizeInEitherByteOrder) {
    const TemporaryFolder folder;
    const auto written = [](auto number, auto... numbers) {
        return std::pair((bytes_of(number) + ... + bytes_of(numbers)),
                         (reversed_bytes_of(number) + ... + reversed_bytes_of(numbers)));
    };
    const auto [native, other] =
        written(std::int8_t{-3}, std::uint16_t{0x1234}, std::int32_t{-70000}, 1.5F,
                std::int64_t{-5'000'000'000}, -0.1);
    for (const bool swapped : {false, true}) {
        ByteReader reader(folder.write("a", swapped ? other : native));
        reader.swap_bytes(swapped);
        EXPECT_EQ(reader.take<std::int8_t>("it"), -3);
        EXPECT_EQ(reader.take<std::uint16_t>("it"), 0x1234);
        EXPECT_EQ(reader.take<std::int32_t>("it"), -70000);
        EXPECT_EQ(reader.take<float>("it"), 1.5F);
        EXPECT_EQ(reader.position(), 11U);
        EXPECT_EQ(reader.remaining(), 16U);
        EXPECT_EQ(reader.take<std::int64_t>("it"), -5'000'000'000);
        EXPECT_EQ(reader.take<double>("it"), -0.1);
        EXPECT_EQ(reader.remaining(), 0U);
    }
}

TEST(ByteReader, TakesListsOfEveryLengthAcrossItsBuffer) {
    constexpr std::size_t in_buffer = ByteReader::buffer_size / sizeof(double);
    const TemporaryFolder folder;
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, in_buffer - 1, in_buffer, in_buffer + 1, 5 * in_buffer}) {
        for (const bool swapped : {false, true}) {
            std::vector<double> expected(count);
            std::string bytes = "abc";
            for (std::size_t i = 0; i < count; ++i) {
                expected[i] = 1.0 / static_cast<double>(i + 1);
                bytes += swapped ? reversed_bytes_of(expected[i]) : bytes_of(expected[i]);
            }
            ByteReader reader(folder.write("a", bytes + "z"));
            reader.swap_bytes(swapped);
            for (const char c : {'a', 'b', 'c'}) EXPECT_EQ(reader.take<char>("a head"), c);
            std::vector<double> found(count);
            reader.take<double>(found, "numbers");
            EXPECT_TRUE(found == expected) << count;
            EXPECT_EQ(reader.take<char>("the last"), 'z');
        }
    }
}

TEST(ByteReader, HandsOutWholeRowsUntilAllAreThere) {
    constexpr std::size_t row_size = 28;
    constexpr std::size_t rows = 3 * ByteReader::buffer_size / row_size;
    std::string bytes(5 + rows * row_size, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 251);
    const TemporaryFolder folder;
    ByteReader reader(folder.write("a", bytes + "z"));
    reader.seek(5);
    std::string found = bytes.substr(0, 5);
    for (std::size_t left = rows; left > 0;) {
        const auto some = reader.take_rows(left == rows ? 2 : left, row_size, "a row");
        ASSERT_EQ(some.size() % row_size, 0U);
        ASSERT_GE(some.size(), row_size);
        if (left == rows) {
            ASSERT_EQ(some.size(), 2 * row_size);
        }
        found.append(reinterpret_cast<const char*>(some.data()), some.size());
        left -= some.size() / row_size;
    }
    EXPECT_TRUE(found == bytes);
    EXPECT_EQ(reader.take<char>("the last"), 'z');
}

TEST(ByteReader, SeeksToAnyPositionWithinTheFileOnly) {
    std::string bytes(3 * ByteReader::buffer_size + 7, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 253);
    const TemporaryFolder folder;
    ByteReader reader(folder.write("a", bytes));
    for (const std::size_t place : {bytes.size() - 1, std::size_t{0}, ByteReader::buffer_size,
                                    std::size_t{17}, 2 * ByteReader::buffer_size - 1,
                                    std::size_t{0}, ByteReader::buffer_size + 1, std::size_t{5}}) {
        reader.seek(place);
        EXPECT_EQ(reader.position(), place);
        EXPECT_EQ(reader.take<char>("it"), bytes[place]);
    }
    reader.seek(bytes.size());
    EXPECT_EQ(reader.remaining(), 0U);
    reader.seek(9);
    EXPECT_THAT(
        refusal([&] { reader.seek(bytes.size() + 1); }),
        HasSubstr("/a: at byte 9: the file refers to byte 3145736, but has only 3145735 bytes"));
}

TEST(ByteReader, TakesLinesOfText) {
    const TemporaryFolder folder;
    const std::string longest(ByteReader::buffer_size - 1, 'x');
    ByteReader reader(folder.write("a", "one\r\n\n" + longest + "\nlast"));
    EXPECT_EQ(reader.take_line("a line"), "one");
    EXPECT_EQ(reader.take_line("a line"), "");
    EXPECT_TRUE(reader.take_line("a line") == longest);
    EXPECT_EQ(reader.take_line("a line"), "last");
    EXPECT_THAT(refusal([&] { (void)reader.take_line("a line"); }),
                HasSubstr("at byte 1048586: the file ends where a line should be"));
    ByteReader too_long(folder.write("b", "one\n" + longest + "xx\n"));
    EXPECT_EQ(too_long.take_line("a line"), "one");
    EXPECT_THAT(refusal([&] { (void)too_long.take_line("a keyword"); }),
                HasSubstr("/b: at byte 4: a line of more than 1048576 bytes where a keyword"));
}

TEST(ByteReader, NamesTheByteWhereTheFileEndsTooEarly) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", std::string(10, '\0'));
    const auto refused = [&](const auto& take) {
        ByteReader reader(file);
        reader.seek(7);
        return refusal([&] { take(reader); });
    };
    const auto expected = HasSubstr("/a: at byte 7: the file ends where it should be");
    EXPECT_THAT(refused([](ByteReader& r) { (void)r.take<std::int32_t>("it"); }), expected);
    EXPECT_THAT(refused([](ByteReader& r) { (void)r.take_bytes(4, "it"); }), expected);
    EXPECT_THAT(refused([](ByteReader& r) { (void)r.take_rows(1, 4, "it"); }), expected);
    EXPECT_THAT(refused([](ByteReader& r) { r.skip(4, "it"); }), expected);
    EXPECT_THAT(refused([](ByteReader& r) {
                    std::array<std::int16_t, 2> two{};
                    r.take<std::int16_t>(two, "it");
                }),
                expected);
    ByteReader empty(folder.write("b", ""));
    EXPECT_THAT(refusal([&] { (void)empty.take<char>("it"); }), HasSubstr("/b: at byte 0: "));
}

TEST(ByteReader, RefusesCountsThatTheFileDoesNotHold) {
    const TemporaryFolder folder;
    ByteReader reader(folder.write("a", std::string(100, '\0')));
    reader.seek(10);
    reader.check_count(9, 10, "rows", 2);
    EXPECT_THAT(refusal([&] { reader.check_count(10, 10, "rows", 2); }),
                HasSubstr("/a: at byte 2: 10 rows announced, but the 90 bytes that follow hold at "
                          "most 9"));
    EXPECT_THAT(refusal([&] { reader.check_count(~std::uint64_t{0}, 2, "rows", 2); }),
                HasSubstr("hold at most 45"));
}

TEST(ByteReader, IsOfAFile) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal([&] { ByteReader reader(folder / "none"); }),
                HasSubstr("cannot be opened"));
    EXPECT_THAT(refusal([&] { ByteReader reader(folder.path()); }), HasSubstr("is not a file"));
}

}  // namespace
}  // namespace octetra
