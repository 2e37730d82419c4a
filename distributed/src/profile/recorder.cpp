#include "profile/recorder.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>

namespace octetra::distributed {

Profile::Profile(ProfileDetail detail, ProfileClock clock)
    : keeps_spans_(detail == ProfileDetail::spans), clock_(clock) {
    open_.push_back({.record = record_of("rest", 0)});
}

Profile::Nanoseconds Profile::now() const {
    timespec time{};
    ::clock_gettime(clock_ == ProfileClock::wall ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID,
                    &time);
    return Nanoseconds{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::size_t Profile::record_of(std::string_view name, int level) {
    for (std::size_t r = 0; r < records_.size(); ++r) {
        if (records_[r].level == level && records_[r].name == name) return r;
    }
    records_.push_back({.name = name.data(), .level = level});
    return records_.size() - 1;
}

Profile::Nanoseconds Profile::add_elapsed() {
    const Nanoseconds passed = now() - start_;
    (communicates_ ? current().communicating : current().computing) += passed - attributed_;
    attributed_ = passed;
    return passed;
}

void Profile::begin_span(const char* name, Nanoseconds now, bool is_communication) {
    Span& span = spans_.emplace_back();
    const std::string_view text(name);
    std::ranges::copy(text.substr(0, span.name.size() - 1), span.name.begin());
    span.begin_nanoseconds = now;
    span.level = current().level;
    span.is_communication = is_communication;
}

void Profile::begin_phase(const char* name, int level) {
    const Nanoseconds now = add_elapsed();
    open_.push_back({.record = record_of(name, level), .span = spans_.size()});
    if (keeps_spans_) begin_span(name, now, false);
}

void Profile::end_phase() {
    const Nanoseconds now = add_elapsed();
    if (keeps_spans_) {
        Span& span = spans_[open_.back().span];
        span.nanoseconds = now - span.begin_nanoseconds;
    }
    open_.pop_back();
}

void Profile::begin_communication(const char* name) {
    const Nanoseconds now = add_elapsed();
    communicates_ = true;
    if (!keeps_spans_) return;
    begin_span(name, now, true);
    counts_before_ = counts();
}

void Profile::end_communication() {
    const Nanoseconds now = add_elapsed();
    communicates_ = false;
    if (!keeps_spans_) return;
    Span& span = spans_.back();
    span.nanoseconds = now - span.begin_nanoseconds;
    span.messages = counts().messages - counts_before_.messages;
    span.bytes = counts().bytes - counts_before_.bytes;
}

void Profile::note_cells(int level, std::uint64_t cells, std::uint64_t touched) {
    levels_.push_back(
        {.level = level, .cells = cells, .touched = touched, .peak_memory = peak_memory()});
}

void Profile::finish() {
    if (open_.size() != 1) throw std::logic_error("a profile is gathered while a phase is open");
    (void)add_elapsed();
}

std::uint64_t peak_memory() {
    std::ifstream status("/proc/self/status");
    const std::string beginning = "VmHWM:";
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(beginning)) return std::stoull(line.substr(beginning.size())) * 1024;
    }
    return 0;
}

}  // namespace octetra::distributed
