#include <octetra/distributed/agreement.hpp>

#include <exception>
#include <new>
#include <string>

#include <octetra/core/error.hpp>

namespace octetra::distributed {
namespace {

enum class Outcome : char { done, bad_input, system_failed };

Outcome run(const std::function<void()>& work, std::string& what) {
    try {
        work();
        return Outcome::done;
    } catch (const InputError& error) {
        what = error.what();
        return Outcome::bad_input;
    } catch (const std::bad_alloc&) {
        what = "out of memory";
        return Outcome::system_failed;
    } catch (const std::exception& error) {
        what = error.what();
        return Outcome::system_failed;
    }
}

}  // namespace

void on_first(const Communicator& processes, const std::function<void()>& work) {
    std::vector<char> message{static_cast<char>(Outcome::done)};
    if (processes.is_first()) {
        std::string what;
        message.front() = static_cast<char>(run(work, what));
        message.insert(message.end(), what.begin(), what.end());
    }
    processes.broadcast(message);
    const std::string what(message.begin() + 1, message.end());
    switch (Outcome{message.front()}) {
        case Outcome::done: return;
        case Outcome::bad_input: throw InputError(what);
        case Outcome::system_failed: throw SystemError(what);
    }
}

}  // namespace octetra::distributed
