#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// The patterns by which a refinement step cuts cells, one byte each, as stored in checkpoints.
namespace octetra {

/// The pattern of a cell in a step, in seven bits. Bits 0 to 5 are the bisected edges, in the order
/// of cell_edges; bit 6 is set if they make one more child than the number of edges plus one, as
/// when the longest edge and its opposite are both bisected. 0: the cell is not cut.
using Cut = std::uint8_t;

inline constexpr Cut cut_edges = 0b0111111;
inline constexpr Cut one_child_more = 0b1000000;

/// Returns the number of cells into which a cell is cut; 1 if it is not cut.
[[nodiscard]] std::size_t child_count_of(Cut cut);

/// A run of consecutive cells with equal cuts.
struct CutRun {
    Cut cut = 0;
    std::uint64_t count = 0;

    friend bool operator==(const CutRun&, const CutRun&) = default;
};

/// The cuts of consecutive cells, run-length encoded. A byte below 128 is the cut of one cell. Any
/// other byte is 128 plus the cut of several cells; it is followed by their number minus 2, encoded
/// as by append_number().
class CutRuns {
public:
    /// Appends the cut of `count` cells; in the order of the cells.
    void append(Cut cut, std::uint64_t count = 1);
    /// To be called after the last append().
    void finish() { write_run(); }
    void clear() { bytes_.clear(); }

    [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

    friend bool operator==(const CutRuns&, const CutRuns&) = default;

private:
    void write_run();

    std::vector<std::uint8_t> bytes_;
    Cut cut_ = 0;  ///< of the run that is not yet encoded
    std::uint64_t count_ = 0;
};

/// Decodes runs one by one. The bytes may be invalid; this is detected.
class CutReader {
public:
    explicit CutReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    /// Returns the next run; its count is 0 if the bytes are invalid.
    [[nodiscard]] CutRun next();

private:
    std::span<const std::uint8_t> rest_;
};

/// Calls visit(cut, count) for each run of finished cuts.
void for_each_run(const CutRuns& runs, auto&& visit) {
    for (CutReader reader(runs.bytes()); !reader.at_end();) {
        const CutRun run = reader.next();
        visit(run.cut, run.count);
    }
}

/// Appends a number in an encoding of variable length: seven bits a byte, the lowest first, with
/// the eighth bit set in all but the last byte.
void append_number(std::uint64_t number, std::vector<std::uint8_t>& bytes);
/// Removes a number from the front. Returns false if there is none that fits into 64 bits.
[[nodiscard]] bool take_number(std::span<const std::uint8_t>& bytes, std::uint64_t& number);

}  // namespace octetra
