#include <cstdint>

#include "fuzz/check_readers.hpp"
#include "support/temporary_folder.hpp"

/// One program for each reader; OCTETRA_FUZZED is its check. An exception that leaves this function
/// is a finding.
// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const octetra::test::TemporaryFolder folder;
    octetra::test::OCTETRA_FUZZED({reinterpret_cast<const char*>(bytes), size}, folder.path());
    return 0;
}
