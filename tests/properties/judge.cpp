#include "properties/judge.hpp"

#include <unistd.h>

#include <exception>

#include "properties/case_files.hpp"

namespace octetra::properties {

std::string judge(const Law& law, const Case& c) {
    constexpr unsigned seconds = 120;
    const std::string name = law.name + "-running-" + std::to_string(::getpid());
    write_finding({law.name, "the program died, or waited for ever", c}, found_folder(), name);
    ::alarm(seconds);
    std::string fault;
    try {
        fault = law.fault(c);
    } catch (const std::exception& error) {
        fault = std::string("an exception: ") + error.what();
    }
    ::alarm(0);
    remove_finding(found_folder(), name);
    return fault;
}

}  // namespace octetra::properties
