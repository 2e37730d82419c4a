#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>

#include "files/output/output_file.hpp"
#include "support/temporary_folder.hpp"
#include "verify/thread_group.hpp"

namespace {

/// The number of temporary names with predicted random bytes; later names use random bytes of the
/// system.
int predicted_names = 0;

}  // namespace

/// Replaces the C library's function in the whole program.
int getentropy(void* bytes, size_t size) {
    if (predicted_names == 0) {
        return ::syscall(SYS_getrandom, bytes, size, 0) == static_cast<long>(size) ? 0 : -1;
    }
    --predicted_names;
    std::memset(bytes, 0x5a, size);
    return 0;
}

/// The output file below the mesh writers, with the volumes of meshes of many gigabytes.
namespace octetra {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20U;

TEST(OutputFile, KeepsCountOfBlocksOfEverySizeAcrossItsBuffer) {
    for (const std::size_t size :
         {std::size_t{0}, buffer_size - 3, buffer_size, buffer_size + 1, 3 * buffer_size}) {
        const test::TemporaryFolder folder;
        const std::string block(size, 'b');
        OutputFile out(folder / "a");
        out.put(std::string_view{"head"});
        out.put_bytes(block.data(), block.size());
        EXPECT_EQ(out.position(), 4 + size);
        out.put(std::string_view{"tail"});
        EXPECT_EQ(out.position(), 8 + size);
        out.overwrite(1, "EA", 2);
        out.overwrite(4 + size, "T", 1);
        out.put('.');
        EXPECT_EQ(out.position(), 9 + size);
        out.commit();
        EXPECT_TRUE(test::content_of(folder / "a") == "hEAd" + block + "Tail.") << size;
    }
}

/// The bytes that a rank puts in a turn, and the end of the turn: a function of the arguments.
struct Turn {
    std::string block;
    bool ends_later = false;
    std::size_t overwritten = 0;  ///< a byte of the output so far, overwritten after the turn
    int overwriter = 0;           ///< the rank that overwrites it; may be none
};

Turn turn_of(int number, int rank, int ranks, std::size_t put_so_far) {
    std::mt19937 random(static_cast<unsigned>(number));  // all ranks must agree on the end
    Turn turn{.ends_later = random() % 3 != 0,
              .overwritten = put_so_far == 0 ? 0 : random() % put_so_far,
              .overwriter = static_cast<int>(random() % static_cast<unsigned>(ranks + 1))};
    random.seed(static_cast<unsigned>(100 * number + rank));
    const std::size_t most = random() % 8 == 0 ? 3 * buffer_size : 1000;
    turn.block.assign(random() % 4 == 0 ? 0 : random() % most,
                      static_cast<char>('a' + (number + rank) % 26));
    return turn;
}

void put_in_parts(OutputFile& out, const std::string& block) {
    const std::size_t some = std::min<std::size_t>(block.size(), 100);
    for (std::size_t i = 0; i < some; ++i) out.put(block[i]);
    const std::string_view rest = std::string_view(block).substr(some);
    out.put(rest.substr(0, rest.size() / 3));
    out.put_bytes(rest.data() + rest.size() / 3, rest.size() - rest.size() / 3);
}

TEST(OutputFile, OfAGroupHasTheOutputOfAllInOrderHoweverTheirTurnsEnd) {
    constexpr int turns = 60;
    for (const int ranks : {2, 3, 4}) {
        std::string expected;
        for (int number = 0; number < turns; ++number) {
            const std::size_t before = expected.size();
            const Turn first = turn_of(number, 0, ranks, before);
            for (int rank = 0; rank < ranks; ++rank) {
                expected += turn_of(number, rank, ranks, before).block;
            }
            const bool overwrites = !first.ends_later && before > 0 && first.overwriter < ranks;
            if (overwrites) expected[first.overwritten] = '#';
        }
        const test::TemporaryFolder folder;
        test::run_together(ranks, [&](const ProcessGroup& group) {
            OutputFile out(folder / "a", group);
            for (int number = 0; number < turns; ++number) {
                const auto before = static_cast<std::size_t>(out.position());
                const Turn turn = turn_of(number, group.rank(), ranks, before);
                put_in_parts(out, turn.block);
                if (turn.ends_later) {
                    out.end_turn_later();
                    continue;
                }
                out.end_turn();
                if (before > 0 && turn.overwriter == group.rank()) {
                    out.overwrite(turn.overwritten, "#", 1);
                }
            }
            out.commit();
        });
        EXPECT_TRUE(test::content_of(folder / "a") == expected) << ranks << " ranks";
    }
}

constexpr const char* predicted_name = "a.5a5a5a5a5a5a.tmp";

TEST(OutputFile, WritesToNoFileThatHasItsTemporaryName) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "other", "as it was");
    for (const bool is_link : {true, false}) {
        const std::filesystem::path planted = folder / predicted_name;
        if (is_link) {
            std::filesystem::create_symlink("other", planted);
        } else {
            test::write_file(planted, "of another program");
        }
        predicted_names = 2;
        write_text("text", folder / "a");
        EXPECT_EQ(predicted_names, 0) << "other names have been tried";
        EXPECT_EQ(test::content_of(folder / "a"), "text");
        EXPECT_EQ(test::content_of(folder / "other"), "as it was");
        EXPECT_EQ(test::content_of(planted), is_link ? "as it was" : "of another program");
        EXPECT_EQ(std::filesystem::is_symlink(planted), is_link);
        std::filesystem::remove(planted);
    }
}

TEST(OutputFile, OfAGroupIsTheOneThatTheFirstRankHasCreated) {
    const test::TemporaryFolder folder;
    test::write_file(folder / predicted_name, "of another program");
    predicted_names = 1;
    test::run_together(3, [&](const ProcessGroup& group) {
        OutputFile out(folder / "a", group);
        out.put(static_cast<char>('0' + group.rank()));
        out.commit();
    });
    EXPECT_EQ(test::content_of(folder / "a"), "012");
    EXPECT_EQ(test::content_of(folder / predicted_name), "of another program");
}

TEST(OutputFile, EndsWhereAllTemporaryNamesAreTakenAndRemovesNone) {
    const test::TemporaryFolder folder;
    test::write_file(folder / predicted_name, "of another program");
    predicted_names = 1000;
    EXPECT_THROW(OutputFile(folder / "a"), SystemError);
    predicted_names = 0;
    EXPECT_EQ(test::content_of(folder / predicted_name), "of another program");
}

/// The pieces that a rank puts.
std::vector<std::string> pieces_of(int rank) {
    std::mt19937 random(static_cast<unsigned>(rank));
    std::vector<std::string> pieces(random() % 12);  // some ranks put nothing
    for (std::string& piece : pieces) {
        const std::size_t most = random() % 4 == 0 ? 3 * buffer_size : 1000;
        const std::size_t length = random() % most;
        piece.assign(length, static_cast<char>('a' + random() % 26));
    }
    return pieces;
}

TEST(OutputFile, OfAGroupHasTheSharesOfAllInOrder) {
    for (const int ranks : {2, 3, 5}) {
        std::string expected = "head";
        for (int rank = 0; rank < ranks; ++rank) {
            for (const std::string& piece : pieces_of(rank)) expected += piece;
        }
        const std::size_t size = expected.size();
        for (int rank = 0; rank < ranks; ++rank) expected += "tail";
        const test::TemporaryFolder folder;
        test::run_together(ranks, [&](const ProcessGroup& group) {
            OutputFile out(folder / "a", group);
            if (group.is_first()) out.put(std::string_view{"head"});
            const std::vector<std::string> pieces = pieces_of(group.rank());
            std::uint64_t own = 0;
            for (const std::string& piece : pieces) own += piece.size();
            out.begin_ranges(own);
            for (const std::string& piece : pieces) {
                put_in_parts(out, piece);
                out.end_turn_later();
            }
            out.end_ranges();
            EXPECT_EQ(out.position(), size);
            out.put(std::string_view{"tail"});
            out.commit();
        });
        EXPECT_TRUE(test::content_of(folder / "a") == expected) << ranks << " ranks";
    }
}

TEST(OutputFile, IsNotWrittenIfAShareHasAnotherSizeThanAnnounced) {
    const test::TemporaryFolder folder;
    for (const std::uint64_t said : {std::uint64_t{4}, std::uint64_t{6}}) {
        test::run_together(3, [&](const ProcessGroup& group) {
            OutputFile out(folder / "a", group);
            out.begin_ranges(group.rank() == 1 ? said : 5);
            out.put(std::string_view{"12345"});
            out.end_turn_later();
            out.end_ranges();
            EXPECT_THROW(out.commit(), SystemError);
        });
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    }
}

TEST(OutputFile, ThatIsNotCommittedLeavesNoTrace) {
    const test::TemporaryFolder folder;
    {
        OutputFile out(folder / "a");
        out.put(std::string_view{"lost"});
        out.close();
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace octetra
