// Advice for newcomers who write commands of LaTeX, or units and other characters after numbers.
#pragma once

#include <string>
#include <string_view>

namespace cascade {

/// A command of LaTeX, or an operator of LaTeX and its operand.
struct LatexText {
    std::size_t size = 0;  ///< The size of the LaTeX text in bytes, without the backslash.
    std::string advice;
};
/// The command of LaTeX with which a text begins. The backslash before the command is not in the
/// text. If the command is an operator of derivatives with a simple operand, such as \nabla^2 u,
/// \nabla \cdot J or \Delta (u + v), the result includes the operand.
LatexText latex_text(std::string_view text);

/// Advice on a word after a number that looks like a unit but is not one, as in "20 steps" or "5
/// C". Empty for units and for other words.
std::string advice_about_unit(std::string_view number, std::string_view unit);

/// Advice on a number that is directly followed by `tail`, as in 2u, 1e, 1cm, 0x10, or 100x100 (the
/// size of a screen). `tail` must not be empty. The result is empty if there is no advice.
std::string advice_about_number(std::string_view number, std::string_view tail);

/// Advice on a line that begins with a colour as web pages write it, #ff8000 or #f80. Cascade reads
/// such a line as a comment. Empty for other lines.
std::string advice_about_hex_colour(std::string_view line);

}  // namespace cascade
