#include <string>

#include <gtest/gtest.h>

#include "files/output/output_file.hpp"
#include "support/temporary_folder.hpp"

/// The bytes below the mesh writers, in amounts that only meshes of many gigabytes have.
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
