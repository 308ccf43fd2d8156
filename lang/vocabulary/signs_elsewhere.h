// Advice on commands of LaTeX, and on units and other characters after numbers, which newcomers
// bring along.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// Advice on a command of LaTeX by its name without the backslash, or on a backslash alone if the
/// name is empty.
std::string advice_about_latex(std::string_view command);

/// Advice on a unit directly after a number, "1cm": the number in metres or seconds. Empty if it is
/// no unit.
std::string advice_about_unit(std::string_view number, std::string_view unit);

/// Advice on a number directly followed by `tail`, which is not empty: 2u, 1e, 1cm, 0x10, or
/// 100x100 as of screens. May be empty.
std::string advice_about_number(std::string_view number, std::string_view tail);

/// Advice on a line that begins with a colour of web pages, #ff8000 or #f80, which is a comment
/// here. Empty if it does not.
std::string advice_about_hex_colour(std::string_view line);

}  // namespace cascade
