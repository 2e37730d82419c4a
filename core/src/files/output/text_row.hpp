#pragma once

#include <cstddef>

#include "files/output/number_text.hpp"
#include "files/output/output_file.hpp"

namespace octetra {

/// A line of numbers separated by spaces. Space in the file is requested for eight numbers at a
/// time: the caller must call reserve_more() before the ninth, and so on.
class TextRow {
public:
    explicit TextRow(OutputFile& out) : out_(&out), place_(out.room_for(max_bytes)) {}

    void put(auto number) {
        if (!is_empty_) *place_++ = ' ';
        is_empty_ = false;
        place_ = put_number(place_, number);
    }
    void reserve_more() {
        out_->put_up_to(place_);
        place_ = out_->room_for(max_bytes);
    }
    /// To be called once, after the last number.
    void end() {
        *place_++ = '\n';
        out_->put_up_to(place_);
    }

private:
    static constexpr std::size_t max_bytes = 8 * (1 + longest_number) + 1;

    OutputFile* out_;
    char* place_;
    bool is_empty_ = true;
};

/// Writes a line of at most eight numbers.
void put_line(OutputFile& out, auto... numbers) {
    static_assert(sizeof...(numbers) <= 8);
    TextRow row(out);
    (row.put(numbers), ...);
    row.end();
}

}  // namespace octetra
