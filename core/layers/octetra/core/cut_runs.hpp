#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// How a refinement step cuts cells, one byte each, as checkpoints have it.
namespace octetra {

/// What a step did to a cell, in seven bits: bits 0 to 5 are the edges that it bisected, in the
/// order of cell_edges; bit 6 is set where these made one child more than there are edges and one,
/// as they do where the longest and its opposite are both among them. 0: the cell stayed whole.
using Cut = std::uint8_t;

inline constexpr Cut cut_edges = 0b0111111;
inline constexpr Cut one_child_more = 0b1000000;

/// The cells that one of them is cut into; 1 if it stays whole.
[[nodiscard]] std::size_t child_count_of(Cut cut);

/// Cells that follow each other and are cut alike.
struct CutRun {
    Cut cut = 0;
    std::uint64_t count = 0;

    friend bool operator==(const CutRun&, const CutRun&) = default;
};

/// The cuts of cells that follow each other, run-length coded. A byte below 128 is one cell's cut;
/// another is that of several, less 128, and their number less 2 follows: seven bits a byte, the
/// lowest first, with the eighth bit set in all but the last.
class CutRuns {
public:
    /// One by one, or many at once; in the order of the cells.
    void append(Cut cut, std::uint64_t count = 1);
    /// After the last.
    void finish() { write_run(); }
    void clear() { bytes_.clear(); }

    [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

    friend bool operator==(const CutRuns&, const CutRuns&) = default;

private:
    void write_run();

    std::vector<std::uint8_t> bytes_;
    Cut cut_ = 0;  ///< of a run that is not yet among the bytes
    std::uint64_t count_ = 0;
};

/// Reads runs one by one. The bytes may be anything: what is no run is found.
class CutReader {
public:
    explicit CutReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    /// The next run; of no cells where what is there is none.
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

/// A number in as few bytes as it takes: seven bits a byte, the lowest first, with the eighth bit
/// set in all but the last.
void append_number(std::uint64_t number, std::vector<std::uint8_t>& bytes);
/// Takes one from the front; false where there is none that 64 bits hold.
[[nodiscard]] bool take_number(std::span<const std::uint8_t>& bytes, std::uint64_t& number);

}  // namespace octetra
