#pragma once

#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"

namespace octetra {

/// The file as a sequence of tokens that goes on over line ends.
class Tokens {
public:
    explicit Tokens(LineReader& reader) : reader_(&reader), fields_(reader, {}) {}

    /// The next token as it stands; empty at the end of the file.
    std::string_view text() { return advance() ? fields_.text() : std::string_view{}; }
    std::uint64_t unsigned_integer(std::string_view what) {
        require(what);
        return fields_.unsigned_integer(what);
    }
    std::int32_t marker(std::string_view what) {
        require(what);
        return fields_.marker(what);
    }
    double real(std::string_view what) {
        require(what);
        return fields_.real(what);
    }
    double coordinate(std::string_view what) {
        require(what);
        return fields_.coordinate(what);
    }

    /// Goes to the line that the next token is on. The file must not end before it.
    void require(std::string_view what) {
        if (!advance()) reader_->fail(fmt::format("the file ends where {} should be", what));
    }
    /// Is no token left on the line of the last one?
    [[nodiscard]] bool at_line_end() const { return fields_.at_end(); }
    /// Goes on behind the line on which the reader is, which was not read by tokens.
    void leave_line() { fields_ = Fields(*reader_, {}); }

private:
    bool advance() {
        if (!fields_.at_end()) return true;
        if (!reader_->next()) return false;
        fields_ = Fields(*reader_);
        return true;
    }

    LineReader* reader_;
    Fields fields_;
};

}  // namespace octetra
