#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

/// TetGen runs in a child process, because it prints, and may crash on a surface that it cannot
/// fill. The child has no output and sends the mesh through a pipe. Its exit status or signal
/// determines the error message.
namespace octetra::generator {

/// The child's end of the pipe to its parent.
class ToParent {
public:
    explicit ToParent(int file) : file_(file) {}

    template <class T>
    void send(const T* items, std::size_t count) const {
        send(std::as_bytes(std::span(items, count)));
    }
    /// Ends the process if the parent has closed its end.
    void send(std::span<const std::byte> bytes) const;

private:
    int file_;
};

struct ChildResult {
    std::vector<std::byte> sent;
    int exit_status = 0;  ///< result of `work`, if the child ended normally
    int signal = 0;       ///< signal that ended it, or 0
};

/// Runs `work` in a forked copy of this process, with output discarded, and waits for it. Throws
/// SystemError if the process cannot be created.
[[nodiscard]] ChildResult run_in_child(const std::function<int(ToParent&)>& work);

}  // namespace octetra::generator
