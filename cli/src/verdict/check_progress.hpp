#pragma once

#include <chrono>
#include <string>

#include <octetra/verify/verify.hpp>

namespace octetra::cli {

/// On a terminal, a line with the running check and its progress, after it has run for a second.
class CheckProgress {
public:
    CheckProgress() = default;
    ~CheckProgress() { clear(); }
    CheckProgress(const CheckProgress&) = delete;
    CheckProgress& operator=(const CheckProgress&) = delete;
    CheckProgress(CheckProgress&&) = delete;
    CheckProgress& operator=(CheckProgress&&) = delete;

    /// Returns the callback for the verifier; empty if stderr is not a terminal. Valid during the
    /// lifetime of the object.
    [[nodiscard]] verify::Progress progress_callback();
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    void show(std::string_view check, double share);

    std::string check_;
    Clock::time_point since_;
    Clock::time_point shown_;
    bool is_shown_ = false;
};

}  // namespace octetra::cli
