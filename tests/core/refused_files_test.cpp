#include "core/refused_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>

#include "support/thrown.hpp"

namespace octetra::test {
namespace {

TEST_P(RefusedFiles, AreRefusedWithPlaceAndReason) {
    const std::string message = thrown_by<InputError>(GetParam().read);
    EXPECT_THAT(message, testing::HasSubstr(GetParam().place));
    EXPECT_THAT(message, testing::HasSubstr(GetParam().what));
}

}  // namespace
}  // namespace octetra::test
