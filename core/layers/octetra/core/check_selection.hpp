#pragma once

#include <string_view>

#include <octetra/core/selection.hpp>

/// Are the numbers of a criterion such that it can be meant? Each function throws InputError where
/// they are not. Messages begin with `name` and end with `text`: an option of the command line and
/// its value there, a member of Selection and its numbers elsewhere.
namespace octetra {

/// Finite numbers, and a radius of at least 0.
void check(const Sphere& sphere, std::string_view name, std::string_view text);
/// Finite numbers, none of the low corner greater than that of the high corner.
void check(const Box& box, std::string_view name, std::string_view text);
/// From 0 to 1; if not 0, of a size that has all its digits.
void check(const RandomShare& share, std::string_view name);

/// All criteria of a selection, the greatest volume among them: a number of at least 0. Not
/// collective.
void check(const Selection& selection);

}  // namespace octetra
