#include "files/shares/keyword_scan.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>

#include "files/input/fields.hpp"
#include "files/input/input_file.hpp"
#include "files/input/line_reader.hpp"
#include "files/shares/gather.hpp"
#include "files/shares/shares.hpp"

namespace octetra {
namespace {

constexpr std::size_t max_keywords = 1000;

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/// Finds the lines whose first character after blanks is a letter.
class KeywordScan {
public:
    /// `position`: of the first byte in the file, which begins a line.
    explicit KeywordScan(std::uint64_t position) : position_(position), line_(position) {}

    void scan_bytes(const char* bytes, std::size_t size) {
        const char* const end = bytes + size;
        const bool has_mark =
            position_ == 0 && std::string_view(bytes, size).starts_with(byte_order_mark);
        for (const char* at = has_mark ? bytes + byte_order_mark.size() : bytes; at != end;) {
            if (!is_in_line_) {
                while (at != end && is_blank(*at)) ++at;
                if (at == end) break;
                if (is_letter(*at)) take_line();
                is_in_line_ = true;
            }
            const auto* newline =
                static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at)));
            if (newline == nullptr) break;
            at = newline + 1;
            ++lines_;
            is_in_line_ = false;
            line_ = position_ + static_cast<std::uint64_t>(at - bytes);
        }
        position_ += size;
    }

    /// The lines found, numbered from 0 at the beginning of the scan, and the number of line ends.
    [[nodiscard]] const std::vector<NumberedLine>& found() const { return found_; }
    [[nodiscard]] std::uint64_t lines() const { return lines_; }

private:
    void take_line() {
        if (found_.size() == max_keywords) throw std::length_error("too many keywords");
        found_.push_back({line_, lines_});
    }

    std::uint64_t position_;
    std::uint64_t line_;
    bool is_in_line_ = false;
    std::uint64_t lines_ = 0;
    std::vector<NumberedLine> found_;
};

/// Returns the keywords of a share; the last element has the number of lines of the share.
std::vector<NumberedLine> keywords_in(const std::filesystem::path& path, const FileRange& share) {
    const InputFile file(path);
    KeywordScan scan(share.begin);
    std::vector<char> bytes(std::min<std::uint64_t>(std::uint64_t{1} << 18U, share.size()));
    for (std::uint64_t at = share.begin; at < share.end; at += bytes.size()) {
        const auto size = std::min<std::uint64_t>(bytes.size(), share.end - at);
        file.read(at, bytes.data(), size);
        scan.scan_bytes(bytes.data(), size);
    }
    std::vector<NumberedLine> found = scan.found();
    found.push_back({share.end, scan.lines()});
    return found;
}

}  // namespace

std::vector<NumberedLine> scan_for_keywords(const ProcessGroup& group,
                                            const std::filesystem::path& path,
                                            std::uint64_t file_size) {
    const FileRange share = share_of_lines(path, {0, file_size}, group.rank(), group.size());
    const std::vector<NumberedLine> found = keywords_in(path, share);
    std::vector<NumberedLine> keywords;
    std::uint64_t lines_before = 0;
    for (const auto& of_share : gather_lists(group, std::span<const NumberedLine>(found))) {
        for (std::size_t k = 0; k + 1 < of_share.size(); ++k) {
            keywords.push_back({of_share[k].position, lines_before + of_share[k].number + 1});
        }
        lines_before += of_share.back().number;
    }
    if (keywords.size() > max_keywords) throw std::length_error("too many keywords");
    return keywords;
}

}  // namespace octetra
