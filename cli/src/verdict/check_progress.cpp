#include "verdict/check_progress.hpp"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

namespace octetra::cli {

verify::Progress CheckProgress::progress_callback() {
    if (::isatty(STDERR_FILENO) == 0) return {};
    return [this](std::string_view check, double share) { show(check, share); };
}

void CheckProgress::clear() {
    if (is_shown_) fmt::print(stderr, "\r{:60}\r", "");
    std::fflush(stderr);
    is_shown_ = false;
}

void CheckProgress::show(std::string_view check, double share) {
    constexpr std::chrono::seconds silent{1};
    constexpr std::chrono::milliseconds between{100};
    const auto now = Clock::now();
    if (check != check_) {
        clear();
        check_ = check;
        since_ = now;
    }
    if (now - since_ < silent || now - shown_ < between) return;
    fmt::print(stderr, "\r{:60}", fmt::format("{}: {:.0f} %", check_, 100 * share));
    std::fflush(stderr);
    shown_ = now;
    is_shown_ = true;
}

}  // namespace octetra::cli
