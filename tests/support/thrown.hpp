#pragma once

#include <string>

#include <gtest/gtest.h>

namespace octetra::test {

/// Returns the message of the Error that `call` throws; fails the test if it throws none.
template <class Error>
std::string thrown_by(auto&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace octetra::test
