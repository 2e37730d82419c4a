#pragma once

#include <string>

#include <fmt/format.h>

#include <octetra/core/process_group.hpp>
#include <octetra/verify/verify.hpp>

namespace octetra::verify {

/// Collective in the group. Throws InputError on all processes if two pass different options:
/// checks are collective, so processes that run different checks would wait for each other.
inline void check_same_options(const ProcessGroup& group, const VerifyOptions& options) {
    group.check_same("option fast", options.fast ? "true" : "false");
    group.check_same("option min_dihedral", options.min_dihedral
                                                ? fmt::format("{}", *options.min_dihedral)
                                                : std::string("none"));
    group.check_same("option request",
                     options.request
                         ? fmt::format("{} levels of scheme {}", options.request->levels,
                                       static_cast<int>(options.request->scheme))
                         : std::string("none"));
    group.check_same("option closure",
                     options.closure == Closure::regular ? "regular" : "longest-edge");
    group.check_same("option maps", options.maps != nullptr ? "given" : "none");
}

}  // namespace octetra::verify
