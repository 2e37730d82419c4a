#include "numbering/compressed_words.hpp"

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace octetra::distributed {
namespace {

TEST(CompressedWords, AreDecodedUnchanged) {
    std::mt19937_64 random(1);
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    for (int k = 0; k < 500; ++k) {
        std::vector<std::uint64_t> words(random() % 20);
        for (std::uint64_t& word : words) {
            const std::uint64_t any = random() >> random() % 64U;
            word = random() % 8 == 0 ? most - any : any;
        }
        EXPECT_EQ(decompressed(compressed(words)), words);
    }
}

/// Numbers that increase by one, and counts that vary little.
TEST(CompressedWords, TakeOneByteEachIfTheyChangeLittle) {
    std::vector<std::uint64_t> words;
    for (std::uint64_t k = 0; k < 1000; ++k)
        words.insert(words.end(), {1'000'000'000 + k, 10 + k % 7});
    EXPECT_LE(compressed(words).size(), words.size() + 10);
}

}  // namespace
}  // namespace octetra::distributed
