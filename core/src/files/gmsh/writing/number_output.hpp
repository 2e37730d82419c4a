#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "files/output/output_file.hpp"
#include "files/output/text_row.hpp"

namespace octetra::gmsh {

/// Writes numbers as text or binary. A row is a line in text, and has no representation in a binary
/// file.
class NumberOutput {
public:
    NumberOutput(OutputFile& out, bool is_text) : out_(&out), is_text_(is_text) {}

    [[nodiscard]] bool is_text() const { return is_text_; }

    /// Writes a number; in a binary file it has the size of its type.
    template <class T>
    requires std::same_as<T, std::int32_t> || std::same_as<T, std::uint64_t> ||
        std::same_as<T, double>
    void put(T number) {
        if (!is_text_) return out_->put_bytes(&number, sizeof number);
        if (!is_row_start_) out_->put(' ');
        is_row_start_ = false;
        out_->put(number);
    }
    /// Writes a row of numbers of one type.
    template <class T, std::size_t N>
    requires(N <= 8) void put_row(const std::array<T, N>& row) {
        if (!is_text_) return out_->put_bytes(row.data(), sizeof row);
        TextRow text(*out_);
        for (const T number : row) text.put(number);
        text.end();
    }
    void end_row() {
        if (is_text_) out_->put('\n');
        is_row_start_ = true;
    }
    void put_text(std::string_view text) { out_->put(text); }
    /// Writes "$EndNodes" etc. after numbers.
    void end_section(std::string_view name) {
        if (!is_text_) out_->put('\n');
        out_->put(std::string_view{"$End"});
        out_->put(name);
        out_->put('\n');
    }

private:
    OutputFile* out_;
    bool is_text_;
    bool is_row_start_ = true;
};

}  // namespace octetra::gmsh
