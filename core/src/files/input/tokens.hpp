#pragma once

#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"

namespace octetra {

/// The file as a sequence of tokens that ignores line ends.
class Tokens {
public:
    explicit Tokens(LineReader& reader) : reader_(&reader), fields_(reader, {}) {}

    /// Moves to the line of the next token. Returns false at the end of the file.
    bool advance() {
        if (!fields_.at_end()) return true;
        if (!reader_->next()) return false;
        fields_ = Fields(*reader_);
        return true;
    }

    /// Returns the next token verbatim; empty at the end of the file.
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

    /// Moves to the line of the next token. Throws InputError if the file ends before it.
    void require(std::string_view what) {
        if (!advance()) reader_->fail(fmt::format("the file ends where {} should be", what));
    }
    /// Returns whether the last token was the last one on its line.
    [[nodiscard]] bool at_line_end() const { return fields_.at_end(); }
    /// Skips the rest of the reader's current line, which was not read through this object.
    void skip_line() { fields_ = Fields(*reader_, {}); }

private:
    LineReader* reader_;
    Fields fields_;
};

}  // namespace octetra
