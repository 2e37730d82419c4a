#pragma once

#include <chrono>
#include <string>

#include <octetra/verify/verify.hpp>

namespace octetra::cli {

/// Where people watch, a line that says which check is running and how far it is, once that has
/// taken a second.
class CheckProgress {
public:
    CheckProgress() = default;
    ~CheckProgress() { clear(); }
    CheckProgress(const CheckProgress&) = delete;
    CheckProgress& operator=(const CheckProgress&) = delete;
    CheckProgress(CheckProgress&&) = delete;
    CheckProgress& operator=(CheckProgress&&) = delete;

    /// What the verifier tells of its progress; nothing where stderr is no terminal. Ends with
    /// this.
    [[nodiscard]] verify::Progress listener();
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    void hear(std::string_view check, double share);

    std::string check_;
    Clock::time_point since_;
    Clock::time_point shown_;
    bool is_shown_ = false;
};

}  // namespace octetra::cli
