// Breaks long equations in TeX into several lines of an align environment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The largest width of a formula that is printed on one line, in the unit of width_in_signs().
inline constexpr int signs_of_a_line = 60;

/// The approximate width of a TeX formula: the number of its letters, digits and signs. Both the
/// numerator and the denominator of a fraction count.
int width_in_signs(std::string_view formula);

/// A sum, broken into pieces. Each piece fits on a line, unless it is a single term that is longer.
/// Every piece except the first begins with a plus or minus sign. Sums in brackets, fractions and
/// roots are not broken, with one exception: if the whole formula is a long fraction, it becomes 1
/// / denominator times a sum in brackets.
std::vector<std::string> broken_sum(std::string_view formula);

}  // namespace cascade
