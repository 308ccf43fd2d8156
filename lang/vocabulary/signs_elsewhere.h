// Advice on commands of LaTeX and units after numbers, which newcomers bring along.
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

}  // namespace cascade
