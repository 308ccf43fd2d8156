// Advice for newcomers who write commands of LaTeX, or units and other characters after numbers.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// Advice on a command of LaTeX. `command` is its name without the backslash, empty for a backslash
/// alone.
std::string advice_about_latex(std::string_view command);

/// Advice on a unit directly after a number, as in "1cm". The advice states the number converted to
/// metres or seconds. Empty if the text is not a unit.
std::string advice_about_unit(std::string_view number, std::string_view unit);

/// Advice on a number that is directly followed by `tail`, as in 2u, 1e, 1cm, 0x10, or in 100x100
/// (the size of a screen). `tail` must not be empty. The advice may be empty.
std::string advice_about_number(std::string_view number, std::string_view tail);

/// Advice on a line that begins with a colour of web pages, #ff8000 or #f80. Such a line is a
/// comment in Cascade. Empty for other lines.
std::string advice_about_hex_colour(std::string_view line);

}  // namespace cascade
