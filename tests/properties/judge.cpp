#include "properties/judge.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <string>

#include "distributed/world.hpp"
#include "properties/simpler.hpp"

namespace octetra::properties {
namespace {

unsigned cpu_seconds() {
    const char* const seconds = std::getenv("OCTETRA_CPU_SECONDS");
    return seconds != nullptr ? static_cast<unsigned>(std::stoul(seconds)) : 120;
}

/// Starts both timers; either signal ends the program, and 0 stops them. Processor time, because on
/// a loaded machine a case may take many times as long by the clock.
void end_after(unsigned seconds) {
    const itimerval timer{.it_interval = {}, .it_value = {static_cast<time_t>(seconds), 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);
    ::alarm(10 * seconds);
}

}  // namespace

std::string judge(const Law& law, const Case& c) {
    const std::string name = running_name(law.name);
    write_finding({law.name, "the program crashed or blocked", c, test::world().size()},
                  found_folder(), name);
    end_after(cpu_seconds());
    std::string fault;
    try {
        fault = law.fault(c);
    } catch (const std::exception& error) {
        fault = std::string("an exception: ") + error.what();
    }
    end_after(0);
    remove_finding(found_folder(), name);
    return fault;
}

Finding shrunk(Finding finding) {
    const Law& law = law_named(finding.law);
    finding.refinement = simplest(finding.refinement, [&](const Case& simpler) {
        const std::string fault = judge(law, simpler);
        if (fault.empty()) return Trial::holds;
        finding.fault = fault;
        return Trial::fails;
    });
    return finding;
}

}  // namespace octetra::properties
