#pragma once

#include <string_view>

#include <octetra/core/selection.hpp>

/// Checks the numbers of criteria. Each function throws InputError if they are invalid. Messages
/// begin with `name` and end with `text`: an option of the command line and its value there, a
/// member of Selection and its numbers elsewhere.
namespace octetra {

/// Requires finite numbers and a radius of at least 0.
void check(const Sphere& sphere, std::string_view name, std::string_view text);
/// Requires finite numbers, none of the low corner greater than that of the high corner.
void check(const Box& box, std::string_view name, std::string_view text);
/// Requires a fraction from 0 to 1 that is not denormal.
void check(const RandomShare& share, std::string_view name);

/// Checks all criteria of a selection, including its greatest volume, a number of at least 0. Not
/// collective.
void check(const Selection& selection);

}  // namespace octetra
