// Breaks long equations in TeX into several lines of an align environment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The largest number of signs of a formula on a line of a page.
inline constexpr int signs_of_a_line = 60;

/// The approximate width of a TeX formula: the number of its letters, digits and signs. Both parts
/// of a fraction count.
int width_in_signs(std::string_view formula);

/// A sum in pieces that fit on a line each, as far as its terms do. All pieces but the first begin
/// with their sign. Sums in brackets, fractions and roots stay whole, unless a long fraction is the
/// whole formula: it becomes 1 / denominator times a sum in brackets.
std::vector<std::string> broken_sum(std::string_view formula);

}  // namespace cascade
